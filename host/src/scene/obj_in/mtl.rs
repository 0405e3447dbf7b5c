//! MTL libraries.

use std::collections::HashMap;
use std::path::Path;
use std::rc::Rc;

use super::super::error::SceneError;
use super::super::mean_picture::{Encoding, Mean, Pictures};
use super::super::model::Material;
use super::super::notes::{Notes, Place};
use super::beside;
use super::lines::{Lines, numbers, split};

/// What a library says of a material.
#[derive(Clone, Debug, Default)]
struct Entry {
    diffuse: Option<[f32; 3]>,
    diffuse_map: Option<Mean>,
    specular: [f32; 3],
    exponent: Option<f32>,
    emission: Option<[f32; 3]>,
    emission_map: Option<Mean>,
    dissolve: Option<f32>,
    transparency: Option<f32>,
    illumination: i32,
    roughness: Option<f32>,
    metallic: f32,
}

/// Materials by name, and the pictures that they share.
#[derive(Debug, Default)]
pub(super) struct Library {
    pub materials: HashMap<String, Material>,
    pictures: Pictures,
}

impl Library {
    /// Adds the materials of a file; the first one of a name stays.
    pub fn read(
        &mut self,
        file: &str,
        bytes: &[u8],
        folder: Option<&Path>,
        notes: &mut Notes,
    ) -> Result<(), SceneError> {
        let place_file: Rc<str> = file.into();
        let mut open: Option<(String, Entry)> = None;
        for (line, text) in Lines::new(bytes) {
            let (word, rest) = split(&text);
            if word == "newmtl" {
                self.close(open.replace((rest.to_owned(), Entry::default())));
                continue;
            }
            let Some((_, entry)) = &mut open else { continue };
            let place = Place {
                file: Rc::clone(&place_file),
                line,
            };
            match word {
                "Kd" => entry.diffuse = color(file, line, rest, &place, notes)?,
                "Ks" => entry.specular = color(file, line, rest, &place, notes)?.unwrap_or_default(),
                "Ke" => entry.emission = color(file, line, rest, &place, notes)?,
                "Ns" => entry.exponent = Some(numbers::<1>(file, line, rest)?[0]),
                "Pr" => entry.roughness = Some(numbers::<1>(file, line, rest)?[0]),
                "Pm" => entry.metallic = numbers::<1>(file, line, rest)?[0],
                "d" => {
                    let rest = rest.strip_prefix("-halo").unwrap_or(rest);
                    entry.dissolve = Some(numbers::<1>(file, line, rest)?[0]);
                }
                "Tr" => entry.transparency = Some(numbers::<1>(file, line, rest)?[0]),
                "illum" => entry.illumination = numbers::<1>(file, line, rest)?[0] as i32,
                "map_Kd" => entry.diffuse_map = self.picture(rest, folder, &place, notes),
                "map_Ke" | "map_ke" => {
                    entry.emission_map = self.picture(rest, folder, &place, notes);
                    if entry.emission_map.is_none() {
                        // What is known to glow somewhere is not taken to glow everywhere.
                        entry.emission_map = Some(Mean {
                            rgb: [0.0; 3],
                            alpha: 1.0,
                        });
                    }
                }
                "map_d" | "map_Ks" | "map_Ns" | "map_Pr" | "map_Pm" | "map_Bump" | "map_bump" | "bump"
                | "norm" | "disp" | "map_Ka" | "refl" => {
                    notes.add(&place, format!("textures by `{word}` are left out"));
                }
                _ => {}
            }
        }
        self.close(open);
        Ok(())
    }

    fn close(&mut self, entry: Option<(String, Entry)>) {
        if let Some((name, entry)) = entry {
            let material = entry.material(&name);
            self.materials.entry(name).or_insert(material);
        }
    }

    /// The mean of a map, whose name comes after its options.
    fn picture(
        &mut self,
        rest: &str,
        folder: Option<&Path>,
        place: &Place,
        notes: &mut Notes,
    ) -> Option<Mean> {
        let name = map_name(rest).replace('\\', "/");
        let Some(folder) = folder else {
            notes.add(place, "pictures are left out, as there is no folder to look in");
            return None;
        };
        match self.pictures.mean(&beside(folder, &name), Encoding::Srgb) {
            Ok(mean) => {
                notes.add(place, "textures are replaced by their mean colours");
                Some(mean)
            }
            Err(problem) => {
                notes.add(
                    place,
                    format!("a picture counts as white, and where it is what glows as black: {problem}"),
                );
                None
            }
        }
    }
}

/// A color; spectral curves and CIEXYZ are left out.
fn color(
    file: &str,
    line: u32,
    rest: &str,
    place: &Place,
    notes: &mut Notes,
) -> Result<Option<[f32; 3]>, SceneError> {
    if rest.starts_with("spectral") || rest.starts_with("xyz") {
        notes.add(
            place,
            "colours by `spectral` or `xyz` are left out; write them as RGB",
        );
        return Ok(None);
    }
    // One number stands for all three channels.
    let one = rest.split_ascii_whitespace().count() == 1;
    let rgb = if one {
        [numbers::<1>(file, line, rest)?[0]; 3]
    } else {
        numbers::<3>(file, line, rest)?
    };
    Ok(Some(rgb))
}

/// The file of a map, after options as `-s 1 1 1` and `-clamp on`; names may have spaces.
fn map_name(rest: &str) -> &str {
    let mut rest = rest.trim();
    while rest.starts_with('-') {
        let (_, after) = split(rest);
        rest = after;
        loop {
            let (word, after) = split(rest);
            let is_value = word.parse::<f32>().is_ok() || matches!(word, "on" | "off");
            if !is_value || after.is_empty() {
                break;
            }
            rest = after;
        }
    }
    rest
}

impl Entry {
    fn material(&self, name: &str) -> Material {
        let unit = |x: f32| x.clamp(0.0, 1.0);
        let luminance = |[r, g, b]: [f32; 3]| 0.2126 * r + 0.7152 * g + 0.0722 * b;
        let mut base = self.diffuse.unwrap_or([0.8; 3]);
        if let Some(map) = self.diffuse_map {
            // Exporters write black beside a map that says all.
            if base == [0.0; 3] {
                base = [1.0; 3];
            }
            base = [0, 1, 2].map(|i| base[i] * map.rgb[i] as f32);
        }
        let mut metallic = unit(self.metallic);
        let is_mirror = matches!(self.illumination, 3 | 5) && luminance(self.specular) > luminance(base);
        if is_mirror {
            (base, metallic) = (self.specular, 1.0);
        }
        // The exponent of Walter et al. 2007, section 5.2, as of `Material::surface`: n = 2/α² - 2.
        let of_exponent = |n: f32| (2.0 / (n.max(0.0) + 2.0)).sqrt().sqrt();
        let is_glossy = self.illumination != 1 && luminance(self.specular) > 0.0;
        let roughness = match (self.roughness, self.exponent) {
            (Some(roughness), _) => roughness,
            (None, Some(exponent)) if is_glossy => of_exponent(exponent),
            (None, None) if is_mirror => 0.0,
            _ => 1.0,
        };
        let is_glass = matches!(self.illumination, 4 | 6 | 7 | 9);
        let transmission = match (self.dissolve, self.transparency) {
            _ if is_glass => 1.0,
            (Some(dissolve), _) => 1.0 - dissolve,
            (None, Some(transparency)) => transparency,
            (None, None) => 0.0,
        };
        let mut radiance = self.emission.unwrap_or([0.0; 3]);
        if let Some(map) = self.emission_map {
            if radiance == [0.0; 3] {
                radiance = [1.0; 3];
            }
            radiance = [0, 1, 2].map(|i| radiance[i] * map.rgb[i] as f32);
        }
        Material {
            name: name.to_owned(),
            base_color: base.map(unit),
            radiance,
            metallic,
            roughness: unit(roughness),
            transmission: unit(transmission),
            ..Material::default()
        }
    }
}

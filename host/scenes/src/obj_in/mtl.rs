//! MTL libraries.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::rc::Rc;

use super::super::check::MAX_TEXTURE_COORDINATE;
use super::super::error::SceneError;
use super::super::files::Load;
use super::super::glow::{Glow, Glows};
use super::super::model::Material;
use super::super::notes::{Notes, Place};
use super::super::paint::{Opacity, Paint, Picture, Texture, Wrap};
use super::beside;
use super::lines::{Lines, numbers, split};
use super::pictures::{Kept, Mean, Pictures};

/// A picture, its mean, and where it lies.
#[derive(Clone, Debug)]
struct Map {
    path: PathBuf,
    mean: Mean,
    placing: Placing,
}

/// Options of a map.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Placing {
    scale: [f32; 2],
    offset: [f32; 2],
    is_clamped: bool,
}

impl Placing {
    const PLAIN: Self = Self {
        scale: [1.0; 2],
        offset: [0.0; 2],
        is_clamped: false,
    };

    fn wrap(&self) -> [Wrap; 2] {
        [if self.is_clamped {
            Wrap::Clamp
        } else {
            Wrap::Repeat
        }; 2]
    }

    /// The second coordinate of the format grows upward, rows go down.
    fn transform(&self) -> [[f32; 2]; 3] {
        self.unbounded()
            .map(|column| column.map(|x| x.clamp(-MAX_TEXTURE_COORDINATE, MAX_TEXTURE_COORDINATE)))
    }

    fn unbounded(&self) -> [[f32; 2]; 3] {
        let ([sx, sy], [ox, oy]) = (self.scale, self.offset);
        [[sx, 0.0], [0.0, -sy], [ox, 1.0 - oy]]
    }

    /// Whether a scene takes its numbers as they are.
    fn is_near(&self) -> bool {
        self.transform() == self.unbounded()
    }
}

/// What a library says of a material.
#[derive(Clone, Debug, Default)]
struct Entry {
    diffuse: Option<[f32; 3]>,
    diffuse_map: Option<Map>,
    specular: [f32; 3],
    exponent: Option<f32>,
    emission: Option<[f32; 3]>,
    emission_map: Option<Map>,
    opacity_map: Option<Map>,
    dissolve: Option<f32>,
    transparency: Option<f32>,
    /// It glows by a picture that cannot be had.
    is_dark: bool,
    illumination: i32,
    roughness: Option<f32>,
    metallic: f32,
}

/// Materials by name, and the pictures that they share.
#[derive(Debug)]
pub(super) struct Library<'a> {
    pub materials: HashMap<String, Material>,
    /// What those glow by that have a picture of it, by the same names.
    pub glows: HashMap<String, Glow>,
    shared: Glows,
    pictures: Pictures<'a>,
    /// What was left out of materials since it was said last, a sentence each.
    problems: Vec<&'static str>,
}

impl<'a> Library<'a> {
    pub fn new(load: &'a Load) -> Self {
        Self {
            materials: HashMap::new(),
            glows: HashMap::new(),
            shared: Glows::default(),
            pictures: Pictures::new(load),
            problems: Vec::new(),
        }
    }

    /// The pictures that materials show.
    pub fn into_kept(self) -> Vec<Picture> {
        drop((self.glows, self.shared));
        self.pictures.into_kept()
    }

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
            let place = Place {
                file: Rc::clone(&place_file),
                line,
            };
            if word == "newmtl" {
                self.close(open.replace((rest.to_owned(), Entry::default())));
                self.note_unshown(&place, notes)?;
                continue;
            }
            let Some((_, entry)) = &mut open else { continue };
            let number = |rest: &str| numbers(file, line, rest).map(|[value]: [f32; 1]| value);
            match word {
                "Kd" => entry.diffuse = color(file, line, rest, &place, notes)?,
                "Ks" => {
                    entry.specular = color(file, line, rest, &place, notes)?.unwrap_or_default();
                }
                "Ke" => entry.emission = color(file, line, rest, &place, notes)?,
                "Ns" => entry.exponent = Some(number(rest)?),
                "Pr" => entry.roughness = Some(number(rest)?),
                "Pm" => entry.metallic = number(rest)?,
                "d" => {
                    let rest = rest.strip_prefix("-halo").unwrap_or(rest);
                    entry.dissolve = Some(number(rest)?);
                }
                "Tr" => entry.transparency = Some(number(rest)?),
                "illum" => {
                    let model = number(rest)?;
                    entry.illumination = if model.fract() == 0.0 { model as i32 } else { 0 };
                }
                "map_Kd" => entry.diffuse_map = self.picture(rest, folder, &place, notes),
                "map_Ke" | "map_ke" => {
                    entry.emission_map = self.picture(rest, folder, &place, notes);
                    // What is known to glow somewhere is not taken to glow everywhere.
                    entry.is_dark = entry.emission_map.is_none();
                }
                "map_d" => entry.opacity_map = self.picture(rest, folder, &place, notes),
                "map_Ks" | "map_Ns" | "map_Pr" | "map_Pm" | "map_Bump" | "map_bump" | "bump" | "norm"
                | "disp" | "map_Ka" | "refl" => {
                    notes.add(&place, format!("textures by `{word}` are left out"));
                }
                _ => {}
            }
        }
        self.close(open);
        let place = Place {
            file: place_file,
            line: 0,
        };
        self.note_unshown(&place, notes)
    }

    fn note_unshown(&mut self, place: &Place, notes: &mut Notes) -> Result<(), SceneError> {
        for problem in self.pictures.take_unshown() {
            notes.add(place, problem);
        }
        for problem in self.problems.drain(..) {
            notes.add(place, problem);
        }
        self.pictures.end()
    }

    fn close(&mut self, entry: Option<(String, Entry)>) {
        if let Some((name, entry)) = entry.filter(|(name, _)| !self.materials.contains_key(name)) {
            let mut material = entry.material(&name);
            material.paint = self.paint(&entry, &material);
            material.masked = material
                .paint
                .is_some_and(|paint| paint.opacity != Opacity::Opaque);
            let glow = entry
                .emission_map
                .as_ref()
                .filter(|_| entry.radiance() != [0.0; 3]);
            let glow = glow.and_then(|map| {
                let kept = self.pictures.keep(&map.path, None)?;
                let (wrap, transform) = (map.placing.wrap(), map.placing.transform());
                Some(Glow::new(kept.pixels, wrap, false, transform, &self.shared))
            });
            if let Some(glow) = glow {
                self.glows.insert(name.clone(), glow);
            }
            self.materials.insert(name, material);
        }
    }

    /// What is painted on a material, where it has pictures that are shown.
    fn paint(&mut self, entry: &Entry, material: &Material) -> Option<Paint> {
        let shown = |kept: Kept, placing: &Placing| Texture {
            picture: kept.picture,
            is_color: true,
            is_nearest: false,
            wrap: placing.wrap(),
            transform: placing.transform(),
        };
        let is_mirror = entry.is_mirror();
        let opacity = entry.opacity_map.as_ref();
        let base = entry.diffuse_map.as_ref().filter(|_| !is_mirror);
        let base_texture = base.and_then(|map| {
            let kept = self
                .pictures
                .keep(&map.path, opacity.map(|opacity| opacity.path.as_path()))?;
            Some(shown(kept, &map.placing))
        });
        let lies_alone = |opacity: &Map| base.is_some_and(|base| base.placing != opacity.placing);
        if base_texture.is_some() && opacity.is_some_and(lies_alone) {
            self.problems.push(
                "options `-s`, `-o` and `-clamp` of `map_d` that `map_Kd` does not have are left out: what is cut out lies as the colours do",
            );
        }
        let glow_texture = entry
            .emission_map
            .as_ref()
            .filter(|_| entry.radiance() != [0.0; 3])
            .and_then(|map| Some(shown(self.pictures.keep(&map.path, None)?, &map.placing)));
        let [r, g, b] = match base_texture {
            Some(_) => entry.base().map(|x| x.clamp(0.0, 1.0)),
            None => material.base_color,
        };
        let paint = Paint {
            base: [r, g, b, 1.0],
            metallic: material.metallic,
            roughness: material.roughness,
            bump: 0.0,
            radiance: entry.radiance(),
            base_texture,
            rough_texture: None,
            bump_texture: None,
            glow_texture,
            opacity: match (base_texture, opacity) {
                (Some(_), Some(_)) => Opacity::Cut(0.5),
                _ => Opacity::Opaque,
            },
            transmission: 0.0,
        };
        // Glass is left out as a whole.
        (paint.is_seen() && !material.is_clear()).then_some(paint)
    }

    /// A map, whose name comes after its options.
    fn picture(
        &mut self,
        rest: &str,
        folder: Option<&Path>,
        place: &Place,
        notes: &mut Notes,
    ) -> Option<Map> {
        let (placing, name) = map_options(rest);
        if !placing.is_near() {
            notes.add(
                place,
                "numbers of `-s` and `-o` of maps beyond 2^20 count as 2^20",
            );
        }
        let name = name.replace('\\', "/");
        let Some(folder) = folder else {
            notes.add(place, "pictures are left out, as there is no folder to look in");
            return None;
        };
        let path = beside(self.pictures.load, folder, &name);
        match self.pictures.mean(&path) {
            Ok(mean) => Some(Map { path, mean, placing }),
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

/// The options of a map, as `-s 1 1 1` and `-clamp on`, and the file after them, whose name may have spaces.
fn map_options(rest: &str) -> (Placing, &str) {
    let mut placing = Placing::PLAIN;
    let mut rest = rest.trim();
    while rest.starts_with('-') {
        let (option, mut after) = split(rest);
        // Numbers may be fewer than these; a word is one.
        let most = match option {
            "-s" | "-o" | "-t" => 3,
            "-mm" => 2,
            _ => 1,
        };
        let is_word = matches!(
            option,
            "-imfchan" | "-type" | "-colorspace" | "-blendu" | "-blendv" | "-cc" | "-clamp"
        );
        let mut values = Vec::new();
        for _ in 0..most {
            let (word, next) = split(after);
            let number = word.parse::<f32>().ok().filter(|x| x.is_finite());
            // The last word is the file.
            if next.is_empty() || !(is_word || number.is_some()) {
                break;
            }
            if option == "-clamp" {
                placing.is_clamped = word == "on";
            }
            values.extend(number);
            after = next;
        }
        // What is not there is as it was.
        let into: &mut [f32] = match option {
            "-s" => &mut placing.scale,
            "-o" => &mut placing.offset,
            _ => &mut [],
        };
        for (into, value) in into.iter_mut().zip(values) {
            *into = value;
        }
        rest = after;
    }
    (placing, rest)
}

fn luminance([r, g, b]: [f32; 3]) -> f32 {
    0.2126 * r + 0.7152 * g + 0.0722 * b
}

impl Entry {
    /// The colour that a map of it multiplies.
    fn base(&self) -> [f32; 3] {
        match self.diffuse.unwrap_or([0.8; 3]) {
            // Exporters write black beside a map that says all.
            [0.0, 0.0, 0.0] if self.diffuse_map.is_some() => [1.0; 3],
            base => base,
        }
    }

    /// The radiance that a map of it multiplies.
    fn radiance(&self) -> [f32; 3] {
        match self.emission.unwrap_or([0.0; 3]) {
            _ if self.is_dark => [0.0; 3],
            [0.0, 0.0, 0.0] if self.emission_map.is_some() => [1.0; 3],
            radiance => radiance,
        }
    }

    /// Whether it reflects as a mirror more than of its colour.
    fn is_mirror(&self) -> bool {
        let mut base = self.base();
        if let Some(map) = &self.diffuse_map {
            base = [0, 1, 2].map(|i| base[i] * map.mean[i] as f32);
        }
        matches!(self.illumination, 3 | 5) && luminance(self.specular) > luminance(base)
    }

    fn material(&self, name: &str) -> Material {
        let unit = |x: f32| x.clamp(0.0, 1.0);
        let mut base = self.base();
        if let Some(map) = &self.diffuse_map {
            base = [0, 1, 2].map(|i| base[i] * map.mean[i] as f32);
        }
        let mut metallic = unit(self.metallic);
        let is_mirror = self.is_mirror();
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
        let mut radiance = self.radiance();
        if let Some(map) = &self.emission_map {
            radiance = [0, 1, 2].map(|i| radiance[i] * map.mean[i] as f32);
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

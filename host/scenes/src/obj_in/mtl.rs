//! MTL libraries.

use std::collections::HashMap;
use std::path::Path;

use super::super::check::MAX_TEXTURE_COORDINATE;
use super::super::error::SceneError;
use super::super::files::{Load, without_mark};
use super::super::glow::{Glow, Glows};
use super::super::model::Material;
use super::super::notes::Notes;
use super::super::paint::{Opacity, Paint, Picture, Texture, Wrap};
use super::pictures::{Map, Pictures};
use super::{beside, lines, numbers, split};

/// Where a map lies, by its options.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Placing {
    scale: [f32; 2],
    offset: [f32; 2],
    is_clamped: bool,
}

impl Placing {
    fn wrap(&self) -> [Wrap; 2] {
        [if self.is_clamped {
            Wrap::Clamp
        } else {
            Wrap::Repeat
        }; 2]
    }

    /// The second coordinate of the format grows upward, rows go down.
    fn transform(&self) -> [[f32; 2]; 3] {
        let ([sx, sy], [ox, oy]) = (self.scale, self.offset);
        [[sx, 0.0], [0.0, -sy], [ox, 1.0 - oy]]
    }
}

/// What a library says of a material: by its first word the last line of it, and its number.
#[derive(Debug, Default)]
struct Entry(HashMap<String, (u32, String)>);

/// Materials by name, and the pictures that they share.
pub(super) struct Library<'a> {
    /// With what those glow by that have a picture of it.
    pub materials: HashMap<String, (Material, Option<Glow>)>,
    glows: Glows,
    pictures: Pictures<'a>,
}

/// A library that is read.
struct Reading<'r, 'a> {
    path: &'r Path,
    file: String,
    library: &'r mut Library<'a>,
    notes: &'r mut Notes,
}

impl<'a> Library<'a> {
    pub fn new(load: &'a Load) -> Self {
        Self {
            materials: HashMap::new(),
            glows: Glows::default(),
            pictures: Pictures::new(load),
        }
    }

    /// The pictures that materials show.
    pub fn into_pictures(self) -> Vec<Picture> {
        drop(self.materials);
        self.pictures.into_kept()
    }

    /// Adds the materials of a file; the first one of a name stays.
    pub fn read(&mut self, path: &Path, bytes: &[u8], notes: &mut Notes) -> Result<(), SceneError> {
        let file = path.display().to_string();
        let text = String::from_utf8_lossy(without_mark(&file, bytes)?);
        let mut reading = Reading {
            path,
            file,
            library: self,
            notes,
        };
        let mut open: Option<(String, Entry)> = None;
        for (line, text) in lines(&text) {
            let (word, rest) = split(&text);
            if word == "newmtl" {
                reading.close(open.replace((rest.to_owned(), Entry::default())))?;
                continue;
            }
            let Some((_, entry)) = &mut open else { continue };
            match word {
                "map_Ks" | "map_Ns" | "map_Pr" | "map_Pm" | "map_Bump" | "map_bump" | "bump" | "norm"
                | "disp" | "map_Ka" | "refl" => {
                    reading.note(line, format!("textures by `{word}` are left out"))
                }
                _ => {
                    let word = if word == "map_ke" { "map_Ke" } else { word };
                    entry.0.insert(word.to_owned(), (line, rest.to_owned()));
                }
            }
        }
        reading.close(open)
    }
}

impl Reading<'_, '_> {
    fn note(&mut self, line: u32, what: impl Into<String>) {
        self.notes.add(format!("{} line {line}", self.file), what);
    }

    fn number(&self, entry: &Entry, word: &str) -> Result<Option<f32>, SceneError> {
        let Some((line, rest)) = entry.0.get(word) else {
            return Ok(None);
        };
        let rest = rest.strip_prefix("-halo").unwrap_or(rest);
        numbers(&self.file, *line, rest).map(|[number]| Some(number))
    }

    /// A colour; spectral curves and CIEXYZ are left out.
    fn color(&mut self, entry: &Entry, word: &str) -> Result<Option<[f32; 3]>, SceneError> {
        let Some((line, rest)) = entry.0.get(word) else {
            return Ok(None);
        };
        if rest.starts_with("spectral") || rest.starts_with("xyz") {
            let what = "colours by `spectral` or `xyz` are left out; write them as RGB";
            self.note(*line, what);
            return Ok(None);
        }
        // One number stands for all three channels.
        if rest.split_ascii_whitespace().count() == 1 {
            return numbers(&self.file, *line, rest).map(|[one]| Some([one; 3]));
        }
        numbers(&self.file, *line, rest).map(Some)
    }

    /// A map, whose name comes after its options.
    fn map(&mut self, entry: &Entry, word: &str) -> Result<Option<Map>, SceneError> {
        let Some((line, rest)) = entry.0.get(word) else {
            return Ok(None);
        };
        let (placing, name, is_bounded) = map_options(rest);
        if is_bounded {
            let what = "numbers of `-s` and `-o` of maps beyond 2^20 count as 2^20";
            self.note(*line, what);
        }
        let folder = self.path.parent().unwrap_or(Path::new(""));
        let path = beside(self.library.pictures.load, folder, &name.replace('\\', "/"));
        match self.library.pictures.mean(&path) {
            Ok(mean) => Ok(Some(Map { path, mean, placing })),
            Err(error) if error.ends_the_load() => Err(error),
            Err(error) => {
                let what = format!("a picture counts as white, and where it is what glows as black: {error}");
                self.note(*line, what);
                Ok(None)
            }
        }
    }

    /// A map as the renderer shows it, and what glows by it.
    fn shown(&mut self, map: &Map, opacity: Option<&Map>) -> Result<Option<(Texture, Glow)>, SceneError> {
        let opacity = opacity.map(|opacity| opacity.path.as_path());
        let (picture, pixels) = match self.library.pictures.keep(&map.path, opacity) {
            Ok(Some(kept)) => kept,
            Ok(None) => {
                let what = "holds light that bytes cannot, and its mean colour is shown";
                self.notes.add(map.path.display().to_string(), what);
                return Ok(None);
            }
            Err(error) if error.ends_the_load() => return Err(error),
            Err(_) => return Ok(None),
        };
        let (wrap, transform) = (map.placing.wrap(), map.placing.transform());
        let texture = Texture {
            picture,
            is_color: true,
            is_nearest: false,
            wrap,
            transform,
        };
        let picture = (picture as usize, pixels);
        let glow = Glow::new(picture, wrap, false, transform, &self.library.glows);
        Ok(Some((texture, glow)))
    }

    fn close(&mut self, entry: Option<(String, Entry)>) -> Result<(), SceneError> {
        let new = entry.filter(|(name, _)| !self.library.materials.contains_key(name));
        let Some((name, entry)) = new else {
            return Ok(());
        };
        let diffuse_map = self.map(&entry, "map_Kd")?;
        let emission_map = self.map(&entry, "map_Ke")?;
        let opacity_map = self.map(&entry, "map_d")?;
        let illumination = self.number(&entry, "illum")?;
        let is_one_of = |models: &[f32]| illumination.is_some_and(|own| models.contains(&own));
        let unit = |x: f32| x.clamp(0.0, 1.0);
        let times = |color: [f32; 3], map: &Option<Map>| match map {
            Some(map) => [0, 1, 2].map(|i| color[i] * map.mean[i]),
            None => color,
        };
        // Exporters write black beside a map that says all.
        let or_one = |color: [f32; 3], map: &Option<Map>| match map {
            Some(_) if color == [0.0; 3] => [1.0; 3],
            _ => color,
        };
        let factor = or_one(self.color(&entry, "Kd")?.unwrap_or([0.8; 3]), &diffuse_map);
        let mut base = times(factor, &diffuse_map);
        let specular = self.color(&entry, "Ks")?.unwrap_or_default();
        // It reflects as a mirror more than of its colour.
        let is_mirror = is_one_of(&[3.0, 5.0]) && luminance(specular) > luminance(base);
        let mut metallic = unit(self.number(&entry, "Pm")?.unwrap_or(0.0));
        if is_mirror {
            (base, metallic) = (specular, 1.0);
        }
        // The exponent of Walter et al. 2007, section 5.2, as of `Material::surface`: n = 2/α² - 2.
        let of_exponent = |n: f32| (2.0 / (n.max(0.0) + 2.0)).sqrt().sqrt();
        let is_glossy = !is_one_of(&[1.0]) && luminance(specular) > 0.0;
        let roughness = match (self.number(&entry, "Pr")?, self.number(&entry, "Ns")?) {
            (Some(roughness), _) => roughness,
            (None, Some(exponent)) if is_glossy => of_exponent(exponent),
            (None, None) if is_mirror => 0.0,
            _ => 1.0,
        };
        let transmission = match (self.number(&entry, "d")?, self.number(&entry, "Tr")?) {
            _ if is_one_of(&[4.0, 6.0, 7.0, 9.0]) => 1.0,
            (Some(dissolve), _) => 1.0 - dissolve,
            (None, transparency) => transparency.unwrap_or(0.0),
        };
        let mut radiance = or_one(self.color(&entry, "Ke")?.unwrap_or_default(), &emission_map);
        if emission_map.is_none() && entry.0.contains_key("map_Ke") {
            // What is known to glow somewhere is not taken to glow everywhere.
            radiance = [0.0; 3];
        }
        let mut material = Material {
            name: name.clone(),
            base_color: base.map(unit),
            radiance: times(radiance, &emission_map),
            metallic,
            roughness: unit(roughness),
            transmission: unit(transmission),
            ..Material::default()
        };
        let [r, g, b] = material.base_color;
        let mut paint = Paint {
            base: [r, g, b, 1.0],
            metallic: material.metallic,
            roughness: material.roughness,
            radiance,
            ..Paint::PLAIN
        };
        if let Some(map) = diffuse_map.filter(|_| !is_mirror)
            && let Some((texture, _)) = self.shown(&map, opacity_map.as_ref())?
        {
            let [r, g, b] = factor.map(unit);
            (paint.base, paint.base_texture) = ([r, g, b, 1.0], Some(texture));
            if let Some(opacity) = opacity_map {
                paint.opacity = Opacity::Cut(0.5);
                material.masked = !material.is_clear();
                if opacity.placing != map.placing {
                    let what = "options `-s`, `-o` and `-clamp` of `map_d` that `map_Kd` does not have are left out: what is cut out lies as the colours do";
                    self.notes.add(self.file.as_str(), what);
                }
            }
        }
        let mut glow = None;
        if let Some(map) = emission_map.filter(|_| radiance != [0.0; 3])
            && let Some((texture, own)) = self.shown(&map, None)?
        {
            (paint.glow_texture, glow) = (Some(texture), Some(own));
        }
        // Glass is left out as a whole.
        material.paint = Some(paint).filter(|paint| paint.is_seen() && !material.is_clear());
        self.library.materials.insert(name, (material, glow));
        Ok(())
    }
}

/// The options of a map, as `-s 1 1 1` and `-clamp on`, the file after them, whose name may have spaces, and whether numbers of
/// them are bounded.
fn map_options(rest: &str) -> (Placing, &str, bool) {
    let (mut scale, mut offset, mut is_clamped) = ([1.0; 2], [0.0; 2], false);
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
        for k in 0..most {
            let (word, next) = split(after);
            let number = word.parse::<f32>().ok().filter(|x| x.is_finite());
            // The last word is the file.
            if next.is_empty() || !(is_word || number.is_some()) {
                break;
            }
            match (option, number) {
                ("-clamp", _) => is_clamped = word == "on",
                ("-s", Some(number)) if k < 2 => scale[k] = number,
                ("-o", Some(number)) if k < 2 => offset[k] = number,
                _ => {}
            }
            after = next;
        }
        rest = after;
    }
    // The transform adds one.
    let (most, near) = (MAX_TEXTURE_COORDINATE, MAX_TEXTURE_COORDINATE - 1.0);
    let placing = Placing {
        scale: scale.map(|x: f32| x.clamp(-most, most)),
        offset: offset.map(|x: f32| x.clamp(-near, near)),
        is_clamped,
    };
    (placing, rest, placing.scale != scale || placing.offset != offset)
}

fn luminance([r, g, b]: [f32; 3]) -> f32 {
    0.2126 * r + 0.7152 * g + 0.0722 * b
}

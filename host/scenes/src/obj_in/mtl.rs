//! MTL libraries, and the pictures that they name.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use image::RgbaImage;

use super::super::error::SceneError;
use super::super::files::{Load, without_mark};
use super::super::glow::{Glow, Glows};
use super::super::model::{Material, emits};
use super::super::notes::Notes;
use super::super::paint::{Paint, Picture, Texture, Wrap};
use super::super::pictures;
use super::{beside, lines, numbers, split};

/// The last line of each word of a material, with its number.
type Entry = HashMap<String, (u32, String)>;

/// A picture of a scene with its number.
#[derive(Clone)]
struct Kept {
    number: u32,
    picture: Picture,
    mean: [f32; 3],
    has_shape: bool,
}

/// A material of a library.
pub(super) struct Look {
    pub material: Material,
    /// Where it has a picture of what it emits.
    pub glow: Option<Glow>,
    /// Whether it is clear and does not emit.
    pub is_clear: bool,
}

/// Materials by name, and the pictures that they share.
pub(super) struct Library<'a> {
    load: &'a Load,
    pub materials: HashMap<String, Look>,
    glows: Glows,
    /// By the files of colours and opacities.
    kept: HashMap<(PathBuf, Option<PathBuf>), Kept>,
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
            load,
            materials: HashMap::new(),
            glows: Glows::default(),
            kept: HashMap::new(),
        }
    }

    /// All pictures, by number.
    pub fn into_pictures(self) -> Vec<Picture> {
        let mut kept: Vec<Kept> = self.kept.into_values().collect();
        kept.sort_by_key(|own| own.number);
        kept.into_iter().map(|own| own.picture).collect()
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
                    entry.insert(word.to_owned(), (line, rest.to_owned()));
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
        let own = entry.get(word).map(|(line, rest)| {
            let rest = rest.strip_prefix("-halo").unwrap_or(rest);
            numbers(&self.file, *line, rest).map(|[number]| number)
        });
        own.transpose()
    }

    /// A colour; one number stands for all three channels.
    fn color(&self, entry: &Entry, word: &str) -> Result<Option<[f32; 3]>, SceneError> {
        match entry.get(word) {
            Some((_, rest)) if rest.split_ascii_whitespace().count() == 1 => {
                Ok(self.number(entry, word)?.map(|one| [one; 3]))
            }
            Some((line, rest)) => numbers(&self.file, *line, rest).map(Some),
            None => Ok(None),
        }
    }

    /// The file of a map.
    fn file_of(&self, name: &str) -> PathBuf {
        let folder = self.path.parent().unwrap_or(Path::new(""));
        beside(self.library.load, folder, &name.replace('\\', "/"))
    }

    /// A map by a word; `opacity` is the word of another one, which says where it is.
    fn map(
        &mut self,
        entry: &Entry,
        word: &str,
        opacity: &str,
    ) -> Result<Option<(Texture, Kept)>, SceneError> {
        let Some((line, rest)) = entry.get(word) else {
            return Ok(None);
        };
        let (wrap, transform, name) = map_options(rest);
        let opacity = entry
            .get(opacity)
            .map(|(_, rest)| self.file_of(map_options(rest).2));
        let kept = self.kept(*line, (self.file_of(name), opacity))?;
        let texture = |kept: &Kept| Texture {
            picture: kept.number,
            is_nearest: false,
            wrap,
            transform,
        };
        Ok(kept.map(|kept| (texture(&kept), kept)))
    }

    /// The picture of a file, with the alpha of another one, or its red if that is opaque.
    fn kept(&mut self, line: u32, of: (PathBuf, Option<PathBuf>)) -> Result<Option<Kept>, SceneError> {
        if let Some(known) = self.library.kept.get(&of) {
            return Ok(Some(known.clone()));
        }
        let Some(mut pixels) = self.decode(line, &of.0)? else {
            return Ok(None);
        };
        let bytes = pixels.as_raw().len() as u64;
        self.library
            .load
            .take(&of.0.display().to_string(), "a picture", bytes)?;
        let other = match &of.1 {
            Some(path) => self.decode(line, path)?,
            None => None,
        };
        match &other {
            None => pixels.pixels_mut().for_each(|pixel| pixel.0[3] = u8::MAX),
            Some(other) => {
                let has_alpha = other.pixels().any(|pixel| pixel.0[3] < u8::MAX);
                let (size, of) = (pixels.dimensions(), other.dimensions());
                let at = |k: u32, size: u32, of: u32| {
                    ((u64::from(k) * u64::from(of) / u64::from(size)) as u32).min(of - 1)
                };
                for (x, y, pixel) in pixels.enumerate_pixels_mut() {
                    let other = other.get_pixel(at(x, size.0, of.0), at(y, size.1, of.1));
                    pixel.0[3] = other.0[if has_alpha { 3 } else { 0 }];
                }
            }
        }
        let picture = Picture::from(pixels);
        let [r, g, b, _] = pictures::mean_of(&picture);
        let kept = Kept {
            number: self.library.kept.len() as u32,
            picture,
            mean: [r, g, b],
            has_shape: other.is_some(),
        };
        self.library.kept.insert(of, kept.clone());
        Ok(Some(kept))
    }

    /// The pixels of a file; `None` where they cannot be had, which is noted.
    fn decode(&mut self, line: u32, path: &Path) -> Result<Option<RgbaImage>, SceneError> {
        let load = self.library.load;
        let name = path.display().to_string();
        let pixels = load.read(path);
        match pixels.and_then(|bytes| pictures::decode_surface(load, &name, &bytes, Some(path))) {
            Ok(pixels) => Ok(Some(pixels)),
            Err(error) if error.ends_the_load() => Err(error),
            Err(error) => {
                let what = format!("a picture counts as white, and where it is what glows as black: {error}");
                self.note(line, what);
                Ok(None)
            }
        }
    }

    fn close(&mut self, entry: Option<(String, Entry)>) -> Result<(), SceneError> {
        let new = entry.filter(|(name, _)| !self.library.materials.contains_key(name));
        let Some((name, entry)) = new else {
            return Ok(());
        };
        let diffuse_map = self.map(&entry, "map_Kd", "map_d")?;
        let emission_map = self.map(&entry, "map_Ke", "")?;
        let illumination = self.number(&entry, "illum")?;
        let is_one_of = |models: &[f32]| illumination.is_some_and(|own| models.contains(&own));
        let unit = |x: f32| x.clamp(0.0, 1.0);
        let times = |color: [f32; 3], map: &Option<(Texture, Kept)>| match map {
            Some((_, kept)) => [0, 1, 2].map(|i| color[i] * kept.mean[i]),
            None => color,
        };
        // Exporters write black beside a map that says all.
        let or_one = |color: [f32; 3], map: &Option<(Texture, Kept)>| match map {
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
        if emission_map.is_none() && entry.contains_key("map_Ke") {
            // A surface that is known to glow somewhere is not taken to glow everywhere.
            radiance = [0.0; 3];
        }
        let material = Material {
            name: name.clone(),
            base_color: base.map(unit),
            radiance: times(radiance, &emission_map),
            metallic,
            roughness: unit(roughness),
            ..Material::default()
        };
        let [r, g, b] = material.base_color;
        let mut paint = Paint {
            base: [r, g, b, 1.0],
            radiance,
            ..Paint::PLAIN
        };
        if let Some((texture, kept)) = diffuse_map.filter(|_| !is_mirror) {
            let [r, g, b] = factor.map(unit);
            (paint.base, paint.base_texture) = ([r, g, b, 1.0], Some(texture));
            if kept.has_shape {
                paint.cutoff = 0.5;
            }
        }
        let mut glow = None;
        if let Some((texture, kept)) = emission_map.filter(|_| radiance != [0.0; 3]) {
            paint.glow_texture = Some(texture);
            let Library { load, glows, .. } = &*self.library;
            glow = Some(Glow::new(load, glows, texture, &kept.picture)?);
        }
        let look = Look {
            is_clear: transmission >= 0.5 && !emits(radiance),
            material: Material {
                paint: Some(paint).filter(Paint::is_seen),
                ..material
            },
            glow,
        };
        self.library.materials.insert(name, look);
        Ok(())
    }
}

/// Wrapping and transform by the options of a map, as `-s 1 1 1` and `-clamp on`, and the file after them, whose name may have
/// spaces.
fn map_options(rest: &str) -> ([Wrap; 2], [[f32; 2]; 3], &str) {
    let (mut scale, mut offset, mut wrap) = ([1.0; 2], [0.0; 2], Wrap::Repeat);
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
            let number = word.parse::<f32>().ok();
            // The last word is the file.
            if next.is_empty() || !(is_word || number.is_some()) {
                break;
            }
            match (option, number) {
                ("-clamp", _) if word == "on" => wrap = Wrap::Clamp,
                ("-s", Some(number)) if k < 2 => scale[k] = number,
                ("-o", Some(number)) if k < 2 => offset[k] = number,
                _ => {}
            }
            after = next;
        }
        rest = after;
    }
    // The second coordinate of the format grows upward, rows go down.
    let transform = [[scale[0], 0.0], [0.0, -scale[1]], [offset[0], 1.0 - offset[1]]];
    ([wrap; 2], transform, rest)
}

fn luminance([r, g, b]: [f32; 3]) -> f32 {
    0.2126 * r + 0.7152 * g + 0.0722 * b
}

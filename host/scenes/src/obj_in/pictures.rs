//! Pictures in files beside a scene, within limits: their mean colours, and the pictures that the renderer shows.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::rc::Rc;

use image::{DynamicImage, RgbaImage};

use super::super::error::SceneError;
use super::super::files::Load;
use super::super::paint::Picture;
use super::super::pictures;
use super::mtl::Placing;

/// A picture, its mean, and where it lies.
pub(super) struct Map {
    pub path: PathBuf,
    /// Linear.
    pub mean: [f32; 3],
    pub placing: Placing,
}

/// A picture that the renderer shows, with its number among those of the scene.
type Kept = (u32, Rc<RgbaImage>);

/// What has been decoded.
pub(super) struct Pictures<'a> {
    pub load: &'a Load,
    means: HashMap<PathBuf, [f32; 3]>,
    /// By the files of colours and opacities.
    kept: HashMap<(PathBuf, Option<PathBuf>), Kept>,
}

impl<'a> Pictures<'a> {
    pub fn new(load: &'a Load) -> Self {
        Self {
            load,
            means: HashMap::new(),
            kept: HashMap::new(),
        }
    }

    /// The mean colour of a file.
    pub fn mean(&mut self, path: &Path) -> Result<[f32; 3], SceneError> {
        if let Some(&known) = self.means.get(path) {
            return Ok(known);
        }
        let mean = mean_of(self.decode(path)?);
        self.means.insert(path.to_owned(), mean);
        Ok(mean)
    }

    /// A file as a picture that is shown; `None` where its numbers are light, which bytes cannot hold. With `opacity` its
    /// opacity is that of another file: its alpha, or where that is opaque its red.
    pub fn keep(&mut self, path: &Path, opacity: Option<&Path>) -> Result<Option<Kept>, SceneError> {
        let source = (path.to_owned(), opacity.map(Path::to_owned));
        if let Some(known) = self.kept.get(&source) {
            return Ok(Some(known.clone()));
        }
        let picture = self.decode(path)?;
        if is_linear(&picture) {
            return Ok(None);
        }
        let mut pixels = picture.into_rgba8();
        let bytes = pixels.as_raw().len() as u64;
        self.load.take(&path.display().to_string(), "a picture", bytes)?;
        match opacity {
            None => pixels.pixels_mut().for_each(|pixel| pixel.0[3] = u8::MAX),
            Some(opacity) => {
                let other = self.decode(opacity)?.into_rgba8();
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
        let kept = (self.kept.len() as u32, Rc::new(pixels));
        self.kept.insert(source, kept.clone());
        Ok(Some(kept))
    }

    /// All that is kept, by number.
    pub fn into_kept(self) -> Vec<Picture> {
        let mut kept: Vec<Kept> = self.kept.into_values().collect();
        kept.sort_by_key(|(number, _)| *number);
        kept.into_iter()
            .map(|(_, pixels)| pictures::kept(pixels))
            .collect()
    }

    /// The pixels of a file.
    fn decode(&self, path: &Path) -> Result<DynamicImage, SceneError> {
        pictures::decode_light(self.load, self.load.read(path)?, path)
    }
}

/// Whether its numbers are light already, as in EXR and HDR.
fn is_linear(picture: &DynamicImage) -> bool {
    matches!(
        picture,
        DynamicImage::ImageRgb32F(_) | DynamicImage::ImageRgba32F(_)
    )
}

fn mean_of(picture: DynamicImage) -> [f32; 3] {
    if !is_linear(&picture) {
        let [r, g, b, _] = pictures::mean_of(&picture.into_rgba8(), true);
        return [r, g, b];
    }
    let pixels = f64::from(picture.width()) * f64::from(picture.height());
    let mut sums = [0.0; 3];
    for pixel in picture.into_rgb32f().pixels() {
        sums = [0, 1, 2].map(|k| sums[k] + f64::from(pixel.0[k]));
    }
    sums.map(|sum| (sum / pixels) as f32)
}

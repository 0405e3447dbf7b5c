//! Pictures in files beside a scene, within limits: their mean colours, and the pictures that the renderer shows.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::rc::Rc;

use image::{DynamicImage, RgbaImage};

use super::super::error::SceneError;
use super::super::files::Load;
use super::super::paint::Picture;
use super::super::srgb::linear_from_srgb;
use super::super::{pictures, radiance_hdr};

/// The mean of a picture, linear.
pub(super) type Mean = [f64; 3];

/// A picture that the renderer shows.
#[derive(Clone, Debug)]
pub(super) struct Kept {
    /// Its number among those of the scene.
    pub picture: u32,
    pub pixels: Rc<RgbaImage>,
}

/// What a kept picture is made of: a file, and another one that says its opacity.
type Source = (PathBuf, Option<PathBuf>);

/// What has been decoded, with what was wrong with it.
#[derive(Debug)]
pub(super) struct Pictures<'a> {
    pub load: &'a Load,
    means: HashMap<PathBuf, Result<Mean, String>>,
    kept: Vec<Rc<RgbaImage>>,
    by_source: HashMap<Source, Option<Kept>>,
    /// Why pictures are not shown that could be read, a sentence each.
    unshown: Vec<String>,
    /// What ends the load.
    end: Option<SceneError>,
}

impl<'a> Pictures<'a> {
    pub fn new(load: &'a Load) -> Self {
        Self {
            load,
            means: HashMap::new(),
            kept: Vec::new(),
            by_source: HashMap::new(),
            unshown: Vec::new(),
            end: None,
        }
    }

    /// What no scene may do, where a picture was asked for that would have needed it.
    ///
    /// # Errors
    /// [`SceneError::Outside`], [`SceneError::Memory`].
    pub fn end(&mut self) -> Result<(), SceneError> {
        self.end.take().map_or(Ok(()), Err)
    }

    /// The mean colour of a file.
    pub fn mean(&mut self, path: &Path) -> Result<Mean, String> {
        if let Some(known) = self.means.get(path) {
            return known.clone();
        }
        let mean = self.decode(path).map(|picture| mean_of(&picture));
        self.means.insert(path.to_owned(), mean.clone());
        mean
    }

    /// A file whose mean is known, as a picture that is shown; `None` where its numbers are light, which bytes cannot hold, and
    /// where it cannot be read. With `opacity` its opacity is that of another file: its alpha, or where that is opaque its red.
    pub fn keep(&mut self, path: &Path, opacity: Option<&Path>) -> Option<Kept> {
        let source = (path.to_owned(), opacity.map(Path::to_owned));
        if let Some(known) = self.by_source.get(&source) {
            return known.clone();
        }
        let kept = self.made(path, opacity).map(|pixels| {
            let pixels = Rc::new(pixels);
            self.kept.push(Rc::clone(&pixels));
            Kept {
                picture: self.kept.len() as u32 - 1,
                pixels,
            }
        });
        self.by_source.insert(source, kept.clone());
        kept
    }

    /// Why pictures are not shown, since this was asked last.
    pub fn take_unshown(&mut self) -> Vec<String> {
        std::mem::take(&mut self.unshown)
    }

    fn made(&mut self, path: &Path, opacity: Option<&Path>) -> Option<RgbaImage> {
        let picture = self.decode(path).ok()?;
        if is_linear(&picture) {
            self.unshown.push(format!(
                "{} holds light that bytes cannot, and its mean colour is shown",
                path.display()
            ));
            return None;
        }
        let mut pixels = picture.into_rgba8();
        let bytes = pixels.as_raw().len() as u64;
        let taken = self.load.take(&path.display().to_string(), "a picture", bytes);
        taken.map_err(|error| self.end = Some(error)).ok()?;
        match opacity {
            None => pixels.pixels_mut().for_each(|pixel| pixel.0[3] = u8::MAX),
            Some(opacity) => {
                let other = self.decode(opacity).ok()?.into_rgba8();
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
        Some(pixels)
    }

    /// All that is kept, by number.
    pub fn into_kept(self) -> Vec<Picture> {
        drop(self.by_source);
        self.kept.into_iter().map(pictures::kept).collect()
    }

    /// The pixels of a file.
    fn decode(&mut self, path: &Path) -> Result<DynamicImage, String> {
        let decode = || {
            let name = path.display().to_string();
            let bytes = radiance_hdr::with_signature(self.load.read(path)?);
            let mut picture = pictures::decode(self.load, &name, &bytes, Some(path))?;
            if let DynamicImage::ImageRgb32F(pixels) = &mut picture {
                let divisors = radiance_hdr::divisors(&bytes);
                let divisors = divisors.map_err(|problem| pictures::undecoded(&name, problem))?;
                pixels
                    .pixels_mut()
                    .for_each(|pixel| pixel.0 = radiance_hdr::divided(pixel.0, divisors));
            }
            Ok(picture)
        };
        decode().map_err(|error: SceneError| {
            let text = error.to_string();
            if error.ends_the_load() {
                self.end = Some(error);
            }
            text
        })
    }
}

/// Whether its numbers are light already, as in EXR and HDR.
fn is_linear(picture: &DynamicImage) -> bool {
    matches!(
        picture,
        DynamicImage::ImageRgb32F(_) | DynamicImage::ImageRgba32F(_)
    )
}

fn mean_of(picture: &DynamicImage) -> Mean {
    let pixels = f64::from(picture.width()) * f64::from(picture.height());
    let mut sums = [0.0; 3];
    if is_linear(picture) {
        for pixel in picture.to_rgb32f().pixels() {
            sums = [0, 1, 2].map(|k| sums[k] + f64::from(pixel.0[k]));
        }
    } else {
        let light: [f64; 256] = std::array::from_fn(|step| linear_from_srgb(step as u8).into());
        for pixel in picture.to_rgb8().pixels() {
            sums = [0, 1, 2].map(|k| sums[k] + light[usize::from(pixel.0[k])]);
        }
    }
    sums.map(|sum| sum / pixels)
}

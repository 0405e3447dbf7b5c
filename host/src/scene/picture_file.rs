//! Pictures in files beside a scene, within limits: their mean colours, and the pictures that the renderer shows.

use std::collections::HashMap;
use std::io::Cursor;
use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::sync::Arc;

use image::{DynamicImage, ImageReader, Limits, RgbaImage};

use super::paint::Picture;
use super::pfm;
use super::radiance_hdr;
use super::read_file::read_file;

/// Most memory of one decoder.
const MAX_ALLOCATION: u64 = 1 << 30;

/// Most pixels decoded for one scene: 2^28.
const MAX_PIXELS: u64 = 1 << 28;

/// Largest width or height.
const MAX_SIDE: u32 = 16_384;

/// How numbers of a picture of whole numbers become light.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Encoding {
    /// IEC 61966-2-1.
    Srgb,
    /// As they are.
    Linear,
}

/// The mean of a picture, linear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Mean {
    pub rgb: [f64; 3],
    pub alpha: f64,
}

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
#[derive(Debug, Default)]
pub(super) struct Pictures {
    means: HashMap<(PathBuf, Encoding), Result<Mean, String>>,
    kept: Vec<Rc<RgbaImage>>,
    by_source: HashMap<Source, Option<Kept>>,
    /// Why pictures are not shown that could be read, a sentence each.
    unshown: Vec<String>,
    pixels: u64,
    kept_pixels: u64,
}

impl Pictures {
    /// The mean colour of a file.
    pub fn mean(&mut self, path: &Path, encoding: Encoding) -> Result<Mean, String> {
        let key = (path.to_owned(), encoding);
        if let Some(known) = self.means.get(&key) {
            return known.clone();
        }
        let mean = self.decode(path).map(|picture| mean_of(&picture, encoding));
        self.means.insert(key, mean.clone());
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
        // Its pixels were counted for its mean.
        let picture = self.decode_again(path)?;
        if is_linear(&picture) {
            self.unshown.push(format!(
                "{} holds light that bytes cannot, and its mean colour is shown",
                path.display()
            ));
            return None;
        }
        let mut pixels = picture.to_rgba8();
        self.kept_pixels += u64::from(pixels.width()) * u64::from(pixels.height());
        if self.kept_pixels > MAX_PIXELS {
            self.unshown.push(format!(
                "{} and what follows are shown by their mean colours: pictures of a scene have {MAX_PIXELS} pixels at most",
                path.display()
            ));
            return None;
        }
        match opacity {
            None => pixels.pixels_mut().for_each(|pixel| pixel.0[3] = u8::MAX),
            Some(opacity) => {
                let other = self.decode_again(opacity)?;
                let other = other.to_rgba8();
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
        let pictures = self.kept.into_iter().map(|pixels| {
            let (width, height) = pixels.dimensions();
            let pixels = Rc::try_unwrap(pixels).unwrap_or_else(|shared| (*shared).clone());
            Picture {
                width,
                height,
                texels: Arc::new(pixels.into_raw()),
            }
        });
        pictures.collect()
    }

    /// The pixels of a file whose mean is known.
    fn decode_again(&mut self, path: &Path) -> Option<DynamicImage> {
        let before = std::mem::take(&mut self.pixels);
        let picture = self.decode(path);
        self.pixels = before;
        picture.ok()
    }

    /// The pixels of a file.
    pub fn decode(&mut self, path: &Path) -> Result<DynamicImage, String> {
        let bytes = radiance_hdr::with_signature(read_file(path).map_err(|error| error.to_string())?);
        if let Some(picture) = pfm::read(&bytes) {
            let picture =
                picture.map_err(|problem| format!("cannot decode {}: {problem}", path.display()))?;
            self.pixels += u64::from(picture.width()) * u64::from(picture.height());
            return Ok(DynamicImage::ImageRgb32F(picture));
        }
        let reader = || {
            let mut reader = ImageReader::new(Cursor::new(&bytes));
            if let Ok(format) = image::ImageFormat::from_path(path) {
                reader.set_format(format);
            }
            reader.with_guessed_format().map_err(|error| error.to_string())
        };
        let unread = |error: image::ImageError| {
            format!(
                "cannot decode {}: {error}; use PNG, JPEG, WebP, TGA, PFM, HDR or EXR",
                path.display()
            )
        };
        let (width, height) = reader()?.into_dimensions().map_err(unread)?;
        let pixels = self.pixels + u64::from(width) * u64::from(height);
        if pixels > MAX_PIXELS || width == 0 || height == 0 {
            return Err(format!(
                "{} has {width} x {height} pixels, and all pictures of a scene may have {MAX_PIXELS} together",
                path.display()
            ));
        }
        self.pixels = pixels;
        let mut limits = Limits::default();
        limits.max_image_width = Some(MAX_SIDE);
        limits.max_image_height = Some(MAX_SIDE);
        limits.max_alloc = Some(MAX_ALLOCATION);
        let mut reader = reader()?;
        reader.limits(limits);
        let mut picture = reader.decode().map_err(unread)?;
        if let (Some(header), DynamicImage::ImageRgb32F(pixels)) = (radiance_hdr::read(&bytes), &mut picture)
        {
            let header = header.map_err(|problem| format!("cannot decode {}: {problem}", path.display()))?;
            header.apply(pixels);
        }
        Ok(picture)
    }
}

/// Light of a channel in [0, 1] that is encoded by sRGB.
pub(super) fn from_srgb(x: f64) -> f64 {
    if x <= 0.040_45 {
        x / 12.92
    } else {
        libm::pow((x + 0.055) / 1.055, 2.4)
    }
}

/// Whether its numbers are light already, as in EXR and HDR.
pub(super) fn is_linear(picture: &DynamicImage) -> bool {
    matches!(
        picture,
        DynamicImage::ImageRgb32F(_) | DynamicImage::ImageRgba32F(_)
    )
}

fn mean_of(picture: &DynamicImage, encoding: Encoding) -> Mean {
    let pixels = f64::from(picture.width()) * f64::from(picture.height());
    let mut sums = [0.0; 4];
    if is_linear(picture) {
        for pixel in picture.to_rgba32f().pixels() {
            for (sum, channel) in sums.iter_mut().zip(pixel.0) {
                *sum += f64::from(channel);
            }
        }
    } else {
        let mut light = [0.0; 256];
        for (step, light) in (0..).zip(&mut light) {
            let x = f64::from(step) / 255.0;
            *light = if encoding == Encoding::Srgb {
                from_srgb(x)
            } else {
                x
            };
        }
        for pixel in picture.to_rgba8().pixels() {
            let [r, g, b, a] = pixel.0;
            for (sum, channel) in sums.iter_mut().zip([r, g, b]) {
                *sum += light[usize::from(channel)];
            }
            sums[3] += f64::from(a) / 255.0;
        }
    }
    let [r, g, b, alpha] = sums.map(|sum| sum / pixels);
    Mean {
        rgb: [r, g, b],
        alpha,
    }
}

//! Images of radiance, and their files.

use image::{ExtendedColorType, ImageFormat};
use lightbvh::device::emission::luminance_of;
use std::io::Cursor;
use std::path::{Path, PathBuf};

use super::output::write_whole;
use super::tone::display;

/// Most exposure that is chosen by itself. Light a thousand times as faint as a white surface shows is what few samples happened to
/// find: exposure of 10^5 made pictures of it.
pub const MAX_AUTO_EXPOSURE: f32 = 1000.0;

/// Why an image cannot be made, compared or written.
#[allow(missing_docs, reason = "the messages name the fields")]
#[derive(Debug, thiserror::Error)]
pub enum FilmError {
    #[error(
        "an image of {width} x {height} has not {pixels} pixels; give width times height of them, at least one"
    )]
    Size { width: u32, height: u32, pixels: usize },
    #[error("{}: unknown image format; name a file that ends in .png or .exr", .path.display())]
    Format { path: PathBuf },
    #[error("{}: cannot encode the image: {source}; try the other format", .path.display())]
    Encode {
        path: PathBuf,
        source: image::ImageError,
    },
    #[error("{}: cannot write the image: {source}; check that its folder exists, may be written to and has room", .path.display())]
    Write { path: PathBuf, source: std::io::Error },
}

/// An image of linear RGB radiance, W/(m² sr), by rows from the upper left.
#[derive(Clone, Debug, PartialEq)]
pub struct Film {
    width: u32,
    height: u32,
    pixels: Vec<[f32; 3]>,
}

impl Film {
    /// An image of these pixels.
    pub fn new(width: u32, height: u32, pixels: Vec<[f32; 3]>) -> Result<Self, FilmError> {
        if pixels.is_empty() || u64::from(width) * u64::from(height) != pixels.len() as u64 {
            return Err(FilmError::Size {
                width,
                height,
                pixels: pixels.len(),
            });
        }
        Ok(Self {
            width,
            height,
            pixels,
        })
    }

    /// Columns.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Rows.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// The pixels by rows from the upper left.
    pub fn pixels(&self) -> &[[f32; 3]] {
        &self.pixels
    }

    /// The factor that brings the image's mean brightness to a middle grey of 0.18: the mean is that of the logarithm,
    /// which a few bright lights hardly move (Reinhard et al. 2002, equations 1 and 2). 1 for a black image. At most
    /// [`MAX_AUTO_EXPOSURE`]; [`darkness`](Self::darkness) says in words where that is too little.
    pub fn auto_exposure(&self) -> f32 {
        self.wanted_exposure()
            .map_or(1.0, |wanted| wanted.min(MAX_AUTO_EXPOSURE))
    }

    /// The reason why the image is dark although it is exposed: nothing is lit, or so faintly that more exposure would show noise.
    pub fn darkness(&self) -> Option<String> {
        match self.wanted_exposure() {
            None => Some(String::from(
                "the image is black: nothing that emits is seen, and nothing that is seen is lit; lights may be hidden, face away, \
                 or be outside of the view (`--look-from` and `--look-at` set another one)",
            )),
            Some(wanted) if wanted > MAX_AUTO_EXPOSURE => Some(format!(
                "what is seen is so faintly lit that an exposure of {wanted:.0} would be needed, and {MAX_AUTO_EXPOSURE:.0} is taken, \
                 as more shows mostly noise; --exposure sets another one"
            )),
            Some(_) => None,
        }
    }

    /// The exposure that [`auto_exposure`](Self::auto_exposure) would take if it were not bounded; none of a black image.
    fn wanted_exposure(&self) -> Option<f32> {
        let logarithm = |&pixel: &[f32; 3]| {
            let l = f64::from(luminance_of(&pixel));
            (l > 0.0 && l.is_finite()).then(|| l.ln())
        };
        let lit: Vec<f64> = self.pixels.iter().filter_map(logarithm).collect();
        let mean = lit.iter().sum::<f64>() / lit.len() as f64;
        (!lit.is_empty()).then(|| (0.18 / mean.exp()) as f32)
    }

    /// The image as a screen shows it: tone-mapped 8-bit sRGB after scaling by `exposure`, three bytes per pixel.
    pub fn shown(&self, exposure: f32) -> Vec<u8> {
        let channels = self.pixels.iter().flatten();
        channels.map(|&c| display(c, exposure)).collect()
    }

    /// Writes the image: tone-mapped 8-bit sRGB after scaling by `exposure` for `.png`, the radiance itself in 32-bit
    /// floats for `.exr`. The file appears whole or not at all.
    pub fn write(&self, path: &Path, exposure: f32) -> Result<(), FilmError> {
        let extension = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase());
        let (bytes, color, format): (Vec<u8>, _, _) = match extension.as_deref() {
            Some("png") => (self.shown(exposure), ExtendedColorType::Rgb8, ImageFormat::Png),
            Some("exr") => {
                let bytes = bytemuck::cast_slice(&self.pixels).to_vec();
                (bytes, ExtendedColorType::Rgb32F, ImageFormat::OpenExr)
            }
            _ => {
                return Err(FilmError::Format {
                    path: path.to_owned(),
                });
            }
        };
        let path = path.to_owned();
        let mut file = Cursor::new(Vec::new());
        match image::write_buffer_with_format(&mut file, &bytes, self.width, self.height, color, format) {
            Err(source) => Err(FilmError::Encode { path, source }),
            Ok(()) => write_whole(&path, file.get_ref()).map_err(|source| FilmError::Write { path, source }),
        }
    }
}

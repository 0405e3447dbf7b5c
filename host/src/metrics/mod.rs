//! How far an image is from a reference.
//!
//! The paper's measures are taken of what a screen shows: tone-mapped sRGB of 8 bits, so that MSE is in squared steps of
//! 0 to 255, and PSNR, SSIM and FLIP follow. Next to them stand the MSE of the radiance itself and the relative MSE, which
//! no display curve flatters.

mod estimate;
mod flip;
mod irradiance;
mod mse;
mod ssim;

pub use estimate::{Estimate, mean, variance};
pub use flip::{flip_map, mean_flip};
pub use irradiance::{irradiance, variances};
pub use mse::{mean_squared_error, psnr, relative_mean_squared_error, relative_squared_error, squared_error};
pub use ssim::{luma, ssim};

use serde::Serialize;

use crate::render::Film;

/// Why two images cannot be measured against each other.
#[allow(missing_docs, reason = "the messages name the fields")]
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MetricError {
    #[error("an image of {} x {} cannot be measured against one of {} x {}; render both at one size", .image.0, .image.1, .reference.0, .reference.1)]
    Shapes {
        image: (u32, u32),
        reference: (u32, u32),
    },
    #[error("pixel {pixel} of the image is not finite; report it as a defect of the renderer")]
    NotFinite { pixel: usize },
    #[error("an image of {} x {} is beyond what FLIP takes; render a smaller one", .size.0, .size.1)]
    Flip { size: (u32, u32) },
}

/// An image's distance from a reference by every measure; smaller is better but for SSIM and PSNR.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Quality {
    /// Mean squared error of the displayed bytes, 0 to 255².
    pub mse: f64,
    /// Structural similarity of the displayed luma, at most 1 (Wang et al. 2004).
    pub ssim: f64,
    /// Mean LDR-FLIP of the displayed images, 0 to 1 (Andersson et al. 2020).
    pub flip: f64,
    /// Mean squared error of radiance, (W/(m² sr))².
    pub linear_mse: f64,
    /// Mean over all channels of the squared error over the reference's square, see [`relative_mean_squared_error`].
    pub relative_mse: f64,
}

impl Quality {
    /// Peak signal-to-noise ratio of the displayed bytes, dB; infinite for equal images.
    pub fn psnr(&self) -> f64 {
        psnr(self.mse)
    }
}

/// A reference that images are measured against.
#[derive(Clone, Debug)]
pub struct Judge {
    reference: Film,
    exposure: f32,
    shown: Vec<u8>,
}

/// An image next to a reference.
#[derive(Clone, Debug)]
pub struct Judged {
    /// As displayed, three bytes per pixel.
    pub shown: Vec<u8>,
    /// FLIP of each pixel, 0 to 1.
    pub flip: Vec<f32>,
    /// Every measure.
    pub quality: Quality,
}

impl Judge {
    /// Takes a reference and the exposure at which it and the images are displayed.
    pub fn new(reference: Film, exposure: f32) -> Result<Self, MetricError> {
        require_finite(&reference)?;
        Ok(Self {
            shown: reference.shown(exposure),
            reference,
            exposure,
        })
    }

    /// The reference.
    pub fn reference(&self) -> &Film {
        &self.reference
    }

    /// The reference as displayed, three bytes per pixel.
    pub fn shown(&self) -> &[u8] {
        &self.shown
    }

    /// Factor on radiance before the display curve.
    pub fn exposure(&self) -> f32 {
        self.exposure
    }

    /// Columns and rows.
    pub fn size(&self) -> (u32, u32) {
        (self.reference.width(), self.reference.height())
    }

    /// Measures an image.
    pub fn judge(&self, image: &Film) -> Result<Judged, MetricError> {
        if (image.width(), image.height()) != self.size() {
            return Err(MetricError::Shapes {
                image: (image.width(), image.height()),
                reference: self.size(),
            });
        }
        require_finite(image)?;
        let shown = image.shown(self.exposure);
        let flip = flip_map(&self.shown, &shown, self.size())?;
        let [bytes, expected] = [&shown, &self.shown].map(|bytes| bytes.as_chunks::<3>().0);
        let (pixels, reference) = (image.pixels(), self.reference.pixels());
        let (width, height) = (image.width() as usize, image.height() as usize);
        let quality = Quality {
            mse: mean_squared_error(bytes, expected),
            ssim: ssim(&luma(bytes), &luma(expected), width, height),
            flip: mean_flip(&flip),
            linear_mse: mean_squared_error(pixels, reference),
            relative_mse: relative_mean_squared_error(pixels, reference, self.exposure),
        };
        Ok(Judged { shown, flip, quality })
    }
}

fn require_finite(image: &Film) -> Result<(), MetricError> {
    let wrong = |pixel: &[f32; 3]| pixel.iter().any(|c| !c.is_finite());
    match image.pixels().iter().position(wrong) {
        Some(pixel) => Err(MetricError::NotFinite { pixel }),
        None => Ok(()),
    }
}

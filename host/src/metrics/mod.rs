//! How far an image is from a reference.
//!
//! The paper's measures are taken of what a screen shows: tone-mapped sRGB of 8 bits, so that MSE is in squared steps of
//! 0 to 255, and PSNR, SSIM and FLIP follow. Next to them stand the MSE of the radiance itself and the relative MSE, which
//! no display curve flatters. Every measure can be taken of the whole image or of a region.

mod estimate;
mod flip;
mod mse;
mod region;
mod ssim;

pub use estimate::{Estimate, mean};
pub use flip::{flip_map, mean_flip};
pub use mse::{mean_squared_error, psnr, relative_mean_squared_error, relative_squared_error, squared_error};
pub use region::Region;
pub use ssim::{luma, ssim};

use serde::Serialize;

use crate::render::Film;

/// Why two images cannot be measured against each other.
#[allow(missing_docs, reason = "the messages name the fields")]
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MetricError {
    /// Two images of different sizes.
    #[error("an image of {} x {} cannot be measured against one of {} x {}; render both at one size", .image.0, .image.1, .reference.0, .reference.1)]
    Shapes {
        image: (u32, u32),
        reference: (u32, u32),
    },
    /// Radiance that is infinite or not a number: no distance from it means anything.
    #[error("pixel {pixel} of the image is not finite; report it as a defect of the renderer")]
    NotFinite { pixel: usize },
    /// A region that is empty or beyond the image.
    #[error("the region {region} is not within an image of {} x {}; choose one inside, of at least one pixel", .size.0, .size.1)]
    Region { region: Region, size: (u32, u32) },
    /// FLIP refuses the size.
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

/// An image next to a reference: what several regions of it are measured from.
#[derive(Clone, Debug)]
pub struct Judged<'a> {
    judge: &'a Judge,
    image: &'a Film,
    shown: Vec<u8>,
    flip: Vec<f32>,
}

impl Judge {
    /// Takes a reference and the exposure at which it and the images are displayed.
    ///
    /// # Errors
    /// [`MetricError::NotFinite`] for a reference that is not.
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

    /// Puts an image next to the reference.
    ///
    /// # Errors
    /// [`MetricError`] for an image of another size, or not finite, or too large for FLIP.
    pub fn judge<'a>(&'a self, image: &'a Film) -> Result<Judged<'a>, MetricError> {
        if (image.width(), image.height()) != self.size() {
            return Err(MetricError::Shapes {
                image: (image.width(), image.height()),
                reference: self.size(),
            });
        }
        require_finite(image)?;
        let shown = image.shown(self.exposure);
        let flip = flip_map(&self.shown, &shown, self.size())?;
        Ok(Judged {
            judge: self,
            image,
            shown,
            flip,
        })
    }

    /// Measures a whole image.
    ///
    /// # Errors
    /// As [`judge`](Self::judge).
    pub fn quality(&self, image: &Film) -> Result<Quality, MetricError> {
        let (width, height) = self.size();
        let whole = Region {
            x: 0,
            y: 0,
            width,
            height,
        };
        self.judge(image)?.region(whole)
    }
}

impl Judged<'_> {
    /// The image as displayed, three bytes per pixel.
    pub fn shown(&self) -> &[u8] {
        &self.shown
    }

    /// FLIP of each pixel, 0 to 1.
    pub fn flip(&self) -> &[f32] {
        &self.flip
    }

    /// Measures a region. FLIP sees the whole images, as a viewer does, and is averaged over the region; the other measures
    /// see nothing but the region.
    ///
    /// # Errors
    /// [`MetricError::Region`] for a region that is empty or reaches beyond the images.
    pub fn region(&self, region: Region) -> Result<Quality, MetricError> {
        let size = self.judge.size();
        if !region.is_within(size) {
            return Err(MetricError::Region { region, size });
        }
        let shown = |bytes: &[u8]| region.cut(bytes.as_chunks::<3>().0, size.0);
        let (image_shown, reference_shown) = (shown(&self.shown), shown(&self.judge.shown));
        let image = region.cut(self.image.pixels(), size.0);
        let reference = region.cut(self.judge.reference.pixels(), size.0);
        Ok(Quality {
            mse: mean_squared_error(&image_shown, &reference_shown),
            ssim: ssim(
                &luma(&image_shown),
                &luma(&reference_shown),
                region.width as usize,
                region.height as usize,
            ),
            flip: mean_flip(&region.cut(&self.flip, size.0)),
            linear_mse: mean_squared_error(&image, &reference),
            relative_mse: relative_mean_squared_error(&image, &reference, self.judge.exposure),
        })
    }
}

fn require_finite(image: &Film) -> Result<(), MetricError> {
    let wrong = |pixel: &[f32; 3]| pixel.iter().any(|c| !c.is_finite());
    match image.pixels().iter().position(wrong) {
        Some(pixel) => Err(MetricError::NotFinite { pixel }),
        None => Ok(()),
    }
}

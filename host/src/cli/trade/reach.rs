//! How many shadow rays a configuration takes to a budget, and what it comes to.

use crate::error::HostError;

/// What is measured of one configuration by equal rays.
pub(super) struct Measured {
    pub update_ms: f64,
    /// Of one least image.
    pub least_ms: f64,
    /// Mean squared, of a number of least images.
    pub error: f64,
    pub count: u32,
}

/// What a budget comes to.
#[derive(Debug)]
pub(super) struct Found {
    /// Least images: a whole number in each, between which this lies.
    pub images: f64,
    pub frame_ms: f64,
    /// As a share of white.
    pub error: f64,
}

/// Squared steps of a byte below which the reference cannot tell errors apart.
pub(super) const LEAST_ERROR: f64 = 1e-3;

/// Most least images that are tried.
pub(super) const MOST_IMAGES: u32 = 256;

impl Measured {
    /// What fits into `frame_ms`, the frame; where not even one least image does, the time that this takes.
    pub fn within(
        &self,
        frame_ms: f64,
        error_of: &mut dyn FnMut(u32) -> Result<f64, HostError>,
    ) -> Result<Result<Found, f64>, HostError> {
        let fits = ((frame_ms - self.update_ms) / self.least_ms).min(f64::from(MOST_IMAGES));
        if fits < 1.0 {
            return Ok(Err(self.update_ms + self.least_ms));
        }
        // Errors fall by powers of the samples between them.
        let fewer = fits.floor() as u32;
        let share = (fits / f64::from(fewer)).ln() / (f64::from(fewer + 1) / f64::from(fewer)).ln();
        let [a, b] = [error_of(fewer)?, error_of(fewer + 1)?];
        let found = self.found(fits, a * (b / a).powf(share));
        // Divided and multiplied again, a budget may come out one rounding above itself.
        let frame_ms = found.frame_ms.min(frame_ms);
        Ok(Ok(Found { frame_ms, ..found }))
    }

    /// What leads to the `error`; where [`MOST_IMAGES`] do not, the error by those. Errors are taken as a power of the number
    /// of images: the one between what is measured and an image by about as many as are needed.
    pub fn until(
        &self,
        error: f64,
        error_of: &mut dyn FnMut(u32) -> Result<f64, HostError>,
    ) -> Result<Result<Found, f64>, HostError> {
        let wanted = (255.0 * error).powi(2);
        let guess = (f64::from(self.count) * self.error / wanted).clamp(1.0, f64::from(MOST_IMAGES));
        // Another number than what is measured, so that there is a slope.
        let near = match guess.round() as u32 {
            near if near == self.count => near + 1,
            near => near,
        };
        let there = error_of(near)?;
        if near == 1 && there <= wanted {
            return Ok(Ok(self.found(1.0, there)));
        }
        let slope = (there / self.error).ln() / (f64::from(near) / f64::from(self.count)).ln();
        // Between no gain and that of perfectly spread numbers, whatever the noise says.
        let images = f64::from(near) * (there / wanted).powf(1.0 / (-slope).clamp(0.5, 2.0));
        if images > f64::from(MOST_IMAGES) {
            return Ok(Err(of_white(error_of(MOST_IMAGES)?)));
        }
        Ok(Ok(self.found(images.max(1.0), wanted)))
    }

    fn found(&self, images: f64, squared: f64) -> Found {
        Found {
            images,
            frame_ms: self.update_ms + images * self.least_ms,
            error: of_white(squared),
        }
    }
}

/// A mean squared error in squared steps of a byte as a share of white.
pub(super) fn of_white(squared: f64) -> f64 {
    squared.sqrt() / 255.0
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An image of 4 ms and 2 ms of update, whose error falls as the inverse of its samples.
    const USUAL: Measured = Measured {
        update_ms: 2.0,
        least_ms: 4.0,
        error: 100.0,
        count: 12,
    };

    fn error_of(images: u32) -> Result<f64, HostError> {
        Ok((1200.0 / f64::from(images)).max(LEAST_ERROR))
    }

    fn within(frame_ms: f64) -> Result<Found, f64> {
        USUAL.within(frame_ms, &mut error_of).expect("no image fails")
    }

    fn until(error: f64) -> Result<Found, f64> {
        USUAL.until(error, &mut error_of).expect("no image fails")
    }

    #[test]
    fn a_frame_holds_what_fits() {
        let found = within(20.0).expect("4.5 images");
        let expected = of_white(1200.0 / 4.5);
        assert!(
            (found.images - 4.5).abs() < 1e-9
                && (found.frame_ms - 20.0).abs() < 1e-9
                && (found.error / expected - 1.0).abs() < 1e-9
        );
        assert_eq!(within(5.9).err(), Some(6.0), "an update and one image");
        let most = within(1e9).expect("more than are tried");
        assert_eq!((most.images, most.frame_ms), (256.0, 2.0 + 256.0 * 4.0));
    }

    #[test]
    fn no_frame_is_beyond_its_budget() {
        let measured = Measured {
            update_ms: 0.1,
            least_ms: 0.3,
            ..USUAL
        };
        for k in 0..1000 {
            let budget = 1.0 + 0.07 * f64::from(k);
            let found = measured.within(budget, &mut error_of).expect("no image fails");
            let found = found.expect("several images");
            assert!(found.frame_ms <= budget, "{budget} {found:?}");
        }
    }

    #[test]
    fn an_error_is_reached_by_what_it_takes() {
        let found = until(of_white(40.0)).expect("30 images");
        assert!((found.images - 30.0).abs() < 1e-6 && (found.frame_ms - 122.0).abs() < 1e-5);
        // One image has what it has, not what was asked for.
        let one = until(1.0).expect("one image");
        assert_eq!((one.images, one.error), (1.0, of_white(1200.0)));
        let beyond = until(of_white(4.0)).expect_err("300 images");
        assert!((beyond - of_white(1200.0 / 256.0)).abs() < 1e-12);
    }
}

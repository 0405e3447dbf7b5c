//! Squared errors, and the ratio made of them.

/// Added to the square of the reference in the relative error, so that dark pixels do not rule (the form of F. Rousselle
/// et al., "Adaptive Sampling and Reconstruction using Greedy Error Minimization", 2011). Radiance is scaled first so that
/// middle grey is 0.18; this is a third of its square.
const DARK: f64 = 0.01;

/// Sum over the channels of the squared difference.
pub fn squared_error<T: Into<f64> + Copy>(a: [T; 3], b: [T; 3]) -> f64 {
    (0..3).map(|k| (a[k].into() - b[k].into()).powi(2)).sum()
}

/// Mean of the squared differences over all channels of all pixels; 0 for no pixels.
pub fn mean_squared_error<T: Into<f64> + Copy>(image: &[[T; 3]], reference: &[[T; 3]]) -> f64 {
    let pairs = image.iter().zip(reference);
    let sum: f64 = pairs.map(|(&a, &b)| squared_error(a, b)).sum();
    sum / (3 * image.len().max(1)) as f64
}

/// Mean over all channels of all pixels of `(x - r)² / (r² + 0.01)`, with image `x` and reference `r` scaled by `exposure`.
pub fn relative_mean_squared_error(image: &[[f32; 3]], reference: &[[f32; 3]], exposure: f32) -> f64 {
    let pairs = image.iter().zip(reference);
    let sum: f64 = pairs.map(|(&x, &r)| relative_squared_error(x, r, exposure)).sum();
    sum / image.len().max(1) as f64
}

/// The same of one pixel: the mean over its channels.
pub fn relative_squared_error(pixel: [f32; 3], reference: [f32; 3], exposure: f32) -> f64 {
    let scale = f64::from(exposure);
    let of = |(x, r): (f32, f32)| {
        let (x, r) = (f64::from(x) * scale, f64::from(r) * scale);
        (x - r).powi(2) / (r * r + DARK)
    };
    pixel.into_iter().zip(reference).map(of).sum::<f64>() / 3.0
}

/// Peak signal-to-noise ratio of 8-bit images, dB: `10 log10(255² / mse)`, infinite for no error.
pub fn psnr(mse: f64) -> f64 {
    10.0 * (255.0 * 255.0 / mse).log10()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn peaks_are_in_decibels() {
        // 10 log10(65025 / 9) = 38.588...
        assert!((psnr(9.0) - 38.588_378_7).abs() < 1e-6, "{}", psnr(9.0));
    }

    #[test]
    fn the_relative_error_does_not_know_units() {
        let reference = [[2.0_f32, 0.5, 0.0]];
        let image = [[1.0_f32, 0.5, 0.5]];
        // 1 / 4.01, 0, 0.25 / 0.01; f32 holds all of these exactly.
        let expected = (1.0 / 4.01 + 25.0) / 3.0;
        assert!((relative_mean_squared_error(&image, &reference, 1.0) - expected).abs() < 1e-12);
        let scaled = |pixels: [[f32; 3]; 1]| pixels.map(|p| p.map(|c| c * 8.0));
        let other = relative_mean_squared_error(&scaled(image), &scaled(reference), 0.125);
        assert!((other - expected).abs() < 1e-12);
    }
}

//! Structural similarity: Z. Wang, A. C. Bovik, H. R. Sheikh, E. P. Simoncelli, "Image Quality Assessment: From Error
//! Visibility to Structural Similarity", IEEE Transactions on Image Processing 13(4), 2004.
//!
//! Our own, because no crate at hand measures that: `image-compare` 0.5 takes the mean over 8 × 8 blocks that do not overlap,
//! and leaves the division by the number of pixels out of its variances, which makes the paper's C2 64 times too small.

/// Section III-C of the paper: windows of 11 × 11, a Gaussian of 1.5 pixels, K1 = 0.01, K2 = 0.03, L = 255.
const WINDOW: usize = 11;
const SIGMA: f64 = 1.5;
const C1: f64 = (0.01 * 255.0) * (0.01 * 255.0);
const C2: f64 = (0.03 * 255.0) * (0.03 * 255.0);

/// Luma of displayed pixels, 0 to 255 (ITU-R BT.601, which the authors' program assumes).
pub fn luma(shown: &[[u8; 3]]) -> Vec<f64> {
    shown
        .iter()
        .map(|&[r, g, b]| 0.299 * f64::from(r) + 0.587 * f64::from(g) + 0.114 * f64::from(b))
        .collect()
}

/// Mean structural similarity of two images of luma, 0 to 255, by rows: at most 1, and 1 for equal ones.
///
/// Only windows that lie wholly in the image count, as in the authors' program; nothing is scaled down first. In an image
/// narrower or lower than the window the window is cut to its size.
///
/// # Panics
/// Where an image has not `width * height` pixels, at least one.
pub fn ssim(image: &[f64], reference: &[f64], width: usize, height: usize) -> f64 {
    assert!(image.len() == width * height && reference.len() == image.len() && !image.is_empty());
    let (across, down) = (gaussian(WINDOW.min(width)), gaussian(WINDOW.min(height)));
    let filtered = |value: &dyn Fn(f64, f64) -> f64| {
        let plane: Vec<f64> = image.iter().zip(reference).map(|(&x, &y)| value(x, y)).collect();
        filter(&plane, width, &across, &down)
    };
    // Equations 14 to 16: E[x²] - E[x]², which in f64 is exact enough for values up to 255.
    let mean_x = filtered(&|x, _| x);
    let mean_y = filtered(&|_, y| y);
    let square_x = filtered(&|x, _| x * x);
    let square_y = filtered(&|_, y| y * y);
    let product = filtered(&|x, y| x * y);
    let sum: f64 = (0..mean_x.len())
        .map(|i| {
            let (x, y) = (mean_x[i], mean_y[i]);
            let (xx, yy, xy) = (square_x[i] - x * x, square_y[i] - y * y, product[i] - x * y);
            // Equation 13.
            (2.0 * x * y + C1) * (2.0 * xy + C2) / ((x * x + y * y + C1) * (xx + yy + C2))
        })
        .sum();
    sum / mean_x.len() as f64
}

/// `taps` weights that sum to one.
fn gaussian(taps: usize) -> Vec<f64> {
    let middle = (taps - 1) as f64 * 0.5;
    let weight = |i: usize| (-(i as f64 - middle).powi(2) / (2.0 * SIGMA * SIGMA)).exp();
    let sum: f64 = (0..taps).map(weight).sum();
    (0..taps).map(|i| weight(i) / sum).collect()
}

/// Weighted means at every place where the window fits.
fn filter(plane: &[f64], width: usize, across: &[f64], down: &[f64]) -> Vec<f64> {
    let columns = width - across.len() + 1;
    let rows: Vec<f64> = plane
        .chunks_exact(width)
        .flat_map(|row| row.windows(across.len()))
        .map(|window| window.iter().zip(across).map(|(x, w)| x * w).sum())
        .collect();
    let height = plane.len() / width - down.len() + 1;
    (0..height * columns)
        .map(|i| {
            let column = rows[i..].iter().step_by(columns);
            column.zip(down).map(|(x, w)| x * w).sum()
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Bytes of a linear congruential generator (Numerical Recipes), and the same with up to 32 added or taken.
    fn noise(count: usize) -> [Vec<f64>; 2] {
        let mut state = 1_u32;
        let mut next = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            state
        };
        let x: Vec<f64> = (0..count).map(|_| f64::from(next() >> 24)).collect();
        let near = |&x: &f64| (x + f64::from(next() >> 26) - 32.0).clamp(0.0, 255.0);
        let y = x.iter().map(near).collect();
        [x, y]
    }

    #[test]
    fn agrees_with_another_program_on_noise() {
        let (width, height) = (23, 17);
        let [x, y] = noise(width * height);
        // Printed by scikit-image 0.26: a Gaussian of 1.5, covariance of the population, a range of 255.
        let expected = 0.962_284_058_980_416_8;
        let found = ssim(&x, &y, width, height);
        assert!((found - expected).abs() < 1e-12, "{found}");
    }

    #[test]
    fn images_may_be_smaller_than_the_window() {
        let [x, y] = noise(40);
        assert_eq!(ssim(&[7.0], &[7.0], 1, 1), 1.0);
        assert!((ssim(&x, &x, 20, 2) - 1.0).abs() < 1e-12 && ssim(&x, &y, 20, 2) < 1.0);
    }
}

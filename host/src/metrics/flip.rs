//! LDR-FLIP: P. Andersson, J. Nilsson, T. Akenine-Möller, M. Oskarsson, K. Åström, M. D. Fairchild, "FLIP: A Difference
//! Evaluator for Alternating Images", Proceedings of the ACM on Computer Graphics and Interactive Techniques 3(2), 2020.
//!
//! By the crate `flip-rs`, a port of NVIDIA's C++. The binding `nv-flip` would need a C++ compiler on every machine; the
//! two gave the same 32-bit words for each pixel of the images below and of larger ones.

use flip_rs::{DEFAULT_PPD, RgbImage, ldr_flip};

use super::MetricError;

/// FLIP of each pixel of displayed images (sRGB, three bytes per pixel), 0 to 1, for a viewer who sees 67 pixels per degree:
/// the paper's 0.7 m from a screen 0.7 m wide with 3840 columns.
///
/// # Errors
/// [`MetricError::Shapes`] where the bytes are not those of two images of `size`, [`MetricError::Flip`] where they are too
/// many.
pub fn flip_map(reference: &[u8], image: &[u8], size: (u32, u32)) -> Result<Vec<f32>, MetricError> {
    let take = |bytes: &[u8]| {
        RgbImage::new(size.0 as usize, size.1 as usize, bytes.to_vec())
            .map_err(|_| MetricError::Flip { size })
    };
    let map =
        ldr_flip(&take(reference)?, &take(image)?, DEFAULT_PPD).map_err(|_| MetricError::Flip { size })?;
    Ok(map.into_pixels())
}

/// The mean over the map.
pub fn mean_flip(map: &[f32]) -> f64 {
    map.iter().map(|&x| f64::from(x)).sum::<f64>() / map.len().max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use lightbvh::exact::hash;

    fn flip(a: &[u8], b: &[u8], size: (u32, u32)) -> f64 {
        mean_flip(&flip_map(a, b, size).expect("small images"))
    }

    /// Flat images have no edges or points, and filters leave them as they are: what is left is the colour difference,
    /// here by the paper's formulas in f64 from linear greys.
    fn flat_greys(a: f64, b: f64) -> f64 {
        let hunt = |[x, y, z]: [f64; 3]| {
            let f = |t: f64| {
                let delta: f64 = 6.0 / 29.0;
                if t > delta.powi(3) {
                    t.cbrt()
                } else {
                    t / (3.0 * delta * delta) + 4.0 / 29.0
                }
            };
            let l = 116.0 * f(y) - 16.0;
            [
                l,
                0.01 * l * 500.0 * (f(x) - f(y)),
                0.01 * l * 200.0 * (f(y) - f(z)),
            ]
        };
        let distance = |a: [f64; 3], b: [f64; 3]| {
            ((a[0] - b[0]).abs() + ((a[1] - b[1]).powi(2) + (a[2] - b[2]).powi(2)).sqrt()).powf(0.7)
        };
        // Columns of the matrix from linear sRGB to XYZ over the white point, for green and blue.
        let green = [0.357_58 / 0.950_43, 0.715_17, 0.119_19 / 1.088_90];
        let blue = [0.180_45 / 0.950_43, 0.072_18, 0.950_40 / 1.088_90];
        let most = distance(hunt(green), hunt(blue));
        let d = distance(hunt([a; 3]), hunt([b; 3]));
        let knee = 0.4 * most;
        if d < knee {
            d * 0.95 / knee
        } else {
            0.95 + 0.05 * (d - knee) / (most - knee)
        }
    }

    fn linear(byte: u8) -> f64 {
        let x = f64::from(byte) / 255.0;
        if x <= 0.04045 {
            x / 12.92
        } else {
            ((x + 0.055) / 1.055).powf(2.4)
        }
    }

    #[test]
    fn flat_images_differ_by_the_papers_colour_difference() {
        let size = (8, 8);
        for (a, b) in [(0_u8, 255_u8), (100, 140), (17, 18)] {
            let found = flip(&[a; 192], &[b; 192], size);
            let expected = flat_greys(linear(a), linear(b));
            // The filtered values go through f32 and the 5-digit matrix above.
            assert!(
                (found - expected).abs() < 2e-3 * expected.max(0.05),
                "{a} {b}: {found} {expected}"
            );
        }
        // The paper scales by the distance of green from blue, the greatest there is.
        let (green, blue) = ([0_u8, 255, 0].repeat(64), [0_u8, 0, 255].repeat(64));
        assert!((flip(&green, &blue, size) - 1.0).abs() < 1e-6);
        assert_eq!(flip(&green, &green, size), 0.0);
    }

    #[test]
    fn agrees_with_nvidias_program_on_a_noisy_pattern() {
        let (width, height) = (96, 64);
        let pattern: Vec<u8> = (0..width * height * 3)
            .map(|i| {
                let (x, y) = (i / 3 % width, i / 3 / width);
                match i % 3 {
                    0 => (x * 255 / 95) as u8,
                    1 => (y * 255 / 63) as u8,
                    _ if (x / 8 + y / 8) % 2 == 0 => 40,
                    _ => 200,
                }
            })
            .collect();
        let noisy: Vec<u8> = pattern
            .iter()
            .enumerate()
            .map(|(i, &v)| (i32::from(v) + (hash(i as u32) % 61) as i32 - 30).clamp(0, 255) as u8)
            .collect();
        // Printed by nv-flip 0.1.2, which runs NVIDIA's C++, for these two images.
        let nvidia = 0.140_013_199;
        let found = flip(&pattern, &noisy, (width as u32, height as u32));
        assert!((found - nvidia).abs() < 1e-6, "{found}");
    }

    #[test]
    fn bytes_that_do_not_fit_the_size_are_refused() {
        assert!(flip_map(&[0; 3], &[0; 6], (1, 1)).is_err());
        assert!(flip_map(&[], &[], (0, 0)).is_err());
    }
}

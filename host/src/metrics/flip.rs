//! LDR-FLIP: P. Andersson, J. Nilsson, T. Akenine-Möller, M. Oskarsson, K. Åström, M. D. Fairchild, "FLIP: A Difference
//! Evaluator for Alternating Images", Proceedings of the ACM on Computer Graphics and Interactive Techniques 3(2), 2020.
//!
//! By the crate `flip-rs`, a port of NVIDIA's C++. The binding `nv-flip` would need a C++ compiler on every machine; the
//! two gave the same 32-bit words for each pixel of the images below and of larger ones.

use flip_rs::{DEFAULT_PPD, RgbImage, ldr_flip};

use super::MetricError;

/// FLIP of each pixel of displayed images (sRGB, three bytes per pixel), 0 to 1, for a viewer who sees 67 pixels per degree:
/// the paper's 0.7 m from a screen 0.7 m wide with 3840 columns.
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

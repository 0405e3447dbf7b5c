//! How surfaces reflect: diffuse and one glossy lobe.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;
use lightbvh::exact::{clamp, flush, rsqrt};
use lightbvh::vector::{dot, length_squared};

use super::grid::{STEP, TINY};

/// Largest [`Material::exponent_log2`] that counts; larger ones are read as this.
pub const MAX_EXPONENT_LOG2: u32 = 16;

const INV_PI: f32 = core::f32::consts::FRAC_1_PI;

/// A reflectance; 20 bytes. It never reflects more than arrives.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Material {
    /// Diffuse albedo, linear RGB, each in [0, 1].
    pub albedo: [f32; 3],
    /// The part of the light that the glossy lobe takes from the diffuse one, in [0, 1]; the same at every angle.
    pub specular: f32,
    /// Binary logarithm of the lobe's exponent, at most [`MAX_EXPONENT_LOG2`]: a power of two is taken by squaring.
    pub exponent_log2: u32,
}

const _: () = assert!(size_of::<Material>() == 20);

impl Material {
    /// The reflectance (BRDF) from unit direction `wi` to unit direction `wo` at unit normal `n`, 1/sr; both directions
    /// point away from the surface and lie on the normal's side.
    ///
    /// `(1 - s) albedo / pi + s (k + 6) / (8 pi) (n . h)^k` with the half vector `h` (J. Blinn, "Models of light
    /// reflection for computer synthesized pictures", 1977). The exact normalisation is
    /// `(k + 2)(k + 4) / (8 pi (k + 2^(-k/2)))` (F. Giesen, "Phong and Blinn-Phong normalization factors", 2009), which
    /// `(k + 6) / (8 pi)` stays just below for every `k >= 1`: so the lobe loses a little energy but never adds any.
    #[inline]
    #[must_use]
    pub fn eval(&self, n: Vec3, wi: Vec3, wo: Vec3) -> Vec3 {
        let specular = clamp(self.specular, 0.0, 1.0);
        let diffuse = (1.0 - specular) * INV_PI;

        let half = wi + wo;
        let squared = length_squared(half);
        // Opposite directions have no half vector; they meet only where both graze the surface.
        let cosine = if squared > STEP {
            dot(n, half) * rsqrt(squared)
        } else {
            0.0
        };
        let mut lobe = flush(clamp(cosine, 0.0, 1.0), STEP);
        let log2 = if self.exponent_log2 < MAX_EXPONENT_LOG2 {
            self.exponent_log2
        } else {
            MAX_EXPONENT_LOG2
        };
        for _ in 0..log2 {
            lobe = flush(lobe * lobe, STEP);
        }
        let exponent = (1_u32 << log2) as i32 as f32;
        let gloss = flush(specular * lobe, TINY) * ((exponent + 6.0) * (INV_PI * 0.125));

        Vec3::new(
            flush(diffuse * self.albedo[0], TINY) + gloss,
            flush(diffuse * self.albedo[1], TINY) + gloss,
            flush(diffuse * self.albedo[2], TINY) + gloss,
        )
    }
}

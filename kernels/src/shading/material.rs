//! How surfaces reflect: diffuse and one glossy lobe.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;
use lightbvh::device::emission::luminance_of;
use lightbvh::device::vector::{dot, flush3};
use lightbvh::exact::{clamp, floor_u32, flush, max, pow2};

use super::grid::{STEP, TINY, div};
use super::lobe::{about, circle, cosine_power, power_cosine};

/// Largest [`Material::exponent_log2`] that counts; larger ones are read as this.
pub const MAX_EXPONENT_LOG2: u32 = 16;

const INV_PI: f32 = core::f32::consts::FRAC_1_PI;

/// Directions less likely than this count as never sampled: a quotient by the density then stays in range.
const MIN_DENSITY: f32 = pow2(-60);

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

/// Least width of a lobe.
const LEAST_ALPHA: f32 = 1.0 / 32.0;

impl Material {
    /// The reflectance of a surface of this base colour; each number in [0, 1].
    ///
    /// Normal-incidence reflectance is 0.04 for dielectrics and the base colour for metals (glTF 2.0, appendix B.2).
    /// The exponent follows Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces",
    /// section 5.2: n = 2/α² - 2 with α = roughness², rounded down to a power of two. The glossy lobe is white, so a metal keeps its
    /// colour in the diffuse lobe that is left.
    #[must_use]
    pub fn of(base_color: [f32; 3], metallic: f32, roughness: f32) -> Self {
        let alpha = max(roughness * roughness, LEAST_ALPHA);
        let exponent = clamp(div(2.0, alpha * alpha) - 2.0, 1.0, 1024.0);
        Self {
            albedo: base_color,
            specular: 0.04 * (1.0 - metallic) + luminance_of(&base_color) * metallic,
            exponent_log2: (exponent.to_bits() >> 23) - 127,
        }
    }

    /// Material `index`, word by word.
    #[inline]
    pub(super) fn load(materials: &[Self], index: u32) -> Self {
        let own = &materials[index as usize];
        Self {
            albedo: [own.albedo[0], own.albedo[1], own.albedo[2]],
            specular: own.specular,
            exponent_log2: own.exponent_log2,
        }
    }

    /// The reflectance (BRDF) from unit direction `wi` to unit direction `wo` at unit normal `n`, 1/sr, and the density
    /// with which [`sample`](Self::sample) chooses `wi`. Both directions point away from the surface and lie on the
    /// normal's side.
    ///
    /// `(1 - s) albedo / pi + s (k + 6) / (8 pi) (n . h)^k` with the half vector `h` (J. Blinn, "Models of light
    /// reflection for computer synthesized pictures", 1977). The exact normalisation is
    /// `(k + 2)(k + 4) / (8 pi (k + 2^(-k/2)))` (F. Giesen, "Phong and Blinn-Phong normalization factors", 2009), which
    /// `(k + 6) / (8 pi)` stays just below for every `k >= 1`: so the lobe loses a little energy but never adds any.
    #[cfg_attr(target_arch = "spirv", inline(never))]
    #[cfg_attr(not(target_arch = "spirv"), inline)]
    #[must_use]
    pub fn scatter(self, n: Vec3, wi: Vec3, wo: Vec3) -> Scattering {
        let specular = self.specular();
        let diffuse = (1.0 - specular) * INV_PI;
        let half = wi + wo;
        let log2 = self.log2();
        let exponent = (1_u32 << log2) as i32 as f32;
        let lobe = cosine_power(n, half, log2);
        let gloss = flush(specular * lobe, TINY) * ((exponent + 6.0) * (INV_PI * 0.125));

        // The half vector has density k / (2 pi) (n . h)^(k-1) over its own solid angle, and the reflected direction
        // 1 / (4 wo . h) of that (pbrt-v4, section 9.6.5). With h = half / |half|, wo . h = |half| / 2, so that the
        // product is k (n . h)^k / (4 pi n . half).
        let along = dot(n, half);
        let mut gloss_density = 0.0;
        if lobe > 0.0 {
            gloss_density = div(lobe, along) * (exponent * (INV_PI * 0.25));
        }
        let diffuse_density = flush(dot(n, wi), STEP) * INV_PI;
        let share = self.gloss_share();
        let density = flush((1.0 - share) * diffuse_density, TINY) + flush(share * gloss_density, TINY);
        Scattering {
            reflectance: Vec3::new(
                flush(diffuse * self.albedo[0], TINY) + gloss,
                flush(diffuse * self.albedo[1], TINY) + gloss,
                flush(diffuse * self.albedo[2], TINY) + gloss,
            ),
            density: if diffuse_density > 0.0 && density > MIN_DENSITY {
                density
            } else {
                0.0
            },
        }
    }

    /// A unit direction that light may come from, chosen about as the reflectance times cosine, with the density
    /// that [`scatter`](Self::scatter) returns: the half vector by the lobe's own power of the cosine, or the direction by
    /// the cosine. It may lie below the surface, where the density of what is reflected is 0.
    #[cfg_attr(target_arch = "spirv", inline(never))]
    #[cfg_attr(not(target_arch = "spirv"), inline)]
    #[must_use]
    pub fn sample(self, n: Vec3, wo: Vec3, u: [f32; 3]) -> Vec3 {
        let glossy = u[2] < self.gloss_share();
        let [cosine, sine] = power_cosine(u[0], if glossy { self.log2() } else { 1 });
        let [across, up] = circle(u[1]);
        let chosen = about(n, sine * across, sine * up, cosine);
        let mirrored = flush3(chosen * (2.0 * flush(dot(wo, chosen), STEP)) - wo, STEP);
        if glossy { mirrored } else { chosen }
    }

    #[inline]
    fn specular(&self) -> f32 {
        clamp(self.specular, 0.0, 1.0)
    }

    #[inline]
    fn log2(&self) -> u32 {
        if self.exponent_log2 < MAX_EXPONENT_LOG2 {
            self.exponent_log2
        } else {
            MAX_EXPONENT_LOG2
        }
    }

    /// The part of the directions that are sampled by the lobe: its part of the reflected light, about, as a multiple of
    /// 2^-24 so that it is the exact probability.
    #[inline]
    fn gloss_share(&self) -> f32 {
        let specular = flush(self.specular(), STEP);
        let albedo = clamp(max(max(self.albedo[0], self.albedo[1]), self.albedo[2]), 0.0, 1.0);
        let both = specular + flush((1.0 - specular) * albedo, STEP);
        let mut share = 0.0;
        if both > 0.0 {
            share = floor_u32(div(specular, both) * pow2(24)) as i32 as f32 * pow2(-24);
        }
        share
    }
}

/// How a surface scatters from one direction to another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scattering {
    /// The BRDF, 1/sr, linear RGB.
    pub reflectance: Vec3,
    /// Density over solid angle with which [`Material::sample`] chooses the direction, 1/sr; 0 below the surface, and
    /// where it would be under 2^-60.
    pub density: f32,
}

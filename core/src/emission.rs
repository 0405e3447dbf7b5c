//! Emission of flat lights.

use glam::Vec3;

use crate::exact::{self, exponent, pow2, significand};
use crate::vector::{cross, dot, greatest_exponent};

/// Smallest flux that is not zero, W: smaller ones count as this much.
pub const MIN_PHI: f32 = pow2(-100);
/// Largest flux of one light, W; larger ones count as this much.
pub const MAX_PHI: f32 = pow2(100);
/// Largest flux of a set of lights, W: 2^126. Sums stop there.
pub(crate) const MAX_SUM: f32 = pow2(MAX_SUM_EXPONENT);
/// Exponent of [`MAX_SUM`].
pub(crate) const MAX_SUM_EXPONENT: i32 = 126;

/// Flux and normal of a flat light.
pub(crate) struct Emission {
    /// Radiant flux, W; zero, or in [`MIN_PHI`]`..=`[`MAX_PHI`].
    pub phi: f32,
    /// The cross product of its edges by a power of two, so that its greatest component is in [1, 2); z without area.
    pub normal: Vec3,
    /// Squared length of `normal`.
    pub squared: f32,
    /// The exponent of that power, the edges as they are given.
    pub exponent: i32,
}

/// Whether a triangle has area: its edges, the longer of exponent `edge_exponent`, are brought to about 1, and
/// `across_exponent` is that of their cross product then.
#[inline(always)]
pub(crate) fn has_area(across_exponent: i32, edge_exponent: i32) -> bool {
    (across_exponent >= -100) & (edge_exponent > -127)
}

/// The flux `shine` · 2^`exponent`, W, within the stated range; `shine` is about 1.
#[inline(always)]
pub(crate) fn bounded_phi(shine: f32, exponent: i32) -> f32 {
    let low = if exponent < -110 { -110 } else { exponent };
    let bounded = if low > 110 { 110 } else { low };
    exact::max(exact::min(shine * exact::power(bounded), MAX_PHI), MIN_PHI)
}

/// Luminance of linear R, G, B (Rec. ITU-R BT.709-6, section 3).
#[inline(always)]
#[must_use]
pub fn luminance_of(rgb: &[f32; 3]) -> f32 {
    (0.2126 * rgb[0] + 0.7152 * rgb[1]) + 0.0722 * rgb[2]
}

/// The emission of a flat light whose edges are `a` and `b` by 2^`edge_exponent`: together of about 1; `per_product` is its flux over its
/// luminance and the length of a × b. Without a branch, for processors that compute several at a time.
#[inline(always)]
pub(crate) fn flux_of(a: Vec3, b: Vec3, edge_exponent: i32, luminance: f32, per_product: f32) -> Emission {
    let across = cross(a, b);
    let across_exponent = greatest_exponent(across, -127);
    let has_area = has_area(across_exponent, edge_exponent);
    let scaled = across * pow2(-across_exponent);
    let area = exact::mask_of(has_area);
    let normal = Vec3::new(
        exact::masked(area, scaled.x),
        exact::masked(area, scaled.y),
        f32::from_bits(exact::masked_u32(area, scaled.z.to_bits(), 1.0_f32.to_bits())),
    );
    let squared = dot(normal, normal);

    // Φ = significand · 2^exponent, put together once, within the stated range.
    let shine = significand(luminance) * exact::sqrt(squared) * per_product;
    let phi = bounded_phi(
        shine,
        exponent(luminance) + across_exponent + edge_exponent + edge_exponent,
    );
    Emission {
        phi: exact::masked(area & exact::mask_of(luminance > 0.0), phi),
        normal,
        squared,
        exponent: across_exponent,
    }
}

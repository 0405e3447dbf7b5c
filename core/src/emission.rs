//! What a triangle emits.

use glam::Vec3;

use crate::exact::{self, exponent, pow2, significand};
use crate::light::EmissiveTriangle;
use crate::vector::{abs3, cross, dot, greatest_exponent, max3};

/// Smallest flux that is not zero, W: smaller ones count as this much.
pub const MIN_PHI: f32 = pow2(-100);
/// Largest flux of one light, W; larger ones count as this much.
pub const MAX_PHI: f32 = pow2(100);
/// Largest flux of a set of lights, W: 2^126. Sums stop there.
pub(crate) const MAX_SUM: f32 = pow2(MAX_SUM_EXPONENT);
/// Exponent of [`MAX_SUM`].
pub(crate) const MAX_SUM_EXPONENT: i32 = 126;

/// What a triangle emits, and its normal.
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
fn has_area(across_exponent: i32, edge_exponent: i32) -> bool {
    (across_exponent >= -100) & (edge_exponent > -127)
}

/// Whether `triangle` has flux, for less than [`flux`] costs.
#[inline(always)]
pub(crate) fn has_flux(triangle: &EmissiveTriangle) -> bool {
    let p0 = triangle.vertex(0);
    let (e1, e2) = (triangle.vertex(1) - p0, triangle.vertex(2) - p0);
    let edge_exponent = greatest_exponent(max3(abs3(e1), abs3(e2)), -127);
    let to_one = pow2(-edge_exponent);
    let across_exponent = greatest_exponent(cross(e1 * to_one, e2 * to_one), -127);
    has_area(across_exponent, edge_exponent) & (triangle.luminance() > 0.0)
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
pub(crate) fn luminance_of(rgb: &[f32; 3]) -> f32 {
    (0.2126 * rgb[0] + 0.7152 * rgb[1]) + 0.0722 * rgb[2]
}

/// The emission of `triangle`, whose edges are `a` and `b` by 2^`edge_exponent`: together of about 1. Without a branch, for
/// processors that compute several at a time.
#[inline(always)]
pub(crate) fn flux(a: Vec3, b: Vec3, edge_exponent: i32, triangle: &EmissiveTriangle) -> Emission {
    let per_product = if triangle.is_two_sided() {
        core::f32::consts::PI
    } else {
        core::f32::consts::FRAC_PI_2
    };
    flux_of(a, b, edge_exponent, triangle.luminance(), per_product)
}

/// The same of any flat light: `per_product` is its flux over its luminance and the length of a × b.
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
    let faces = per_product;
    let shine = significand(luminance) * exact::sqrt(squared) * faces;
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

#[cfg(test)]
mod tests {
    extern crate std;

    use std::format;

    use super::*;
    use crate::bounds::LightBounds;
    use crate::exact::hash;

    #[test]
    fn has_flux_where_flux_is_above_zero() {
        let mut counts = [0_u32; 2];
        for seed in 0..200_000_u32 {
            let word = |k: u32| hash(seed.wrapping_mul(31).wrapping_add(k));
            // Coordinates over the whole range; edges of unlike lengths, some as long as rounding, some none; few radiances are 0.
            let size = pow2((word(0) % 120) as i32 - 79);
            let at = |k: u32| (word(k) >> 8) as f32 * pow2(-23) - 1.0;
            let p0 = [at(2), at(3), at(4)];
            let vertex = |k: u32| {
                let near = pow2(-((word(k + 3) % 40) as i32));
                core::array::from_fn(|i| (p0[i] + near * at(k + i as u32)) * size)
            };
            let radiance = core::array::from_fn(|i| if word(20 + i as u32) % 4 == 0 { 0.0 } else { 1.0e-6 });
            let p1 = vertex(8);
            let triangle = EmissiveTriangle {
                p: [
                    p0.map(|x| x * size),
                    p1,
                    if word(14) % 8 == 0 { p1 } else { vertex(30) },
                ],
                radiance,
                mesh: 0,
                flags: word(15) & EmissiveTriangle::TWO_SIDED,
            };
            let expected = LightBounds::of_triangle(&triangle).phi > 0.0;
            assert_eq!(has_flux(&triangle), expected, "{triangle:?}");
            counts[usize::from(expected)] += 1;
        }
        assert!(counts[0] > 10_000 && counts[1] > 10_000, "{counts:?}");
    }

    /// The cross product of the edges is 2^-k of the longer one squared: flux from 2^-100 on.
    #[test]
    fn needles_have_flux_down_to_the_stated_area() {
        for k in 90..110 {
            for size in [pow2(-20), 1.0, pow2(30)] {
                // Edges of about one length, and of lengths far apart.
                for shorter in [0, 60] {
                    let base = [size * pow2(-shorter), 0.0, 0.0];
                    let apex = [size, size * pow2(shorter - k), 0.0];
                    for p in [[[0.0; 3], base, apex], [[0.0; 3], apex, base]] {
                        let (triangle, what) = (crate::kit::triangle(p), format!("2^-{k} of {size:e}"));
                        assert_eq!(LightBounds::of_triangle(&triangle).phi > 0.0, k <= 100, "{what}");
                        assert_eq!(has_flux(&triangle), k <= 100, "{what}");
                    }
                }
            }
        }
    }
}

//! Bounds and moments of a triangle.

use crate::bounds::{LightBounds, LightMoments};
use crate::cone::normalized;
use crate::emission::{Emission, flux_of, has_area};
use crate::exact::{self, pow2};
use crate::light::EmissiveTriangle;
use crate::vector::{abs3, cross, dot, greatest_exponent, max3, min3};
use glam::Vec3;

/// Constants of their own: rust-gpu does not fold an expression of literals.
const THIRD: f32 = 1.0 / 3.0;
const TWENTY_FOURTH: f32 = 1.0 / 24.0;
/// Exponent of the least cross product, in units of the longest edge squared, that has a direction.
const LEAST_CROSS: i32 = -60;

/// Least exponent of a set's size: 2^-100 m, the least coordinate that is not zero.
const LEAST_EXPONENT: i32 = -100;

/// Whether `triangle` has flux, for less than [`flux`] costs.
#[inline(always)]
pub(super) fn has_flux(triangle: &EmissiveTriangle) -> bool {
    let p0 = triangle.vertex(0);
    let (e1, e2) = (triangle.vertex(1) - p0, triangle.vertex(2) - p0);
    let edge_exponent = greatest_exponent(max3(abs3(e1), abs3(e2)), -127);
    let to_one = pow2(-edge_exponent);
    let across_exponent = greatest_exponent(cross(e1 * to_one, e2 * to_one), -127);
    has_area(across_exponent, edge_exponent) & (triangle.luminance() > 0.0)
}

/// The emission of `triangle`, whose edges are `a` and `b` by 2^`edge_exponent`: together of about 1. Without a branch, for
/// processors that compute several at a time.
#[inline(always)]
pub(super) fn flux(a: Vec3, b: Vec3, edge_exponent: i32, triangle: &EmissiveTriangle) -> Emission {
    let per_product = if triangle.is_two_sided() {
        core::f32::consts::PI
    } else {
        core::f32::consts::FRAC_PI_2
    };
    flux_of(a, b, edge_exponent, triangle.luminance(), per_product)
}

impl LightBounds {
    /// Bounds of one emissive triangle: its box, its normal, and Φ = π · area · luminance, twice that for two sides
    /// (a diffuse emitter: pbrt-v4 `DiffuseAreaLight::Phi`).
    ///
    /// The triangle has no flux when its luminance is zero, or when the `f32` cross product of its edges is below about 2^-100
    /// of its longest edge squared: that of every area so small is, and rounding can make it so from 2^-22 on.
    #[inline(always)]
    #[must_use]
    pub fn of_triangle(triangle: &EmissiveTriangle) -> Self {
        let (p0, p1, p2) = (triangle.vertex(0), triangle.vertex(1), triangle.vertex(2));
        let (e1, e2) = (p1 - p0, p2 - p0);

        // Scale the edges, then their cross product, to about 1 by powers of two, so that no product leaves the range.
        let (e1_scale, e2_scale) = (greatest_exponent(e1, -127), greatest_exponent(e2, -127));
        let edge_scale = if e1_scale > e2_scale { e1_scale } else { e2_scale };
        let to_one = pow2(-edge_scale);
        let emission = flux(e1 * to_one, e2 * to_one, edge_scale, triangle);
        let (n, across_scale) = (emission.normal, emission.exponent);

        // Rounding turns the normal by up to 2^-21 |e1||e2| / |e1 × e2| rad: 2^-24 for each edge, as much again for
        // products and difference, and some for safety. In a needle that may be any angle, so its cone is opened.
        let (a, b) = (e1 * pow2(-e1_scale), e2 * pow2(-e2_scale));
        let excess = e1_scale + e2_scale - (across_scale + edge_scale + edge_scale);
        let bounded = if excess < 40 { excess } else { 40 };
        let turn_squared = dot(a, a) * dot(b, b) * exact::recip(dot(n, n)) * pow2(bounded + bounded - 42);
        let any_normal = triangle.is_two_sided() || turn_squared > 0.015_625;

        Self {
            min: min3(p0, min3(p1, p2)),
            max: max3(p0, max3(p1, p2)),
            axis: normalized(n),
            cos_theta_o: if any_normal { -1.0 } else { 1.0 - turn_squared },
            phi: emission.phi,
        }
    }
}

/// Moments of one triangle; its flux is that of [`LightBounds::of_triangle`]. Without flux the other numbers mean nothing. There is no
/// branch in it, so that processors compute several triangles at a time.
#[inline(always)]
pub(super) fn moments(triangle: &EmissiveTriangle) -> LightMoments {
    let p0 = triangle.vertex(0);
    let (e1, e2) = (triangle.vertex(1) - p0, triangle.vertex(2) - p0);
    // Edges of about 1 by a power of two, so that no product leaves the range. Shorter edges than the least are whole
    // multiples of 2^-23 of it, so no product of theirs is too small either.
    let e = greatest_exponent(max3(abs3(e1), abs3(e2)), LEAST_EXPONENT);
    let (to_one, unit) = (exact::power(-e), exact::power(e));
    let (a, b) = (e1 * to_one, e2 * to_one);
    let emission = flux(a, b, e, triangle);
    let mean = (a + b) * THIRD;
    let (da, db) = (a - mean, b - mean);
    // The variance of a triangle is the sum of its vertices' squares over 12, of all axes; it has two.
    let sum = (dot(mean, mean) + dot(da, da)) + dot(db, db);
    let across = exact::sqrt(sum * TWENTY_FOURTH) * unit;
    let directed = !triangle.is_two_sided() & (emission.exponent >= LEAST_CROSS);
    let directed = exact::mask_of(directed);
    LightMoments {
        phi: emission.phi,
        c: p0 + mean * unit,
        across,
        along: exact::masked(!directed, across),
        m: emission.normal * exact::masked(directed, exact::rsqrt(emission.squared)),
        h: max3(abs3(mean), max3(abs3(da), abs3(db))) * unit,
    }
}

#[cfg(test)]
mod tests {
    extern crate std;

    use std::format;

    use super::*;
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

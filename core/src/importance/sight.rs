//! Distances from a point to a child's centre.

use glam::Vec3;

use super::Scaled;
use crate::exact::{self, exponent, pow2, recip_rough, rsqrt_rough, significand};
use crate::point::ShadingPoint;
use crate::vector::flush3;

/// Squared distances count as at least this, m²: 2^-100.
pub const MIN_DISTANCE_SQUARED: f32 = pow2(-100);

/// Lengths along an axis count as zero below this, metres: their squares are then normal numbers.
const LEAST_OFFSET: f32 = pow2(-62);
/// Lengths along a direction count as zero below this, metres: 2^-25 of the least distance. No product of two lengths is then subnormal that a
/// sum shows: where both are short, both across are about the distance.
pub const LEAST_ALONG: f32 = pow2(-75);

/// From the point to `center`, metres.
#[inline(always)]
#[must_use]
pub fn offset(center: Vec3, point: &ShadingPoint) -> Vec3 {
    flush3(center - point.position(), LEAST_OFFSET)
}

/// `phi` · `factor` / `squared`, exponents apart: a squared distance with what softens it, m².
#[inline(always)]
#[must_use]
pub fn over_distance(phi: f32, squared: f32, factor: f32) -> Scaled {
    let soft = exact::max(squared, MIN_DISTANCE_SQUARED);
    let value = significand(phi) * recip_rough(significand(soft)) * factor;
    Scaled::of(phi, value, -exponent(soft))
}

/// Square root by the rough reciprocal root; 2^-62 for anything below 2^-124.
#[inline(always)]
#[must_use]
pub fn root(x: f32) -> f32 {
    const LEAST: f32 = pow2(-124);
    let bounded = exact::max(x, LEAST);
    bounded * rsqrt_rough(bounded)
}

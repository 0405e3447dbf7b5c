//! The grid of lengths: multiples of 2^-40 m.
//!
//! Devices may flush subnormal numbers to zero and the CPU keeps them, so none must come up. Coordinates on the grid
//! differ by zero or at least 2^-40; with cross products flushed below 2^-60 ([`flush_vector`]) every product in the
//! ray tests is zero or at least 2^-100, and every sum of such products zero or at least 2^-123: all normal.

use glam::Vec3;
use lightbvh::exact::{abs, flush, pow2};

/// The grid's step, metres.
pub const STEP: f32 = pow2(-40);
/// Largest magnitude of a coordinate that is rendered, metres: 2^30, so that the squared length of a cross product of two
/// edges stays below 2^127.
pub const MAX_COORDINATE: f32 = pow2(30);
/// Components of a cross product of two lengths below this, m², count as zero.
pub const TINY_AREA: f32 = pow2(-60);
/// Products of three or four lengths, and weights, below this count as zero.
pub const TINY: f32 = pow2(-100);
/// Numbers from here on are multiples of the step already, having 24 significant bits.
const COARSE: f32 = pow2(-17);

/// `x` on the grid: small numbers are truncated towards zero (by less than a picometre), others stay.
#[inline]
#[must_use]
pub fn snap(x: f32) -> f32 {
    // Below 2^-17 the quotient is below 2^23: both conversions are exact.
    if abs(x) < COARSE {
        (x * pow2(40)) as i32 as f32 * STEP
    } else {
        x
    }
}

/// [`snap`] for a point.
#[inline]
#[must_use]
pub fn snap_point(p: Vec3) -> Vec3 {
    Vec3::new(snap(p.x), snap(p.y), snap(p.z))
}

/// `v` with +0 for each component smaller than `tiny`.
#[inline]
#[must_use]
pub fn flush_vector(v: Vec3, tiny: f32) -> Vec3 {
    Vec3::new(flush(v.x, tiny), flush(v.y, tiny), flush(v.z, tiny))
}

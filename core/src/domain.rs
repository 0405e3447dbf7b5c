//! The domain in which lights and points are accepted.

use crate::exact;

/// Largest magnitude of a coordinate, metres: 2^40.
pub const MAX_COORDINATE: f32 = exact::pow2(40);
/// Smallest magnitude of a coordinate that is not zero, metres: 2^-100. The difference of two coordinates is then zero
/// or a normal number, which a device that flushes subnormal numbers keeps.
pub const MIN_COORDINATE: f32 = exact::pow2(MIN_COORDINATE_EXPONENT);
pub(crate) const MIN_COORDINATE_EXPONENT: i32 = -100;
/// Offsets from coordinates count as zero below this, metres: 2^-103. The last place of all others is a normal number, and so is every sum.
pub(crate) const MIN_OFFSET: f32 = exact::pow2(-103);
/// Smallest radiance that is not zero, W/(m² sr): 2^-100.
pub const MIN_RADIANCE: f32 = exact::pow2(-100);
/// Largest radiance, W/(m² sr): 2^100.
pub const MAX_RADIANCE: f32 = exact::pow2(100);

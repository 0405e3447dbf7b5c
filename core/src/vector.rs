//! Products of vectors with the order of operations fixed here.
//!
//! glam's own `dot` and `length` may use other instructions on other targets; component access and `+`, `-`, `*` on
//! [`Vec3`] are plain scalar operations everywhere, and the only ones shared code uses.

use glam::Vec3;

use crate::exact;

/// The same coordinates.
#[inline(always)]
pub(crate) fn vector(v: &[f32; 3]) -> Vec3 {
    Vec3::new(v[0], v[1], v[2])
}

/// `(ax bx + ay by) + az bz`.
#[inline]
#[must_use]
pub fn dot(a: Vec3, b: Vec3) -> f32 {
    (a.x * b.x + a.y * b.y) + a.z * b.z
}

/// The cross product, right-handed.
#[inline]
#[must_use]
pub fn cross(a: Vec3, b: Vec3) -> Vec3 {
    Vec3::new(
        a.y * b.z - a.z * b.y,
        a.z * b.x - a.x * b.z,
        a.x * b.y - a.y * b.x,
    )
}

/// `(x x + y y) + z z`.
#[inline]
#[must_use]
pub fn length_squared(v: Vec3) -> f32 {
    dot(v, v)
}

/// Whether all components are zero.
#[inline(always)]
#[must_use]
pub fn is_zero(v: Vec3) -> bool {
    (v.x == 0.0) & (v.y == 0.0) & (v.z == 0.0)
}

/// Component-wise magnitude.
#[inline(always)]
#[must_use]
pub fn abs3(v: Vec3) -> Vec3 {
    Vec3::new(exact::abs(v.x), exact::abs(v.y), exact::abs(v.z))
}

/// Component-wise minimum.
#[inline(always)]
#[must_use]
pub fn min3(a: Vec3, b: Vec3) -> Vec3 {
    Vec3::new(exact::min(a.x, b.x), exact::min(a.y, b.y), exact::min(a.z, b.z))
}

/// Component-wise maximum.
#[inline(always)]
#[must_use]
pub fn max3(a: Vec3, b: Vec3) -> Vec3 {
    Vec3::new(exact::max(a.x, b.x), exact::max(a.y, b.y), exact::max(a.z, b.z))
}

/// Components of magnitude below `tiny` as +0; see [`exact::flush`].
#[inline(always)]
#[must_use]
pub fn flush3(v: Vec3, tiny: f32) -> Vec3 {
    Vec3::new(
        exact::flush(v.x, tiny),
        exact::flush(v.y, tiny),
        exact::flush(v.z, tiny),
    )
}

/// Exponent of the greatest component's magnitude, or `least` where that is greater.
#[inline(always)]
#[must_use]
pub(crate) fn greatest_exponent(v: Vec3, least: i32) -> i32 {
    let a = abs3(v);
    let e = exact::exponent(exact::max(exact::max(a.x, a.y), a.z));
    if e > least { e } else { least }
}

//! Products of vectors with the order of operations fixed here.
//!
//! glam's own `dot` and `length` may use other instructions on other targets; component access and `+`, `-`, `*` on
//! [`Vec3`] are plain scalar operations everywhere, and the only ones shared code uses.

use glam::Vec3;

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

//! Directions as places in a square: the sphere projected onto an octahedron and unfolded (Engelhardt and Dachsbacher, *Octahedron
//! environment maps*, 2008).
//!
//! The pole is y. The square is −1 to 1 both ways; what lies above the horizon is the diamond |u| + |v| ≤ 1, below it are the corners. A place (u, v) is the
//! point (u, 1 − |u| − |v|, v) of the octahedron |x| + |y| + |z| = 1, at distance r from its middle. The faces are at distance 1/√3, so du dv is seen
//! under the solid angle du dv / r³.

use glam::Vec3;

use crate::exact;
use crate::vector::length_squared;

/// `a` with the sign of `b`, + of zero.
#[inline(always)]
fn signed(a: f32, b: f32) -> f32 {
    if b < 0.0 { -a } else { a }
}

/// The point of the octahedron at a place, each coordinate from −1 to 1.
#[inline(always)]
fn on_octahedron(u: f32, v: f32) -> Vec3 {
    let (a, b) = (exact::abs(u), exact::abs(v));
    let y = 1.0 - (a + b);
    if y < 0.0 {
        Vec3::new(signed(1.0 - b, u), y, signed(1.0 - a, v))
    } else {
        Vec3::new(u, y, v)
    }
}

/// The unit direction at a place, each coordinate from −1 to 1.
#[inline]
#[must_use]
pub fn direction_at(place: [f32; 2]) -> [f32; 3] {
    let p = on_octahedron(place[0], place[1]);
    // Rounded correctly: the length is 1 as nearly as words tell.
    let length = exact::sqrt(length_squared(p));
    [
        exact::div(p.x, length),
        exact::div(p.y, length),
        exact::div(p.z, length),
    ]
}

/// The place of a direction, which need not be of length 1: any but zero, of magnitudes from 2^-40 to 2^40. Undoes
/// [`direction_at`] up to rounding.
#[inline]
#[must_use]
pub fn place_of(direction: [f32; 3]) -> [f32; 2] {
    let [x, y, z] = direction;
    let sum = (exact::abs(x) + exact::abs(z)) + exact::abs(y);
    let (u, v) = (exact::div(x, sum), exact::div(z, sum));
    if y < 0.0 {
        [signed(1.0 - exact::abs(v), u), signed(1.0 - exact::abs(u), v)]
    } else {
        [u, v]
    }
}

/// r³ at a direction of length 1: how many times denser over solid angle than over the square a uniform choice is.
#[inline(always)]
pub(super) fn cubed_distance(direction: [f32; 3]) -> f32 {
    let sum = (exact::abs(direction[0]) + exact::abs(direction[2])) + exact::abs(direction[1]);
    let r = exact::div(1.0, sum);
    r * (r * r)
}

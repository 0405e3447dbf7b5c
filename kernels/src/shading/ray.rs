//! A ray against a triangle.

use glam::Vec3;
use lightbvh::device::vector::{cross, dot, flush3};
use lightbvh::exact::{abs, pow2, recip};

use super::grid::{STEP, TINY_AREA, div, snap_point};

/// What a missed triangle returns instead of a distance.
pub const MISS: f32 = -1.0;

/// Longest ray, in multiples of its direction, for rays that should end nowhere.
pub const FAR: f32 = pow2(40);

/// Determinants up to this, m³, are misses: the triangle is seen edge-on, or its area is below 2^-55 m².
const MIN_DETERMINANT: f32 = pow2(-54);

/// The part `0 < t < t_max` of the line `origin + t direction`.
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    /// Start, on the grid, metres.
    pub origin: Vec3,
    /// Direction; any length. Components below 2^-40 are zero.
    pub direction: Vec3,
    /// `1 / direction` by component, with ±2^-40 in place of zeros, so that no product is infinite or NaN.
    pub inverse: Vec3,
    /// End, in multiples of the direction; at most [`FAR`].
    pub t_max: f32,
}

/// A ray and a triangle.
#[derive(Clone, Copy, Debug)]
pub struct Meeting {
    /// Distance in multiples of the direction, times the determinant.
    pub t: f32,
    /// What it is scaled by; positive where `inside`.
    pub determinant: f32,
    /// Whether the line beyond the ray's start comes through the triangle.
    pub inside: bool,
}

impl Meeting {
    /// Distance to the triangle in multiples of the direction, if between 0 and `nearest`, otherwise [`MISS`].
    #[inline(always)]
    #[must_use]
    pub fn before(&self, nearest: f32) -> f32 {
        if self.inside && self.t < nearest * self.determinant {
            div(self.t, self.determinant)
        } else {
            MISS
        }
    }
}

impl Ray {
    /// A ray from `origin`, moved to the grid.
    #[inline]
    #[must_use]
    pub fn new(origin: Vec3, direction: Vec3, t_max: f32) -> Self {
        let direction = flush3(direction, STEP);
        Self {
            origin: snap_point(origin),
            direction,
            inverse: Vec3::new(inverse(direction.x), inverse(direction.y), inverse(direction.z)),
            t_max,
        }
    }

    /// What decides whether and where the ray meets a triangle. Both faces count.
    ///
    /// T. Möller and B. Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997, with everything scaled by the
    /// determinant, so that only an accepted hit pays for the division.
    // No branches: processors test several triangles at once.
    #[inline(always)]
    #[must_use]
    pub fn meet(&self, p0: Vec3, p1: Vec3, p2: Vec3) -> Meeting {
        let e1 = p1 - p0;
        let e2 = p2 - p0;
        let s = self.origin - p0;
        let pv = flush3(cross(self.direction, e2), TINY_AREA);
        let qv = flush3(cross(s, e1), TINY_AREA);
        let signed = dot(e1, pv);
        // Seen from behind, the determinant and all it scales change their sign.
        let back = signed < 0.0;
        let determinant = abs(signed);
        let u = negate_if(back, dot(s, pv));
        let v = negate_if(back, dot(self.direction, qv));
        let t = negate_if(back, dot(e2, qv));
        let inside = (u >= 0.0) & (v >= 0.0) & (u + v <= determinant);
        Meeting {
            t,
            determinant,
            inside: inside & (determinant > MIN_DETERMINANT) & (t > 0.0),
        }
    }

    /// Where the ray meets the plane of a triangle at `p0` that it is known to hit: the parts of the edges `e1` and `e2`; zeros where
    /// [`meet`](Self::meet) would see it edge-on. Coordinates within the plane need no exact division.
    #[inline]
    #[must_use]
    pub fn barycentric(&self, p0: Vec3, e1: Vec3, e2: Vec3) -> [f32; 2] {
        let pv = flush3(cross(self.direction, e2), TINY_AREA);
        let s = self.origin - p0;
        let qv = flush3(cross(s, e1), TINY_AREA);
        let determinant = dot(e1, pv);
        let counts = abs(determinant) > MIN_DETERMINANT;
        let scale = recip(if counts { determinant } else { 1.0 });
        if counts {
            [dot(s, pv) * scale, dot(self.direction, qv) * scale]
        } else {
            [0.0; 2]
        }
    }
}

#[inline]
fn negate_if(condition: bool, x: f32) -> f32 {
    if condition { -x } else { x }
}

/// `1 / d`, at most 2^40 in magnitude.
#[inline]
fn inverse(d: f32) -> f32 {
    div(1.0, if abs(d) < STEP { STEP } else { d })
}

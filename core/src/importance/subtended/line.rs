//! A segment about the centre of a set of lights.

use glam::Vec3;

use crate::exact::{self, pow2};
use crate::importance::sight::root;
use crate::point::RaySegment;
use crate::vector::{abs3, cross, dot, flush3, greatest_exponent, length_squared, max3, vector};
use crate::weight::recip;

/// Approximation of the arc of the tangent x, up to 1: x/(1 + BEND x²).
const BEND: f32 = 0.28;
/// Least exponent of the scale: about the least difference of coordinates.
const LEAST_EXPONENT: i32 = -100;
/// Lengths, in units of the scale, below this are none: their squares would be subnormal.
const LEAST: f32 = pow2(-60);

/// The segment with the centre at the origin, lengths in units of 2^`exponent`: together of about 1.
#[derive(Clone, Copy)]
pub struct Line {
    a: Vec3,
    b: Vec3,
    pub exponent: i32,
    /// 2^−`exponent`.
    pub to_one: f32,
}

impl Line {
    /// `size` is how large the set of lights is.
    #[inline(always)]
    pub fn of(segment: &RaySegment, center: Vec3, size: Vec3) -> Self {
        let (from, to) = (&segment.from, &segment.to);
        let a = vector(from) - center;
        let b = vector(to) - center;
        let greatest = max3(max3(abs3(a), abs3(b)), abs3(size));
        let exponent = greatest_exponent(greatest, LEAST_EXPONENT);
        let to_one = pow2(-exponent);
        Self {
            a: flush3(a * to_one, LEAST),
            b: flush3(b * to_one, LEAST),
            exponent,
            to_one,
        }
    }

    /// The mean over the segment of 1/(d² + `s_squared`): θ/(D L).
    #[inline(always)]
    pub fn mean(&self, s_squared: f32) -> f32 {
        let (a, b) = (self.a, self.b);
        let ends = root(length_squared(a) + s_squared) * root(length_squared(b) + s_squared);
        let cosine = exact::max(ends + (dot(a, b) + s_squared), pow2(-40));
        let chord = flush3(b - a, LEAST);
        // D L: D is across the segment. Of a short segment far away it is about zero, and so is its arc.
        let sine = root(exact::max(
            length_squared(flush3(cross(a, chord), LEAST)) + s_squared * length_squared(chord),
            pow2(-100),
        ));
        let is_narrow = cosine >= sine;
        let greater = if is_narrow { cosine } else { sine };
        let inverse = recip(greater);
        let x = if is_narrow { sine } else { cosine } * inverse;
        let bend = recip(1.0 + BEND * (x * x));
        let narrow = 2.0 * bend;
        let wide = core::f32::consts::PI - 2.0 * (x * bend);
        (if is_narrow { narrow } else { wide }) * inverse
    }

    /// Where a quarter and three quarters of the angle lie before.
    #[inline(always)]
    pub fn quarters(&self, s_squared: f32) -> [Vec3; 2] {
        let distance = |p: Vec3| root(length_squared(p) + s_squared);
        let between =
            |p: Vec3, q: Vec3, from_p: f32, from_q: f32| p + (q - p) * (from_p * recip(from_p + from_q));
        let (from_a, from_b) = (distance(self.a), distance(self.b));
        let middle = between(self.a, self.b, from_a, from_b);
        let from_middle = distance(middle);
        [
            between(self.a, middle, from_a, from_middle),
            between(middle, self.b, from_middle, from_b),
        ]
    }
}

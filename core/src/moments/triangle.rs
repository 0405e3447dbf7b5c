//! The moments of one triangle.

use super::{LEAST_EXPONENT, LightMoments};
use crate::emission::flux;
use crate::exact;
use crate::light::EmissiveTriangle;
use crate::vector::{abs3, dot, greatest_exponent, max3};

/// Constants of their own: rust-gpu does not fold an expression of literals.
const THIRD: f32 = 1.0 / 3.0;
const TWENTY_FOURTH: f32 = 1.0 / 24.0;
/// Exponent of the least cross product, in units of the longest edge squared, that has a direction.
const LEAST_CROSS: i32 = -60;

impl LightMoments {
    /// Moments of one triangle; its flux is that of [`LightBounds::of_triangle`](crate::LightBounds::of_triangle).
    ///
    /// Without flux the other numbers mean nothing. There is no branch in it, so that processors compute several triangles at a time.
    #[inline(always)]
    #[must_use]
    pub fn of_triangle(triangle: &EmissiveTriangle) -> Self {
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
        Self {
            phi: emission.phi,
            c: p0 + mean * unit,
            across,
            along: exact::masked(!directed, across),
            m: emission.normal * exact::masked(directed, exact::rsqrt(emission.squared)),
            h: max3(abs3(mean), max3(abs3(da), abs3(db))) * unit,
        }
    }
}

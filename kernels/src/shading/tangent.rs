//! Normals that a texture bends.

use glam::Vec3;
use lightbvh::device::vector::{cross, dot, length_squared};
use lightbvh::exact::{abs, pow2, rsqrt};

use super::grid::{STEP, TINY_AREA, div, flush_vector, sqrt};

/// Least cosine to the viewer that a bent normal keeps: below it the surface's own is taken.
const LEAST_COSINE: f32 = pow2(-6);
/// Squares of lengths below this are none.
const LEAST_SQUARED: f32 = pow2(-80);

/// The normal that a texture bends `n` to, which points to the side of the viewer at `wo`, on a triangle with edges `e1` and `e2` along which the texture
/// coordinates grow by `uv`. `map` is its numbers along the direction in which the first coordinate grows, against that of the second, and
/// along the normal (glTF 2.0, section 3.9.3). The directions are those of the triangle (E. Lengyel, "Mathematics for 3D Game Programming
/// and Computer Graphics", 2011, section 7.8). Where coordinates tell none, or the viewer would be behind, the normal stays.
#[cfg_attr(target_arch = "spirv", inline(never))]
#[cfg_attr(not(target_arch = "spirv"), inline)]
#[must_use]
pub fn bent(n: Vec3, wo: Vec3, [e1, e2]: [Vec3; 2], uv: [[f32; 2]; 2], map: [f32; 3]) -> Vec3 {
    let [[u1, v1], [u2, v2]] = uv;
    // Edges of about 1 m, so that no product leaves the range.
    let scale = rsqrt(largest(length_squared(e1), length_squared(e2)));
    let (e1, e2) = (flush_vector(e1 * scale, STEP), flush_vector(e2 * scale, STEP));
    // Seen from behind, all of the map is turned around.
    let across = if dot(cross(e1, e2), n) < 0.0 { -1.0 } else { 1.0 };
    let turned = u1 * v2 - u2 * v1;
    let side = if turned < 0.0 { -1.0 } else { 1.0 };
    let along = flush_vector((e1 * v2 - e2 * v1) * side, STEP);
    let growing = flush_vector((e2 * u1 - e1 * u2) * side, STEP);
    let tangent = flush_vector(along - n * dot(n, along), STEP);
    let squared = length_squared(tangent);
    let mut normal = n;
    if squared > LEAST_SQUARED && abs(turned) > STEP {
        let tangent = tangent * rsqrt(squared);
        let other = flush_vector(cross(n, tangent), TINY_AREA);
        // Green points up, and the second coordinate grows downward.
        let up = if dot(other, growing) > 0.0 { -1.0 } else { 1.0 };
        let sum = (tangent * (map[0] * across) + other * (map[1] * (up * across)))
            + n * largest(map[2], LEAST_COSINE);
        let sum = flush_vector(sum, STEP);
        let length = length_squared(sum);
        if length > LEAST_SQUARED {
            let found = flush_vector(sum * div(1.0, sqrt(length)), STEP);
            if dot(found, wo) > LEAST_COSINE {
                normal = found;
            }
        }
    }
    normal
}

#[inline]
fn largest(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

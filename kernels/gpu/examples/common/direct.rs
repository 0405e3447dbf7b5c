//! Direct light on a point: an ordinary function with the same words on both processors.
//!
//! It divides by `exact::div` and compares by `exact::max`, because a device's own division and `max` may give other words.
//! The builder says so where one is used.

use lightbvh::device::vector::{cross, dot, length_squared};
use lightbvh::exact::{div, hash, max};
use lightbvh::refit::world_light;
use lightbvh::{DefaultTree, EmissiveTriangle, Random64, ShadingPoint};

/// The mean of `samples` light samples at `point`. `lights` are `Bvh::lights`; `seed` tells points apart.
#[inline]
pub fn direct_light(
    tree: &DefaultTree<'_>,
    lights: &[EmissiveTriangle],
    point: &ShadingPoint,
    samples: u32,
    seed: u32,
) -> [f32; 3] {
    let (mut red, mut green, mut blue) = (0.0, 0.0, 0.0);
    for k in 0..samples {
        let random = hash(hash(seed) ^ k);
        let sampled = tree.sample(point, Random64::from(random));
        if sampled.pmf > 0.0 {
            let triangle = world_light(lights, tree.instances, sampled.light, sampled.instance);
            let weight = div(received(&triangle, point), sampled.pmf);
            red += triangle.radiance[0] * weight;
            green += triangle.radiance[1] * weight;
            blue += triangle.radiance[2] * weight;
        }
    }
    let count = samples as i32 as f32;
    [div(red, count), div(green, count), div(blue, count)]
}

/// What arrives of a radiance of 1, as if all of it came from the triangle's centre: the cosines at both ends times the area
/// over the square of the distance.
#[inline]
fn received(triangle: &EmissiveTriangle, point: &ShadingPoint) -> f32 {
    let (a, b, c) = (triangle.vertex(0), triangle.vertex(1), triangle.vertex(2));
    let center = ((a + b) + c) * 0.333_333_34;
    let away = center - point.position();
    // As long as twice the area.
    let across = cross(b - a, c - a);
    let facing = 0.0 - dot(across, away);
    let leaving = if triangle.is_two_sided() {
        max(facing, 0.0 - facing)
    } else {
        max(facing, 0.0)
    };
    let squared = length_squared(away);
    let arriving = max(dot(point.normal(), away), 0.0);
    div(0.5 * (arriving * leaving), max(squared * squared, 1.0e-12))
}

//! The light that arrives at points, with and without shadows: what variances are measured by.

use glam::Vec3;
use lightbvh::exact::{hash, unit_f32};
use lightbvh::{EmissiveTriangle, ShadingPoint};
use lightbvh_kernels::shading::ray::Ray;
use lightbvh_kernels::shading::trace::{Surfaces, any_hit};

use crate::cli::measure::irradiance::irradiance;

/// Shadow rays to each light from each point.
const RAYS: u32 = 4;
/// Shadow rays end this share of their length before the light.
const SHORT: f32 = 1e-4;

/// Of one light at a point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sent {
    /// Irradiance without shadows, up to a common factor.
    pub light: f64,
    /// The share of it that arrives.
    pub seen: f64,
}

/// Of all lights at a point, in their order.
pub(super) fn sent(
    triangles: &[EmissiveTriangle],
    surfaces: &Surfaces<'_>,
    point: &ShadingPoint,
) -> Vec<Sent> {
    (0..)
        .zip(triangles)
        .map(|(light, triangle)| match irradiance(triangle, point) {
            0.0 => Sent {
                light: 0.0,
                seen: 0.0,
            },
            of => Sent {
                light: of,
                seen: seen(surfaces, point, triangle, light),
            },
        })
        .collect()
}

/// By rays to points spread evenly over the triangle.
fn seen(surfaces: &Surfaces<'_>, point: &ShadingPoint, triangle: &EmissiveTriangle, light: u32) -> f64 {
    let [a, b, c] = triangle.p.map(Vec3::from_array);
    let origin = Vec3::from_array(point.p);
    let visible = |&k: &u32| {
        let draw = |n: u32| unit_f32(hash(hash(light).wrapping_add(RAYS * n + k)));
        let root = ((k as f32 + draw(0)) / RAYS as f32).sqrt();
        let (u, v) = (1.0 - root, root * draw(1));
        let on = a + (b - a) * u + (c - a) * v;
        !any_hit(surfaces, &Ray::new(origin, on - origin, 1.0 - SHORT), light)
    };
    f64::from((0..RAYS).filter(visible).count() as u32) / f64::from(RAYS)
}

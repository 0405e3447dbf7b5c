//! Points to measure at.

use lightbvh::ShadingPoint;
use lightbvh::exact::{hash, unit_f32};

use crate::scene::Scene;
use crate::vector::{dot, normal};
use crate::workload::on_triangle;

/// Points on the front sides of a scene's surfaces, spread evenly over their area; none where it has no surface.
pub(in crate::cli) fn on_surfaces(scene: &Scene, frame: u32, count: u32) -> Vec<ShadingPoint> {
    let frame = scene.frame(frame);
    let surfaces: Vec<[[f32; 3]; 3]> = frame.triangles.iter().map(|t| t.p).collect();
    if surfaces.is_empty() {
        return Vec::new();
    }
    let mut ends = Vec::with_capacity(surfaces.len());
    let mut total = 0.0;
    for p in &surfaces {
        let m = normal(*p);
        total += dot(m, m).sqrt();
        ends.push(total);
    }
    let points = (0..count).map(|i| {
        let draw = |k: u32| unit_f32(hash(hash(i ^ 0x0bad_cafe).wrapping_add(k)));
        // Strata over the area, so that few points stand for all.
        let at = total * (f64::from(i) + f64::from(draw(0))) / f64::from(count);
        let index = ends.partition_point(|&end| end <= at).min(surfaces.len() - 1);
        // A little off the surface, as the origin of a shadow ray.
        let (on, n) = on_triangle(&surfaces[index], draw(1), draw(2));
        ShadingPoint {
            p: std::array::from_fn(|k| on[k] + 1e-4 * n[k]),
            n,
        }
    });
    points.collect()
}

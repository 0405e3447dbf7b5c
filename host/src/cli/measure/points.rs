//! Points to measure at.

use lightbvh::ShadingPoint;
use lightbvh::exact::{hash, unit_f32};

use crate::scene::Scene;
use crate::vector::{self, dot};

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
        total += normal(p).map_or(0.0, |(area, _)| area);
        ends.push(total);
    }
    let points = (0..count).map(|i| {
        let draw = |k: u32| unit_f32(hash(hash(i ^ 0x0bad_cafe).wrapping_add(k)));
        // Strata over the area, so that few points stand for all.
        let at = total * (f64::from(i) + f64::from(draw(0))) / f64::from(count);
        let index = ends.partition_point(|&end| end <= at).min(surfaces.len() - 1);
        let p = &surfaces[index];
        let (u, v) = (draw(1), draw(2));
        let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
        let n = normal(p).map_or([0.0, 1.0, 0.0], |(_, n)| n);
        // A little off the surface, as the origin of a shadow ray.
        let on: [f32; 3] =
            std::array::from_fn(|k| p[0][k] + (p[1][k] - p[0][k]) * u + (p[2][k] - p[0][k]) * v);
        ShadingPoint {
            p: std::array::from_fn(|k| on[k] + 1e-4 * n[k]),
            n,
        }
    });
    points.collect()
}

/// Area and unit normal; `None` without area.
fn normal(p: &[[f32; 3]; 3]) -> Option<(f64, [f32; 3])> {
    let m = vector::normal(*p);
    let length = dot(m, m).sqrt();
    (length > 0.0).then(|| (0.5 * length, m.map(|x| (x / length) as f32)))
}

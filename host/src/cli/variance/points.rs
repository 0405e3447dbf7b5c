//! Lights and points to measure at.

use lightbvh::exact::{hash, unit_f32};
use lightbvh::{Lights, ShadingPoint};

use crate::cli::bench::scene::{random_lights, random_queries};
use crate::error::HostError;
use crate::render::camera;
use crate::scene::Scene;
use crate::vector::{self, dot};
use crate::workload::lights_at;

/// The lights of a scene, and points on the front sides of its surfaces, spread evenly over their area; in the scene `random`
/// points anywhere with any normal.
pub(in crate::cli) fn of(
    name: &str,
    lights: u32,
    frame: u32,
    count: u32,
) -> Result<(Lights, Vec<ShadingPoint>), HostError> {
    if name == "random" {
        let points = random_queries(count).into_iter().map(|query| query.point);
        return Ok((random_lights(lights), points.collect()));
    }
    let scene = Scene::open(name)?;
    let lights = lights_at(&scene, frame)?;
    let surfaces: Vec<[[f32; 3]; 3]> = scene.frame(frame).triangles.iter().map(|t| t.p).collect();
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
    Ok((lights, points.collect()))
}

/// Where the camera of the scene is; nowhere in the scene `random`.
pub(in crate::cli) fn eye(name: &str, frame: u32) -> Result<Option<[f32; 3]>, HostError> {
    if name == "random" {
        return Ok(None);
    }
    let view = Scene::open(name)?.frame(frame).camera;
    Ok(Some(camera(&view, 1, 1).origin))
}

/// Area and unit normal; `None` without area.
fn normal(p: &[[f32; 3]; 3]) -> Option<(f64, [f32; 3])> {
    let m = vector::normal(*p);
    let length = dot(m, m).sqrt();
    (length > 0.0).then(|| (0.5 * length, m.map(|x| (x / length) as f32)))
}

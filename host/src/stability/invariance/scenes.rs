//! The scenes that are compared with themselves.

use glam::{DMat3, DQuat, DVec3};
use lightbvh::{EmissiveTriangle, ShadingPoint};

use super::Scene;
use crate::stability::case::around;
use crate::stability::random::Random;

/// `base` about twelve axes.
pub(super) fn turns(base: &Scene) -> Vec<Scene> {
    let random = &mut Random::new(9);
    (0..12)
        .map(|_| {
            let axis = DVec3::from(random.direction().map(f64::from)).normalize();
            base.turned(DMat3::from_quat(DQuat::from_axis_angle(
                axis,
                f64::from(random.between(0.1, 3.0)),
            )))
        })
        .collect()
}

/// A scene on a grid of 1 m about the origin, and the same at 10^7 m, where that is the grid of f32: no vertex is rounded.
pub(super) fn offset() -> (Scene, Scene) {
    let random = &mut Random::new(13);
    let mut lights = Vec::new();
    for i in 0..400 {
        let corner = [0; 3].map(|_| random.between(0.0, 2000.0).floor());
        let vertex = |random: &mut Random| corner.map(|c| c + random.between(-40.0, 40.0).floor());
        lights.push(EmissiveTriangle {
            p: [corner, vertex(random), vertex(random)],
            radiance: [1.0; 3],
            mesh: i / 8,
            flags: u32::from(i.is_multiple_of(4)),
        });
    }
    let points = around(&lights, 48, random);
    let points = points.into_iter().map(|point| ShadingPoint {
        p: point.p.map(f32::floor),
        ..point
    });
    let near = Scene {
        points: points.collect(),
        lights,
    };
    let far = near.mapped(|[x, y, z]| [x + 1e7, y - 1e7, z + 1e7], |n| n);
    (near, far)
}

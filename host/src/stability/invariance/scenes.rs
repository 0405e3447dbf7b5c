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

/// Lights in coordinate planes, seen from coordinate axes, with `zero` for every zero.
pub(super) fn scene_of_zeros(zero: f32) -> Scene {
    let mut lights = Vec::new();
    for i in 0..48u32 {
        let mut corner = [zero; 3];
        corner[(i % 3) as usize] = 1.0 + (i / 3) as f32;
        let mut p = [corner; 3];
        p[1][(i as usize + 1) % 3] = 0.5;
        p[2][(i as usize + 2) % 3] = 0.25;
        // Radiance may be minus zero too; a subnormal one is refused.
        let blue = if zero.to_bits() == (-0f32).to_bits() {
            zero
        } else {
            0.0
        };
        lights.push(EmissiveTriangle {
            p,
            radiance: [1.0, 1.0, blue],
            mesh: i / 8,
            flags: i & 1,
        });
    }
    let axis = |k: usize, x: f32| {
        let mut v = [zero; 3];
        v[k] = x;
        v
    };
    let mut points = Vec::new();
    for k in 0..3 {
        for x in [0.5, -2.0, 3.25, 20.0] {
            points.extend((0..3).map(|m| ShadingPoint {
                p: axis(k, x),
                n: axis(m, x.signum()),
            }));
        }
        points.push(ShadingPoint {
            p: [zero; 3],
            n: axis(k, 1.0),
        });
    }
    Scene { lights, points }
}

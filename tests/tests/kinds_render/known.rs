//! Irradiance by each kind of light.

use lightbvh::ShadingPoint;
use lightbvh::light::Light;

use super::*;
use crate::textures::{add, plain_floor, reflects};

/// What core's points on the lights of the scene send to a point of the floor at `x`: integrals, as its own tests show.
fn sent(scene: &Scene, x: f32) -> f64 {
    let lights = arrays(scene, &render_params((1, 1), 1, 1, [0.0; 3])).lights;
    let point = ShadingPoint {
        p: [x, 0.0, 0.0],
        n: [0.0, 1.0, 0.0],
    };
    let n = 512;
    let mut sum = 0.0;
    for light in lights.all() {
        for k in 0..n * n {
            let uv = [k % n, k / n].map(|k| (k as f32 + 0.5) / n as f32);
            let own = light.point_for(point.position(), uv).irradiance(&point);
            sum += f64::from(own[1]) / f64::from(n * n);
        }
    }
    sum
}

#[test]
fn each_kind_has_the_irradiance_of_its_points() {
    for kind in ALL {
        for x in [0.0, 1.1] {
            let mut data = plain_floor([x, 1.0]);
            add(&mut data, down([0.0, 2.5, 0.0]), kind, 3.0);
            let scene = Scene::new(data).expect("a sound scene");
            let irradiance = sent(&scene, x);
            assert!(irradiance > 0.01, "{kind:?} is dark");
            reflects(scene.into_data(), [irradiance; 3], [0.5; 3], 1e-3);
        }
    }
}

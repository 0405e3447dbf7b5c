//! Irradiance by each kind of light, and by skies.

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
    for light in lights.triangles() {
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

/// The sky of a uniform map lights an open floor as theory says, and as a background does by paths; a sun does by its cosine.
#[test]
fn skies_have_the_known_irradiance() {
    let sun = AnalyticKind::Directional;
    for angle in [0.0_f32, 0.9] {
        // Turned from straight down about x.
        let (sine, cosine) = (0.5 * (angle - std::f32::consts::FRAC_PI_2)).sin_cos();
        let transform = Transform::Trs {
            translation: [0.0; 3],
            rotation: [sine, 0.0, 0.0, cosine],
            scale: [1.0; 3],
        };
        let mut data = plain_floor([0.0, 1.0]);
        add(&mut data, transform, sun, 2.0);
        reflects(data, [2.0 * f64::from(angle).cos(); 3], [0.5; 3], 2e-3);
    }
    let mut data = plain_floor([0.0, 1.0]);
    data.environment = Some(Arc::new(Environment::from_fn(4, |_| [1.5; 3]).expect("a map")));
    reflects(data, [1.5 * PI; 3], [0.5; 3], 2e-3);
    // A small bright patch, which both ways find: weights share it.
    let mut data = plain_floor([0.0, 1.0]);
    let patch = |[x, y, z]: [f32; 3]| {
        let is_bright = x > 0.2 && x < 0.4 && y > 0.7 && z.abs() < 0.1;
        [if is_bright { 200.0 } else { 0.1 }; 3]
    };
    let map = Environment::from_fn(64, patch).expect("a map");
    let mut e = 0.0;
    let n = 2000;
    for i in 0..n {
        for j in 0..4 * n {
            // Even over the hemisphere's cosine: E = π times the mean radiance.
            let (u, v) = (
                (i as f64 + 0.5) / f64::from(n),
                (j as f64 + 0.5) / f64::from(4 * n),
            );
            let (r, angle) = (u.sqrt(), 2.0 * PI * v);
            let d = [r * angle.cos(), (1.0 - u).sqrt(), r * angle.sin()].map(|x| x as f32);
            e += f64::from(map.map().radiance(d)[1]) * PI / (f64::from(n) * f64::from(4 * n));
        }
    }
    data.environment = Some(Arc::new(map));
    reflects(data, [e; 3], [0.5; 3], 2e-3);
}

//! What is lit: points on lights and far away.

use lightbvh::{EmissiveTriangle, ShadingPoint, exact};

use super::super::case::Case;
use super::super::random::Random;
use super::scattered;
use crate::vector::{dot, normal};

pub(super) fn cases() -> Vec<Case> {
    let lights = scattered(200, 41);
    vec![
        Case::new("points on lights", lights.clone()).at(on_lights(&lights)),
        Case::new("points at 1e15 m", lights.clone()).at(far(1e15)),
        Case::new("points at 2^60 m", lights).at(far(exact::pow2(60))),
    ]
}

fn volume(p: [f32; 3]) -> ShadingPoint {
    ShadingPoint { p, n: [0.0; 3] }
}

/// At vertices, on edges and within lights, with the light's own normal, its opposite, none, and any.
fn on_lights(lights: &[EmissiveTriangle]) -> Vec<ShadingPoint> {
    let random = &mut Random::new(43);
    let mut points = Vec::new();
    for light in lights.iter().step_by(12) {
        let [a, b, c] = light.p;
        let m = normal(light.p);
        let length = dot(m, m).sqrt();
        let normal = m.map(|x| (x / length) as f32);
        let places = [
            a,
            std::array::from_fn(|k| 0.5 * (a[k] + b[k])),
            std::array::from_fn(|k| (a[k] + b[k] + c[k]) / 3.0),
        ];
        for p in places {
            for n in [normal, normal.map(|x| -x), [0.0; 3], random.direction()] {
                points.push(ShadingPoint { p, n });
            }
        }
    }
    points
}

fn far(distance: f32) -> Vec<ShadingPoint> {
    let random = &mut Random::new(53);
    let mut points: Vec<ShadingPoint> = (0..24)
        .map(|i| {
            let p = random.direction().map(|x| x * distance);
            let n = match i % 3 {
                0 => [0.0; 3],
                1 => p.map(|x| -x / distance),
                _ => random.direction(),
            };
            ShadingPoint { p, n }
        })
        .collect();
    points.push(volume([distance; 3]));
    points.push(volume([-distance, distance, 0.0]));
    points
}

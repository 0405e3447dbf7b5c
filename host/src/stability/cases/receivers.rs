//! What is lit: points on lights, at the centres of nodes, far away.

use lightbvh::{BuildParams, EmissiveTriangle, LightBvh, Lights, Node, ShadingPoint, Summary, exact};

use super::super::case::Case;
use super::super::random::Random;
use super::scattered;
use crate::vector::{dot, normal};

pub(super) fn cases() -> Vec<Case> {
    let lights = scattered(200, 41);
    vec![
        Case::new("points on lights", lights.clone()).at(on_lights(&lights)),
        Case::new("points at the centres of nodes", lights.clone()).at(at_centres(&lights)),
        Case::new("points at 1e15 m", lights.clone()).at(far(1e15)),
        Case::new("points at 2^60 m", lights.clone()).at(far(exact::pow2(60))),
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

/// At the centres of a tree's nodes, in volumes and on surfaces.
fn at_centres(lights: &[EmissiveTriangle]) -> Vec<ShadingPoint> {
    let random = &mut Random::new(47);
    let Ok(lights) = Lights::new(lights.to_vec()) else {
        return Vec::new();
    };
    let bvh = LightBvh::single_level(&lights, &BuildParams::default());
    let mut points = Vec::new();
    for node in bvh.nodes() {
        let p = node.summary(0).center().to_array();
        points.extend([[0.0; 3], random.direction()].map(|n| ShadingPoint { p, n }));
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

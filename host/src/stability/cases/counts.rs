//! How many lights there are: one, two, millions.

use lightbvh::{EmissiveTriangle, ShadingPoint};

use super::super::case::Case;
use super::super::random::Random;
use super::{add, scattered};

pub(super) fn few() -> Vec<Case> {
    vec![
        Case::new("one light", scattered(1, 91)),
        Case::new("three lights", scattered(3, 92)),
    ]
}

/// `count` lights anywhere in a box of 1000 m.
pub fn many(count: u32) -> Case {
    let random = &mut Random::new(97);
    let light = |i: u32| small([0; 3].map(|_| random.between(0.0, 1000.0)), i / 1000);
    let lights: Vec<_> = (0..count).map(light).collect();
    let points = vec![
        ShadingPoint {
            p: [500.0; 3],
            n: [0.0, 1.0, 0.0],
        },
        ShadingPoint {
            p: [1200.0, -300.0, 40.0],
            n: [0.0; 3],
        },
    ];
    Case::new(format!("{count} lights"), lights).at(points)
}

fn small(corner: [f32; 3], mesh: u32) -> EmissiveTriangle {
    EmissiveTriangle {
        p: [
            corner,
            add(corner, [0.25, 0.0, 0.0]),
            add(corner, [0.0, 0.25, 0.125]),
        ],
        radiance: [1.0; 3],
        mesh,
        flags: 1,
    }
}

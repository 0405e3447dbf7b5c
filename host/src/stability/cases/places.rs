//! Where lights are: scales, far from the origin, all at one place, on a line, in a plane.

use lightbvh::EmissiveTriangle;

use super::super::case::Case;
use super::super::random::Random;
use super::{facing_x, scattered};

pub(super) fn cases() -> Vec<Case> {
    let scaled = |factor: f32| {
        let mut lights = scattered(200, 3);
        for x in lights.iter_mut().flat_map(|light| light.p.iter_mut().flatten()) {
            *x *= factor;
        }
        Case::new(format!("coordinates scaled by {factor:e}"), lights)
    };
    let mut cases: Vec<Case> = [1e-12, 1e-6, 1.0, 1e6, 1e12].map(scaled).into();
    cases.push(Case::new("offset of 1e7 m", offset()));
    cases.push(Case::new("scales from 1e-12 to 1e12 in one scene", all_scales()));
    cases.push(Case::new(
        "all at one place",
        (0..64)
            .map(|i| EmissiveTriangle {
                mesh: i / 4,
                ..coincident(i)
            })
            .collect(),
    ));
    cases.push(Case::new(
        "all on a line, the same to 1e-6",
        (0..256).map(near_line).collect(),
    ));
    cases.push(Case::new("all in a plane", plane()));
    cases
}

/// Triangles of 1 to 64 m on a grid of 1 m, 10^7 m from the origin along every axis.
fn offset() -> Vec<EmissiveTriangle> {
    let random = &mut Random::new(11);
    let light = |i: u32| {
        let corner = [1e7, -1e7, 1e7].map(|o| o + random.between(0.0, 1000.0));
        let vertex = |random: &mut Random| corner.map(|c| c + random.between(-64.0, 64.0));
        EmissiveTriangle {
            p: [vertex(random), vertex(random), vertex(random)],
            radiance: [1.0; 3],
            mesh: i / 8,
            flags: u32::from(i.is_multiple_of(5)),
        }
    };
    (0..200).map(light).collect()
}

/// Lights of 1e-13 m beside lights of 1e11 m.
fn all_scales() -> Vec<EmissiveTriangle> {
    let mut lights = Vec::new();
    for power in -12..=12 {
        let factor = 10f32.powi(power);
        for mut light in scattered(8, (100 + power) as u32) {
            for x in light.p.iter_mut().flatten() {
                *x *= factor;
            }
            light.mesh = (power + 12) as u32;
            lights.push(light);
        }
    }
    lights
}

/// Equal triangles, some of them turned over.
fn coincident(i: u32) -> EmissiveTriangle {
    let mut light = facing_x([1.0, 2.0, 3.0], 0.25, 1.0, 0, 0);
    if i.is_multiple_of(3) {
        light.p.swap(1, 2);
    }
    light
}

/// Lights that lie within some units of the last place of each other.
fn near_line(i: u32) -> EmissiveTriangle {
    let x = f32::from_bits(1f32.to_bits() + i / 4);
    facing_x([x, 1.0, 1.0], 1e-2, 1.0, i / 16, 0)
}

/// 256 one-sided triangles in the plane z = 2.
fn plane() -> Vec<EmissiveTriangle> {
    let light = |i: u32| {
        let (x, y) = ((i % 16) as f32, (i / 16) as f32);
        EmissiveTriangle {
            p: [[x, y, 2.0], [x + 0.5, y, 2.0], [x, y + 0.5, 2.0]],
            radiance: [1.0; 3],
            mesh: i / 16,
            flags: 0,
        }
    };
    (0..256).map(light).collect()
}

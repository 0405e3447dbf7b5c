//! The lamps, and their edits in each frame.

use lightbvh::exact::{hash, unit_f32};
use lightbvh::{Edit, EmissiveTriangle, LightBvh, MeshId, Transform};

pub const LAMPS: u32 = 1024;

// As in `path.wgsl`.
const CELLS: f32 = 12.0;
const PITCH: f32 = 10.0;

const COLOURS: [[f32; 3]; 5] = [
    [1.0, 0.70, 0.38],
    [1.0, 0.25, 0.22],
    [0.25, 0.75, 0.95],
    [1.0, 0.55, 0.18],
    [1.0, 0.42, 0.12],
];

/// In [0, 1), of a thing and a question.
fn unit(thing: u32, question: u32) -> f32 {
    unit_f32(hash(thing ^ hash(question)))
}

/// A lamp of unit radius: two pyramids of five sides, base to base.
pub fn lamp() -> Vec<EmissiveTriangle> {
    let corner = |k: u8| {
        let (z, x) = (f32::from(k) * std::f32::consts::TAU / 5.0).sin_cos();
        [x, 0.0, z]
    };
    let [up, down] = [1.3, -1.3].map(|y| [0.0, y, 0.0]);
    let sides = (0..5).flat_map(|k| [[corner(k), up, corner(k + 1)], [corner(k + 1), down, corner(k)]]);
    let radiance = [1.0; 3];
    sides
        .map(|p| EmissiveTriangle {
            p,
            radiance,
            mesh: 0,
            flags: 0,
        })
        .collect()
}

/// Where lamp `k` is after `time` seconds: it drifts along a street, and turns.
pub fn place(k: u32, time: f32) -> Transform {
    let street = (1.0 + (CELLS - 1.0) * unit(k, 0)).floor() * PITCH;
    let across = street + 2.6 * (unit(k, 1) - 0.5);
    let along = (unit(k, 2) * CELLS * PITCH + (unit(k, 3) - 0.5) * time).rem_euclid(CELLS * PITCH);
    let height = 0.8 + 8.0 * unit(k, 4);
    let [x, z] = if k.is_multiple_of(2) {
        [along, across]
    } else {
        [across, along]
    };
    let (sin, cos) = (unit(k, 6) * 3.0 + 0.5 * time).sin_cos();
    Transform::from_trs(
        [x, height, z],
        [0.0, sin, 0.0, cos],
        [0.12 + 0.16 * unit(k, 7); 3],
    )
}

/// Of lamp `k`.
pub fn colour(k: u32) -> [f32; 3] {
    COLOURS[k as usize % COLOURS.len()]
}

/// Dim lamps, and a few bright ones: radiances from 6 to 384 W/(m² sr).
pub fn added(mesh: MeshId, k: u32) -> Edit {
    let power = 6.0 * (6.0 * unit(k, 8)).exp2();
    Edit::AddInstance {
        mesh,
        transform: place(k, 0.0),
        radiance: colour(k).map(|part| part * power),
        mask: u32::MAX,
    }
}

/// Each light, its instance, and the sum of the powers before it in parts of 2^32: `Listed` in `path.wgsl`.
pub fn listed(bvh: &LightBvh) -> Vec<[u32; 3]> {
    let power = |own: &EmissiveTriangle| {
        let edge = |to: [f32; 3]| [0, 1, 2].map(|k| f64::from(to[k] - own.p[0][k]));
        let (u, v) = (edge(own.p[1]), edge(own.p[2]));
        let area = [(1, 2), (2, 0), (0, 1)].map(|(i, j)| (u[i] * v[j] - u[j] * v[i]).powi(2));
        let [red, green, blue] = own.radiance.map(f64::from);
        area.iter().sum::<f64>().sqrt() * (0.2126 * red + 0.7152 * green + 0.0722 * blue)
    };
    let lights = bvh.view().world_lights();
    let all: f64 = lights.iter().map(power).sum();
    let mut below = 0.0;
    let with_sum = |(light, own): (u32, &EmissiveTriangle)| {
        let at = (below / all * 4_294_967_296.0) as u32;
        below += power(own);
        // The `mesh` of a light in the world is the index of its instance.
        [light, own.mesh, at]
    };
    (0..).zip(&lights).map(with_sum).collect()
}

//! Scenes that are hard for walks over bounds: most of the flux is where it cannot arrive.

use lightbvh::exact::{hash, unit_f32};
use lightbvh::{EmissiveTriangle, Lights, ShadingPoint};

/// Lights, and where they are looked at from.
pub(super) struct Scene {
    pub name: &'static str,
    pub lights: Lights,
    point: fn(u32) -> ShadingPoint,
}

impl Scene {
    /// Point `i`.
    pub fn point(&self, i: u32) -> ShadingPoint {
        (self.point)(hash(i ^ 0x51ed_270b))
    }

    /// A random number for a sample, and a light for a pmf.
    pub fn random(&self, i: u32) -> (u32, u32) {
        let random = hash(i);
        (random, hash(!random) % self.lights.all().len() as u32)
    }
}

pub(super) fn scenes() -> Vec<Scene> {
    let scene = |name, triangles, point: fn(u32) -> ShadingPoint| Scene {
        name,
        lights: Lights::new(triangles).expect("the scenes are made within the domain"),
        point,
    };
    vec![
        scene("wall below the horizon", wall(), |r| facing_wall(r, -0.001)),
        scene("wall across the horizon", wall(), |r| facing_wall(r, 0.5)),
        scene("one bright among a million dim", one_bright(), anywhere),
        scene("lights on a line, 2^i apart", exponential(), anywhere),
    ]
}

fn draw(seed: u32, k: u32) -> f32 {
    unit_f32(hash(seed.wrapping_add(k.wrapping_mul(0x9e37_79b9))))
}

fn lamp(p: [f32; 3], u: [f32; 3], v: [f32; 3], radiance: f32) -> EmissiveTriangle {
    let corner = |d: [f32; 3]| std::array::from_fn(|k| p[k] + d[k]);
    EmissiveTriangle {
        p: [p, corner(u), corner(v)],
        radiance: [radiance; 3],
        mesh: 0,
        flags: 0,
    }
}

/// 262,144 lamps in the plane x = 0 that shine along +x, from y = 0 to y = 51.2 m.
fn wall() -> Vec<EmissiveTriangle> {
    let size = 512u32;
    (0..size * size)
        .map(|i| {
            let (y, z) = ((i / size) as f32 * 0.1, (i % size) as f32 * 0.1);
            lamp([0.0, y, z], [0.0, 0.05, 0.0], [0.0, 0.0, 0.05], 1.0)
        })
        .collect()
}

/// Before the wall; `height` of it reaches above the receiver's horizon.
fn facing_wall(r: u32, height: f32) -> ShadingPoint {
    // The normal points up, so the wall is below where the point is above its upper edge.
    let top = 51.2 - height * 51.2;
    ShadingPoint {
        p: [0.5 + 20.0 * draw(r, 0), top, 51.2 * draw(r, 1)],
        n: [0.0, 1.0, 0.0],
    }
}

/// A million lamps in a box of 100 m; one sends 10^9 times as much as each other.
fn one_bright() -> Vec<EmissiveTriangle> {
    (0..1_000_000u32)
        .map(|i| {
            let p = std::array::from_fn(|k| 100.0 * draw(i, k as u32));
            let radiance = if i == 777_777 { 1.0e9 } else { 1.0 };
            lamp(p, [0.0, 0.05, 0.0], [0.05, 0.0, 0.0], radiance)
        })
        .collect()
}

fn anywhere(r: u32) -> ShadingPoint {
    ShadingPoint {
        p: std::array::from_fn(|k| 100.0 * draw(r, k as u32)),
        n: [0.6, -0.64, 0.48],
    }
}

/// Lamps at x = 2^i, i from −60 to 39, a hundred sizes of them.
fn exponential() -> Vec<EmissiveTriangle> {
    (0..100i32)
        .flat_map(|i| {
            let x = 2.0f32.powi(i - 60);
            (0..100u16).map(move |k| {
                let y = f32::from(k) * x * 0.01;
                lamp([x, y, 0.0], [0.0, 0.0, 0.01 * x], [0.0, 0.01 * x, 0.0], 1.0)
            })
        })
        .collect()
}

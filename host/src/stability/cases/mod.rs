//! The extremes.

mod counts;
mod depth;
mod flux;
mod moving;
mod places;
mod receivers;
mod shapes;

pub use counts::many;

use lightbvh::EmissiveTriangle;

use super::case::Case;
use super::random::Random;

/// All extremes but the largest, [`many`], in the order of the report.
pub fn small() -> Vec<Case> {
    [
        places::cases(),
        flux::cases(),
        shapes::cases(),
        receivers::cases(),
        depth::cases(),
        moving::cases(),
        counts::few(),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// A right triangle of legs `size` at `corner` that faces along `x`.
fn facing_x(corner: [f32; 3], size: f32, radiance: f32, mesh: u32, flags: u32) -> EmissiveTriangle {
    EmissiveTriangle {
        p: [
            corner,
            add(corner, [0.0, size, 0.0]),
            add(corner, [0.0, 0.0, size]),
        ],
        radiance: [radiance; 3],
        mesh,
        flags,
    }
}

/// `count` triangles of 0.01 to 0.04 m anywhere in the unit cube, facing anywhere, one in four on both sides, in mesh lights
/// of eight.
pub fn scattered(count: u32, seed: u32) -> Vec<EmissiveTriangle> {
    let random = &mut Random::new(seed);
    let light = |i: u32| {
        let corner = [0; 3].map(|_| random.between(0.05, 0.9));
        let edge = |random: &mut Random| {
            let size = random.between(0.01, 0.04);
            random.direction().map(|x| x * size)
        };
        let (e1, e2) = (edge(random), edge(random));
        EmissiveTriangle {
            p: [corner, add(corner, e1), add(corner, e2)],
            radiance: [0; 3].map(|_| random.between(0.5, 1.5)),
            mesh: i / 8,
            flags: u32::from(random.below(4) == 0),
        }
    };
    (0..count).map(light).collect()
}

fn add(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

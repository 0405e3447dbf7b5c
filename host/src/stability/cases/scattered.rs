//! Small triangles anywhere.

use lightbvh::EmissiveTriangle;

use crate::stability::random::Random;

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

pub(super) fn add(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

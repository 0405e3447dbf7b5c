//! What lights look like: needles, no area, numbers at the ends of f32.

use lightbvh::{EmissiveTriangle, ShadingPoint, exact};

use super::super::case::Case;
use super::super::random::Random;
use super::{facing_x, scattered};

pub(super) fn cases() -> Vec<Case> {
    vec![
        Case::new("needles and triangles without area", needles()),
        subnormal("subnormal coordinates", f32::from_bits(0x0003_0001)),
        subnormal("minus zero", -0.0),
    ]
}

/// Lights that differ in width by 2^30, and some of one edge or of one point.
fn needles() -> Vec<EmissiveTriangle> {
    let random = &mut Random::new(23);
    let mut lights = scattered(240, 23);
    for (i, light) in (0..).zip(&mut lights) {
        let [a, b, c] = light.p;
        let share = exact::pow2(-(random.below(31) as i32));
        match i % 6 {
            0 => light.p[2] = std::array::from_fn(|k| a[k] + (c[k] - a[k]) * share),
            1 => light.p[2] = std::array::from_fn(|k| b[k] + (c[k] - b[k]) * share),
            2 => light.p[2] = std::array::from_fn(|k| 0.5 * (a[k] + b[k])),
            3 => light.p = [a; 3],
            _ => {}
        }
    }
    // About the origin nothing of a width is lost beside a corner's coordinates.
    for (i, light) in (0..).zip(&mut lights).filter(|(i, _)| i % 6 == 4) {
        let width = exact::pow2(-(i % 31));
        light.p = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, width, 0.0]];
    }
    lights
}

/// Lights with `tiny` in place of zeros, and points that have it too.
fn subnormal(name: &str, tiny: f32) -> Case {
    let mut lights: Vec<_> = (0..64)
        .map(|i| facing_x([0.0, (i % 8) as f32, (i / 8) as f32], 0.5, 1.0, i / 8, i & 1))
        .collect();
    for x in lights.iter_mut().flat_map(|light| light.p.iter_mut().flatten()) {
        *x = if *x == 0.0 { tiny } else { *x };
    }
    let points = [[tiny; 3], [1.0, tiny, tiny], [-1.0, 2.0, tiny], [tiny, 1.0, 1.0]];
    let normals = [
        [1.0, tiny, tiny],
        [-1.0, tiny, tiny],
        [tiny, 1.0, tiny],
        [0.0; 3],
        [-0.0; 3],
    ];
    let points = points
        .iter()
        .flat_map(|&p| normals.iter().map(move |&n| ShadingPoint { p, n }));
    Case::new(name, lights).with_points(points)
}

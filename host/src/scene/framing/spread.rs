//! Numbers, directions and places that are spread evenly, the same in every run.

use crate::vector::{cross, dot, normal};

/// At length one; zero stays.
pub(super) fn unit(v: [f64; 3]) -> [f64; 3] {
    super::super::transform::unit_or(v, [0.0; 3])
}

/// `p` and `t` times `d`.
pub(super) fn along(p: [f64; 3], t: f64, d: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|axis| p[axis] + t * d[axis])
}

pub(super) fn area(p: &[[f32; 3]; 3]) -> f64 {
    let n = normal(*p);
    0.5 * dot(n, n).sqrt()
}

/// The `i`-th of evenly spread points of four numbers: fractions of multiples of the powers of 1 / 1.16730, the root of x⁵ = x + 1
/// (M. Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences", 2018).
pub(super) fn sequence(i: usize) -> [f64; 4] {
    const ROOT: f64 = 1.167_303_978_261_418_7;
    let powers = [ROOT, ROOT * ROOT, ROOT * ROOT * ROOT, ROOT * ROOT * ROOT * ROOT];
    powers.map(|power| (0.5 + i as f64 / power) % 1.0)
}

/// The `i`-th of directions, all alike.
pub(super) fn anywhere(i: usize) -> [f64; 3] {
    let [_, _, u, v] = sequence(i);
    let (angle, z) = (std::f64::consts::TAU * u, 1.0 - 2.0 * v);
    let flat = (1.0 - z * z).sqrt();
    [libm::cos(angle) * flat, z, libm::sin(angle) * flat]
}

/// The `i`-th of directions about `n`, as often as a diffuse light sends light there.
pub(super) fn cosine(n: [f64; 3], i: usize) -> [f64; 3] {
    let [_, _, u, v] = sequence(i);
    about(n, u, (1.0 - v).sqrt())
}

/// The `i`-th of directions in a cone about `n`, all alike.
pub(super) fn within(n: [f64; 3], cosine: f64, i: usize) -> [f64; 3] {
    let [_, _, u, v] = sequence(i);
    about(n, u, 1.0 - v * (1.0 - cosine))
}

/// The direction of that cosine to `n`, so much of a turn around it.
fn about(n: [f64; 3], turn: f64, z: f64) -> [f64; 3] {
    let beside = unit(cross(
        n,
        if n[0].abs() < 0.5 {
            [1.0, 0.0, 0.0]
        } else {
            [0.0, 1.0, 0.0]
        },
    ));
    let above = cross(n, beside);
    let (angle, flat) = (std::f64::consts::TAU * turn, (1.0 - z * z).max(0.0).sqrt());
    let (x, y) = (libm::cos(angle) * flat, libm::sin(angle) * flat);
    [0, 1, 2].map(|axis| x * beside[axis] + y * above[axis] + z * n[axis])
}

/// The `i`-th of points spread over a triangle, none on its edges: what lies there may be seen from both sides of a corner.
pub(super) fn inside(p: &[[f32; 3]; 3], i: usize) -> [f64; 3] {
    let [u, v, ..] = sequence(i);
    let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
    let [u, v] = [u, v].map(|x| 0.01 + 0.97 * x);
    let [a, b, c] = p.map(|vertex| vertex.map(f64::from));
    [0, 1, 2].map(|axis| a[axis] + u * (b[axis] - a[axis]) + v * (c[axis] - a[axis]))
}

/// `count` indices, each as often as its weight says, with a running number. None where there is no weight.
pub(super) fn spread(weights: &[f64], count: usize) -> impl Iterator<Item = (usize, usize)> {
    let total: f64 = weights.iter().sum();
    let (mut index, mut passed) = (0, weights.first().copied().unwrap_or(0.0));
    let count = if total > 0.0 && total.is_finite() {
        count
    } else {
        0
    };
    (0..count).map(move |i| {
        let at = total * (i as f64 + 0.5) / count as f64;
        while passed < at && index + 1 < weights.len() {
            index += 1;
            passed += weights[index];
        }
        (index, i)
    })
}

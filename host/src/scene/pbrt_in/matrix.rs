//! Transforms of pbrt, as affine maps.

use super::super::transform::{Affine, unit_or};
use crate::vector::{cross, dot, sub};

pub(super) fn translation([x, y, z]: [f64; 3]) -> Affine {
    Affine {
        columns: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [x, y, z]],
    }
}

pub(super) fn scaling([x, y, z]: [f64; 3]) -> Affine {
    Affine {
        columns: [[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z], [0.0; 3]],
    }
}

/// About an axis, counter-clockwise seen from its end; the identity where there is no axis.
pub(super) fn rotation(degrees: f64, axis: [f64; 3]) -> Affine {
    let [x, y, z] = unit_or(axis, [0.0; 3]);
    if [x, y, z] == [0.0; 3] {
        return Affine::IDENTITY;
    }
    let (sine, cosine) = libm::sincos(0.5 * degrees.to_radians());
    Affine::from_trs([0.0; 3], [x * sine, y * sine, z * sine, cosine], [1.0; 3])
}

/// From the world to a left-handed camera at `eye`, which looks along its +z, +y up; `None` where it looks nowhere, or up is
/// there too.
pub(super) fn look_at(eye: [f64; 3], target: [f64; 3], up: [f64; 3]) -> Option<Affine> {
    let forward = unit_or(sub(target, eye), [0.0; 3]);
    let right = unit_or(cross(unit_or(up, [0.0; 3]), forward), [0.0; 3]);
    if dot(right, right) == 0.0 {
        return None;
    }
    let up = cross(forward, right);
    inverse(&Affine {
        columns: [right, up, forward, eye],
    })
}

/// Of four columns of four, as files have them: the affine part, and whether there is another.
pub(super) fn of_columns(m: [f64; 16]) -> (Affine, bool) {
    let w = m[15];
    let scale = if w == 0.0 { 1.0 } else { 1.0 / w };
    let column = |i: usize| [0, 1, 2].map(|row| m[4 * i + row] * scale);
    let is_affine = m[3] == 0.0 && m[7] == 0.0 && m[11] == 0.0 && w != 0.0;
    (
        Affine {
            columns: [column(0), column(1), column(2), column(3)],
        },
        is_affine,
    )
}

/// `None` where the map flattens space, or its numbers are too large or small.
pub(super) fn inverse(map: &Affine) -> Option<Affine> {
    let [a, b, c, t] = map.columns;
    let rows = [cross(b, c), cross(c, a), cross(a, b)];
    let volume = dot(a, rows[0]);
    if !(volume != 0.0 && volume.is_finite()) {
        return None;
    }
    let rows = rows.map(|row| row.map(|x| x / volume));
    let column = |i: usize| [0, 1, 2].map(|row: usize| rows[row][i]);
    let linear = Affine {
        columns: [column(0), column(1), column(2), [0.0; 3]],
    };
    let moved = linear.vector(t).map(|x| -x);
    let out = Affine {
        columns: [column(0), column(1), column(2), moved],
    };
    let is_finite = out.columns.as_flattened().iter().all(|x| x.is_finite());
    is_finite.then_some(out)
}

/// A normal of a surface in the space that `map` leads to, at length one, on the same side; zero where there is none.
pub(super) fn normal(map: &Affine, n: [f64; 3]) -> [f64; 3] {
    let [a, b, c, _] = map.columns;
    let cofactors = [cross(b, c), cross(c, a), cross(a, b)];
    let sign = if map.mirrors() { -1.0 } else { 1.0 };
    let out = [0, 1, 2]
        .map(|row| sign * (cofactors[0][row] * n[0] + cofactors[1][row] * n[1] + cofactors[2][row] * n[2]));
    unit_or(out, [0.0; 3])
}

/// The factor by which the map scales all lengths, where it is one.
pub(super) fn uniform_scale(map: &Affine) -> Option<f64> {
    let [a, b, c, _] = map.columns;
    let [aa, bb, cc] = [dot(a, a), dot(b, b), dot(c, c)];
    let near = |x: f64, y: f64| (x - y).abs() <= 1e-4 * aa;
    let is_uniform = aa > 0.0
        && aa.is_finite()
        && near(aa, bb)
        && near(aa, cc)
        && near(dot(a, b), 0.0)
        && near(dot(b, c), 0.0)
        && near(dot(c, a), 0.0);
    is_uniform.then(|| aa.sqrt())
}

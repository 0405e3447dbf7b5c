//! Directions about an axis, distributed as a power of the cosine: from `+ - *`, quotients and roots alone.
//!
//! For the density `k / (2 pi) cos^(k-1)` over the hemisphere's solid angle, the cosine is `u^(1/k)`; where `k` is a power
//! of two that is a root of a root, and the density a product of squares. `k = 2` is the cosine-weighted hemisphere.

use glam::Vec3;
use lightbvh::device::vector::{cross, dot, flush3, length_squared};
use lightbvh::exact::{floor_u32, flush, min};

use super::grid::{STEP, div, sqrt};

/// Coefficients of `sin(x pi / 2) / x` and `cos(x pi / 2)` in powers of `x^2`: the Taylor series, whose first term left
/// out is below 2^-25 for `|x| <= 1/2`.
const SIN: [f32; 5] = [
    core::f32::consts::FRAC_PI_2,
    -0.645_964_1,
    0.079_692_63,
    -0.004_681_754,
    0.000_160_441_18,
];
const COS: [f32; 5] = [1.0, -1.233_700_5, 0.253_669_5, -0.020_863_48, 0.000_919_260_3];

/// The point of the unit circle at `turns` of the full angle, `turns` in [0, 1): (cos, sin), each within 2^-22.
#[inline]
#[must_use]
pub fn circle(turns: f32) -> [f32; 2] {
    // Quarter turns, and what is left of half a quarter to either side; the difference is exact.
    let quarters = turns * 4.0;
    let nearest = floor_u32(quarters + 0.5);
    let x = quarters - nearest as i32 as f32;
    let xx = x * x;
    let sin = ((((SIN[4] * xx + SIN[3]) * xx + SIN[2]) * xx + SIN[1]) * xx + SIN[0]) * x;
    let cos = (((COS[4] * xx + COS[3]) * xx + COS[2]) * xx + COS[1]) * xx + COS[0];
    let odd = nearest & 1 != 0;
    let across = if odd { -sin } else { cos };
    let up = if odd { cos } else { sin };
    let opposite = nearest & 2 != 0;
    [
        if opposite { -across } else { across },
        if opposite { -up } else { up },
    ]
}

/// Cosine and sine of an angle to the axis with the density `k / (2 pi) cos^(k-1)`, `k = 2^log2`, by `u` in [0, 1).
///
/// `1 - sqrt(x) = (1 - x) / (1 + sqrt(x))` carries the cosine's distance from one along, from which the sine of a narrow
/// lobe follows without cancellation.
#[inline]
#[must_use]
pub fn power_cosine(u: f32, log2: u32) -> [f32; 2] {
    let mut cosine = 1.0 - u;
    let mut defect = u;
    // No range, as in `cosine_power`.
    let mut step = 0;
    while step < log2 {
        cosine = sqrt(cosine);
        defect = div(defect, 1.0 + cosine);
        step += 1;
    }
    [cosine, sqrt(defect * (1.0 + cosine))]
}

/// The cosine between unit `n` and `v` of any length, to the power `2^log2`; zero where it is negative, or the power below
/// 2^-40.
///
/// A narrow lobe multiplies the error of its cosine by the exponent: near the axis the squares are therefore taken of the
/// distance from one, `1 - (1 - c)^2 = c (2 - c)`, which starts as the square of the sine.
#[inline]
#[must_use]
pub fn cosine_power(n: Vec3, v: Vec3, log2: u32) -> f32 {
    let squared = length_squared(v);
    let along = flush(dot(n, v), STEP);
    let mut power = 0.0;
    // Opposite directions have no half vector; they meet only where both graze the surface.
    if along > 0.0 && squared > STEP {
        let across = flush3(cross(n, v), STEP);
        let sin_squared = div(length_squared(across), squared);
        let cos_squared = min(flush(div(along * along, squared), STEP), 1.0);
        let near = sin_squared < 0.5;
        let mut defect = if near { sin_squared } else { 1.0 - cos_squared };
        power = if near { 1.0 - sin_squared } else { cos_squared };
        let steps = if log2 > 0 { log2 - 1 } else { 0 };
        // No range: one may panic for all that rust-gpu knows, and what may panic it inlines wherever it is called.
        let mut step = 0;
        while step < steps {
            let near = defect < 0.5;
            let squared_defect = defect * (2.0 - defect);
            let squared_power = flush(power * power, STEP);
            defect = if near { squared_defect } else { 1.0 - squared_power };
            power = if near { 1.0 - squared_defect } else { squared_power };
            step += 1;
        }
        power = if log2 == 0 { sqrt(power) } else { power };
    }
    power
}

/// The direction with these coordinates in some frame about unit `n`, unit length where `(across, up, along)` has it.
/// Components below 2^-40 are zero.
///
/// The frame is that of T. Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017, listing 3.
#[inline]
#[must_use]
pub fn about(n: Vec3, across: f32, up: f32, along: f32) -> Vec3 {
    let n = flush3(n, STEP);
    let sign = if n.z < 0.0 { -1.0 } else { 1.0 };
    let a = div(-1.0, sign + n.z);
    let b = n.x * n.y * a;
    let tangent = flush3(Vec3::new(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x), STEP);
    let bitangent = flush3(Vec3::new(b, sign + n.y * n.y * a, -n.y), STEP);
    flush3((tangent * across + bitangent * up) + n * along, STEP)
}

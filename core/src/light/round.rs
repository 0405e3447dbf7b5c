//! Circles by exact operations alone.

use crate::exact::{self, floor_small};

/// A quarter of a turn.
const QUARTER: f32 = core::f32::consts::FRAC_PI_2;
/// An eighth of a turn.
const EIGHTH: f32 = core::f32::consts::FRAC_PI_4;

/// Cosine and sine of an angle of magnitude up to π/4: their series up to the eighth and the ninth power, within 2^-23.
#[inline(always)]
fn near_zero(x: f32) -> [f32; 2] {
    let s = x * x;
    let cosine = 1.0 - s * (0.5 - s * (0.041_666_668 - s * (0.001_388_888_9 - s * 0.000_024_801_588)));
    let sine = x
        * (1.0 - s * (0.166_666_67 - s * (0.008_333_334 - s * (0.000_198_412_7 - s * 0.000_002_755_731_9))));
    [cosine, sine]
}

/// Cosine and sine of `turns` whole turns, from 0 to 1.
#[inline(always)]
pub(super) fn circle(turns: f32) -> [f32; 2] {
    let quarters = turns * 4.0;
    let nearest = floor_small(quarters + 0.5);
    let [c, s] = near_zero((quarters - nearest as i32 as f32) * QUARTER);
    let swapped = nearest & 1 != 0;
    let (x, y) = if swapped { (s, c) } else { (c, s) };
    // The second and third quarter lie at negative x, the third and fourth at negative y.
    let second = (nearest.wrapping_add(1)) & 2 != 0;
    let third = nearest & 2 != 0;
    [if second { -x } else { x }, if third { -y } else { y }]
}

/// A point of the unit disc for one of the unit square, areas in proportion (P. Shirley and K. Chiu, "A low distortion map between
/// disk and square", Journal of Graphics Tools 2(3), 1997).
#[inline(always)]
pub(super) fn disc(uv: [f32; 2]) -> [f32; 2] {
    let (a, b) = (2.0 * uv[0] - 1.0, 2.0 * uv[1] - 1.0);
    let wide = exact::abs(a) > exact::abs(b);
    let (r, other) = if wide { (a, b) } else { (b, a) };
    // In the middle both are zero.
    let ratio = exact::div(other, if r == 0.0 { 1.0 } else { r });
    let [c, s] = near_zero(ratio * EIGHTH);
    if wide { [r * c, r * s] } else { [r * s, r * c] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_circle_is_round() {
        for k in 0..=100_000_u32 {
            let turns = k as f32 / 100_000.0;
            let angle = f64::from(turns) * core::f64::consts::TAU;
            let [c, s] = circle(turns).map(f64::from);
            assert!(
                (c - angle.cos()).abs() < 4e-7 && (s - angle.sin()).abs() < 4e-7,
                "{turns}: {c} {s}"
            );
        }
    }
}

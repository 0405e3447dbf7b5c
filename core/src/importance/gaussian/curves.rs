//! Exponentials and integrals of spherical Gaussians, by exact operations alone.

use crate::exact::{self, pow2, recip, rsqrt};

/// log₂ e.
const LOG2_E: f32 = core::f32::consts::LOG2_E;
/// Arguments of [`exp_minus`] count as at most this: e^-80 is 2^-115.
const GREATEST: f32 = 80.0;
/// 2^−f from f = 0 to 1, within 8e-8: coefficients of f^0 to f^5.
const POWERS: [f32; 6] = [
    0.999_999_9,
    -0.693_142_2,
    0.240_171_6,
    -0.055_278_134,
    0.009_186_875,
    -0.000_938_116_5,
];

/// About e^−x for x from 0, within 1e-5 relative; e^-80 from 80 on.
#[inline(always)]
pub fn exp_minus(x: f32) -> f32 {
    let y = exact::clamp(x, 0.0, GREATEST) * LOG2_E;
    let whole = exact::floor_small(y) as i32;
    let f = y - whole as f32;
    let [a, b, c, d, e, g] = POWERS;
    (a + f * (b + f * (c + f * (d + f * (e + f * g))))) * pow2(-whole)
}

/// Below this the integrals take their series, which the published ones do too.
const SERIES: f32 = 0.5;

/// About (1 − e^−x) / x, x from 0, within 1e-5 relative: 1 at 0.
#[inline(always)]
pub fn less_exp_over(x: f32) -> f32 {
    let series =
        1.0 - x * (0.5 - x * (0.166_666_67 - x * (0.041_666_668 - x * (0.008_333_334 - x * 0.001_388_889))));
    let direct = (1.0 - exp_minus(x)) * recip(exact::max(x, SERIES));
    if x <= SERIES { series } else { direct }
}

/// Coefficients of x to x^6, Abramowitz & Stegun 7.1.28.
const ERFC: [f32; 6] = [
    0.070_523_08,
    0.042_282_01,
    0.009_270_527,
    0.000_152_014_3,
    0.000_276_567_2,
    0.000_043_063_8,
];
/// erfc is zero to its error from here on.
const NONE_BEYOND: f32 = 8.0;

/// About erfc |x|, within 1e-5.
#[inline(always)]
fn erfc_of_magnitude(x: f32) -> f32 {
    let x = exact::min(exact::abs(x), NONE_BEYOND);
    let [a, b, c, d, e, f] = ERFC;
    let polynomial = 1.0 + x * (a + x * (b + x * (c + x * (d + x * (e + x * f)))));
    let fourth = (polynomial * polynomial) * (polynomial * polynomial);
    let sixteenth = (fourth * fourth) * (fourth * fourth);
    recip(sixteenth)
}

/// 1/√π.
const OVER_ROOT_PI: f32 = 0.564_189_6;
/// Sharpness counts as at least this in the steepness of the interpolation, which divides by it.
const LEAST_STEEPNESS: f32 = pow2(-10);

/// About the integral of a spherical Gaussian of greatest value 1 times a clamped cosine, over π: `cosine` is that between both axes, from
/// −1 to 1, `sharpness` from 2^-20 to 2^32. By listings 5 to 7 of the supplement of Tokuyoshi et al. 2024: an interpolation between the
/// integrals for opposite and for equal axes.
#[inline(always)]
pub fn clamped_cosine(cosine: f32, sharpness: f32) -> f32 {
    let s = sharpness;
    let above = (s + 2.736_083) * s + 17.021_298;
    let below = ((s + 4.010_083) * s + 15.219_156) * s + 76.087_9;
    let ratio = 0.5 * above * recip(below);
    let t = exact::max(s * (ratio * rsqrt(ratio)), LEAST_STEEPNESS);
    let tz = t * cosine;
    let tail = erfc_of_magnitude(tz);
    let upper_tail = if tz > 0.0 { 2.0 - tail } else { tail };
    let ends = exp_minus(tz * tz) - exp_minus(t * t);
    let linear = cosine * upper_tail + erfc_of_magnitude(t);
    let share = exact::clamp(0.5 * linear + (0.5 * OVER_ROOT_PI) * (ends * recip(t)), 0.0, 1.0);
    let (lower, upper) = hemispheres(s);
    2.0 * (lower + (upper - lower) * share)
}

/// The integrals over 2π where the axes are opposite and where they are equal.
#[inline(always)]
fn hemispheres(s: f32) -> (f32, f32) {
    let e = exp_minus(s);
    let small = exact::min(s, SERIES);
    let upper_series = 0.5
        - small * (0.166_666_67 - small * (0.041_666_668 - small * (0.008_333_334 - small * 0.001_388_889)));
    let lower_series = 0.5
        - small
            * (0.333_333_34
                - small
                    * (0.125
                        - small * (0.033_333_335 - small * (0.006_944_444_5 - small * 0.001_190_476_2))));
    let inverse = recip(exact::max(s, SERIES));
    let upper = (1.0 - (1.0 - e) * inverse) * inverse;
    let lower = ((1.0 - e) * inverse - e) * inverse;
    if s <= SERIES {
        (e * lower_series, upper_series)
    } else {
        (e * lower, upper)
    }
}

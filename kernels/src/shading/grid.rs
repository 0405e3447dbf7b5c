//! The grid of lengths: multiples of 2^-40 m.
//!
//! Devices may flush subnormal numbers to zero and the CPU keeps them, so none must come up. Coordinates on the grid
//! differ by zero or at least 2^-40; with cross products flushed below 2^-60 every product in the
//! ray tests is zero or at least 2^-100, and every sum of such products zero or at least 2^-123: all normal.

use glam::Vec3;
use lightbvh::exact::{abs, exponent, flush, pow2};

/// The grid's step, metres.
pub const STEP: f32 = pow2(-40);
/// Largest magnitude of a coordinate that is rendered, metres: 2^30, so that the squared length of a cross product of two
/// edges stays below 2^127.
pub const MAX_COORDINATE: f32 = pow2(30);
/// Components of a cross product of two lengths below this, m², count as zero.
pub const TINY_AREA: f32 = pow2(-60);
/// Products of three or four lengths, and weights, below this count as zero.
pub const TINY: f32 = pow2(-100);
/// Numbers from here on are multiples of the step already, having 24 significant bits.
const COARSE: f32 = pow2(-17);

/// [`exact::div`](lightbvh::exact::div). A function of its own on devices, where it is 70 instructions.
#[cfg_attr(target_arch = "spirv", inline(never))]
#[cfg_attr(not(target_arch = "spirv"), inline)]
#[must_use]
pub fn div(a: f32, b: f32) -> f32 {
    lightbvh::exact::div(a, b)
}

/// [`exact::sqrt`](lightbvh::exact::sqrt), a function of its own as [`div`].
#[cfg_attr(target_arch = "spirv", inline(never))]
#[cfg_attr(not(target_arch = "spirv"), inline)]
#[must_use]
pub fn sqrt(x: f32) -> f32 {
    lightbvh::exact::sqrt(x)
}

/// `x` on the grid: small numbers are truncated towards zero (by less than a picometre), others stay.
#[inline]
#[must_use]
pub fn snap(x: f32) -> f32 {
    // Below 2^-17 the quotient is below 2^23: both conversions are exact.
    if abs(x) < COARSE {
        (x * pow2(40)) as i32 as f32 * STEP
    } else {
        x
    }
}

/// [`snap`] for a point.
#[inline]
#[must_use]
pub fn snap_point(p: Vec3) -> Vec3 {
    Vec3::new(snap(p.x), snap(p.y), snap(p.z))
}

/// Largest estimate of a radiance, W/(m² sr): 2^90. Greater ones are cut to it, so that no sum of up to 2^30 of them
/// overflows.
pub const MAX_ESTIMATE: f32 = pow2(MAX_EXPONENT);
const MAX_EXPONENT: i32 = 90;

/// `a b` for numbers that are not negative: +0 where it is below [`TINY`], [`MAX_ESTIMATE`] where it would reach that.
#[inline]
#[must_use]
pub fn bounded_product(a: f32, b: f32) -> f32 {
    // The product is at least 2^e for e the sum of the exponents, and below 2^(e + 2).
    let over = exponent(a) + exponent(b) >= MAX_EXPONENT;
    let product = a * if over { 0.0 } else { b };
    let bounded = if product < MAX_ESTIMATE {
        product
    } else {
        MAX_ESTIMATE
    };
    if over { MAX_ESTIMATE } else { flush(bounded, TINY) }
}

/// `a / b` for `a` not negative and `b` positive and normal: +0 where it is below [`TINY`], [`MAX_ESTIMATE`] where it
/// would reach that.
#[inline]
#[must_use]
pub fn bounded_quotient(a: f32, b: f32) -> f32 {
    // The quotient is above 2^(e - 1) for e the difference of the exponents, and below 2^(e + 1).
    let over = exponent(a) - exponent(b) > MAX_EXPONENT;
    let quotient = div(a, if over { a } else { b });
    let bounded = if quotient < MAX_ESTIMATE {
        quotient
    } else {
        MAX_ESTIMATE
    };
    if over { MAX_ESTIMATE } else { flush(bounded, TINY) }
}

//! Square root: correctly rounded, and a cheaper reciprocal root with equal bits everywhere.

use super::{FRACTION, HIDDEN, ONE};

/// The square root rounded to nearest, the same bits on every processor.
///
/// Domain: every finite number. Below 2^-126, negative numbers included, the result is +0: some devices have no
/// denormals, and the callers' negative arguments are roundings of zero (as in `1 - cos^2`).
///
/// Without the feature `std` a CPU has no native square root in Rust's core library; the integer form, equal in every
/// bit, takes its place there.
#[inline]
#[must_use]
pub fn sqrt(x: f32) -> f32 {
    #[cfg(any(target_arch = "spirv", not(feature = "std")))]
    {
        sqrt_emulated(x)
    }
    #[cfg(not(any(target_arch = "spirv", not(feature = "std"))))]
    {
        // The one place where the native root is right: IEEE 754 rounds it correctly, and the device does not get here.
        #[allow(clippy::disallowed_methods)]
        if x < f32::MIN_POSITIVE { 0.0 } else { x.sqrt() }
    }
}

/// [`sqrt`] as devices compute it, public so that tests can hold it against the native root.
///
/// As in [`super::div_emulated`], floats only estimate; the exact remainder in integers decides the last bits.
#[inline]
#[must_use]
pub fn sqrt_emulated(x: f32) -> f32 {
    let bits = x.to_bits();
    // x = m 2^(2h) with m in [1, 4): an odd exponent leaves a factor of two with the significand.
    let exponent = (bits >> 23) & 0xff;
    let odd = (exponent & 1) ^ 1;
    let significand = (bits & FRACTION) | HIDDEN;
    let m = f32::from_bits((bits & FRACTION) | (ONE + (odd << 23)));

    // root = floor(sqrt(significand 2^shift)) has exactly 24 bits. Three steps bring the estimate within a few units, so
    // the remainder, whose slope is twice the root, fits 32 bits with a sign.
    let shift = 23 + odd;
    let reciprocal = newton_step(m, newton_step(m, newton_step(m, seed(m))));
    let mut root = (m * reciprocal * 8_388_608.0) as u32;
    let mut remainder = (significand << shift).wrapping_sub(root.wrapping_mul(root)) as i32;

    // One correction by about remainder / (2 root); the conversion drops 8 bits so that it is exact.
    let correction = ((remainder >> 8) as f32 * reciprocal * 1.525_878_9e-5) as i32;
    root = root.wrapping_add(correction as u32);
    remainder = (significand << shift).wrapping_sub(root.wrapping_mul(root)) as i32;

    // At most one off now: (r - 1)^2 = r^2 - 2r + 1, (r + 1)^2 = r^2 + 2r + 1.
    let too_large = remainder < 0;
    root = if too_large { root.wrapping_sub(1) } else { root };
    remainder = if too_large {
        remainder.wrapping_add(2 * root as i32 + 1)
    } else {
        remainder
    };
    let too_small = remainder > 2 * root as i32;
    remainder = if too_small {
        remainder.wrapping_sub(2 * root as i32 + 1)
    } else {
        remainder
    };
    root = if too_small { root.wrapping_add(1) } else { root };
    // Nearest: (r + 1/2)^2 = r^2 + r + 1/4, which no integer equals.
    root = if remainder > root as i32 {
        root.wrapping_add(1)
    } else {
        root
    };

    // (exponent - 127 - [odd]) / 2 + 127 = (exponent + 126 + [not odd]) / 2, and a carry out of the root adds itself.
    let result = (((exponent + 127 - odd) >> 1) << 23).wrapping_add(root.wrapping_sub(HIDDEN));
    if (bits as i32) < HIDDEN as i32 {
        0.0
    } else {
        f32::from_bits(result)
    }
}

/// About `1 / sqrt(x)`, within 5e-6 relative, the same bits on every processor; for directions that must be equal on
/// both sides but need not be accurate.
///
/// Domain: 2^-125 <= x <= `f32::MAX`; there neither the seed nor a step leaves the normal range. For +0 the result is
/// some finite number, so that `x * rsqrt(x)` is a root there too.
#[inline]
#[must_use]
pub fn rsqrt(x: f32) -> f32 {
    newton_step(x, newton_step(x, seed(x)))
}

/// About `1 / sqrt(x)`, within 6.6e-4 relative, the same bits on every processor: one Newton step whose constants
/// share out the error of the guess instead of removing one side of it (J. Kadlec, "Řrřlog: Improving the fast inverse
/// square root", 2010).
///
/// Domain: as [`rsqrt`].
#[inline]
#[must_use]
pub fn rsqrt_rough(x: f32) -> f32 {
    let y = f32::from_bits(0x5f1f_fff9_u32.wrapping_sub(x.to_bits() >> 1));
    y * (0.703_952_25 * (2.389_244_6 - x * (y * y)))
}

/// The well-known first guess: halves and negates the exponent (C. Lomont, "Fast inverse square root", 2003).
#[inline]
fn seed(x: f32) -> f32 {
    f32::from_bits(0x5f37_59df_u32.wrapping_sub(x.to_bits() >> 1))
}

/// One Newton step `y (3/2 - x/2 y^2)` towards `1 / sqrt(x)`.
#[inline]
fn newton_step(x: f32, y: f32) -> f32 {
    y * (1.5 - 0.5 * x * y * y)
}

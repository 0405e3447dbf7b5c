//! Division: correctly rounded, and a cheaper reciprocal with equal bits everywhere.

use super::{FRACTION, HIDDEN, INFINITY, ONE, SIGN};

/// `a / b` rounded to nearest, the same bits on every processor.
///
/// Domain: `b` finite, normal, not zero; `a` finite (a denormal `a` counts as zero). Within it the result is the IEEE 754
/// quotient with one change: what is smaller in magnitude than 2^-126 becomes zero with the quotient's sign, because
/// some devices have no denormals. A quotient above `f32::MAX` is an infinity, which shared code must not let happen:
/// bound the operands.
#[inline]
#[must_use]
pub fn div(a: f32, b: f32) -> f32 {
    #[cfg(target_arch = "spirv")]
    {
        div_emulated(a, b)
    }
    #[cfg(not(target_arch = "spirv"))]
    {
        // Equal to `div_emulated`, as both round to nearest: but for `rounded_up` no quotient lies close enough below 2^-126 to
        // be rounded up to it. One branch, seldom taken, since quotients of ordinary numbers are larger.
        const LEAST: f32 = f32::MIN_POSITIVE;
        let quotient = a / b;
        if super::abs(a) < LEAST || super::abs(quotient) <= LEAST {
            let is_least = super::abs(a) >= LEAST && super::abs(quotient) == LEAST && !rounded_up(a, b);
            let sign = (a.to_bits() ^ b.to_bits()) & SIGN;
            f32::from_bits(if is_least { quotient.to_bits() } else { sign })
        } else {
            quotient
        }
    }
}

/// Whether `a / b`, which a processor gave as 2^-126, is (2 - 2^-23) 2^-127: below 2^-126 it has one bit less. Only the longest
/// significand over a power of two is that quotient.
#[cfg(not(target_arch = "spirv"))]
#[inline]
fn rounded_up(a: f32, b: f32) -> bool {
    (a.to_bits() & FRACTION == FRACTION) & (b.to_bits() & FRACTION == 0)
}

/// [`div`] as devices compute it, public so that tests can hold it against the native quotient.
///
/// A float estimate of the quotient's significand within 2^7 units, then the exact remainder in integers decides the last
/// bits: so neither contraction, nor the rounding mode, nor flushing on the device can reach the result. Only the low
/// 32 bits of the remainder are needed since its magnitude is known to stay below 2^31.
#[inline]
#[must_use]
pub fn div_emulated(a: f32, b: f32) -> f32 {
    let (a_bits, b_bits) = (a.to_bits(), b.to_bits());
    let sign = (a_bits ^ b_bits) & SIGN;
    let a_exponent = (a_bits >> 23) & 0xff;
    let b_exponent = (b_bits >> 23) & 0xff;
    let numerator = (a_bits & FRACTION) | HIDDEN;
    let denominator = (b_bits & FRACTION) | HIDDEN;

    // The quotient of the significands lies in (1/2, 2); `shift` makes it an integer of exactly 24 bits.
    let below_one = numerator < denominator;
    let shift = if below_one { 24 } else { 23 };
    let scale = if below_one { 16_777_216.0 } else { 8_388_608.0 };
    let reciprocal = recip(f32::from_bits((b_bits & FRACTION) | ONE));
    let estimate = f32::from_bits((a_bits & FRACTION) | ONE) * reciprocal * scale;
    let mut quotient = estimate as u32;
    let mut remainder = (numerator << shift).wrapping_sub(quotient.wrapping_mul(denominator)) as i32;

    // One correction by about remainder / denominator; the conversion drops 8 bits so that it is exact.
    let correction = ((remainder >> 8) as f32 * reciprocal * 3.051_757_8e-5) as i32;
    quotient = quotient.wrapping_add(correction as u32);
    remainder = remainder.wrapping_sub(correction.wrapping_mul(denominator as i32));

    // Truncation above leaves the quotient at most one off. Then round to nearest; a tie would need an odd factor of
    // 25 bits in a numerator of 24.
    let too_large = remainder < 0;
    quotient = if too_large {
        quotient.wrapping_sub(1)
    } else {
        quotient
    };
    remainder = if too_large {
        remainder.wrapping_add(denominator as i32)
    } else {
        remainder
    };
    let too_small = remainder >= denominator as i32;
    quotient = if too_small {
        quotient.wrapping_add(1)
    } else {
        quotient
    };
    remainder = if too_small {
        remainder.wrapping_sub(denominator as i32)
    } else {
        remainder
    };
    quotient = if remainder.wrapping_mul(2) > denominator as i32 {
        quotient.wrapping_add(1)
    } else {
        quotient
    };

    let exponent = (a_exponent as i32) - (b_exponent as i32) + (if below_one { 126 } else { 127 });
    let magnitude = if a_exponent == 0 || exponent <= 0 {
        0
    } else if exponent >= 255 {
        INFINITY
    } else {
        ((exponent as u32) << 23).wrapping_add(quotient & FRACTION)
    };
    f32::from_bits(sign | magnitude)
}

/// About `1 / x`, within 7e-6 relative, the same bits on every processor; for weights that must be equal on both sides
/// but need not be accurate: two Newton steps `r (2 - x r)` from a seed that the bits of `x` give.
///
/// Domain: 2^-126 <= |x| <= 2^125; there neither the seed nor a step leaves the normal range.
#[inline]
#[must_use]
pub fn recip(x: f32) -> f32 {
    let seed = recip_seed(x);
    let once = seed * (2.0 - x * seed);
    once * (2.0 - x * once)
}

/// About `1 / x`, within 3e-3 relative, the same bits on every processor: one Newton step. Domain: as [`recip`].
#[inline]
#[must_use]
pub fn recip_rough(x: f32) -> f32 {
    let seed = recip_seed(x);
    seed * (2.0 - x * seed)
}

/// Subtracting from this constant negates the exponent and, linearly, the significand; it is the one that leaves the
/// least error after the steps (12 % before, 2.6e-3 after one, 6.7e-6 after two).
#[inline]
fn recip_seed(x: f32) -> f32 {
    let bits = x.to_bits();
    f32::from_bits((bits & SIGN) | 0x7ef3_11c7_u32.wrapping_sub(bits & !SIGN))
}

//! Powers of two, taken apart and put together on the bits: how the crate keeps every product in range.

/// Exponent `e` of a normal `x = ±s · 2^e` with `1 <= s < 2`; −127 for zero and subnormal numbers.
#[inline]
#[must_use]
pub fn exponent(x: f32) -> i32 {
    ((x.to_bits() >> 23) & 0xff) as i32 - 127
}

/// Significand in `[1, 2)` of a positive normal `x`.
#[inline]
#[must_use]
pub fn significand(x: f32) -> f32 {
    f32::from_bits((x.to_bits() & 0x007f_ffff) | 0x3f80_0000)
}

/// `2^e`, `e` clamped to −126..=127, the exponents of normal numbers.
#[inline]
#[must_use]
pub const fn pow2(e: i32) -> f32 {
    let low = if e < -126 { -126 } else { e };
    let high = if low > 127 { 127 } else { low };
    f32::from_bits(((high + 127) as u32) << 23)
}

/// [`pow2`] of an `e` that is known to lie in −126..=127.
#[inline(always)]
#[must_use]
pub(crate) fn power(e: i32) -> f32 {
    f32::from_bits(((e + 127) as u32) << 23)
}

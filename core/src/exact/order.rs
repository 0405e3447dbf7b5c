//! Order, by comparison and select: SPIR-V's own `FMin`, `FMax` and `FClamp` leave signed zeros and NaN open.

use super::SIGN;

/// The smaller one; `b` where they are equal (so of two zeros, the second).
#[inline]
#[must_use]
pub fn min(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// The larger one; `b` where they are equal (so of two zeros, the second).
#[inline]
#[must_use]
pub fn max(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

/// `x` moved into `[lo, hi]`: `lo` below it, `hi` above it. Where the ends cross nothing panics; a NaN stays one.
#[inline]
#[must_use]
pub fn clamp(x: f32, lo: f32, hi: f32) -> f32 {
    if x < lo {
        lo
    } else if x > hi {
        hi
    } else {
        x
    }
}

/// All ones for a `count` of 1 to 2^31, zero for 0: for [`masked_u32`].
#[inline(always)]
#[must_use]
pub(crate) fn mask(count: u32) -> u32 {
    ((count.wrapping_neg() as i32) >> 31) as u32
}

/// `a` where `mask` is all ones, `b` where it is zero: a select that stays one.
///
/// On x86 the compiler makes a branch of many selects, and a branch that depends on chance is mispredicted half the time.
#[inline(always)]
#[must_use]
pub(crate) fn masked_u32(mask: u32, a: u32, b: u32) -> u32 {
    b ^ ((a ^ b) & mask)
}

/// All ones for true, zero for false.
#[inline(always)]
#[must_use]
pub(crate) fn mask_of(holds: bool) -> u32 {
    u32::from(holds).wrapping_neg()
}

/// `x` where `mask` is all ones, +0 where it is zero.
#[inline(always)]
#[must_use]
pub(crate) fn masked(mask: u32, x: f32) -> f32 {
    f32::from_bits(x.to_bits() & mask)
}

/// `|x|`, by its sign bit: unlike SPIR-V's `FAbs` this never flushes.
#[inline]
#[must_use]
pub fn abs(x: f32) -> f32 {
    f32::from_bits(x.to_bits() & !SIGN)
}

/// `x`, or +0 where `|x| < tiny`.
///
/// Hides what devices may differ in: the sign of a zero, and whether a result below 2^-126 is flushed. Use it where a
/// product of small numbers or a difference may come out that small; `tiny` must be normal (>= 2^-126).
#[inline]
#[must_use]
pub fn flush(x: f32, tiny: f32) -> f32 {
    if abs(x) < tiny { 0.0 } else { x }
}

/// The integer part of `x`, for `0 <= x <= 2^24`.
#[inline]
#[must_use]
pub fn floor_u32(x: f32) -> u32 {
    x as u32
}

/// The integer part of `x`, for `0 <= x < 2^22`: as [`floor_u32`], but on the CPU by arithmetic that processors do several
/// numbers at a time, which they do not convert to `u32`.
#[inline(always)]
#[must_use]
pub fn floor_small(x: f32) -> u32 {
    #[cfg(target_arch = "spirv")]
    {
        x as u32
    }
    #[cfg(not(target_arch = "spirv"))]
    {
        // From 2^23 to 2^24 numbers are the integers, and the last bits of their words count them: the sum rounds to one.
        const COUNTS: f32 = 8_388_608.0;
        let nearest = x + COUNTS;
        let above = u32::from(nearest - COUNTS > x);
        nearest
            .to_bits()
            .wrapping_sub(COUNTS.to_bits())
            .wrapping_sub(above)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn masks_choose_whole_words() {
        let words = [0, 1, SIGN, 0x7fc0_0001, u32::MAX, 1.5f32.to_bits()];
        for count in [1, 2, 15, 1 << 16, SIGN] {
            assert_eq!((mask(0), mask(count)), (0, u32::MAX), "{count}");
        }
        for (a, b) in words.iter().flat_map(|&a| words.map(|b| (a, b))) {
            assert_eq!((masked_u32(mask(3), a, b), masked_u32(mask(0), a, b)), (a, b));
        }
    }
}

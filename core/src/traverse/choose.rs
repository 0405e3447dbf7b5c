//! The choice of a child.

use crate::exact;
use crate::importance::halving_sum;

/// Ranges of numbers are at most this long, 2^22: their sums are exact in `f32`.
pub(super) const FULL: u32 = 1 << 22;
/// Bits of [`FULL`].
pub(super) const FULL_BITS: u32 = 22;

/// Share of a range that is given out by weight, 1 − 2^-15. The sum of up to 16 weights, its reciprocal, the rounding of
/// shares and the numbers that the least weights are raised to are together too large by less than the rest, which goes to
/// the last child.
const GIVEN: f32 = 1.0 - exact::pow2(-15);

/// From 2^23 on `f32` numbers are integers: adding it rounds to the nearest one.
const COUNTS: f32 = 8_388_608.0;

/// The numbers of a range that choose a child.
#[derive(Clone, Copy)]
pub(super) struct Share {
    pub slot: u32,
    /// The first of them.
    pub first: u32,
    /// How many there are; 0 for a child without weight.
    pub count: u32,
}

/// Shares the numbers `0..range` out among the children, to each at least one where its weight is positive. Returns the share
/// that holds `number`, or with `follow` the share of `wanted`, which is below 16.
#[inline(always)]
pub(super) fn choose<const W: usize>(
    weights: &[f32; W],
    range: u32,
    number: u32,
    follow: bool,
    wanted: u32,
) -> Share {
    let sum = halving_sum(weights);
    let alive = sum > 0.0;
    let length = range as i32 as f32;
    let scale = length * GIVEN * exact::recip(if alive { sum } else { 1.0 });
    // Integers, but in `f32`, where processors add and compare several at a time.
    let mut counts = [0.0; W];
    let mut open = [0.0; W];
    for slot in 0..W {
        let w = weights[slot];
        let whole = exact::max((w * scale + COUNTS) - COUNTS, 1.0);
        // Masks, for a select of floats would become a branch.
        let some = exact::mask(w.to_bits());
        counts[slot] = f32::from_bits(whole.to_bits() & some);
        open[slot] = f32::from_bits((slot as i32 as f32).to_bits() & some);
    }
    let ends = prefix_sums(&counts);
    // The slot is the number of shares that end at or before the number, but not beyond the last child with weight.
    let at = number as i32 as f32;
    let mut passed = [0.0; W];
    for slot in 0..W {
        passed[slot] = if ends[slot] <= at { 1.0 } else { 0.0 };
    }
    let last = greatest(&open);
    let found = integer(exact::min(halving_sum(&passed), last));
    let last = integer(last);
    let slot = if follow { wanted } else { found };
    let within = if slot < W as u32 { slot } else { 0 };
    let count = entry(&counts, within);
    let first = entry(&ends, within) - count;
    let all = if slot == last { length - first } else { count };
    let some = alive & (count > 0.0) & (slot < W as u32);
    Share {
        slot: within,
        first: if some { integer(first) } else { 0 },
        count: if some { integer(all) } else { 0 },
    }
}

/// The integer that `x` is, for `0 <= x < 2^23`; some integer below 2^23 for any other, without the tests of a conversion.
#[inline(always)]
fn integer(x: f32) -> u32 {
    (x + COUNTS).to_bits() & 0x007f_ffff
}

/// Inclusive prefix sums of integers: within rows of four, the width of the least vector registers, then over the rows.
#[inline(always)]
fn prefix_sums<const W: usize>(counts: &[f32; W]) -> [f32; W] {
    let mut ones = *counts;
    for slot in 0..W {
        ones[slot] += if slot & 3 >= 1 { counts[slot - 1] } else { 0.0 };
    }
    let mut ends = ones;
    for slot in 0..W {
        ends[slot] += if slot & 3 >= 2 { ones[slot - 2] } else { 0.0 };
    }
    for row in 1..4 {
        if 4 * row < W {
            let before = ends[4 * row - 1];
            for k in 0..4 {
                if 4 * row + k < W {
                    ends[4 * row + k] += before;
                }
            }
        }
    }
    ends
}

/// The greatest of numbers, none of them negative; in the order of [`halving_sum`].
#[inline(always)]
fn greatest<const W: usize>(numbers: &[f32; W]) -> f32 {
    let mut most = *numbers;
    let mut stride = 8;
    for _ in 0..4 {
        for slot in 0..W {
            if slot < stride && slot + stride < W {
                most[slot] = exact::max(most[slot], most[slot + stride]);
            }
        }
        stride /= 2;
    }
    most[0]
}

/// Entry `slot` of a local array. Devices keep arrays in registers only where no index varies, so there it is selected.
#[inline(always)]
fn entry<const W: usize>(array: &[f32; W], slot: u32) -> f32 {
    #[cfg(target_arch = "spirv")]
    {
        let mut found = 0.0;
        for s in 0..W {
            found = if s as u32 == slot { array[s] } else { found };
        }
        found
    }
    #[cfg(not(target_arch = "spirv"))]
    {
        array[slot as usize]
    }
}

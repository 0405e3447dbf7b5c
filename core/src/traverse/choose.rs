//! The choice of a child.

use crate::exact;
use crate::importance::pairwise_sum;

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
    let sum = pairwise_sum(weights);
    let alive = sum > 0.0;
    let length = range as i32 as f32;
    let scale = length * GIVEN * exact::recip(if alive { sum } else { 1.0 });
    // Integers, but in `f32`, where processors add and compare several at a time.
    let mut ends = [0.0; W];
    let mut open = 0;
    for slot in 0..W {
        let w = weights[slot];
        let whole = exact::max((w * scale + COUNTS) - COUNTS, 1.0);
        ends[slot] = if w > 0.0 { whole } else { 0.0 };
        open |= u32::from(w > 0.0) << slot;
    }
    let counts = ends;
    // Inclusive prefix sums, by doubling steps.
    let mut stride = 1;
    for _ in 0..4 {
        let before = ends;
        for slot in 0..W {
            if slot >= stride {
                ends[slot] = before[slot] + before[slot - stride];
            }
        }
        stride *= 2;
    }
    // The slot is the number of shares that end at or before the number, but not beyond the last child with weight.
    let at = number as i32 as f32;
    let mut passed = 0;
    for slot in 0..W {
        passed += u32::from(ends[slot] <= at);
    }
    let last = 31 - (open | 1).leading_zeros();
    let found = if passed < last { passed } else { last };
    let slot = if follow { wanted } else { found };
    let within = if slot < W as u32 { slot } else { 0 };
    let count = entry(&counts, within);
    let first = entry(&ends, within) - count;
    let all = if slot == last { length - first } else { count };
    let some = alive & (count > 0.0) & (slot < W as u32);
    Share {
        slot: within,
        first: if some { first as i32 as u32 } else { 0 },
        count: if some { all as i32 as u32 } else { 0 },
    }
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

//! The choice of a child.

use crate::exact;
use crate::importance::pairwise_sum;

/// Ranges of numbers are at most this long, 2^22: sums and products with them are exact in `f32`.
pub(super) const FULL: u32 = 1 << 22;
/// Bits of [`FULL`].
pub(super) const FULL_BITS: u32 = 22;

/// Share of a range that is given out by weight, 1 − 2^-15. The sum of up to 16 weights, its reciprocal and the numbers that
/// the least weights are raised to are together too large by less than the rest, which goes to the last child.
const GIVEN: f32 = 1.0 - exact::pow2(-15);

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
/// that holds `number`, or with `follow` the share of `wanted`.
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
    let scale = (range as i32 as f32) * GIVEN * exact::recip(if alive { sum } else { 1.0 });
    let mut counts = [0u32; W];
    for slot in 0..W {
        let w = weights[slot];
        let whole = exact::floor_small(w * scale);
        let at_least_one = if whole == 0 { 1 } else { whole };
        counts[slot] = if w > 0.0 { at_least_one } else { 0 };
    }
    // Inclusive prefix sums, by doubling steps.
    let mut ends = counts;
    let mut stride = 1;
    for _ in 0..4 {
        for i in 0..W {
            // From the last on, so that no step sees a sum of its own step.
            let slot = W - 1 - i;
            if slot >= stride {
                ends[slot] = ends[slot].wrapping_add(ends[slot - stride]);
            }
        }
        stride *= 2;
    }
    // The slot is the number of shares that end at or before the number, but not beyond the last child with weight.
    let (mut passed, mut last) = (0, 0);
    for slot in 0..W {
        passed += u32::from(ends[slot] <= number);
        last = if counts[slot] > 0 { slot as u32 } else { last };
    }
    let found = if passed < last { passed } else { last };
    let slot = if follow { wanted } else { found };
    let (mut end, mut count) = (0, 0);
    for s in 0..W {
        let own = !exact::mask(s as u32 ^ slot);
        end = exact::masked_u32(own, ends[s], end);
        count = exact::masked_u32(own, counts[s], count);
    }
    let first = end.wrapping_sub(count);
    let to_the_end = range.wrapping_sub(first);
    let all = if slot == last { to_the_end } else { count };
    Share {
        slot,
        first,
        count: if count > 0 && alive { all } else { 0 },
    }
}

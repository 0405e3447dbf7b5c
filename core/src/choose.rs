//! The choice of a child.

use crate::exact::{self, mask_of, masked_u32};
use crate::unroll::each;

/// Ranges of numbers are at most this long, 2^22: a share plus [`COUNTS`] stays below 2^24.
pub(crate) const FULL: u32 = 1 << 22;
/// Bits of [`FULL`].
pub(crate) const FULL_BITS: u32 = 22;

/// Share of a range that is given out by weight, 1 − 2^-15. The rest exceeds the rounding of up to 16 weights, of their sum, its reciprocal
/// and the shares, and all raised shares; the last child gets it.
const GIVEN: f32 = 1.0 - exact::pow2(-15);

/// From 2^23 on `f32` numbers are integers: adding it rounds to the nearest one.
const COUNTS: f32 = 8_388_608.0;

/// The numbers of a range that choose a child.
#[derive(Clone, Copy)]
pub(crate) struct Share {
    pub slot: u32,
    /// The first of them.
    pub first: u32,
    /// How many there are; 0 for a child without weight.
    pub count: u32,
}

/// Shares the numbers `0..range` out among the children, to each at least one where its weight is positive. Returns the share
/// that holds `number`, or with `follow` the share of `wanted`.
#[inline(always)]
pub(crate) fn choose<const W: usize>(
    weight: impl Fn(usize) -> f32,
    range: u32,
    number: u32,
    follow: bool,
    wanted: u32,
) -> Share {
    let (mut sums, mut last) = ([0.0; 4], 0);
    each!(slot, W, {
        let own = weight(slot);
        sums[slot % 4] += own;
        last = masked_u32(mask_of(own > 0.0), slot as u32, last);
    });
    let sum = (sums[0] + sums[2]) + (sums[1] + sums[3]);
    let alive = sum > 0.0;
    let scale = (range as i32 as f32 * GIVEN) * exact::recip(if alive { sum } else { 1.0 });
    // Skip children before `most` whose shares end at or before `at`. Signed integers compare faster.
    let (at, most) = if follow {
        (i32::MAX, wanted)
    } else {
        (number as i32, last)
    };
    let (mut slot, mut first, mut end, mut upto, mut passes) = (0, 0, 0, 0, u32::MAX);
    each!(k, W, {
        let own = weight(k);
        let whole = ((own * scale + COUNTS).to_bits() & 0x007f_ffff) as i32;
        let count = if whole > 1 { whole } else { 1 };
        end += count & mask_of(own > 0.0) as i32;
        upto = masked_u32(passes, end as u32, upto);
        passes = mask_of((end <= at) & ((k as i32) < most as i32));
        first = masked_u32(passes, end as u32, first);
        slot += passes & 1;
    });
    // A followed path knows its slot before the shares.
    let slot = if follow { wanted } else { slot };
    let all = if slot == last { range } else { upto };
    let some = alive & (upto > first) & (slot < W as u32);
    Share {
        slot: if slot < W as u32 { slot } else { 0 },
        first: if some { first } else { 0 },
        count: if some { all.wrapping_sub(first) } else { 0 },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn last_number_chooses_the_last_child_with_weight() {
        for (count, range) in (1..=16).flat_map(|count| [(count, FULL), (count, FULL / 2 + 1)]) {
            let weights: [f32; 16] =
                core::array::from_fn(|slot| if slot < count { 1.0 + slot as f32 } else { 0.0 });
            let share = choose::<16>(|slot| weights[slot], range, range - 1, false, 0);
            assert!(share.count > 0 && weights[share.slot as usize] > 0.0, "{count}");
            assert_eq!(share.first + share.count, range, "{count}");
        }
    }
}

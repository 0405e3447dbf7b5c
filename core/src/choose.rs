//! The choice of a child.

use glam::Vec4;

use crate::exact;

/// Ranges of numbers are at most this long, 2^22: their sums are exact in `f32`.
pub(crate) const FULL: u32 = 1 << 22;
/// Bits of [`FULL`].
pub(crate) const FULL_BITS: u32 = 22;

/// Share of a range that is given out by weight, 1 − 2^-15. The sum of up to 16 weights, its reciprocal, the rounding of
/// shares and the numbers that the least weights are raised to are together too large by less than the rest, which goes to
/// the last child.
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
/// that holds `number`, or with `follow` the share of `wanted`, which is below 16.
#[inline(always)]
pub(crate) fn choose<const W: usize>(
    weights: &[f32; W],
    range: u32,
    number: u32,
    follow: bool,
    wanted: u32,
) -> Share {
    // As few rows as the children need: each takes registers, or private memory on a device.
    if W <= 4 {
        Shares::<1>::of(weights, range).of_child::<W>(number, follow, wanted)
    } else if W <= 8 {
        Shares::<2>::of(weights, range).of_child::<W>(number, follow, wanted)
    } else {
        Shares::<4>::of(weights, range).of_child::<W>(number, follow, wanted)
    }
}

/// A range of numbers shared out among children in `ROWS` rows of four.
#[derive(Clone, Copy)]
pub(crate) struct Shares<const ROWS: usize> {
    /// Where the share of each child ends. Integers, but in `f32`, where processors add and compare several at a time.
    ends: Rows<ROWS>,
    /// The last child with weight, of each column.
    open: Vec4,
    /// Length of the range.
    length: f32,
    /// Whether any child has weight.
    alive: bool,
}

impl<const ROWS: usize> Shares<ROWS> {
    /// Shares `0..range` out by `weights`.
    #[inline(always)]
    pub fn of<const W: usize>(weights: &[f32; W], range: u32) -> Self {
        let weights = Rows::<ROWS>::of(weights);
        let sum = weights.sum();
        let alive = sum > 0.0;
        let length = range as i32 as f32;
        let scale = length * GIVEN * exact::recip(if alive { sum } else { 1.0 });
        let mut ends = Rows::<ROWS>::ZERO;
        let mut open = Vec4::ZERO;
        let mut before = Vec4::ZERO;
        for row in 0..ROWS {
            let w = weights.0[row];
            let whole = (w * scale + COUNTS) - COUNTS;
            let at_least_one = Vec4::select(whole.cmpgt(Vec4::ONE), whole, Vec4::ONE);
            let some = w.cmpgt(Vec4::ZERO);
            let count = Vec4::select(some, at_least_one, Vec4::ZERO);
            // Inclusive prefix sums: within the row by doubling steps, then from row to row.
            let pairs = count + Vec4::new(0.0, count.x, count.y, count.z);
            let end = (pairs + Vec4::new(0.0, 0.0, pairs.x, pairs.y)) + before;
            before = Vec4::splat(end.w);
            ends.0[row] = end;
            let first = (4 * row) as i32 as f32;
            let slots = Vec4::new(first, first + 1.0, first + 2.0, first + 3.0);
            // Later rows hold later slots.
            open = Vec4::select(some, slots, open);
        }
        Self {
            ends,
            open,
            length,
            alive,
        }
    }

    /// The share that holds `number`, or with `follow` that of `wanted`.
    #[inline(always)]
    pub fn of_child<const W: usize>(&self, number: u32, follow: bool, wanted: u32) -> Share {
        // The number of shares that end at or before the number, but not beyond the last child with weight.
        let at = Vec4::splat(number as i32 as f32);
        let mut passed = Vec4::ZERO;
        for row in 0..ROWS {
            passed += Vec4::select(self.ends.0[row].cmple(at), Vec4::ONE, Vec4::ZERO);
        }
        let open = self.open;
        let last = exact::max(exact::max(open.x, open.z), exact::max(open.y, open.w));
        let found = integer(exact::min((passed.x + passed.z) + (passed.y + passed.w), last));
        let last = integer(last);
        let slot = if follow { wanted } else { found };
        let within = if slot < W as u32 { slot } else { 0 };
        let end = self.ends.entry(within);
        let first = if within == 0 {
            0.0
        } else {
            self.ends.entry(within - 1)
        };
        let count = end - first;
        let all = if slot == last { self.length - first } else { count };
        let some = self.alive & (count > 0.0) & (slot < W as u32);
        Share {
            slot: within,
            first: if some { integer(first) } else { 0 },
            count: if some { integer(all) } else { 0 },
        }
    }
}

/// The integer that `x` is, for `0 <= x < 2^23`; some integer below 2^23 for any other, without the tests of a conversion.
#[inline(always)]
fn integer(x: f32) -> u32 {
    (x + COUNTS).to_bits() & 0x007f_ffff
}

/// One number of each child in rows of four, the width of the least vector registers: left to itself, the compiler packs such
/// short loops badly. Only sums, products, comparisons and selects of vectors are used, which are those of their components.
#[derive(Clone, Copy)]
struct Rows<const ROWS: usize>([Vec4; ROWS]);

impl<const ROWS: usize> Rows<ROWS> {
    const ZERO: Self = Self([Vec4::ZERO; ROWS]);

    #[inline(always)]
    fn of<const W: usize>(numbers: &[f32; W]) -> Self {
        let number = |slot: usize| if slot < W { numbers[slot] } else { 0.0 };
        let mut rows = Self::ZERO;
        for row in 0..ROWS {
            let first = 4 * row;
            rows.0[row] = Vec4::new(
                number(first),
                number(first + 1),
                number(first + 2),
                number(first + 3),
            );
        }
        rows
    }

    /// The sum, its halves added slot by slot, as registers do it.
    #[inline(always)]
    fn sum(&self) -> f32 {
        let row = if ROWS == 4 {
            (self.0[0] + self.0[2 % ROWS]) + (self.0[1 % ROWS] + self.0[3 % ROWS])
        } else if ROWS == 2 {
            self.0[0] + self.0[1 % ROWS]
        } else {
            self.0[0]
        };
        (row.x + row.z) + (row.y + row.w)
    }

    /// The number of child `slot`, below `W`. Devices keep arrays in registers only where no index varies, so there it is
    /// selected.
    #[inline(always)]
    fn entry(&self, slot: u32) -> f32 {
        #[cfg(target_arch = "spirv")]
        {
            let mut found = 0.0;
            for row in 0..ROWS {
                let v = self.0[row];
                let first = (4 * row) as u32;
                found = if slot == first { v.x } else { found };
                found = if slot == first + 1 { v.y } else { found };
                found = if slot == first + 2 { v.z } else { found };
                found = if slot == first + 3 { v.w } else { found };
            }
            found
        }
        #[cfg(not(target_arch = "spirv"))]
        {
            self.0[(slot / 4) as usize % ROWS].to_array()[(slot & 3) as usize]
        }
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
            let share = choose(&weights, range, range - 1, false, 0);
            assert!(share.count > 0 && weights[share.slot as usize] > 0.0, "{count}");
            assert_eq!(share.first + share.count, range, "{count}");
        }
    }
}

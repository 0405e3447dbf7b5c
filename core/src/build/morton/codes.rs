//! Morton codes: positions along a curve that seldom jumps.

use crate::build::ward::{Extent, WardPrimitive};
use crate::exact::exponent;

/// Bits of a code.
pub(super) const BITS: u32 = 30;
/// Shortest side that is divided, metres.
const SHORTEST: f32 = crate::exact::pow2(-96);

/// From a position to its code.
///
/// Cells are cubes at every length of prefix: while one side of the box is twice as long as the others, bits are its
/// alone; then two sides take turns until they are as short as the third. So lights on a line or in a plane have as fine
/// cells as the bits allow (compare M. Vinkler et al., "Extended Morton codes for high performance bounding volume
/// hierarchy construction", 2017).
#[derive(Clone, Copy, Debug)]
pub(super) struct Curve {
    low: [f32; 3],
    per_cell: f32,
    /// Axes by length of side, the longest first.
    axes: [usize; 3],
    /// Bits that are the longest side's alone, turns of two sides, turns of three.
    alone: u32,
    twos: u32,
    threes: u32,
}

impl Curve {
    /// The curve through the box `extent`.
    pub fn through(extent: &Extent) -> Self {
        let side = |axis: usize| extent.side(axis);
        let mut axes = [0, 1, 2];
        axes.sort_by(|&a, &b| {
            side(b)
                .partial_cmp(&side(a))
                .unwrap_or(core::cmp::Ordering::Equal)
        });
        let [longest, middle, shortest] = axes.map(side);
        let is_long = longest >= SHORTEST;
        // Infinite ratios have the greatest exponent.
        let alone = if middle > 0.0 {
            exponent(longest / middle)
        } else {
            128
        };
        let alone = (alone as u32).min(BITS);
        let twos = if shortest > 0.0 {
            exponent(middle / shortest)
        } else {
            128
        };
        let twos = if alone < BITS {
            (twos as u32).min((BITS - alone) / 2)
        } else {
            0
        };
        let threes = (BITS - alone - 2 * twos) / 3;
        let cells = (1u32 << (alone + twos + threes)) as f32;
        Self {
            low: [extent.low[0], extent.low[1], extent.low[2]],
            // A little less, so that the greatest position stays in the last cell.
            per_cell: if is_long {
                cells * (1.0 - 1e-6) / longest
            } else {
                0.0
            },
            axes,
            alone,
            twos,
            threes,
        }
    }

    /// The code of `primitive`, of [`BITS`] bits.
    #[inline]
    pub fn code(&self, primitive: &WardPrimitive) -> u32 {
        let cell = |side: usize, bits: u32| {
            let axis = self.axes[side];
            // Rounding may reach the next cell.
            let cell = ((primitive.c[axis] - self.low[axis]) * self.per_cell) as i32 as u32;
            let last = (1 << bits) - 1;
            if cell > last { last } else { cell }
        };
        let (two, three) = (self.twos + self.threes, self.threes);
        let (x, y, z) = (cell(0, self.alone + two), cell(1, two), cell(2, three));
        let low = |x: u32, bits: u32| x & ((1 << bits) - 1);
        let pair = |x: u32| spread_two(low(x >> three, self.twos));
        let twos = (pair(x) << 1) | pair(y);
        let threes = (spread_three(low(x, three)) << 2)
            | (spread_three(low(y, three)) << 1)
            | spread_three(low(z, three));
        ((((x >> two) << (2 * self.twos)) | twos) << (3 * three)) | threes
    }
}

/// The low 15 bits of `x`, each followed by one zero upwards.
#[inline]
fn spread_two(x: u32) -> u32 {
    let x = (x | (x << 8)) & 0x00ff_00ff;
    let x = (x | (x << 4)) & 0x0f0f_0f0f;
    let x = (x | (x << 2)) & 0x3333_3333;
    (x | (x << 1)) & 0x5555_5555
}

/// The low 10 bits of `x`, each followed by two zeros upwards.
#[inline]
fn spread_three(x: u32) -> u32 {
    let x = (x | (x << 16)) & 0x0300_00ff;
    let x = (x | (x << 8)) & 0x0300_f00f;
    let x = (x | (x << 4)) & 0x030c_30c3;
    (x | (x << 2)) & 0x0924_9249
}

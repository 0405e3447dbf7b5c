//! The space that a range of primitives is judged in: free of units, so that no square leaves the range of numbers.

use super::primitive::WardPrimitive;
use crate::build::MAX_BUCKETS;
use crate::exact::{exponent, pow2};

/// A box of centres (lanes 0 to 2) and of flux (lane 3).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::build) struct Extent {
    pub low: [f32; 4],
    pub high: [f32; 4],
}

impl Extent {
    pub const EMPTY: Self = Self {
        low: [f32::MAX; 4],
        high: [f32::MIN; 4],
    };

    /// The box of `primitives`.
    pub fn of(primitives: &[WardPrimitive]) -> Self {
        let mut all = Self::EMPTY;
        for p in primitives {
            let lanes = p.lanes();
            all.grow(&lanes, &lanes);
        }
        all
    }

    #[inline(always)]
    pub fn grow(&mut self, low: &[f32; 4], high: &[f32; 4]) {
        for k in 0..4 {
            self.low[k] = if low[k] < self.low[k] { low[k] } else { self.low[k] };
            self.high[k] = if high[k] > self.high[k] {
                high[k]
            } else {
                self.high[k]
            };
        }
    }

    pub fn side(&self, axis: usize) -> f32 {
        self.high[axis] - self.low[axis]
    }

    /// The axis of the longest side; the first of several.
    pub fn longest(&self) -> usize {
        let mut longest = 0;
        for axis in 1..3 {
            if self.side(axis) > self.side(longest) {
                longest = axis;
            }
        }
        longest
    }
}

/// Weight of a primitive without flux, as a part of the brightest one's in its range: lights that emit nothing now are
/// still told apart by their positions.
const DARK: f32 = pow2(-20);
/// Shortest side that is split by planes, metres: the reciprocals of shorter ones come near the end of the range.
const SHORTEST: f32 = pow2(-118);
/// Shortest side that is split by planes, as a part of the longest one.
const THINNEST: f32 = pow2(-60);
/// Adding it rounds a small number to an integer, which the last bits of the sum then count.
const COUNTS: f32 = 12_582_912.0;

/// Positions as parts of a range's box and weights as parts of its brightest primitive's, both scaled by powers of two:
/// a scene scaled by powers of two has the same ones to the bit.
#[derive(Clone, Copy, Debug)]
pub(in crate::build) struct Frame {
    low: [f32; 4],
    /// To a position in 0..2 along the longest axis; lane 3 to the weight.
    scale: [f32; 4],
    /// From there to bins; 0 along an axis that is too thin to be split.
    per_bin: [f32; 3],
    /// A cost of 1, W m².
    unit: f64,
}

impl Frame {
    /// The frame of a range within `extent`, with that many bins along each axis, at most `MAX_BUCKETS`; none if all its
    /// primitives are at one point, or so near to it that no plane can part them.
    pub fn of(extent: &Extent, bins: usize) -> Option<Self> {
        let longest = extent.side(extent.longest());
        if longest < SHORTEST {
            return None;
        }
        let (space, flux) = (-exponent(longest), -exponent(extent.high[3]));
        let (per_metre, per_watt) = (pow2(space), pow2(flux));
        let mut per_bin = [0.0; 3];
        for axis in 0..3 {
            let side = extent.side(axis) * per_metre;
            if side >= THINNEST {
                // A little less, so that the greatest position stays in the last bin.
                per_bin[axis] = bins as f32 * (1.0 - 1e-6) / side;
            }
        }
        let [x, y, z, _] = extent.low;
        // Where nothing emits, the weights are told apart from those of the faintest light.
        let dark = if extent.high[3] > 0.0 { -flux } else { -150 };
        Some(Self {
            low: [x, y, z, 0.0],
            scale: [per_metre, per_metre, per_metre, per_watt],
            per_bin,
            unit: wide_pow2(dark - space - space),
        })
    }

    /// Position (lanes 0 to 2) and weight of `primitive`.
    #[inline(always)]
    pub fn place(&self, primitive: &WardPrimitive) -> [f32; 4] {
        let lanes = primitive.lanes();
        let mut at = [0.0; 4];
        for k in 0..4 {
            at[k] = (lanes[k] - self.low[k]) * self.scale[k];
        }
        at[3] += DARK;
        at
    }

    /// The bin of position `x` along `axis`; it never falls as `x` rises.
    #[inline(always)]
    pub fn bin(&self, axis: usize, x: f32) -> usize {
        bin(x, self.per_bin[axis]) as usize
    }

    /// The same along one axis alone.
    pub fn along(&self, axis: usize) -> Along {
        Along {
            low: self.low[axis],
            scale: self.scale[axis],
            per_bin: self.per_bin[axis],
        }
    }

    /// Whether planes across `axis` can part anything.
    pub fn splits(&self, axis: usize) -> bool {
        self.per_bin[axis] > 0.0
    }

    /// A cost in this frame as W m².
    pub fn cost(&self, within: f32) -> f64 {
        f64::from(within) * self.unit
    }
}

/// From a coordinate to its bin, with the same bits as by way of the [`Frame`].
#[derive(Clone, Copy, Debug)]
pub(in crate::build) struct Along {
    low: f32,
    scale: f32,
    per_bin: f32,
}

impl Along {
    /// The bin of `coordinate`.
    #[inline(always)]
    pub fn bin_of(&self, coordinate: f32) -> u32 {
        bin((coordinate - self.low) * self.scale, self.per_bin)
    }
}

#[inline(always)]
fn bin(x: f32, per_bin: f32) -> u32 {
    let nearest = (x * per_bin - 0.5) + COUNTS;
    nearest.to_bits() & (MAX_BUCKETS - 1)
}

/// 2^`e`, for −1022 ≤ e ≤ 1023.
fn wide_pow2(e: i32) -> f64 {
    f64::from_bits(((1023 + i64::from(e)) as u64) << 52)
}

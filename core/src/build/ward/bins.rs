//! Ward's criterion (J. H. Ward, "Hierarchical grouping to optimize an objective function", 1963): the split that leaves
//! the least sum of flux times squared distance from the flux-weighted centre on both sides.

use super::frame::{Along, Extent, Frame};
use super::primitive::WardPrimitive;
use super::{CHUNK, SMALL};
use crate::build::{BuildParams, MAX_BUCKETS};

const MOST: usize = MAX_BUCKETS as usize;

/// Weighted positions (lanes 0 to 2) and weights of the primitives in each bin along each axis, and the weighted squares
/// of all positions.
#[derive(Clone, Debug)]
struct Bins {
    sums: [[[f32; 4]; MOST]; 3],
    squares: [f32; 3],
}

/// A plane between two bins.
#[derive(Clone, Copy, Debug)]
pub(in crate::build) struct Plane {
    along: Along,
    pub axis: u32,
    /// First bin of the right side.
    pub bin: u32,
}

impl Plane {
    /// Whether `primitive` lies on the right side.
    #[inline(always)]
    pub fn is_right(&self, primitive: &WardPrimitive) -> bool {
        self.along.bin_of(primitive.c[self.axis as usize]) >= self.bin
    }
}

/// The cost of a range, Σ Φ·|x − c|² in W m², and the plane that it is best split at, if any plane splits it.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::build) struct Measure {
    pub cost: f64,
    pub plane: Option<Plane>,
}

/// Bins along each axis for a range of that many primitives: half as many for a small one, where most would be empty.
pub(in crate::build) fn bins_for(count: usize, params: &BuildParams) -> usize {
    let wanted = params.buckets.clamp(2, MAX_BUCKETS) as usize;
    if count < SMALL && wanted > 2 {
        wanted.div_ceil(2)
    } else {
        wanted
    }
}

impl Measure {
    /// Measures `range`, whose box is `extent`.
    pub fn of(range: &[WardPrimitive], extent: &Extent, params: &BuildParams) -> Self {
        let bins = bins_for(range.len(), params);
        let Some(frame) = Frame::of(extent, bins) else {
            return Self::default();
        };
        let mut sums = Bins::EMPTY;
        sums.gather(range, &frame);

        let mut all = [0.0; 4];
        for sum in &sums.sums[0][..bins] {
            all = plus(&all, sum);
        }
        let mean_squared = (all[0] * all[0] + all[1] * all[1] + all[2] * all[2]) / all[3];
        let cost = (sums.squares[0] + sums.squares[1] + sums.squares[2]) - mean_squared;
        Self {
            cost: frame.cost(if cost > 0.0 { cost } else { 0.0 }),
            plane: sums.best(&frame, bins).map(|(axis, bin)| Plane {
                along: frame.along(axis),
                axis: axis as u32,
                bin: bin as u32,
            }),
        }
    }
}

impl Bins {
    const EMPTY: Self = Self {
        sums: [[[0.0; 4]; MOST]; 3],
        squares: [0.0; 3],
    };

    /// Sums over pieces of a fixed size, then over the pieces in order.
    fn gather(&mut self, range: &[WardPrimitive], frame: &Frame) {
        if range.len() <= CHUNK {
            return self.add(range, frame);
        }
        for piece in range.chunks(CHUNK) {
            let mut sums = Self::EMPTY;
            sums.add(piece, frame);
            self.merge(&sums);
        }
    }

    fn add(&mut self, range: &[WardPrimitive], frame: &Frame) {
        let [xs, ys, zs] = &mut self.sums;
        let mut squares = [0.0; 4];
        for p in range {
            let at = frame.place(p);
            let w = at[3];
            let weighted = [at[0] * w, at[1] * w, at[2] * w, w];
            for k in 0..4 {
                squares[k] += weighted[k] * at[k];
            }
            for (axis, bins) in [&mut *xs, &mut *ys, &mut *zs].into_iter().enumerate() {
                let bin = &mut bins[frame.bin(axis, at[axis])];
                *bin = plus(bin, &weighted);
            }
        }
        self.squares = [squares[0], squares[1], squares[2]];
    }

    fn merge(&mut self, other: &Self) {
        for axis in 0..3 {
            for (bin, more) in self.sums[axis].iter_mut().zip(&other.sums[axis]) {
                *bin = plus(bin, more);
            }
            self.squares[axis] += other.squares[axis];
        }
    }

    /// Axis and first right bin of the best plane; the first of equal ones.
    ///
    /// The cost of both sides is that of the whole less Φ_l·Φ_r / Φ · |c_l − c_r|²: the best plane takes most away.
    fn best(&self, frame: &Frame, bins: usize) -> Option<(usize, usize)> {
        let mut best = None;
        let mut most = -1.0;
        for axis in (0..3).filter(|&axis| frame.splits(axis)) {
            let sums = &self.sums[axis];
            // Of the bins from the index on: centre and weight.
            let mut right = [[0.0; 4]; MOST];
            let mut sum = [0.0; 4];
            for b in (1..bins).rev() {
                sum = plus(&sum, &sums[b]);
                right[b] = centre(&sum);
            }
            sum = [0.0; 4];
            for b in 1..bins {
                sum = plus(&sum, &sums[b - 1]);
                let (l, r) = (centre(&sum), &right[b]);
                // Every primitive has some weight, so a side without weight is empty.
                if l[3] > 0.0 && r[3] > 0.0 {
                    let (x, y, z) = (l[0] - r[0], l[1] - r[1], l[2] - r[2]);
                    let gain = (l[3] * r[3]) * ((x * x + y * y) + z * z);
                    if gain > most {
                        most = gain;
                        best = Some((axis, b));
                    }
                }
            }
        }
        best
    }
}

#[inline(always)]
fn plus(a: &[f32; 4], b: &[f32; 4]) -> [f32; 4] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]]
}

/// From weighted positions and weight to centre and weight; not a number where there is no weight.
#[inline(always)]
fn centre(sum: &[f32; 4]) -> [f32; 4] {
    let per_weight = 1.0 / sum[3];
    [
        sum[0] * per_weight,
        sum[1] * per_weight,
        sum[2] * per_weight,
        sum[3],
    ]
}

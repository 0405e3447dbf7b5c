//! An environment map in words: what chooses a direction, on any processor.
//!
//! The map is a square of N × N texels, N = 2^levels, over the unfolded octahedron; the radiance within a texel is one. Each texel has a count out of 2^31, and the
//! nodes of a quad tree over them have sums of counts (hierarchical warping: P. Clarberg, W. Jarosz, T. Akenine-Möller, H. W. Jensen, *Wavelet importance
//! sampling*, 2005). A number below 2^31 goes down to the texel among whose counts it lies: so a texel's probability is its count over 2^31, with
//! no rounding anywhere.

use super::octahedron::{cubed_distance, direction_at, place_of};
use crate::exact;
use crate::random::Random64;

/// Most levels below the root: 2048 × 2048 texels.
pub const MAX_LEVELS: u32 = 11;
/// Bits of all counts together.
pub(super) const BITS: u32 = 31;

/// An environment map as words lie in memory. Texels stand in Z order: bit 2*k* of a texel's number is bit *k* of its column, bit
/// 2*k* + 1 that of its row. Columns go with x, rows with z.
#[derive(Clone, Copy, Debug)]
pub struct EnvironmentMap<'a> {
    /// Levels below the root, at most [`MAX_LEVELS`].
    pub levels: u32,
    /// Sums of counts, level by level from the root, which has 2^31; those of node *k*'s children stand at 4*k* to 4*k* + 3 of the next level.
    /// The last level is that of texels.
    pub counts: &'a [u32],
    /// Radiance of each texel, W/(m² sr), linear RGB.
    pub radiance: &'a [[f32; 3]],
}

/// A direction from which light comes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnvironmentSample {
    /// Number of the texel.
    pub texel: u32,
    /// The probability with which it was chosen.
    pub pmf: f32,
    /// Unit vector towards the light; of zeros where the environment has no light.
    pub direction: [f32; 3],
    /// Density over solid angle, 1/sr: what [`EnvironmentMap::density`] says of the direction.
    pub density: f32,
    /// W/(m² sr).
    pub radiance: [f32; 3],
}

/// Where a level begins: the number of nodes above it.
#[inline(always)]
pub(super) fn start_of(level: u32) -> u32 {
    // (4^level - 1) / 3, every other bit.
    0x5555_5555 & ((1_u32 << (2 * level)).wrapping_sub(1))
}

impl EnvironmentMap<'_> {
    /// Chooses a texel by `random` and a direction within it by the two numbers of `uv` in [0, 1). Takes one step for each level.
    #[inline]
    #[must_use]
    pub fn sample(&self, random: impl Into<Random64>, uv: [f32; 2]) -> EnvironmentSample {
        let random: Random64 = random.into();
        let mut number = random.high >> (32 - BITS);
        let (mut node, mut column, mut row) = (0_u32, 0_u32, 0_u32);
        for level in 0..self.depth() {
            let first = start_of(level + 1).wrapping_add(4 * node);
            // The last child with a count takes what is left, whatever the words are.
            let mut child = 0_u32;
            let mut before = 0_u32;
            let mut end = 0_u32;
            for k in 0..4 {
                let count = self.count(first.wrapping_add(k));
                let is_here = (count > 0) & (number >= end);
                if is_here {
                    child = k;
                    before = end;
                }
                end = end.wrapping_add(count);
            }
            number = number.wrapping_sub(before);
            node = 4 * node + child;
            column = 2 * column + (child & 1);
            row = 2 * row + (child >> 1);
        }
        let count = self.count(start_of(self.depth()).wrapping_add(node));
        if count == 0 || node >= self.radiance.len() as u32 {
            return EnvironmentSample {
                texel: u32::MAX,
                pmf: 0.0,
                direction: [0.0; 3],
                density: 0.0,
                radiance: [0.0; 3],
            };
        }
        let size = exact::pow2(1 - self.depth() as i32);
        let place = [
            (column as i32 as f32 + uv[0]) * size - 1.0,
            (row as i32 as f32 + uv[1]) * size - 1.0,
        ];
        let direction = direction_at(place);
        let pmf = probability(count);
        EnvironmentSample {
            texel: node,
            pmf,
            direction,
            density: self.density_in(pmf, direction),
            radiance: self.radiance[node as usize],
        }
    }

    /// The texel that a direction lies in, which need not be of length 1.
    #[inline]
    #[must_use]
    pub(super) fn texel_of(&self, direction: [f32; 3]) -> u32 {
        let half = exact::pow2(self.depth() as i32 - 1);
        let place = place_of(direction);
        let last = (1_u32 << self.depth()) - 1;
        let mut texel = 0_u32;
        let at = |x: f32| {
            let index = exact::floor_u32(exact::max((x + 1.0) * half, 0.0));
            if index < last { index } else { last }
        };
        let (column, row) = (at(place[0]), at(place[1]));
        for k in 0..self.depth() {
            texel |= ((column >> k) & 1) << (2 * k);
            texel |= ((row >> k) & 1) << (2 * k + 1);
        }
        texel
    }

    /// The probability with which [`sample`](Self::sample) chooses a texel.
    #[inline]
    #[must_use]
    pub fn pmf(&self, texel: u32) -> f32 {
        if texel < self.radiance.len() as u32 {
            probability(self.count(start_of(self.depth()).wrapping_add(texel)))
        } else {
            0.0
        }
    }

    /// The density over solid angle with which a unit direction is chosen, 1/sr (at a length of 1 + *e*, less by 3 *e*): what multiple importance sampling asks where a ray that
    /// something else chose meets nothing.
    #[inline]
    #[must_use]
    pub fn density(&self, direction: [f32; 3]) -> f32 {
        self.density_in(self.pmf(self.texel_of(direction)), direction)
    }

    /// Radiance from a direction, W/(m² sr).
    #[inline]
    #[must_use]
    pub fn radiance(&self, direction: [f32; 3]) -> [f32; 3] {
        let texel = self.texel_of(direction);
        if texel < self.radiance.len() as u32 {
            self.radiance[texel as usize]
        } else {
            [0.0; 3]
        }
    }

    /// Its levels, whatever the words are.
    #[inline(always)]
    fn depth(&self) -> u32 {
        if self.levels < MAX_LEVELS {
            self.levels
        } else {
            MAX_LEVELS
        }
    }

    #[inline(always)]
    fn density_in(&self, pmf: f32, direction: [f32; 3]) -> f32 {
        // Texels over the square's area of 4.
        let per_area = exact::pow2(2 * self.depth() as i32 - 2);
        (pmf * per_area) * cubed_distance(direction)
    }

    #[inline(always)]
    fn count(&self, index: u32) -> u32 {
        if index < self.counts.len() as u32 {
            self.counts[index as usize]
        } else {
            0
        }
    }
}

/// A count as a probability. Counts have 24 significant bits at most, so it is exact.
#[inline(always)]
fn probability(count: u32) -> f32 {
    // Through i32: one driver converts large u32 wrongly.
    let half = (count >> 1) as i32 as f32 * 2.0 + (count & 1) as i32 as f32;
    half * exact::pow2(-(BITS as i32))
}

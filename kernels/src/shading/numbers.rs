//! The numbers that a pixel's light samples are drawn by.

use lightbvh::Random64;
use lightbvh::exact::{hash, unit_f32};

/// Steps of the sequence R2 in units of 2^-32: 1 / g and 1 / g² for the root g of g³ = g + 1 (M. Roberts, "The Unreasonable
/// Effectiveness of Quasirandom Sequences", 2018).
const R2: [u32; 2] = [0xc13f_a9a9, 0x91e1_0da6];

/// Point `k` of the sequence that begins at `first`, in [0, 1)².
#[inline]
pub(super) fn r2(first: [u32; 2], k: u32) -> [f32; 2] {
    [
        unit_f32(first[0].wrapping_add(k.wrapping_mul(R2[0]))),
        unit_f32(first[1].wrapping_add(k.wrapping_mul(R2[1]))),
    ]
}

/// Numbers of the lights, and of the points on them. Those of lights lie at equal distances, those of points are a sequence of low
/// discrepancy; all are shifted by one random number each, so each by itself is uniform.
#[derive(Clone, Copy, Debug)]
pub struct Numbers {
    light: Random64,
    uv: [u32; 2],
    part: Part,
}

/// Which of a pixel's samples these are, where several images share them: every one of `of`, from `index` on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Part {
    /// Below `of`.
    pub index: u32,
    /// How many parts there are; 0 counts as 1.
    pub of: u32,
}

impl Part {
    /// All samples.
    pub const WHOLE: Self = Self { index: 0, of: 1 };

    /// The number among all samples of sample `k` of this part.
    #[inline]
    #[must_use]
    pub fn number(self, k: u32) -> u32 {
        let of = if self.of == 0 { 1 } else { self.of };
        self.index.wrapping_add(k.wrapping_mul(of))
    }
}

impl Numbers {
    /// How many numbers of its seed's sequence it uses; the next may choose something else.
    pub const USED: u32 = 3;

    /// The numbers that `seed` chooses.
    #[inline]
    #[must_use]
    pub fn of(seed: u32) -> Self {
        Self {
            light: Random64::from(hash(seed)),
            uv: [hash(seed.wrapping_add(1)), hash(seed.wrapping_add(2))],
            part: Part::WHOLE,
        }
    }

    /// Those of one part of the samples that `seed` chooses numbers for, `samples` of them: between those of the other parts.
    #[inline]
    #[must_use]
    pub fn of_part(seed: u32, part: Part, samples: u32) -> Self {
        let all = Self::of(seed);
        Self {
            light: all.light.spaced(part.index, part.of.wrapping_mul(samples)),
            uv: all.uv,
            part,
        }
    }

    /// The number that picks light `k` of `count`, all that the part has.
    #[inline]
    #[must_use]
    pub fn light(&self, k: u32, count: u32) -> Random64 {
        self.light.spaced(k, count)
    }

    /// The numbers of the point on light `k`, in [0, 1).
    #[inline]
    #[must_use]
    pub fn uv(&self, k: u32) -> [f32; 2] {
        r2(self.uv, self.part.number(k))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Parts of equal size together have one number in each stratum, and each point once.
    #[test]
    fn parts_lie_between_each_other() {
        for seed in 0..64 {
            for (parts, samples) in [(1, 8), (6, 8), (12, 1), (5, 3)] {
                let all = parts * samples;
                let whole = Numbers::of(hash(seed));
                let mut strata = vec![0; all as usize];
                let mut points = Vec::new();
                for index in 0..parts {
                    let part = Part { index, of: parts };
                    let numbers = Numbers::of_part(hash(seed), part, samples);
                    for k in 0..samples {
                        // From the first one on, past the rounding of the steps.
                        let from = whole.light(0, 1).high.wrapping_sub(all);
                        let light = u64::from(numbers.light(k, samples).high.wrapping_sub(from));
                        strata[((light * u64::from(all)) >> 32) as usize] += 1;
                        points.push(numbers.uv(k).map(f32::to_bits));
                    }
                }
                assert!(strata.iter().all(|&n| n == 1), "{seed}: {strata:?}");
                let mut expected: Vec<_> = (0..all).map(|k| whole.uv(k).map(f32::to_bits)).collect();
                expected.sort_unstable();
                points.sort_unstable();
                assert_eq!(points, expected);
            }
        }
    }
}

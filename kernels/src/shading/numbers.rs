//! The numbers that a pixel's light samples are drawn by.

use lightbvh::Random64;
use lightbvh::exact::{hash, unit_f32};

/// Steps of the sequence R2 in units of 2^-32: 1 / g and 1 / g² for the root g of g³ = g + 1 (M. Roberts, "The Unreasonable
/// Effectiveness of Quasirandom Sequences", 2018).
const R2: [u32; 2] = [0xc13f_a9a9, 0x91e1_0da6];

/// Numbers of the lights, and of the points on them. Those of lights lie at equal distances, those of points are a sequence of low
/// discrepancy; all are shifted by one random number each, so each by itself is uniform.
#[derive(Clone, Copy, Debug)]
pub struct Numbers {
    light: Random64,
    uv: [u32; 2],
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
        }
    }

    /// The number that picks light `k` of `count`.
    #[inline]
    #[must_use]
    pub fn light(&self, k: u32, count: u32) -> Random64 {
        self.light.spaced(k, count)
    }

    /// The numbers of the point on light `k`, in [0, 1).
    #[inline]
    #[must_use]
    pub fn uv(&self, k: u32) -> [f32; 2] {
        [
            unit_f32(self.uv[0].wrapping_add(k.wrapping_mul(R2[0]))),
            unit_f32(self.uv[1].wrapping_add(k.wrapping_mul(R2[1]))),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_fill_their_space_evenly() {
        for seed in 0..64 {
            let numbers = Numbers::of(hash(seed));
            for count in [1, 6, 48] {
                let mut strata = [0; 48];
                let mut squares = [0; 16];
                for k in 0..count {
                    let light = u64::from(numbers.light(k, count).high);
                    strata[((light * u64::from(count)) >> 32) as usize] += 1;
                    let [u, v] = numbers.uv(k).map(|u| (u * 4.0) as usize);
                    squares[4 * u + v] += 1;
                }
                assert!(
                    strata[..count as usize].iter().all(|&n| n == 1),
                    "{seed}: {strata:?}"
                );
                // Independent numbers fill a square with more now and then.
                assert!(
                    squares.iter().all(|&n| n <= count / 16 + 3),
                    "{seed}: {squares:?}"
                );
            }
        }
    }
}

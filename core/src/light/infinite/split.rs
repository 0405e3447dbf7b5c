//! Which of several kinds of light a sample goes to.

use crate::choose::{FULL, FULL_BITS, choose};
use crate::exact;
use crate::random::Random64;

/// Probabilities of `COUNT` sources, 1 to 16: the tree, an environment, suns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Split<const COUNT: usize> {
    weights: [f32; COUNT],
}

/// A source that was chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Share {
    /// Which; `COUNT` where no source has weight.
    pub index: u32,
    /// With which probability; 0 where no source has weight.
    pub pmf: f32,
    /// A number as uniform as the one that chose it, for the choice within it.
    pub rest: Random64,
}

impl<const COUNT: usize> Split<COUNT> {
    const IN_RANGE: () = assert!(COUNT >= 1 && COUNT <= 16, "1 to 16 sources");

    /// In proportion to `weights`: what each source sends to the point, or to all points, as far as is known. Those that are not positive, and
    /// NaN, are none; what is beyond 2^±60 counts as that. A positive one gets 2^-22 at least, so what sends any light has to have a weight.
    #[inline(always)]
    #[must_use]
    pub fn new(weights: [f32; COUNT]) -> Self {
        const { Self::IN_RANGE };
        let mut sound = [0.0; COUNT];
        for k in 0..COUNT {
            if weights[k] > 0.0 {
                sound[k] = exact::clamp(weights[k], exact::pow2(-60), exact::pow2(60));
            }
        }
        Self { weights: sound }
    }

    /// Chooses one.
    #[inline(always)]
    #[must_use]
    pub fn choose(&self, random: impl Into<Random64>) -> Share {
        let random: Random64 = random.into();
        let number = random.high >> (32 - FULL_BITS);
        let share = choose(&self.weights, FULL, number, false, 0);
        let within = number.wrapping_sub(share.first);
        Share {
            index: if share.count > 0 { share.slot } else { COUNT as u32 },
            pmf: probability(share.count),
            rest: stretched(within, share.count, random),
        }
    }

    /// The probability with which source `index` is chosen.
    #[inline(always)]
    #[must_use]
    pub fn pmf(&self, index: u32) -> f32 {
        probability(choose(&self.weights, FULL, 0, true, index).count)
    }
}

#[inline(always)]
fn probability(count: u32) -> f32 {
    count as i32 as f32 * exact::pow2(-(FULL_BITS as i32))
}

/// Bits of the quotient found at a time: with 22 of the remainder they are fewer than 32.
const DIGIT: u32 = 9;

/// Number `within` of `count`, and the bits of `random` behind the first 22, as a number in [0, 1): (within + those) / count, rounded
/// down to a multiple of 2^-63. Long division, for 64-bit integers are a feature that a device may lack.
#[inline(always)]
fn stretched(within: u32, count: u32, random: Random64) -> Random64 {
    let count = if count > 0 { count } else { 1 };
    let mut remainder = if within < count { within } else { 0 };
    let mut bits = Random64 {
        high: (random.high << FULL_BITS) | (random.low >> (32 - FULL_BITS)),
        low: random.low << FULL_BITS,
    };
    let mut found = Random64 { high: 0, low: 0 };
    for _ in 0..7 {
        let next = (remainder << DIGIT) | (bits.high >> (32 - DIGIT));
        bits = Random64 {
            high: (bits.high << DIGIT) | (bits.low >> (32 - DIGIT)),
            low: bits.low << DIGIT,
        };
        let digit = next / count;
        remainder = next - digit * count;
        found = Random64 {
            high: (found.high << DIGIT) | (found.low >> (32 - DIGIT)),
            low: (found.low << DIGIT) | digit,
        };
    }
    // 63 bits, one place short.
    Random64 {
        high: (found.high << 1) | (found.low >> 31),
        low: found.low << 1,
    }
}

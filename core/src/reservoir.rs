//! Reservoirs: resampled importance sampling over a stream of light samples, and over other reservoirs.
//!
//! B. Bitterli, C. Wyman, M. Pharr, P. Shirley, A. Lefohn, W. Jarosz, "Spatiotemporal reservoir resampling for real-time
//! ray tracing with dynamic direct lighting", ACM TOG 39(4), 2020 (below: ReSTIR). Algorithm numbers are theirs.
//!
//! A sample is a light and two random numbers that choose the point on it, so all densities here are over the lights
//! times the unit square. That square moves with its light: a sample of the last frame is one of this frame, at the point
//! that the light's motion has carried it to, and no change of variables comes in.
//!
//! What decides anything stays within 2^±116: targets, pmfs, sums and contribution weights are brought into the ranges
//! that the constants below state. A target may be any function that is positive where the integrand is (ReSTIR section
//! 2.3), so limiting it costs variance only. The other limits are met where an estimate is beyond 2^±60 of all others.

use bytemuck::{Pod, Zeroable};

use crate::exact::{clamp, div, flush, max, min, pow2, unit_f32};
use crate::tree::INVALID;

/// Targets that are not zero count as at least this.
pub const MIN_TARGET: f32 = pow2(-40);
/// Targets count as at most this.
pub const MAX_TARGET: f32 = pow2(40);
/// Probabilities of candidates count as at least this.
pub const MIN_PMF: f32 = pow2(-40);
/// Sums of resampling weights count as at most this.
pub const MAX_WEIGHT_SUM: f32 = pow2(80);
/// Smallest contribution weight that is not zero.
pub const MIN_WEIGHT: f32 = pow2(-60);
/// Contribution weights count as at most this.
pub const MAX_WEIGHT: f32 = pow2(60);
/// Counts of samples stop growing here, so that every product of one with a target and a weight is finite.
pub const MAX_COUNT: u32 = 1 << 16;

/// A point on a light; 16 bytes.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct LightSample {
    /// Number of the light, or [`SampledLight::INVALID`](crate::SampledLight::INVALID).
    pub light: u32,
    /// Its instance, as a [`SampledLight`](crate::SampledLight) names it.
    pub instance: u32,
    /// The two numbers in [0, 1) that the point on it was chosen by.
    pub uv: [f32; 2],
}

impl LightSample {
    /// No sample.
    pub const NONE: Self = Self {
        light: INVALID,
        instance: INVALID,
        uv: [0.0; 2],
    };
}

/// What remains of a stream of samples: one of them, and what it stands for; 24 bytes.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Reservoir {
    /// y, the chosen sample; [`LightSample::NONE`] if every candidate had target zero.
    pub sample: LightSample,
    /// W, the contribution weight: the integrand at y times W estimates the integral (an unbiased estimate of 1 / p(y)).
    /// Zero or in [`MIN_WEIGHT`]`..=`[`MAX_WEIGHT`].
    pub weight: f32,
    /// M, how many samples it stands for, at most [`MAX_COUNT`].
    pub count: u32,
}

const _: () = assert!(size_of::<Reservoir>() == 24);

impl Reservoir {
    /// Of no samples.
    pub const EMPTY: Self = Self {
        sample: LightSample::NONE,
        weight: 0.0,
        count: 0,
    };

    /// The reservoir with M limited: a history that counts for ever would freeze the image (ReSTIR section 5, which
    /// takes 20 times the current frame's M). M is only a confidence, so this changes no expectation.
    #[inline]
    #[must_use]
    pub fn limited(self, most: u32) -> Self {
        Self {
            count: if self.count < most { self.count } else { most },
            ..self
        }
    }

    /// The reservoir after its sample proved to be occluded: it contributes nothing, and its samples still count
    /// (visibility reuse, Algorithm 5).
    #[inline]
    #[must_use]
    pub fn occluded(self) -> Self {
        Self { weight: 0.0, ..self }
    }
}

/// The domain of targets: zero, or from [`MIN_TARGET`] to [`MAX_TARGET`]. `luminance` is that of the unshadowed
/// contribution, zero or a normal number: over the lights times the unit square, so what a point of a light's area contributes is divided
/// by [`LightPoint::density`](crate::light::LightPoint::density).
#[inline]
#[must_use]
pub fn target(luminance: f32) -> f32 {
    if luminance > 0.0 {
        clamp(luminance, MIN_TARGET, MAX_TARGET)
    } else {
        0.0
    }
}

/// A stream that is being resampled for one receiver (Algorithm 2 and its uses).
#[derive(Clone, Copy, Debug)]
pub struct Resampling {
    /// y, the sample chosen so far.
    pub sample: LightSample,
    /// The receiver's target at y.
    pub target: f32,
    /// Which reservoir y came from: what [`merge`](Self::merge) was told. Of candidates how many came before it.
    pub source: u32,
    /// The sum of all weights.
    pub weight_sum: f32,
    /// M.
    pub count: u32,
}

impl Resampling {
    /// Before the first sample.
    pub const EMPTY: Self = Self {
        sample: LightSample::NONE,
        target: 0.0,
        source: 0,
        weight_sum: 0.0,
        count: 0,
    };

    /// Weighted reservoir sampling (Algorithm 2, `update`): takes `sample` in place of the one chosen so far with
    /// probability `weight` over the sum so far. `weight` is finite and zero or at least 2^-100; `random` is 32 random bits.
    ///
    /// The random number is an odd multiple of 2^-24 in (0, 1): never zero, so a sample of weight zero is never taken,
    /// and centred, so that each probability is right to 2^-24 on either side.
    #[inline]
    fn update(&mut self, sample: LightSample, weight: f32, target: f32, source: u32, random: u32) {
        self.weight_sum = min(self.weight_sum + weight, MAX_WEIGHT_SUM);
        let u = unit_f32(random | 0x100);
        let take = u * self.weight_sum < weight;
        self.sample = if take { sample } else { self.sample };
        self.target = if take { target } else { self.target };
        self.source = if take { source } else { self.source };
    }

    /// Takes a candidate that was drawn with probability `pmf`, which is 0 where none was drawn (Algorithm 3): weight
    /// p̂ / p. `target` is p̂ as [`target`] gives it.
    #[inline]
    pub fn candidate(&mut self, sample: LightSample, target: f32, pmf: f32, random: u32) {
        let drawn = pmf > 0.0;
        let weight = if drawn {
            div(target, max(pmf, MIN_PMF))
        } else {
            0.0
        };
        let before = self.count;
        self.count = plus(before, 1);
        self.update(sample, weight, target, before, random);
    }

    /// Takes the sample of another reservoir for all those that it stands for (Algorithm 4): weight p̂ W M, with this
    /// receiver's target p̂ at that sample. `source` tells reservoirs apart.
    #[inline]
    pub fn merge(&mut self, reservoir: &Reservoir, target: f32, source: u32, random: u32) {
        let count = plus(reservoir.count, 0);
        let weight = min(
            (target * reservoir.weight) * (count as i32 as f32),
            MAX_WEIGHT_SUM,
        );
        self.update(reservoir.sample, weight, target, source, random);
        self.count = plus(self.count, count);
    }

    /// W = sum / (M p̂): every sample counts alike (Algorithms 3 and 4).
    ///
    /// Right for candidates that all come from one source. Of reservoirs of other receivers it is **biased**: samples that
    /// some of them could not have produced are counted as if they could (ReSTIR section 4.2).
    #[inline]
    #[must_use]
    pub fn finish_equal(&self) -> Reservoir {
        self.finish(1.0, self.count as i32 as f32)
    }

    /// W = sum / p̂ · p̂_s / Σ M_j p̂_j: y is counted by the balance heuristic among the reservoirs that could have produced
    /// it (Algorithm 6 with the weights of ReSTIR section 4.3). **Unbiased** where each p̂_j is zero wherever reservoir j could
    /// not have produced y with its right weight, and some reservoir could wherever the integrand is positive.
    ///
    /// `own` is p̂_s, the target at y of the receiver that y came from; `balance` the sum of M_j p̂_j over all receivers,
    /// that one included.
    #[inline]
    #[must_use]
    pub fn finish_balanced(&self, own: f32, balance: f32) -> Reservoir {
        self.finish(own, balance)
    }

    /// W = sum / p̂ · `share` / `whole`, zero where any of them is; `share` and `whole` are at most 2^60.
    #[inline]
    fn finish(&self, share: f32, whole: f32) -> Reservoir {
        let found = self.target > 0.0 && self.weight_sum > 0.0 && share > 0.0 && whole > 0.0;
        let mut weight = 0.0;
        if found {
            // 2^80 / 2^-40 at most; a share is at most its whole, or 1 over a count.
            let sum = div(self.weight_sum, self.target);
            weight = flush(min(sum * div(share, whole), MAX_WEIGHT), MIN_WEIGHT);
        }
        Reservoir {
            sample: self.sample,
            weight,
            count: self.count,
        }
    }
}

/// `a + b`, at most [`MAX_COUNT`], for counts of any value.
#[inline]
fn plus(a: u32, b: u32) -> u32 {
    let a = if a < MAX_COUNT { a } else { MAX_COUNT };
    let b = if b < MAX_COUNT - a { b } else { MAX_COUNT - a };
    a + b
}

#[cfg(test)]
mod tests;

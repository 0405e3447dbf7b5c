//! Resampled importance sampling of light samples: one of several candidates (J. Talbot, D. Cline, P. Egbert, "Importance
//! Resampling for Global Illumination", 2005), chosen by a reservoir as in ReSTIR (B. Bitterli, C. Wyman, M. Pharr, P. Shirley,
//! A. Lefohn, W. Jarosz, 2020). Algorithm numbers are those of ReSTIR.
//!
//! A sample is a light and two random numbers that choose the point on it, so all densities here are over the lights
//! times the unit square. That square moves with its light.
//!
//! Targets, pmfs, sums and contribution weights are brought into ranges. A target may be any function that is positive where the
//! integrand is (ReSTIR section 2.3), so limiting it costs variance only. The other limits are met where an estimate is beyond
//! 2^±60 of all others.

use crate::exact::{clamp, div, flush, max, min, pow2, unit_f32};

/// Targets that are not zero count as at least this.
const MIN_TARGET: f32 = pow2(-40);
/// Targets count as at most this.
const MAX_TARGET: f32 = pow2(40);
/// Probabilities of candidates count as at least this.
const MIN_PMF: f32 = pow2(-40);
/// Sums of resampling weights count as at most this.
const MAX_WEIGHT_SUM: f32 = pow2(80);
/// Smallest contribution weight that is not zero.
const MIN_WEIGHT: f32 = pow2(-60);
/// Contribution weights count as at most this.
const MAX_WEIGHT: f32 = pow2(60);

/// The domain of targets: zero, or from 2^-40 to 2^40. `luminance` is that of the unshadowed
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

/// A stream of candidates that is being resampled for one receiver (Algorithm 2). The caller keeps y, the sample chosen so far.
#[derive(Clone, Copy, Debug)]
pub struct Resampling {
    /// The receiver's target at y.
    pub target: f32,
    /// The sum of all weights.
    pub weight_sum: f32,
    /// M, the number of candidates, at most 2^24.
    pub count: u32,
}

impl Resampling {
    /// Before the first sample.
    pub const EMPTY: Self = Self {
        target: 0.0,
        weight_sum: 0.0,
        count: 0,
    };

    /// Takes a candidate that was drawn with probability `pmf`, which is 0 where none was drawn (Algorithm 3): weight
    /// p̂ / p. `target` is p̂ as [`target`] gives it. It is to replace y where true is returned: with probability weight over the sum so
    /// far; `random` is 32 random bits.
    ///
    /// The random number is an odd multiple of 2^-24 in (0, 1): never zero, so a sample of weight zero is never taken,
    /// and centred, so that each probability is right to 2^-24 on either side.
    #[inline]
    #[must_use]
    pub fn candidate(&mut self, target: f32, pmf: f32, random: u32) -> bool {
        let drawn = pmf > 0.0;
        let weight = if drawn {
            div(target, max(pmf, MIN_PMF))
        } else {
            0.0
        };
        self.weight_sum = min(self.weight_sum + weight, MAX_WEIGHT_SUM);
        let u = unit_f32(random | 0x100);
        let take = u * self.weight_sum < weight;
        self.target = if take { target } else { self.target };
        self.count = self.count.wrapping_add(1);
        take
    }

    /// W = sum / (p̂ M), the contribution weight: the integrand at y times W estimates the integral (an unbiased estimate of
    /// 1 / p(y)). From 2^-60 to 2^60; zero where sum, p̂ or M is.
    #[inline]
    #[must_use]
    pub fn weight(&self) -> f32 {
        let found = self.target > 0.0 && self.weight_sum > 0.0 && self.count > 0;
        let mut weight = 0.0;
        if found {
            // 2^80 / 2^-40 at most.
            let sum = div(self.weight_sum, self.target);
            let share = div(1.0, self.count as i32 as f32);
            weight = flush(min(sum * share, MAX_WEIGHT), MIN_WEIGHT);
        }
        weight
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every one of the 2^23 numbers that decide: a weight is taken by its share of them, to one.
    #[test]
    fn a_weight_is_taken_by_its_share_of_all_random_numbers() {
        for (before, weight) in [
            (1.0_f32, 1.0_f32),
            (7.0, 0.1),
            (1e20, 3e18),
            (0.0, 5.0),
            (5.0, 0.0),
        ] {
            let start = Resampling {
                weight_sum: before,
                ..Resampling::EMPTY
            };
            let mut taken = 0_u32;
            for number in 0..1_u32 << 23 {
                let mut stream = start;
                taken += u32::from(stream.candidate(weight, 1.0, number << 9));
            }
            let share = f64::from(weight) / (f64::from(before) + f64::from(weight));
            let expected = share * f64::from(1 << 23);
            assert!(
                (f64::from(taken) - expected).abs() <= 1.0,
                "{before} {weight}: {taken} {expected}"
            );
        }
    }

    /// Algorithm 3 over every combination of random numbers that matters: thresholds fall on the eighths that `random` steps
    /// through, so the mean over all combinations is the expectation itself, Σ f over the candidates' domain.
    #[test]
    fn candidates_estimate_the_sum_in_expectation() {
        // Four lights with pmf 1/4 each, two candidates; f and targets apart from each other, one target zero with its f.
        let targets = [1.0_f32, 3.0, 4.0, 0.0];
        let f = [2.0, 1.5, 8.0, 0.0];
        let (mut mean, mut combinations) = (0.0, 0.0);
        // The chance that the second is taken is its share. Counted by 840 = 3 · 5 · 7 · 8 steps, which all shares divide.
        let steps = 840_u32;
        for pair in 0..16_u32 {
            let lights = [pair % 4, pair / 4];
            for step in 0..steps {
                let random = ((u64::from(step) << 32).div_ceil(u64::from(steps)) + 512) as u32;
                let mut stream = Resampling::EMPTY;
                let mut taken = 0;
                for (light, random) in lights.into_iter().zip([0, random]) {
                    if stream.candidate(targets[light as usize], 0.25, random) {
                        taken = light;
                    }
                }
                assert_eq!(stream.count, 2);
                mean += f[taken as usize] * f64::from(stream.weight());
                combinations += 1.0;
            }
        }
        mean /= combinations;
        let sum: f64 = f.iter().sum();
        assert!((mean / sum - 1.0).abs() < 1e-6, "{mean} {sum}");
    }

    #[test]
    fn tiny_probabilities_count_as_the_least() {
        let mut stream = Resampling::EMPTY;
        assert!(stream.candidate(1.0, pow2(-45), 0));
        assert_eq!(stream.weight(), pow2(40));
    }

    /// At the corners of all ranges together, every number is zero or normal and finite, and within its range.
    #[test]
    fn no_corner_of_the_domain_leaves_it() {
        let targets = [0.0, 1e-38, 1e-30, MIN_TARGET, 1.0, MAX_TARGET, 1e30, f32::MAX].map(target);
        for pmf in [0.0, 1e-38, MIN_PMF, 0.3, 1.0] {
            for (t0, t1) in targets.iter().flat_map(|&a| targets.map(|b| (a, b))) {
                for random in [0, u32::MAX] {
                    let mut stream = Resampling::EMPTY;
                    for target in [t0, t1] {
                        let _ = stream.candidate(target, pmf, random);
                    }
                    let sum = stream.weight_sum;
                    assert!((sum == 0.0 || sum.is_normal()) && sum <= MAX_WEIGHT_SUM);
                    for count in [0, 1, 2, 1 << 24] {
                        let weight = Resampling { count, ..stream }.weight();
                        assert!(weight == 0.0 || (MIN_WEIGHT..=MAX_WEIGHT).contains(&weight));
                    }
                }
            }
        }
    }
}

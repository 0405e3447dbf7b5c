//! By how much a mean over the points of a scene changes.

use serde::Serialize;

/// A mean over another one of the same points, and between what it lies with 95 % where points are picked at random.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(super) struct MeanRatio {
    pub ratio: f64,
    pub low: f64,
    pub high: f64,
}

impl MeanRatio {
    /// Nothing changed.
    pub const ONE: Self = Self {
        ratio: 1.0,
        low: 1.0,
        high: 1.0,
    };

    /// The mean of `after` over that of `before`, which are of the same points. The interval is that of a ratio estimator (W.
    /// G. Cochran, "Sampling Techniques", 1977, section 6.3): what a few points have far above the others in both widens it
    /// little, what one model alone has there widens it much.
    pub fn of(before: &[f64], after: &[f64]) -> Self {
        let (old, new): (f64, f64) = (before.iter().sum(), after.iter().sum());
        if old == new {
            return Self::ONE;
        }
        if old == 0.0 {
            return Self {
                ratio: f64::INFINITY,
                low: f64::INFINITY,
                high: f64::INFINITY,
            };
        }
        let ratio = new / old;
        let left = before.iter().zip(after).map(|(a, b)| (b - ratio * a).powi(2));
        let count = before.len() as f64;
        let half = 1.96 * (left.sum::<f64>() * count / (count - 1.0).max(1.0)).sqrt() / old;
        Self {
            ratio,
            low: (ratio - half).max(0.0),
            high: ratio + half,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_both_share_widens_no_interval() {
        // One point has nearly all of the mean, in both.
        let before: Vec<f64> = (0..256).map(|k| if k == 7 { 1e6 } else { 1.0 }).collect();
        let after: Vec<f64> = before.iter().map(|v| 1.02 * v).collect();
        let both = MeanRatio::of(&before, &after);
        assert!((both.ratio - 1.02).abs() < 1e-9, "{both:?}");
        assert!(both.high - both.low < 1e-9, "{both:?}");
    }

    #[test]
    fn what_one_point_alone_has_is_not_known() {
        let before = [1.0; 256];
        let mut after = before;
        after[7] = 1.0 + 0.04 * 256.0;
        let alone = MeanRatio::of(&before, &after);
        assert!((alone.ratio - 1.04).abs() < 1e-9, "{alone:?}");
        // Of a mean over 256 points of which one differs by d, the standard error is d / 256.
        assert!((alone.high - (1.04 + 1.96 * 0.04)).abs() < 1e-3, "{alone:?}");
    }

    #[test]
    fn intervals_hold_the_truth_as_often_as_they_say() {
        let draw = |k: u32| f64::from(lightbvh::exact::hash(k) >> 8) / 16_777_216.0;
        let held = (0..2000_u32)
            .filter(|turn| {
                let before: Vec<f64> = (0..64).map(|k| 1.0 + draw(turn * 128 + k)).collect();
                let after: Vec<f64> = (0..64)
                    .map(|k| before[k as usize] * (0.6 + draw(turn * 128 + 64 + k)))
                    .collect();
                let found = MeanRatio::of(&before, &after);
                found.low <= 1.1 && 1.1 <= found.high
            })
            .count();
        // 95 % of 2000, less or more five standard deviations of their number, and what 64 points are too few for.
        assert!((1830..=1960).contains(&held), "{held}");
    }

    #[test]
    fn nothing_over_nothing_is_no_change() {
        assert_eq!(MeanRatio::of(&[0.0; 4], &[0.0; 4]), MeanRatio::ONE);
        assert_eq!(MeanRatio::of(&[], &[]), MeanRatio::ONE);
        assert_eq!(MeanRatio::of(&[0.0; 4], &[1.0; 4]).high, f64::INFINITY);
    }
}

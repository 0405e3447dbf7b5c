//! Medians of paired ratios, and how well they are known.

use std::fmt;

use serde::Serialize;

/// A median with its interval of 95 % confidence.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub(in crate::cli) struct Interval {
    pub median: f64,
    pub low: f64,
    pub high: f64,
}

impl fmt::Display for Interval {
    /// `1.25 [1.20, 1.31]`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { median, low, high } = self;
        write!(f, "{median:.2} [{low:.2}, {high:.2}]")
    }
}

impl Interval {
    /// Of `values`, one at least: the median, and the order statistics between which the true median lies with 95 % (binomial,
    /// by the normal approximation; the extremes where there are too few).
    pub fn of(mut values: Vec<f64>) -> Self {
        values.sort_by(f64::total_cmp);
        let count = values.len();
        let half = 0.98 * (count as f64).sqrt();
        let low = (count as f64 / 2.0 - half).floor().max(0.0) as usize;
        let middle = count / 2;
        Self {
            median: if count % 2 == 1 {
                values[middle]
            } else {
                0.5 * (values[middle - 1] + values[middle])
            },
            low: values[low],
            high: values[count - 1 - low],
        }
    }

    /// Of `a` over `b`, turn by turn; nothing over nothing is 1.
    pub fn of_ratios(a: &[f64], b: &[f64]) -> Self {
        let ratio = |(a, b): (&f64, &f64)| if a == b { 1.0 } else { a / b };
        Self::of(a.iter().zip(b).map(ratio).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_interval_holds_the_median() {
        let first = |count: u32| Interval::of((1..=count).map(f64::from).collect());
        assert_eq!(
            first(1),
            Interval {
                median: 1.0,
                low: 1.0,
                high: 1.0
            }
        );
        assert_eq!(first(4).median, 2.5);
        // Images without any error are no different.
        let ratio = Interval::of_ratios(&[0.0, 2.0, 0.0], &[0.0, 2.0, 0.0]);
        assert_eq!((ratio.low, ratio.median, ratio.high), (1.0, 1.0, 1.0));
        // Tables of the binomial distribution: the 6th and the 15th of 20 for 95.9 %.
        let twenty = first(20);
        assert_eq!((twenty.low, twenty.high), (6.0, 15.0));
    }
}

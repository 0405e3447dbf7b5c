//! A mean over independent runs and how well it is known.

use serde::Serialize;

/// A mean of independent measurements with its 95 % confidence interval.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Estimate {
    /// The mean.
    pub mean: f64,
    /// Half the width of the interval: the mean plus and minus this holds the true mean in 95 of 100 such runs, as far as
    /// the measurements are normal. Nothing for fewer than two measurements.
    pub ci95: Option<f64>,
    /// Number of measurements.
    pub count: usize,
}

/// The mean of `values`, 0 of none.
pub fn mean(values: &[f64]) -> f64 {
    match values.len() {
        // The empty sum of floats is -0.
        0 => 0.0,
        count => values.iter().sum::<f64>() / count as f64,
    }
}

/// The relative variance of one sample of lights that send `sent` to a point and have probabilities `pmfs` there: sum of
/// squares over probabilities, over the squared sum, less 1; `None` if nothing is sent.
pub fn variance(lights: impl Iterator<Item = (f64, f64)>) -> Option<f64> {
    let (mut mean, mut square) = (0.0, 0.0);
    for (sent, pmf) in lights.filter(|(sent, _)| *sent > 0.0) {
        mean += sent;
        square += sent * sent / pmf;
    }
    // Below zero by rounding only, where one light counts.
    (mean > 0.0).then(|| (square / (mean * mean) - 1.0).max(0.0))
}

impl Estimate {
    /// The mean of `values` by Student's t distribution; nothing for no values.
    pub fn of(values: &[f64]) -> Option<Self> {
        let count = values.len();
        if count == 0 {
            return None;
        }
        let mean = values.iter().sum::<f64>() / count as f64;
        let ci95 = (count > 1).then(|| {
            let squares: f64 = values.iter().map(|x| (x - mean).powi(2)).sum();
            let freedom = (count - 1) as f64;
            t_975(count - 1) * (squares / freedom / count as f64).sqrt()
        });
        Some(Self { mean, ci95, count })
    }
}

/// The 97.5 % quantile of Student's t distribution with `freedom` degrees of freedom, at least one, to four digits: by table
/// up to ten, then by the expansion around the normal quantile (Abramowitz and Stegun 1964, 26.7.5).
fn t_975(freedom: usize) -> f64 {
    const FIRST: [f64; 10] = [
        12.7062, 4.3027, 3.1824, 2.7764, 2.5706, 2.4469, 2.3646, 2.3060, 2.2622, 2.2281,
    ];
    if let Some(&quantile) = FIRST.get(freedom.saturating_sub(1)) {
        return quantile;
    }
    let z: f64 = 1.959_963_985;
    let n = freedom as f64;
    let (z3, z5, z7) = (z.powi(3), z.powi(5), z.powi(7));
    z + (z3 + z) / (4.0 * n)
        + (5.0 * z5 + 16.0 * z3 + 3.0 * z) / (96.0 * n * n)
        + (3.0 * z7 + 19.0 * z5 + 17.0 * z3 - 15.0 * z) / (384.0 * n * n * n)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_those_of_the_tables() {
        for (freedom, expected) in [
            (1, 12.706),
            (7, 2.365),
            (11, 2.201),
            (15, 2.131),
            (30, 2.042),
            (120, 1.980),
        ] {
            assert!(
                (t_975(freedom) - expected).abs() < 6e-4,
                "{freedom}: {}",
                t_975(freedom)
            );
        }
    }

    #[test]
    fn an_interval_by_hand() {
        // Mean 3, standard deviation sqrt(2.5), error of the mean sqrt(0.5), four degrees of freedom.
        let estimate = Estimate::of(&[1.0, 2.0, 3.0, 4.0, 5.0]).expect("five values");
        assert_eq!((estimate.mean, estimate.count), (3.0, 5));
        let width = estimate.ci95.expect("more than one value");
        assert!((width - 2.7764 * 0.5_f64.sqrt()).abs() < 1e-12);
        assert_eq!(Estimate::of(&[7.0]).expect("one value").ci95, None);
        assert_eq!(Estimate::of(&[]), None);
    }
}

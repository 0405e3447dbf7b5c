//! The decision.

use super::{Measured, TuneError};

/// What a point may cost. Samples of a point are taken as independent, so that n of them have 1/n of the variance; spread
/// numbers do better, most where there are many of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Budget {
    /// The least error in this time for a point, shadow rays included.
    Time {
        /// Nanoseconds.
        ns: f64,
    },
    /// The least time for this standard deviation.
    Error {
        /// The root of a relative variance as [`Measured::variance`] is.
        relative: f64,
    },
}

/// The best configuration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pick {
    /// Which of those measured.
    pub index: usize,
    /// Samples of a point, each with its shadow ray.
    pub samples: u64,
    /// What they take, ns.
    pub time_ns: f64,
    /// Their relative variance.
    pub variance: f64,
}

impl Budget {
    /// The best of `measured`: the first one where several are.
    ///
    /// # Errors
    /// [`TuneError`] for a budget that is not finite and above 0, no configurations, or a time that fits no sample.
    pub fn pick(&self, measured: &[Measured]) -> Result<Pick, TuneError> {
        let value = match *self {
            Self::Time { ns } => ns,
            Self::Error { relative } => relative,
        };
        if !(value.is_finite() && value > 0.0) {
            return Err(TuneError::Budget { value });
        }
        let mut best: Option<Pick> = None;
        let mut least_ns = f64::INFINITY;
        for (index, of) in measured.iter().enumerate() {
            least_ns = least_ns.min(of.time_ns);
            let samples = match *self {
                Self::Time { ns } => whole(ns / of.time_ns),
                Self::Error { relative } => {
                    let wanted = of.variance / (relative * relative);
                    let fewer = whole(wanted);
                    fewer.saturating_add(u64::from((fewer as f64) < wanted)).max(1)
                }
            };
            if samples == 0 {
                continue;
            }
            let pick = Pick {
                index,
                samples,
                time_ns: samples as f64 * of.time_ns,
                variance: of.variance / samples as f64,
            };
            let better = best.is_none_or(|best| match self {
                Self::Time { .. } => pick.variance < best.variance,
                Self::Error { .. } => pick.time_ns < best.time_ns,
            });
            if better {
                best = Some(pick);
            }
        }
        match best {
            Some(best) => Ok(best),
            None if measured.is_empty() => Err(TuneError::NoConfigurations),
            None => Err(TuneError::Time { least_ns }),
        }
    }
}

/// Rounded down, the greatest `u64` beyond it.
fn whole(value: f64) -> u64 {
    value as u64
}

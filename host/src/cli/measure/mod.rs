//! Measurements of all commands: turns, medians with their intervals, points, references.

pub(super) mod interval;
pub(super) mod points;
pub(super) mod reference;
pub(super) mod times;

pub(super) use crate::metrics::variances;

use crate::metrics::mean;

/// The mean; `None` of no values.
pub(super) fn mean_of(values: &[f64]) -> Option<f64> {
    (!values.is_empty()).then(|| mean(values))
}

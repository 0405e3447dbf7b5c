//! Options that are numbers: refused outside of their range, before any work is done.

use std::ops::RangeInclusive;

use crate::error::HostError;

/// Columns and rows of an image, at most.
pub(super) const MAX_SIDE: u64 = 16_384;

/// A number as it was given: its option and its range.
pub(super) struct Given {
    pub option: &'static str,
    pub value: u64,
    pub range: RangeInclusive<u64>,
}

/// `value` of `option`, which is to lie in `range`.
pub(super) fn given(option: &'static str, value: impl Into<u64>, range: RangeInclusive<u64>) -> Given {
    Given {
        option,
        value: value.into(),
        range,
    }
}

/// # Errors
/// [`HostError::Range`] of the first that lies outside of its range.
pub(super) fn check(numbers: &[Given]) -> Result<(), HostError> {
    match numbers.iter().find(|given| !given.range.contains(&given.value)) {
        None => Ok(()),
        Some(given) => Err(HostError::Range {
            option: given.option,
            value: given.value,
            expected: format!("{} to {}", given.range.start(), given.range.end()),
        }),
    }
}

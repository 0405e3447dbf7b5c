//! Why there is no pick.

use core::fmt;

use super::MAX_CANDIDATES;
use crate::point::PointError;

/// Why nothing is picked.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum TuneError {
    /// Nowhere to measure.
    NoPoints,
    /// A point outside the domain.
    Point {
        /// Its index.
        index: usize,
        /// What is wrong with it.
        source: PointError,
    },
    /// A time of a shadow ray that is negative or not finite.
    ShadowRay {
        /// The time, ns.
        ns: f64,
    },
    /// No candidates, or too many.
    Candidates {
        /// How many.
        candidates: u32,
    },
    /// Nothing to choose among.
    NoConfigurations,
    /// No light arrives at any point.
    Dark,
    /// A clock by which some thousand samples take no time.
    Clock,
    /// A budget that is not finite or not above zero.
    Budget {
        /// The time, ns, or the relative standard deviation.
        value: f64,
    },
    /// Not even one sample of the fastest configuration fits into the time.
    Time {
        /// What one takes, ns.
        least_ns: f64,
    },
}

impl fmt::Display for TuneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoPoints => write!(f, "there are no points to measure at; give some of an image"),
            Self::Point { index, source } => write!(f, "point {index}: {source}"),
            Self::ShadowRay { ns } => {
                write!(f, "a shadow ray takes a finite time of at least 0 ns, not {ns}")
            }
            Self::Candidates { candidates } => {
                write!(
                    f,
                    "a sample is one of 1 to {MAX_CANDIDATES} candidates, not {candidates}"
                )
            }
            Self::NoConfigurations => write!(f, "there is nothing to choose among; add a light BVH"),
            Self::Dark => write!(f, "no light arrives at any point; give points that are lit"),
            Self::Clock => write!(
                f,
                "by the clock some thousand samples take no time; give one that goes on by nanoseconds"
            ),
            Self::Budget { value } => write!(f, "a budget is finite and above 0, not {value}"),
            Self::Time { least_ns } => write!(
                f,
                "not one sample fits into the time: the fastest takes {least_ns:.0} ns with its shadow ray"
            ),
        }
    }
}

impl core::error::Error for TuneError {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        match self {
            Self::Point { source, .. } => Some(source),
            _ => None,
        }
    }
}

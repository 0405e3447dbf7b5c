//! Which choices nothing else beats.

use std::fmt;

use super::Point;
use super::choices::{Axis, Config};
use super::quantile::Interval;

/// Differences below this are none, however sure: of times, and of errors.
const LEAST: f64 = 1.03;

/// Surely below 1.
pub(super) fn less(ratio: Interval) -> bool {
    ratio.high * LEAST < 1.0
}

/// Surely above 1.
pub(super) fn more(ratio: Interval) -> bool {
    ratio.low > LEAST
}

/// The points that no other beats: another one beats a point if it surely takes less time for a frame of the same rays or surely has
/// less error in it, and does not surely have more of the other. What is sure lies beyond the interval of the ratios, seed by seed, so
/// that noise does not decide.
pub(super) fn front(points: &[Point]) -> Vec<bool> {
    let beats = |a: &Point, b: &Point| {
        let time = Interval::of_ratios(&a.images.frames, &b.images.frames);
        let error = Interval::of_ratios(&a.images.errors, &b.images.errors);
        (less(time) && !more(error)) || (less(error) && !more(time))
    };
    points
        .iter()
        .map(|point| !points.iter().any(|other| beats(other, point)))
        .collect()
}

impl fmt::Display for Config {
    /// What differs from the default.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let builder: &str = self.builder.name();
        match self.axis {
            Axis::Default => write!(f, "default"),
            Axis::Importance => write!(
                f,
                "{}, {} x {}, {builder}",
                self.importance, self.layout, self.width
            ),
            Axis::Layout => write!(f, "{} nodes, {}", self.layout, self.importance),
            Axis::Width => write!(f, "{} children", self.width),
            Axis::Builder => write!(f, "built by {builder}"),
            Axis::Levels => write!(f, "{}, {}", self.levels.name(), self.importance),
            Axis::Update => write!(f, "{}, {}", self.levels.name(), self.update.name()),
            Axis::Integrator => write!(
                f,
                "{}, {} of {}",
                self.integrator,
                self.candidates,
                self.levels.name()
            ),
            Axis::Candidates => write!(f, "1 of {} candidates", self.candidates),
        }
    }
}

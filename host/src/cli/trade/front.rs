//! Which choices nothing else beats.

use std::cmp::Ordering::{self, Equal, Greater, Less};
use std::fmt;

use super::Point;
use super::choices::{Axis, Config};
use super::quantile::Interval;

/// Errors by the same seeds are the same in every run; a ratio of them below this is no difference, however sure.
const LEAST_ERROR: f64 = 1.03;

/// A ratio of times below this is no difference. Medians of ratios, turn by turn, moved by a seventh at most from run to run on two
/// busy cores, so two measures must agree, and the interval must exclude what says the opposite.
const LEAST_TIME: f64 = 1.1;

/// The default, and the points that are others than it, as far as no other beats them: another one beats a point if it takes less time
/// for a frame of the same rays or has less error in it, and not more of the other. Less error is what lies beyond the interval of the
/// ratios, seed by seed. A point that differs from the default in neither is none: noise would put it on either side.
pub(super) fn front(points: &[Point]) -> Vec<bool> {
    let beats = |a: &Point, b: &Point| matches!(compared(a, b), (Less, Less | Equal) | (Equal, Less));
    let is_the_default = |point: &Point| {
        let other = points.iter().find(|other| other.default && !point.default);
        other.is_some_and(|default| alike(point, default))
    };
    points
        .iter()
        .map(|point| !is_the_default(point) && !points.iter().any(|other| beats(other, point)))
        .collect()
}

/// Whether neither time nor error tells them apart.
pub(super) fn alike(a: &Point, b: &Point) -> bool {
    compared(a, b) == (Equal, Equal)
}

/// Time and error of `a` against those of `b`. What interrupts a frame adds to its time: the least of the frames says the same as their
/// median where there is a difference.
fn compared(a: &Point, b: &Point) -> (Ordering, Ordering) {
    let time = Interval::of_ratios(&a.images.frames, &b.images.frames);
    let least = least(&a.images.frames) / least(&b.images.frames);
    let by_time = match (
        told(time.median, time.median, LEAST_TIME),
        told(least, least, LEAST_TIME),
    ) {
        (Less, Less) if time.high < 1.0 => Less,
        (Greater, Greater) if time.low > 1.0 => Greater,
        _ => Equal,
    };
    let error = Interval::of_ratios(&a.images.errors, &b.images.errors);
    (by_time, told(error.low, error.high, LEAST_ERROR))
}

fn least(times: &[f64]) -> f64 {
    times.iter().copied().fold(f64::INFINITY, f64::min)
}

/// What a ratio from `low` to `high` says.
fn told(low: f64, high: f64, least: f64) -> Ordering {
    if high * least < 1.0 {
        Less
    } else if low > least {
        Greater
    } else {
        Equal
    }
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
            Axis::Arithmetic => write!(f, "native operations"),
            Axis::Candidates => write!(f, "1 of {} candidates", self.candidates),
        }
    }
}

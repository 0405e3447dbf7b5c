//! Which choices nothing else beats.

use std::cmp::Ordering::{self, Equal, Greater, Less};
use std::fmt;

use super::Point;
use super::choices::{Axis, Config};
use super::quantile::Interval;

/// Errors by the same seeds are the same in every run; a ratio of them below this is no difference, however sure.
const LEAST_ERROR: f64 = 1.03;

/// A ratio of times of images below this is no difference. Medians of ratios, image by image, moved by a seventh at most from run to run
/// on two busy cores, so two measures must agree.
const LEAST_TIME: f64 = 1.1;

/// The same of updates, which are short.
const LEAST_UPDATE: f64 = 1.25;

/// The default, and the points that are others than it, as far as no other beats them: another one beats a point if its update takes less
/// time, or its image of the same rays, or that has less error, and it has not more of the others. An update and an image are not added:
/// they are paid on different processors, and an image has whatever size a user gives it. Less error is what lies beyond the interval of
/// the ratios, image by image. A point that differs from the default in none of them is none: noise would put it on either side.
pub(super) fn front(points: &[Point]) -> Vec<bool> {
    let is_the_default = |point: &Point| {
        let other = points.iter().find(|other| other.default && !point.default);
        other.is_some_and(|default| alike(point, default))
    };
    points
        .iter()
        .map(|point| !is_the_default(point) && !points.iter().any(|other| beats(other, point)))
        .collect()
}

fn beats(a: &Point, b: &Point) -> bool {
    let compared = compared(a, b);
    compared.contains(&Less) && !compared.contains(&Greater)
}

/// Whether neither times nor error tell them apart.
pub(super) fn alike(a: &Point, b: &Point) -> bool {
    compared(a, b) == [Equal; 3]
}

/// Update, time of an image and error of `a` against those of `b`. What interrupts an image adds to its time: the least of the times says
/// the same as the median of the ratios where there is a difference.
fn compared(a: &Point, b: &Point) -> [Ordering; 3] {
    let update = a.structure.update_ms / b.structure.update_ms;
    let median = Interval::of_ratios(&a.images.times, &b.images.times).median;
    let least = least(&a.images.times) / least(&b.images.times);
    let [median, least] = [median, least].map(|ratio| told(ratio, ratio, LEAST_TIME));
    let error = Interval::of_ratios(&a.images.errors, &b.images.errors);
    [
        told(update, update, LEAST_UPDATE),
        if median == least { median } else { Equal },
        told(error.low, error.high, LEAST_ERROR),
    ]
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

//! Which choices nothing else beats, and what each step along them buys.

use std::cmp::Ordering::{self, Equal, Greater, Less};
use std::fmt;

use super::Point;
use super::choices::{Axis, Config};
use super::quantile::Interval;

/// Errors by the same seeds are the same in every run; a ratio of them below this is no difference, however sure.
const LEAST_ERROR: f64 = 1.03;

/// A ratio of times below this is no difference. Medians of ratios, turn by turn, moved by a seventh at most from run to run on two
/// busy cores, where the ends of their intervals moved by half.
const LEAST_TIME: f64 = 1.1;

/// The front of one scene.
pub(super) struct Front {
    /// By point.
    pub pareto: Vec<bool>,
    /// One for each step, from the fastest on.
    pub sentences: Vec<String>,
}

/// The default, and the points that are others than it, as far as no other beats them: another one beats a point if it takes less time
/// for a frame of the same rays or has less error in it, and not more of the other. Less error is what lies beyond the interval of the
/// ratios, seed by seed. A point that differs from the default in neither is none: noise would put it on either side.
pub(super) fn fronts(points: &[Point]) -> Front {
    let beats = |a: &Point, b: &Point| matches!(compared(a, b), (Less, Less | Equal) | (Equal, Less));
    let is_the_default = |point: &Point| {
        let other = points.iter().find(|other| other.default && !point.default);
        other.is_some_and(|default| compared(point, default) == (Equal, Equal))
    };
    let pareto: Vec<bool> = points
        .iter()
        .map(|point| !is_the_default(point) && !points.iter().any(|other| beats(other, point)))
        .collect();
    let mut front: Vec<&Point> = points
        .iter()
        .zip(&pareto)
        .filter_map(|(point, &pareto)| pareto.then_some(point))
        .collect();
    front.sort_by(|a, b| {
        let (a, b) = (a.images.frame_ratio.median, b.images.frame_ratio.median);
        a.total_cmp(&b)
    });
    let sentences = front
        .windows(2)
        .map(|pair| {
            let [a, b] = [pair[0], pair[1]];
            let percent = |b: f64, a: f64| 100.0 * (b / a - 1.0);
            format!(
                "from {} to {}: {:+.0} % time of a frame, {:+.0} % error by the same rays, {:+.0} % at equal time",
                a.config,
                b.config,
                percent(b.images.frame_ratio.median, a.images.frame_ratio.median),
                percent(b.images.error, a.images.error),
                percent(b.images.error_equal_time, a.images.error_equal_time),
            )
        })
        .collect();
    Front { pareto, sentences }
}

/// Time and error of `a` against those of `b`.
fn compared(a: &Point, b: &Point) -> (Ordering, Ordering) {
    let time = Interval::of_ratios(&a.images.frames, &b.images.frames).median;
    let error = Interval::of_ratios(&a.images.errors, &b.images.errors);
    (
        told(time, time, LEAST_TIME),
        told(error.low, error.high, LEAST_ERROR),
    )
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
            Axis::Candidates => write!(f, "1 of {} candidates", self.candidates),
        }
    }
}

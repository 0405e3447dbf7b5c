//! Which choices nothing else beats, and what each step along them buys.

use std::fmt;

use super::Point;
use super::choices::{Axis, Config};
use super::quantile::Interval;

/// Differences below this are none, however sure: of times, and of errors.
const LEAST: f64 = 1.03;

/// The front of one scene.
pub(super) struct Front {
    /// By point.
    pub pareto: Vec<bool>,
    /// One for each step, from the fastest on.
    pub sentences: Vec<String>,
}

/// The points that no other beats: another one beats a point if it surely takes less time for a frame of the same rays or surely has
/// less error in it, and does not surely have more of the other. What is sure lies beyond the interval of the ratios, seed by seed, so
/// that noise does not decide.
pub(super) fn fronts(points: &[Point]) -> Front {
    let less = |interval: Interval| interval.high * LEAST < 1.0;
    let more = |interval: Interval| interval.low > LEAST;
    let beats = |a: &Point, b: &Point| {
        let time = Interval::of_ratios(&a.images.frames, &b.images.frames);
        let error = Interval::of_ratios(&a.images.errors, &b.images.errors);
        (less(time) && !more(error)) || (less(error) && !more(time))
    };
    let pareto: Vec<bool> = points
        .iter()
        .map(|point| !points.iter().any(|other| beats(other, point)))
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
            Axis::Arithmetic => write!(f, "native operations"),
            Axis::Candidates => write!(f, "1 of {} candidates", self.candidates),
        }
    }
}

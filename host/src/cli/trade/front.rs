//! Which choices nothing else beats, and what each step along them costs and buys, in words.

use serde::Serialize;

use super::image::Images;
use super::structure::Structure;
use super::subject::Config;
use crate::cli::measure::interval::Interval;

/// A ratio of errors below this is no difference, however sure, for a tree is good or bad luck for the lights of a scene: over
/// eight trees of a scene that was turned eight ways, the ratio of two choices had a standard deviation of 0.04 to 0.05
/// (`docs/trade.md`).
const LEAST_ERROR: f64 = 1.1;

/// Medians of errors this far apart may be a difference.
const SEEMING_ERROR: f64 = 1.05;

/// A ratio of times of images below this is no difference. Medians of ratios, image by image, moved by a seventh at most from
/// run to run on two busy cores, so two measures must agree, and the interval of the ratios must not hold 1.
const LEAST_TIME: f64 = 1.1;

/// The same of updates, which are short, and of their difference, ms: medians over the frames moved by so much from run to run.
const LEAST_UPDATE: f64 = 1.25;
const LEAST_UPDATE_MS: f64 = 0.02;

/// A configuration in a scene.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Point {
    pub scene: String,
    /// The difference from the default, in words.
    pub choice: String,
    pub config: Config,
    pub default: bool,
    #[serde(flatten)]
    pub structure: Structure,
    #[serde(flatten)]
    pub images: Images,
    /// Whether it is on the front: nothing else takes less time for an update or an image of the same rays, or has less error
    /// in it, at no greater cost of the others, and it differs from the default beyond the spread.
    pub pareto: bool,
}

/// The costs of a choice: the time of its update, and image by image the times and errors by the same rays.
struct Costs<'a>(f64, &'a [f64], &'a [f64]);

/// Marks the default, and the points that are others than it, as far as no other beats them: another one beats a point if its
/// update or its image of the same rays takes less time, or that image has less error, for sure, and it seems to have more of
/// none. They are not added: an image has whatever size a user gives it. A point that differs from the default in none of them
/// is none: noise would put it on either side. Returns sentences: the steps of the front from the fastest on, and the points as
/// good as the default.
pub(super) fn front(points: &mut [Point]) -> Vec<String> {
    let costs: Vec<Costs<'_>> = points.iter().map(Costs::of).collect();
    let default = points.iter().position(|point| point.default);
    let like: Vec<usize> = match default {
        Some(default) => (0..points.len())
            .filter(|&at| at != default && costs[at].alike(&costs[default]))
            .collect(),
        None => Vec::new(),
    };
    let is_on = |at: &usize| !like.contains(at) && !costs.iter().any(|other| other.beats(&costs[*at]));
    let mut front: Vec<usize> = (0..points.len()).filter(is_on).collect();
    for &at in &front {
        points[at].pareto = true;
    }
    let time = |point: &Point| point.images.frame_ratio.median;
    front.sort_by(|&a, &b| time(&points[a]).total_cmp(&time(&points[b])));
    let pairs = front.windows(2).map(|pair| (&points[pair[0]], &points[pair[1]]));
    let mut sentences: Vec<String> = pairs
        .map(|(a, b)| {
            format!(
                "from {} to {}: {:.2} times the frame time (update {:.2} ms, before {:.2}); {:.2} times the error by the same rays, \
                 {:.2} times at equal time",
                a.choice,
                b.choice,
                time(b) / time(a),
                b.structure.update_ms,
                a.structure.update_ms,
                b.images.error / a.images.error,
                b.images.error_equal_time / a.images.error_equal_time,
            )
        })
        .collect();
    if !like.is_empty() {
        let like: Vec<&str> = like.iter().map(|&at| points[at].choice.as_str()).collect();
        sentences.push(format!("no different from the default here: {}", like.join("; ")));
    }
    sentences
}

impl<'a> Costs<'a> {
    fn of(point: &'a Point) -> Self {
        Self(
            point.structure.update_ms,
            &point.images.times,
            &point.images.errors,
        )
    }

    fn beats(&self, other: &Self) -> bool {
        self.less(other).iter().any(|less| less.0) && !other.less(self).iter().any(|less| less.1)
    }

    fn alike(&self, other: &Self) -> bool {
        let surely = |a: &Self, b: &Self| a.less(b).iter().any(|less| less.0);
        !surely(self, other) && !surely(other, self)
    }

    /// Whether one surely, and whether it seemingly, has less than another: of an update, of the time of an image, of its error.
    /// An interruption adds to the time of an image: the least of the times says the same as the median of the ratios where
    /// there is a difference. Less error for sure lies beyond the interval of the ratios.
    fn less(&self, other: &Self) -> [(bool, bool); 3] {
        let update = (self.0 * LEAST_UPDATE).max(self.0 + LEAST_UPDATE_MS) < other.0;
        let ratio = Interval::of_ratios(self.1, other.1);
        let median = ratio.median * LEAST_TIME < 1.0;
        let of = |times: &[f64]| times.iter().copied().fold(f64::INFINITY, f64::min);
        let least = of(self.1) * LEAST_TIME < of(other.1);
        let error = Interval::of_ratios(self.2, other.2);
        [
            (update, update),
            (median && least && ratio.high < 1.0, median || least),
            (error.high * LEAST_ERROR < 1.0, error.median * SEEMING_ERROR < 1.0),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SAME: [f64; 3] = [10.0, 12.0, 11.0];

    #[test]
    fn less_of_one_beats_where_there_is_no_more_of_another() {
        let usual = Costs(1.0, &SAME, &SAME);
        for better in [
            Costs(0.5, &SAME, &SAME),
            Costs(1.0, &[8.0, 9.0, 8.5], &SAME),
            Costs(1.0, &SAME, &[7.0, 8.0, 7.5]),
        ] {
            assert!(better.beats(&usual) && !usual.beats(&better) && !usual.alike(&better));
        }
        // One has less of something and more of another.
        for other in [
            Costs(0.5, &SAME, &[11.0, 13.0, 12.0]),
            Costs(2.0, &SAME, &[7.0, 8.0, 7.5]),
            Costs(1.0, &[8.0, 9.0, 8.5], &[20.0, 21.0, 20.0]),
        ] {
            assert!(!other.beats(&usual) && !usual.beats(&other) && !usual.alike(&other));
        }
    }

    #[test]
    fn noise_beats_nothing() {
        let usual = Costs(1.0, &SAME, &SAME);
        assert!(Costs(0.05, &SAME, &SAME).alike(&Costs(0.065, &SAME, &SAME)));
        // One interrupted image, one lucky image, an update a little faster, times that a busy machine scattered.
        for other in [
            Costs(1.0, &[6.0, 20.0, 8.0], &SAME),
            Costs(1.0, &[10.0, 50.0, 11.0], &SAME),
            Costs(1.0, &SAME, &[4.0, 12.1, 11.1]),
            Costs(0.85, &[9.5, 12.0, 10.5], &[10.1, 11.9, 11.0]),
        ] {
            assert!(usual.alike(&other) && other.alike(&usual));
            assert!(!usual.beats(&other) && !other.beats(&usual));
        }
        // Less for sure, and seemingly more: it may be a trade.
        let unsure = Costs(0.1, &SAME, &[9.0, 20.0, 22.0]);
        assert!(!unsure.beats(&usual) && !unsure.alike(&usual));
    }
}

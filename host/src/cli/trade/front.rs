//! Which choices nothing else beats.

use super::point::Point;
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

/// The default, and the points that are others than it, as far as no other beats them: another one beats a point if its update
/// or its image of the same rays takes less time, or that image has less error, for sure, and it seems to have more of none.
/// They are not added: an image has whatever size a user gives it. A point that differs from the default in none of them is
/// none: noise would put it on either side.
pub(super) fn front(points: &[Point]) -> Vec<bool> {
    let costs: Vec<Costs<'_>> = points.iter().map(Costs::of).collect();
    let default = points.iter().position(|point| point.default);
    let is_the_default =
        |at: usize| default.is_some_and(|default| at != default && costs[at].alike(&costs[default]));
    (0..points.len())
        .map(|at| !is_the_default(at) && !costs.iter().any(|other| other.beats(&costs[at])))
        .collect()
}

/// Whether neither times nor error tell them apart.
pub(super) fn alike(a: &Point, b: &Point) -> bool {
    Costs::of(a).alike(&Costs::of(b))
}

/// What a choice costs.
struct Costs<'a> {
    update_ms: f64,
    /// Image by image, by the same rays.
    times: &'a [f64],
    errors: &'a [f64],
}

/// Whether one has less of something than another.
#[derive(Clone, Copy, PartialEq)]
struct Less {
    surely: bool,
    seemingly: bool,
}

impl<'a> Costs<'a> {
    fn of(point: &'a Point) -> Self {
        Self {
            update_ms: point.structure.update_ms,
            times: &point.images.times,
            errors: &point.images.errors,
        }
    }

    fn beats(&self, other: &Self) -> bool {
        self.less(other).iter().any(|less| less.surely) && !other.less(self).iter().any(|less| less.seemingly)
    }

    fn alike(&self, other: &Self) -> bool {
        let surely = |a: &Self, b: &Self| a.less(b).iter().any(|less| less.surely);
        !surely(self, other) && !surely(other, self)
    }

    /// Of an update, of the time of an image, of its error. What interrupts an image adds to its
    /// time: the least of the times says the same as the median of the ratios where there is a difference. Less error for sure
    /// is what lies beyond the interval of the ratios.
    fn less(&self, other: &Self) -> [Less; 3] {
        let update = (self.update_ms * LEAST_UPDATE).max(self.update_ms + LEAST_UPDATE_MS) < other.update_ms;
        let ratio = Interval::of_ratios(self.times, other.times);
        let median = ratio.median * LEAST_TIME < 1.0;
        let least = least(self.times) * LEAST_TIME < least(other.times);
        let error = Interval::of_ratios(self.errors, other.errors);
        [
            Less {
                surely: update,
                seemingly: update,
            },
            Less {
                surely: median && least && ratio.high < 1.0,
                seemingly: median || least,
            },
            Less {
                surely: error.high * LEAST_ERROR < 1.0,
                seemingly: error.median * SEEMING_ERROR < 1.0,
            },
        ]
    }
}

fn least(times: &[f64]) -> f64 {
    times.iter().copied().fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SAME: [f64; 3] = [10.0, 12.0, 11.0];

    fn costs<'a>(update_ms: f64, times: &'a [f64; 3], errors: &'a [f64; 3]) -> Costs<'a> {
        Costs {
            update_ms,
            times,
            errors,
        }
    }

    #[test]
    fn less_of_one_beats_where_there_is_no_more_of_another() {
        let usual = costs(1.0, &SAME, &SAME);
        for better in [
            costs(0.5, &SAME, &SAME),
            costs(1.0, &[8.0, 9.0, 8.5], &SAME),
            costs(1.0, &SAME, &[7.0, 8.0, 7.5]),
        ] {
            assert!(better.beats(&usual) && !usual.beats(&better) && !usual.alike(&better));
        }
        // What one has less of is paid with another.
        for other in [
            costs(0.5, &SAME, &[11.0, 13.0, 12.0]),
            costs(2.0, &SAME, &[7.0, 8.0, 7.5]),
            costs(1.0, &[8.0, 9.0, 8.5], &[20.0, 21.0, 20.0]),
        ] {
            assert!(!other.beats(&usual) && !usual.beats(&other) && !usual.alike(&other));
        }
    }

    #[test]
    fn noise_beats_nothing() {
        let usual = costs(1.0, &SAME, &SAME);
        let short = [0.05, 0.065].map(|update| costs(update, &SAME, &SAME));
        assert!(short[0].alike(&short[1]));
        // One interrupted image, one lucky image, an update a little faster, times that a busy machine scattered.
        for other in [
            costs(1.0, &[6.0, 20.0, 8.0], &SAME),
            costs(1.0, &[10.0, 50.0, 11.0], &SAME),
            costs(1.0, &SAME, &[4.0, 12.1, 11.1]),
            costs(0.85, &[9.5, 12.0, 10.5], &[10.1, 11.9, 11.0]),
        ] {
            assert!(usual.alike(&other) && other.alike(&usual));
            assert!(!usual.beats(&other) && !other.beats(&usual));
        }
        // Less for sure, and seemingly more: it may be a trade.
        let unsure = costs(0.1, &SAME, &[9.0, 20.0, 22.0]);
        assert!(!unsure.beats(&usual) && !unsure.alike(&usual));
    }
}

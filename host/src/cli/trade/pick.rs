//! The best choice within a budget, from the measured table.

use serde::Serialize;

use super::front::Point;
use super::subject::Config;
use crate::cli::measure::interval::Interval;

/// Squared steps of a byte below which the reference cannot tell errors apart.
const LEAST_ERROR: f64 = 1e-3;

/// Most shadow rays of a pixel: times and errors are not extrapolated further.
const MOST_IMAGES: f64 = 256.0;

/// A gain below this is none.
const LEAST_GAIN: f64 = 1.05;

/// A budget.
#[derive(Clone, Copy, Debug)]
pub(super) enum Goal {
    /// Least error in a frame of this time, ms.
    Time(f64),
    /// Least time of a frame whose root mean squared error, as displayed, is this share of white.
    Error(f64),
}

/// A choice brought to the budget.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Reached {
    pub config: Config,
    /// Update and image.
    pub frame_ms: f64,
    /// Root mean squared error as displayed, as a share of white.
    pub error: f64,
    /// Shadow rays of a pixel: a whole number in each image, between which this lies.
    pub samples: f64,
}

/// The best of a scene.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Pick {
    pub scene: String,
    #[serde(flatten)]
    pub best: Reached,
    /// The default within the same budget, where it keeps it.
    pub of_default: Option<Reached>,
    /// Where both keep it: the pick's error in a frame of that time, or its frame's time to that error, over the default's.
    pub margin: Option<Interval>,
    /// How many others keep the budget.
    pub others: usize,
    pub sentence: String,
}

impl Goal {
    /// Time, error and rays of a choice whose update takes `update_ms` and a ray of all pixels `ray_ms`, with a squared error
    /// of `of_one` by one ray of a pixel; where it does not keep the budget, the least time of a frame, or the least error.
    /// Times grow with the rays, squared errors fall by them.
    fn reached(self, update_ms: f64, ray_ms: f64, of_one: f64) -> Result<[f64; 3], f64> {
        let error = |rays: f64| (of_one / rays).sqrt() / 255.0;
        let frame = |rays: f64| update_ms + rays * ray_ms;
        match self {
            Self::Time(frame_ms) => match ((frame_ms - update_ms) / ray_ms).min(MOST_IMAGES) {
                rays if rays < 1.0 => Err(frame(1.0)),
                // Divided and multiplied again, a budget may come out one rounding above itself.
                rays => Ok([frame(rays).min(frame_ms), error(rays), rays]),
            },
            Self::Error(wanted) => match of_one / (255.0 * wanted).powi(2) {
                rays if rays > MOST_IMAGES => Err(error(MOST_IMAGES)),
                rays if rays < 1.0 => Ok([frame(1.0), error(1.0), 1.0]),
                rays => Ok([frame(rays), wanted, rays]),
            },
        }
    }

    /// The figure to minimise, image by image.
    fn figures(self, point: &Point) -> Vec<f64> {
        let update_ms = point.structure.update_ms;
        let pairs = point.images.times.iter().zip(&point.images.errors);
        let of = |(&image_ms, &error): (&f64, &f64)| {
            let product = image_ms * error.max(LEAST_ERROR);
            match self {
                Self::Time(frame_ms) => (product / (frame_ms - update_ms).max(f64::MIN_POSITIVE)).sqrt(),
                Self::Error(wanted) => update_ms + product / (255.0 * wanted).powi(2),
            }
        };
        pairs.map(of).collect()
    }

    /// The best of the points of a scene, whose images were measured by `samples` shadow rays of a pixel: the default unless
    /// another is better for sure. Where none keeps the budget, why.
    pub fn pick(self, points: &[Point], samples: u32) -> Result<Pick, String> {
        let (mut kept, mut nearest) = (Vec::new(), f64::INFINITY);
        for point in points {
            let (samples, images) = (f64::from(samples), &point.images);
            let of_one = images.error.max(LEAST_ERROR) * samples;
            match self.reached(point.structure.update_ms, images.image_ms / samples, of_one) {
                Err(least) => nearest = nearest.min(least),
                Ok([frame_ms, error, samples]) => kept.push((
                    point,
                    Reached {
                        config: point.config,
                        frame_ms,
                        error,
                        samples,
                    },
                )),
            }
        }
        let default = kept.iter().find(|(point, _)| point.default);
        let better = default.and_then(|(own, _)| {
            let base = self.figures(own);
            let ratio = |point: &Point| Interval::of_ratios(&self.figures(point), &base);
            kept.iter()
                .map(|(point, reached)| (reached, ratio(point)))
                .filter(|(_, ratio)| ratio.high < 1.0 && ratio.median * LEAST_GAIN < 1.0)
                .min_by(|(_, a), (_, b)| a.median.total_cmp(&b.median))
        });
        let estimate = |own: &Reached| match self {
            Self::Time(_) => own.error,
            Self::Error(_) => own.frame_ms,
        };
        let all = kept.iter().map(|(_, reached)| reached);
        let best = match (better, default) {
            (Some((reached, _)), _) => Some(reached),
            (None, Some((_, own))) => Some(own),
            (None, None) => all.min_by(|a, b| estimate(a).total_cmp(&estimate(b))),
        };
        let Some(best) = best else {
            let why = match self {
                Self::Time(_) => {
                    format!("the fastest takes {nearest:.2} ms for an image of one shadow ray a pixel")
                }
                Self::Error(_) => {
                    format!("the least error by {MOST_IMAGES} shadow rays of a pixel is {nearest:.4}")
                }
            };
            return Err(format!("no choice keeps this budget: {why}"));
        };
        let (margin, others) = (better.map(|(_, ratio)| ratio), kept.len() - 1);
        let what = match self {
            Self::Time(time) => format!("least error in a frame of {time} ms"),
            Self::Error(error) => format!("least time of a frame of error {error}"),
        };
        let to_default = match (default, margin) {
            (_, Some(ratio)) => format!("{ratio} of the default's"),
            (Some(_), None) => "nothing else is surely better".to_owned(),
            (None, _) => "the default does not keep it".to_owned(),
        };
        Ok(Pick {
            scene: points[0].scene.clone(),
            sentence: format!(
                "{}: {what}, {to_default}: error {:.4}, {:.2} ms by {:.1} shadow rays of a pixel; {others} others keep it",
                best.config, best.error, best.frame_ms, best.samples
            ),
            best: best.clone(),
            of_default: default.map(|(_, own)| own.clone()),
            margin,
            others,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 4 ms for a ray and 2 ms for an update, 1200 squared steps by one ray.
    fn usual(goal: Goal) -> Result<[f64; 3], f64> {
        goal.reached(2.0, 4.0, 1200.0)
    }

    fn steps(squared: f64) -> f64 {
        squared.sqrt() / 255.0
    }

    #[test]
    fn frame_holds_rays_that_fit() {
        let [_, error, samples] = usual(Goal::Time(20.0)).expect("4.5 rays");
        assert!((samples - 4.5).abs() < 1e-9 && (error / steps(1200.0 / 4.5) - 1.0).abs() < 1e-9);
        assert_eq!(usual(Goal::Time(5.9)), Err(6.0), "an update and one ray");
        let [frame_ms, _, samples] = usual(Goal::Time(1e9)).expect("more than are tried");
        assert_eq!((samples, frame_ms), (256.0, 2.0 + 256.0 * 4.0));
        for k in 0..1000 {
            let budget = 1.0 + 0.07 * f64::from(k);
            let found = Goal::Time(budget)
                .reached(0.1, 0.3, 1200.0)
                .expect("several rays");
            assert!(found[0] <= budget, "{budget} {found:?}");
        }
    }

    #[test]
    fn error_takes_rays_by_its_square() {
        let [frame_ms, _, samples] = usual(Goal::Error(steps(40.0))).expect("30 rays");
        assert!((samples - 30.0).abs() < 1e-6 && (frame_ms - 122.0).abs() < 1e-5);
        // One image is the least; its own error is reported.
        let [_, error, samples] = usual(Goal::Error(1.0)).expect("one image");
        assert_eq!((samples, error), (1.0, steps(1200.0)));
        let beyond = usual(Goal::Error(steps(4.0))).expect_err("300 rays");
        assert!((beyond - steps(1200.0 / 256.0)).abs() < 1e-12);
    }
}

//! The best choice within a budget, from the measured table.

use serde::Serialize;

use super::point::Point;
use super::subject::Config;
use crate::cli::measure::interval::Interval;

/// Squared steps of a byte below which the reference cannot tell errors apart.
const LEAST_ERROR: f64 = 1e-3;

/// Most shadow rays of a pixel: times and errors are not extrapolated further.
const MOST_IMAGES: f64 = 256.0;

/// A gain below this is none.
const LEAST_GAIN: f64 = 1.05;

/// What is asked for.
#[derive(Clone, Copy, Debug)]
pub(super) enum Goal {
    /// Least error in a frame of this time, ms.
    Time(f64),
    /// Least time of a frame whose root mean squared error, as displayed, is this share of white.
    Error(f64),
}

/// What a choice costs: the time of an image grows with its shadow rays of a pixel, its squared error falls by them.
#[derive(Clone, Copy)]
struct Costs {
    update_ms: f64,
    /// Of one shadow ray of all pixels.
    ray_ms: f64,
    /// Squared error by one shadow ray of a pixel.
    of_one: f64,
}

impl Costs {
    /// Of a point whose images have `samples` shadow rays of a pixel.
    fn of(point: &Point, samples: u32) -> Self {
        Self {
            update_ms: point.structure.update_ms,
            ray_ms: point.images.image_ms / f64::from(samples),
            of_one: point.images.error.max(LEAST_ERROR) * f64::from(samples),
        }
    }
}

/// A choice brought to the budget.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Reached {
    pub config: Config,
    #[serde(flatten)]
    pub found: Found,
}

/// What a budget comes to.
#[derive(Clone, Copy, Debug, Serialize)]
pub(super) struct Found {
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
    /// What the default does within the same budget, where it keeps it.
    pub of_default: Option<Reached>,
    /// Where both keep it: the pick's error in a frame of that time, or its frame's time to that error, over the default's.
    pub margin: Option<Interval>,
    /// How many others keep the budget.
    pub others: usize,
    pub sentence: String,
}

impl Goal {
    /// What a choice comes to; where it does not keep the budget, the least time of a frame, or the least error.
    fn reached(self, costs: &Costs) -> Result<Found, f64> {
        let Costs {
            update_ms,
            ray_ms,
            of_one,
        } = *costs;
        let error = |rays: f64| (of_one / rays).sqrt() / 255.0;
        let found = |rays: f64, error| Found {
            frame_ms: update_ms + rays * ray_ms,
            error,
            samples: rays,
        };
        match self {
            Self::Time(frame_ms) => {
                let rays = ((frame_ms - update_ms) / ray_ms).min(MOST_IMAGES);
                if rays < 1.0 {
                    return Err(update_ms + ray_ms);
                }
                let own = found(rays, error(rays));
                // Divided and multiplied again, a budget may come out one rounding above itself.
                Ok(Found {
                    frame_ms: own.frame_ms.min(frame_ms),
                    ..own
                })
            }
            Self::Error(wanted) => match of_one / (255.0 * wanted).powi(2) {
                rays if rays > MOST_IMAGES => Err(error(MOST_IMAGES)),
                rays if rays < 1.0 => Ok(found(1.0, error(1.0))),
                rays => Ok(found(rays, wanted)),
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
        let of_point = |point: &Point| {
            let found = self.reached(&Costs::of(point, samples))?;
            let config = point.config;
            Ok(Reached { config, found })
        };
        let reached: Vec<Result<Reached, f64>> = points.iter().map(of_point).collect();
        let kept = || (0..points.len()).filter_map(|at| Some((at, reached[at].as_ref().ok()?)));
        let default = kept().find(|&(at, _)| points[at].default);
        let (best, margin) = match default {
            Some((at, own)) => {
                let base = self.figures(&points[at]);
                let better = kept()
                    .map(|(k, other)| (other, Interval::of_ratios(&self.figures(&points[k]), &base)))
                    .filter(|(_, ratio)| ratio.high < 1.0 && ratio.median * LEAST_GAIN < 1.0)
                    .min_by(|(_, a), (_, b)| a.median.total_cmp(&b.median));
                better.map_or((own, None), |(other, ratio)| (other, Some(ratio)))
            }
            None => {
                let estimate = |own: &Reached| match self {
                    Self::Time(_) => own.found.error,
                    Self::Error(_) => own.found.frame_ms,
                };
                let best = kept().min_by(|(_, a), (_, b)| estimate(a).total_cmp(&estimate(b)));
                let Some((_, best)) = best else {
                    let nearest = reached.iter().filter_map(|own| own.as_ref().err());
                    return Err(self.none(nearest.copied().fold(f64::INFINITY, f64::min)));
                };
                (best, None)
            }
        };
        let (others, of_default) = (kept().count() - 1, default.map(|(_, own)| own.clone()));
        Ok(Pick {
            scene: points[0].scene.clone(),
            sentence: self.sentence(best, of_default.as_ref(), margin, others),
            best: best.clone(),
            of_default,
            margin,
            others,
        })
    }

    /// Why nothing is picked: `nearest` is the fastest frame there is, ms, or the least error.
    fn none(self, nearest: f64) -> String {
        match self {
            Self::Time(_) => format!(
                "no choice keeps this budget: the fastest takes {nearest:.2} ms for an image of one shadow ray a pixel"
            ),
            Self::Error(_) => {
                format!(
                    "no choice keeps this budget: the least error by {MOST_IMAGES} shadow rays of a pixel is {nearest:.4}"
                )
            }
        }
    }

    fn sentence(
        self,
        best: &Reached,
        default: Option<&Reached>,
        margin: Option<Interval>,
        others: usize,
    ) -> String {
        let what = match self {
            Self::Time(time) => format!("least error in a frame of {time} ms"),
            Self::Error(error) => format!("least time of a frame of error {error}"),
        };
        let to_default = match (default, margin) {
            (_, Some(ratio)) => format!("{ratio} of the default's"),
            (Some(_), None) => "nothing else is surely better".to_owned(),
            (None, _) => "the default does not keep it".to_owned(),
        };
        format!(
            "{}: {what}, {to_default}: error {:.4}, {:.2} ms by {:.1} shadow rays of a pixel; {others} others keep it",
            best.config, best.found.error, best.found.frame_ms, best.found.samples
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 4 ms for a ray and 2 ms for an update, 1200 squared steps by one ray.
    const USUAL: Costs = Costs {
        update_ms: 2.0,
        ray_ms: 4.0,
        of_one: 1200.0,
    };

    fn steps(squared: f64) -> f64 {
        squared.sqrt() / 255.0
    }

    #[test]
    fn frame_holds_rays_that_fit() {
        let found = Goal::Time(20.0).reached(&USUAL).expect("4.5 rays");
        assert!((found.samples - 4.5).abs() < 1e-9 && (found.error / steps(1200.0 / 4.5) - 1.0).abs() < 1e-9);
        let too_little = Goal::Time(5.9).reached(&USUAL);
        assert_eq!(too_little.err(), Some(6.0), "an update and one ray");
        let most = Goal::Time(1e9).reached(&USUAL).expect("more than are tried");
        assert_eq!((most.samples, most.frame_ms), (256.0, 2.0 + 256.0 * 4.0));
        let odd = Costs {
            update_ms: 0.1,
            ray_ms: 0.3,
            ..USUAL
        };
        for k in 0..1000 {
            let budget = 1.0 + 0.07 * f64::from(k);
            let found = Goal::Time(budget).reached(&odd).expect("several rays");
            assert!(found.frame_ms <= budget, "{budget} {found:?}");
        }
    }

    #[test]
    fn error_takes_rays_by_its_square() {
        let found = Goal::Error(steps(40.0)).reached(&USUAL).expect("30 rays");
        assert!((found.samples - 30.0).abs() < 1e-6 && (found.frame_ms - 122.0).abs() < 1e-5);
        // One image is the least; its own error is reported.
        let one = Goal::Error(1.0).reached(&USUAL).expect("one image");
        assert_eq!((one.samples, one.error), (1.0, steps(1200.0)));
        let beyond = Goal::Error(steps(4.0)).reached(&USUAL).expect_err("300 rays");
        assert!((beyond - steps(1200.0 / 256.0)).abs() < 1e-12);
    }
}

//! The best configuration within a budget, by a short run over few seeds: images of the real renderer at the scene's own shading points.

use std::fmt;

use serde::Serialize;
use serde_json::json;

use super::Args;
use super::choices::{Config, Subject};
use super::image::{Budget, Reference, average};
use super::prepare::{Prepared, prepare};
use super::update::Updates;
use crate::backend::SceneArrays;
use crate::cli::times::ms;
use crate::cli::{Context, Outcome, table};
use crate::error::HostError;

/// Rounds in which time and error of an image by equal rays are measured.
const SEEDS: u32 = 4;

/// What is asked for.
#[derive(Clone, Copy, Debug)]
pub(super) enum Goal {
    /// Least error in a frame of so many milliseconds.
    Time(f64),
    /// Least time of a frame whose root mean squared error, as displayed, is this share of white.
    Error(f64),
}

/// A configuration brought to the budget.
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
    /// What the default does within the same budget, where it keeps it.
    pub of_default: Option<Reached>,
    /// How many others keep the budget.
    pub others: usize,
    pub sentence: String,
}

/// What is measured of one configuration by equal rays.
struct Measured {
    update_ms: f64,
    /// Of one least image.
    least_ms: f64,
    /// Mean squared, of a number of least images.
    error: f64,
    count: u32,
}

/// The best of each scene within a budget.
pub(super) fn picks(
    context: &Context,
    args: &Args,
    scenes: &[String],
    budget: &Budget,
    goal: Goal,
) -> Result<Outcome, HostError> {
    let mut picks: Vec<Option<Pick>> = Vec::new();
    for name in scenes {
        let mut prepared = prepare(name, args, budget, &[args.frame], &mut |_, _, _, _| Ok(()))?;
        let updates_ms: Vec<f64> = prepared.updates.iter().map(Updates::mean_ms).collect();
        let Prepared {
            subjects,
            arrays,
            background,
            ..
        } = &mut prepared;
        let picked = pick(name, subjects, &updates_ms, arrays, *background, budget, goal)?;
        if !context.json {
            match &picked {
                Some(picked) => println!("{picked}"),
                None => println!("{name}: no configuration keeps this budget; give it more"),
            }
        }
        picks.push(picked);
    }
    if context.json {
        table::print_json(&json!({
            "frame": args.frame, "width": budget.width, "height": budget.height,
            "threads": rayon::current_num_threads(), "pick": picks,
        }))?;
    }
    Ok(Outcome::Good)
}

/// The best of `subjects`, the default first; nothing where no configuration keeps the budget.
fn pick(
    scene: &str,
    subjects: &mut [Box<dyn Subject>],
    updates_ms: &[f64],
    arrays: &SceneArrays,
    background: [f32; 3],
    budget: &Budget,
    goal: Goal,
) -> Result<Option<Pick>, HostError> {
    let params = |samples, seed| budget.params(samples, seed, background);
    let reference = Reference::of(subjects, arrays, budget, params)?;
    let mut times = vec![f64::INFINITY; subjects.len()];
    let mut errors = vec![Vec::new(); subjects.len()];
    for seed in 0..SEEDS {
        for k in 0..subjects.len() {
            let at = (k + 3 * seed as usize) % subjects.len();
            let image = subjects[at].render(arrays, params(budget.samples, seed))?;
            times[at] = times[at].min(ms(image.time));
            errors[at].push(reference.error(&budget.film(image.value)?));
        }
    }
    let mut reached = Vec::new();
    for (k, subject) in subjects.iter_mut().enumerate() {
        let count = (budget.samples / subject.least_rays()).max(1);
        let measured = Measured {
            update_ms: updates_ms[k],
            least_ms: times[k] / f64::from(count),
            error: average(&errors[k]).max(LEAST_ERROR),
            count,
        };
        let mut error_of = |images: u32| -> Result<f64, HostError> {
            let rays = images * subject.least_rays();
            let mut found = Vec::new();
            for seed in SEEDS..2 * SEEDS {
                let image = subject.render(arrays, params(rays, seed))?;
                found.push(reference.error(&budget.film(image.value)?));
            }
            Ok(average(&found).max(LEAST_ERROR))
        };
        let found = match goal {
            Goal::Time(frame_ms) => measured.within(frame_ms, &mut error_of)?,
            Goal::Error(error) => measured.until(error, &mut error_of)?,
        };
        reached.push(found.map(|(images, frame_ms, error)| Reached {
            config: subject.config(),
            frame_ms,
            error,
            samples: images * f64::from(subject.least_rays()),
        }));
    }
    let of_default = reached.first().cloned().flatten();
    let others = reached.iter().flatten().count().saturating_sub(1);
    let by = |reached: &Reached| match goal {
        Goal::Time(_) => reached.error,
        Goal::Error(_) => reached.frame_ms,
    };
    let best = reached
        .into_iter()
        .flatten()
        .min_by(|a, b| by(a).total_cmp(&by(b)));
    Ok(best.map(|best| Pick {
        scene: scene.to_owned(),
        sentence: sentence(&best, of_default.as_ref(), others, goal),
        best,
        of_default,
        others,
    }))
}

/// Squared steps of a byte below which the reference cannot tell errors apart.
const LEAST_ERROR: f64 = 1e-3;

/// Most least images that are tried, beyond which a budget of error is not kept.
const MOST_IMAGES: f64 = 256.0;

impl Measured {
    /// Number of least images that fit into `frame_ms`, the frame, and the error by them as a share of white.
    fn within(
        &self,
        frame_ms: f64,
        error_of: &mut dyn FnMut(u32) -> Result<f64, HostError>,
    ) -> Result<Option<(f64, f64, f64)>, HostError> {
        let fits = ((frame_ms - self.update_ms) / self.least_ms).min(MOST_IMAGES);
        if fits < 1.0 {
            return Ok(None);
        }
        // Errors fall by powers of the samples between them.
        let fewer = fits.floor() as u32;
        let share = (fits / f64::from(fewer)).ln() / (f64::from(fewer + 1) / f64::from(fewer)).ln();
        let [a, b] = [error_of(fewer)?, error_of(fewer + 1)?];
        let frame = self.update_ms + fits * self.least_ms;
        Ok(Some((fits, frame, of_white(a * (b / a).powf(share)))))
    }

    /// Number of least images to the `error`, the frame by them, and the error. Errors are taken as a power of the number of images:
    /// the one between what is measured and an image by about as many as are needed.
    fn until(
        &self,
        error: f64,
        error_of: &mut dyn FnMut(u32) -> Result<f64, HostError>,
    ) -> Result<Option<(f64, f64, f64)>, HostError> {
        let wanted = (255.0 * error).powi(2);
        let guess = (f64::from(self.count) * self.error / wanted).clamp(1.0, MOST_IMAGES);
        // Another number than what is measured, so that there is a slope.
        let near = match guess.round() as u32 {
            near if near == self.count => near + 1,
            near => near,
        };
        let there = error_of(near)?;
        let slope = (there / self.error).ln() / (f64::from(near) / f64::from(self.count)).ln();
        // Between no gain and that of perfectly spread numbers, whatever the noise says.
        let images = f64::from(near) * (there / wanted).powf(1.0 / (-slope).clamp(0.5, 2.0));
        if images > MOST_IMAGES {
            return Ok(None);
        }
        let images = images.max(1.0);
        Ok(Some((images, self.update_ms + images * self.least_ms, error)))
    }
}

fn of_white(squared: f64) -> f64 {
    squared.sqrt() / 255.0
}

fn sentence(best: &Reached, default: Option<&Reached>, others: usize, goal: Goal) -> String {
    let what = match goal {
        Goal::Time(time) => format!("least error in a frame of {time} ms"),
        Goal::Error(error) => format!("least time of a frame of error {error}"),
    };
    let to_default = match (default, goal) {
        (None, _) => "the default does not keep it".to_owned(),
        (Some(default), _) if default.config == best.config => "nothing else is better".to_owned(),
        (Some(default), Goal::Time(_)) => {
            format!(
                "{:.0} % less than the default's",
                100.0 * (1.0 - best.error / default.error)
            )
        }
        (Some(default), Goal::Error(_)) => {
            let saved = 100.0 * (1.0 - best.frame_ms / default.frame_ms);
            format!("{saved:.0} % less than the default's")
        }
    };
    format!(
        "{}: {what}, {to_default}: error {:.4}, {:.2} ms by {:.1} shadow rays of a pixel; {others} others keep it",
        best.config, best.error, best.frame_ms, best.samples
    )
}

impl fmt::Display for Pick {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.scene, self.sentence)
    }
}

//! The best configuration within a budget, by a short run over few seeds: images of the real renderer at the scene's own
//! shading points.

use std::fmt;

use serde::Serialize;
use serde_json::json;

use super::Args;
use super::choices::{Config, Subject};
use super::finals::{Entrant, finals};
use super::image::{Budget, Reference, average};
use super::prepare::{Prepared, prepare};
use super::quantile::Interval;
use super::reach::{LEAST_ERROR, MOST_IMAGES, Measured, of_white};
use super::update::Updates;
use crate::backend::SceneArrays;
use crate::cli::table::{news, say};
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
    /// Where both keep it: the pick's error in a frame of that time, or its frame's time to that error, over the default's.
    pub margin: Option<Interval>,
    /// How many others keep the budget.
    pub others: usize,
    pub sentence: String,
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
        match &picked {
            Ok(picked) if !context.json => say!("{picked}")?,
            Err(why) if !context.json => say!("{name}: {why}")?,
            Err(why) => news!("{name}: {why}"),
            Ok(_) => {}
        }
        picks.push(picked.ok());
    }
    if context.json {
        table::print_json(&json!({
            "frame": args.frame, "processor": "cpu", "width": budget.width, "height": budget.height,
            "threads": rayon::current_num_threads(), "pick": picks,
        }))?;
    }
    Ok(Outcome::Good)
}

/// The best of `subjects`, the default first; where no configuration keeps the budget, what comes nearest.
fn pick(
    scene: &str,
    subjects: &mut [Box<dyn Subject>],
    updates_ms: &[f64],
    arrays: &SceneArrays,
    background: [f32; 3],
    budget: &Budget,
    goal: Goal,
) -> Result<Result<Pick, String>, HostError> {
    let params = |samples, seed| budget.params(samples, seed, background);
    let reference = Reference::of(subjects, arrays, budget, params)?;
    news!("{scene}: images by {} choices on the CPU", subjects.len());
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
    let mut nearest = f64::INFINITY;
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
        match found {
            Ok(found) => reached.push(Entrant {
                at: k,
                update_ms: updates_ms[k],
                reached: Reached {
                    config: subject.config(),
                    frame_ms: found.frame_ms,
                    error: found.error,
                    samples: found.images * f64::from(subject.least_rays()),
                },
            }),
            Err(least) => nearest = nearest.min(least),
        }
    }
    let Some((best, margin)) = finals(subjects, &reached, arrays, &reference, budget, params, goal)? else {
        return Ok(Err(none(goal, nearest)));
    };
    let of_default = reached.iter().find(|entrant| entrant.at == 0);
    let of_default = of_default.map(|entrant| entrant.reached.clone());
    let others = reached.len() - 1;
    Ok(Ok(Pick {
        scene: scene.to_owned(),
        sentence: sentence(&best, of_default.as_ref(), margin, others, goal),
        best,
        of_default,
        margin,
        others,
    }))
}

/// Why nothing is picked: `nearest` is the fastest frame there is, ms, or the least error.
fn none(goal: Goal, nearest: f64) -> String {
    match goal {
        Goal::Time(_) => format!(
            "no configuration keeps this budget: the fastest takes {nearest:.2} ms for an image of one shadow ray a pixel"
        ),
        Goal::Error(_) => format!(
            "no configuration keeps this budget: the least error by {MOST_IMAGES} shadow rays of a pixel, the most that are tried, is {nearest:.4}"
        ),
    }
}

fn sentence(
    best: &Reached,
    default: Option<&Reached>,
    margin: Option<Interval>,
    others: usize,
    goal: Goal,
) -> String {
    let what = match goal {
        Goal::Time(time) => format!("least error in a frame of {time} ms"),
        Goal::Error(error) => format!("least time of a frame of error {error}"),
    };
    let to_default = match (default, margin) {
        (Some(default), _) if default.config == best.config => "nothing else is surely better".to_owned(),
        (Some(_), Some(Interval { median, low, high })) => {
            format!("{median:.2} [{low:.2}, {high:.2}] of the default's, by images in turns")
        }
        _ => "the default does not keep it".to_owned(),
    };
    let error = match best.error {
        error if error <= of_white(LEAST_ERROR) => format!("error below {:.4}", of_white(LEAST_ERROR)),
        error => format!("error {error:.4}"),
    };
    let most = match best.samples {
        samples if samples >= f64::from(MOST_IMAGES) => ", the most that are tried",
        _ => "",
    };
    format!(
        "{}: {what}, {to_default}: {error}, {:.2} ms by {:.1} shadow rays of a pixel{most}; {others} others keep it",
        best.config, best.frame_ms, best.samples
    )
}

impl fmt::Display for Pick {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.scene, self.sentence)
    }
}

//! The default against what seems to keep a budget best: images in turns, so that noise picks nothing.

use lightbvh_kernels::render::RenderParams;

use super::choices::Subject;
use super::image::{Budget, Reference};
use super::pick::{Goal, Reached};
use super::quantile::Interval;
use super::reach::LEAST_ERROR;
use crate::backend::SceneArrays;
use crate::cli::times::ms;
use crate::error::HostError;

/// Turns of the last comparison.
const TURNS: u32 = 9;

/// How many others than the default take part.
const OTHERS: usize = 3;

/// Most images of the last comparison, in those of the measurement: their errors are known well enough.
const MOST: u32 = 2;

/// A gain below this is none.
const LEAST_GAIN: f64 = 1.05;

/// Seeds from here on belong to the last comparison.
const SEED: u32 = 1 << 16;

/// What keeps the budget, by an estimate.
pub(super) struct Entrant {
    /// Among all configurations; the default is the first.
    pub at: usize,
    pub update_ms: f64,
    pub reached: Reached,
}

/// The best of the `entrants`, and its figure over the default's: the default itself unless another is better for sure. Nothing
/// of none.
pub(super) fn finals(
    subjects: &mut [Box<dyn Subject>],
    entrants: &[Entrant],
    arrays: &SceneArrays,
    reference: &Reference,
    budget: &Budget,
    params: impl Fn(u32, u32) -> RenderParams,
    goal: Goal,
) -> Result<Option<(Reached, Option<Interval>)>, HostError> {
    let mut others: Vec<&Entrant> = entrants.iter().filter(|entrant| entrant.at > 0).collect();
    let estimate = |entrant: &Entrant| match goal {
        Goal::Time(_) => entrant.reached.error,
        Goal::Error(_) => entrant.reached.frame_ms,
    };
    others.sort_by(|a, b| estimate(a).total_cmp(&estimate(b)));
    let Some(default) = entrants.iter().find(|entrant| entrant.at == 0) else {
        return Ok(others.first().map(|best| (best.reached.clone(), None)));
    };
    others.truncate(OTHERS);
    let all: Vec<&Entrant> = std::iter::once(default).chain(others).collect();
    let mut figures = vec![Vec::new(); all.len()];
    for turn in 0..TURNS {
        for k in 0..all.len() {
            let at = (k + turn as usize) % all.len();
            let subject = &mut subjects[all[at].at];
            let least = subject.least_rays();
            let images = (all[at].reached.samples / f64::from(least)).round() as u32;
            let rays = least * images.clamp(1, (MOST * budget.samples).div_ceil(least));
            let image = subject.render(arrays, params(rays, SEED + turn))?;
            let error = reference.error(&budget.film(image.value)?).max(LEAST_ERROR);
            figures[at].push(figure(goal, all[at].update_ms, ms(image.time), error));
        }
    }
    let better = (1..all.len())
        .map(|k| (k, Interval::of_ratios(&figures[k], &figures[0])))
        .filter(|(_, ratio)| ratio.high < 1.0 && ratio.median * LEAST_GAIN < 1.0)
        .min_by(|(_, a), (_, b)| a.median.total_cmp(&b.median));
    Ok(Some(match better {
        Some((k, ratio)) => (all[k].reached.clone(), Some(ratio)),
        None => (default.reached.clone(), None),
    }))
}

/// What is to be least, by an image of `image_ms` and the squared `error`: errors fall as the inverse of the time of an image near
/// enough.
fn figure(goal: Goal, update_ms: f64, image_ms: f64, error: f64) -> f64 {
    let product = image_ms * error;
    match goal {
        Goal::Time(frame_ms) => (product / (frame_ms - update_ms).max(f64::MIN_POSITIVE)).sqrt(),
        Goal::Error(wanted) => update_ms + product / (255.0 * wanted).powi(2),
    }
}

//! What a tree costs and how well it chooses: bytes, times, the variance of unshadowed light.

use lightbvh::exact::hash;
use lightbvh::{Lights, Random64, ShadingPoint};
use lightbvh_kernels::shading::trace::Surfaces;
use rayon::prelude::*;
use serde::Serialize;

use super::image::Budget;
use super::light::{Sent, sent};
use super::subject::Subject;
use super::update::{Frame, Updates};
use crate::cli::measure::interval::Interval;
use crate::cli::measure::mean_of;
use crate::cli::measure::times::in_turns;
use crate::error::HostError;

/// Builds of each tree.
const BUILDS: u32 = 3;
/// Trials of several candidates at each point.
const TRIALS: u32 = 32;

#[derive(Clone, Debug, Serialize)]
pub(super) struct Structure {
    pub bytes_per_light: f64,
    pub build_ms: f64,
    /// Edits and new bounds of a frame; 0 where every frame has a new tree.
    pub refit_ms: f64,
    /// All that a frame waits for by the update policy, on average over the animation.
    pub update_ms: f64,
    /// A new top level, built beside a frame that does not wait for it; 0 where the policy has none.
    pub beside_ms: f64,
    /// All candidates of a sample.
    pub ns_per_sample: f64,
    /// Time of a sample over the default's, turn by turn.
    pub sample_ratio: Interval,
    #[serde(flatten)]
    pub variances: Variances,
}

/// Of the estimate of diffuse light by one sample, over the squared mean. Exact for one candidate, by trials for more, up to
/// the rays that tell which share of a light is seen.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Variances {
    /// Without shadows: mean over the points that any light reaches; `None` if there is no such point.
    pub variance: Option<f64>,
    pub variance_median: Option<f64>,
    /// With one shadow ray, to the one of the candidates that is taken by its light without shadows.
    pub shadowed_variance: Option<f64>,
    pub shadowed_variance_median: Option<f64>,
}

pub(super) fn structures(
    subjects: &[Box<dyn Subject>],
    frame: &Frame<'_>,
    surfaces: &Surfaces<'_>,
    updates: Vec<Updates>,
    points: &[ShadingPoint],
    budget: &Budget,
) -> Result<Vec<Structure>, HostError> {
    let lights = frame.lights;
    let triangles = lights.triangles();
    let sent: Vec<Vec<Sent>> = points
        .par_iter()
        .map(|point| sent(triangles, surfaces, point))
        .collect();
    let count = subjects.len();
    let sampled = in_turns(
        count,
        budget.turns,
        budget.passes * points.len() as u32,
        |at, turn| {
            let first = |pass| hash(turn * budget.passes + pass);
            Ok((0..budget.passes)
                .map(|pass| subjects[at].sample(points, first(pass)))
                .sum())
        },
    )?;
    let built = in_turns(count, BUILDS, 1, |at, _| subjects[at].build(frame))?;
    let times = sampled.iter().zip(built);
    subjects
        .iter()
        .zip(times)
        .zip(updates)
        .map(|((subject, (own, built)), updates)| {
            Ok(Structure {
                bytes_per_light: subject.bytes() as f64 / triangles.len() as f64,
                build_ms: 1e-6 * Interval::of(built).median,
                refit_ms: updates.refit_ms(),
                update_ms: updates.mean_ms(),
                beside_ms: updates.beside_ms(),
                sample_ratio: Interval::of_ratios(own, &sampled[0]),
                ns_per_sample: Interval::of(own.clone()).median,
                variances: variances(&**subject, lights, points, &sent),
            })
        })
        .collect()
}

pub(super) fn variances(
    subject: &dyn Subject,
    lights: &Lights,
    points: &[ShadingPoint],
    sent: &[Vec<Sent>],
) -> Variances {
    let (mut unshadowed, mut shadowed) = (Vec::new(), Vec::new());
    for (number, (point, sent)) in (0u32..).zip(points.iter().zip(sent)) {
        let mean: f64 = sent.iter().map(|sent| sent.light).sum();
        if mean <= 0.0 {
            continue;
        }
        let arrives: f64 = sent.iter().map(|sent| sent.light * sent.seen).sum();
        let [square, seen] = match subject.config().candidates {
            1 => squares(subject, lights, point, sent),
            _ => squares_of_trials(subject, number, point, sent, [mean, arrives]),
        };
        unshadowed.push((square / (mean * mean) - 1.0).max(0.0));
        if arrives > 0.0 {
            shadowed.push((seen / (arrives * arrives) - 1.0).max(0.0));
        }
    }
    let median = |values: Vec<f64>| (!values.is_empty()).then(|| Interval::of(values).median);
    Variances {
        variance: mean_of(&unshadowed),
        shadowed_variance: mean_of(&shadowed),
        variance_median: median(unshadowed),
        shadowed_variance_median: median(shadowed),
    }
}

/// The expected squares of the estimate without and with shadows, by one candidate: sums over all lights.
fn squares(subject: &dyn Subject, lights: &Lights, point: &ShadingPoint, sent: &[Sent]) -> [f64; 2] {
    let mut sums = [0.0; 2];
    for (light, of) in (0..).zip(sent).filter(|(_, of)| of.light > 0.0) {
        let square = of.light * of.light / f64::from(subject.pmf(lights, point, light));
        sums[0] += square;
        sums[1] += square * of.seen;
    }
    sums
}

/// The same by several, each taken in proportion to its light over its probability: the mean over trials, and over what is taken.
/// Around the known `means`, so that few trials do.
fn squares_of_trials(
    subject: &dyn Subject,
    number: u32,
    point: &ShadingPoint,
    sent: &[Sent],
    means: [f64; 2],
) -> [f64; 2] {
    let mut sums = means.map(|mean| mean * mean);
    let mut found = Vec::new();
    for trial in 0..TRIALS {
        subject.candidates(point, Random64::from(hash(number * TRIALS + trial)), &mut found);
        let of = |&(light, pmf): &(u32, f32)| match (sent.get(light as usize), pmf) {
            (Some(sent), pmf) if pmf > 0.0 => (sent.light / f64::from(pmf), sent.seen),
            _ => (0.0, 0.0),
        };
        let weights: Vec<(f64, f64)> = found.iter().map(of).collect();
        let sum: f64 = weights.iter().map(|(weight, _)| weight).sum();
        let visible: f64 = weights.iter().map(|(weight, seen)| weight * seen).sum();
        let estimate = sum / found.len() as f64;
        let hidden = if sum > 0.0 { 1.0 - visible / sum } else { 0.0 };
        let around = |mean: f64| (estimate - mean).powi(2);
        sums[0] += around(means[0]) / f64::from(TRIALS);
        sums[1] += (hidden * means[1].powi(2) + (1.0 - hidden) * around(means[1])) / f64::from(TRIALS);
    }
    sums
}

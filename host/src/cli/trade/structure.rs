//! The costs of a tree and how well it chooses: bytes, times, the variance of unshadowed light.

use glam::Vec3;
use lightbvh::exact::{hash, unit_f32};
use lightbvh::{EmissiveTriangle, Lights, Random64, ShadingPoint};
use lightbvh_kernels::shading::ray::Ray;
use lightbvh_kernels::shading::trace::{Surfaces, any_hit};
use rayon::prelude::*;
use serde::Serialize;

use super::image::Budget;
use super::subject::Subject;
use crate::cli::measure::interval::Interval;
use crate::cli::measure::irradiance::irradiance;
use crate::cli::measure::mean_of;
use crate::cli::measure::times::in_turns;
use crate::error::HostError;
use crate::method::Step;

/// Builds of each tree.
const BUILDS: u32 = 3;
/// Trials of several candidates at each point.
const TRIALS: u32 = 32;
/// Shadow rays to each light from each point.
const RAYS: u32 = 4;
/// Shadow rays end this share of their length before the light.
const SHORT: f32 = 1e-4;

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

/// The light that arrives at points: of each light, the irradiance without shadows, up to a common factor, and the share of it
/// that arrives.
pub(super) struct Arriving<'a> {
    lights: &'a Lights,
    points: &'a [ShadingPoint],
    sent: Vec<Vec<[f64; 2]>>,
}

pub(super) fn structures(
    subjects: &[Box<dyn Subject>],
    frame: &Step<'_>,
    arriving: &Arriving<'_>,
    budget: &Budget,
) -> Result<Vec<Structure>, HostError> {
    let items = budget.passes * arriving.points.len() as u32;
    let sampled = in_turns(subjects.len(), budget.turns, items, |at, turn| {
        let first = |pass| hash(turn * budget.passes + pass);
        let passes = (0..budget.passes).map(|pass| subjects[at].sample(arriving.points, first(pass)));
        Ok(passes.sum())
    })?;
    let built = in_turns(subjects.len(), BUILDS, 1, |at, _| subjects[at].build(frame))?;
    let all = subjects.iter().zip(&sampled).zip(built);
    let all = all.map(|((subject, own), built)| Structure {
        bytes_per_light: subject.bytes() as f64 / frame.lights.triangles().len() as f64,
        build_ms: 1e-6 * Interval::of(built).median,
        refit_ms: subject.updates().refit_ms(),
        update_ms: subject.updates().mean_ms(),
        beside_ms: subject.updates().beside_ms(),
        sample_ratio: Interval::of_ratios(own, &sampled[0]),
        ns_per_sample: Interval::of(own.clone()).median,
        variances: arriving.variances(&**subject),
    });
    Ok(all.collect())
}

impl<'a> Arriving<'a> {
    pub fn new(lights: &'a Lights, points: &'a [ShadingPoint], surfaces: &Surfaces<'_>) -> Self {
        let of = |point: &ShadingPoint, light: u32, triangle| match irradiance(triangle, point) {
            0.0 => [0.0; 2],
            sent => [sent, seen(surfaces, point, triangle, light)],
        };
        let all = |point| {
            let lights = (0..).zip(lights.triangles());
            lights
                .map(|(light, triangle)| of(point, light, triangle))
                .collect()
        };
        Self {
            lights,
            points,
            sent: points.par_iter().map(all).collect(),
        }
    }

    pub fn variances(&self, subject: &dyn Subject) -> Variances {
        let (mut unshadowed, mut shadowed) = (Vec::new(), Vec::new());
        for (number, (point, sent)) in (0u32..).zip(self.points.iter().zip(&self.sent)) {
            let mean: f64 = sent.iter().map(|[light, _]| light).sum();
            if mean <= 0.0 {
                continue;
            }
            let arrives: f64 = sent.iter().map(|[light, seen]| light * seen).sum();
            let [square, seen] = match subject.config().candidates {
                1 => self.squares(subject, point, sent),
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
    fn squares(&self, subject: &dyn Subject, point: &ShadingPoint, sent: &[[f64; 2]]) -> [f64; 2] {
        let mut sums = [0.0; 2];
        for (light, [sent, seen]) in (0..).zip(sent).filter(|(_, of)| of[0] > 0.0) {
            let square = sent * sent / f64::from(subject.pmf(self.lights, point, light));
            sums[0] += square;
            sums[1] += square * seen;
        }
        sums
    }
}

/// The same by several, each taken in proportion to its light over its probability: the mean over trials, and over what is taken.
/// Around the known `means`, so that few trials do.
fn squares_of_trials(
    subject: &dyn Subject,
    number: u32,
    point: &ShadingPoint,
    sent: &[[f64; 2]],
    means: [f64; 2],
) -> [f64; 2] {
    let mut sums = means.map(|mean| mean * mean);
    let mut found = Vec::new();
    for trial in 0..TRIALS {
        subject.candidates(point, Random64::from(hash(number * TRIALS + trial)), &mut found);
        let of = |&(light, pmf): &(u32, f32)| match (sent.get(light as usize), pmf) {
            (Some([light, seen]), pmf) if pmf > 0.0 => (light / f64::from(pmf), *seen),
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

/// The share of rays that arrive, to points spread evenly over the triangle.
fn seen(surfaces: &Surfaces<'_>, point: &ShadingPoint, triangle: &EmissiveTriangle, light: u32) -> f64 {
    let [a, b, c] = triangle.p.map(Vec3::from_array);
    let origin = Vec3::from_array(point.p);
    let visible = |&k: &u32| {
        let draw = |n: u32| unit_f32(hash(hash(light).wrapping_add(RAYS * n + k)));
        let root = ((k as f32 + draw(0)) / RAYS as f32).sqrt();
        let (u, v) = (1.0 - root, root * draw(1));
        let on = a + (b - a) * u + (c - a) * v;
        !any_hit(surfaces, &Ray::new(origin, on - origin, 1.0 - SHORT), light)
    };
    f64::from((0..RAYS).filter(visible).count() as u32) / f64::from(RAYS)
}

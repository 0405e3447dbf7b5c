//! What a tree costs and how well it chooses: bytes, times, the variance of unshadowed light.

use lightbvh::exact::hash;
use lightbvh::{Lights, Random64, ShadingPoint};
use rayon::prelude::*;
use serde::Serialize;

use super::choices::Subject;
use super::image::Budget;
use super::quantile::Interval;
use super::update::{Frame, Updates};
use crate::cli::times::ms;
use crate::cli::variance::irradiance::irradiance;
use crate::error::HostError;

/// Trials of several candidates at each point.
const TRIALS: u32 = 32;

#[derive(Clone, Debug, Serialize)]
pub(super) struct Structure {
    pub bytes_per_light: f64,
    pub build_ms: f64,
    /// Edits and new bounds of a frame; 0 where every frame has a new tree.
    pub refit_ms: f64,
    /// All that the update policy does for a frame, on average over the animation.
    pub update_ms: f64,
    /// All candidates of a sample.
    pub ns_per_sample: f64,
    /// Time of a sample over the default's, turn by turn.
    pub sample_ratio: Interval,
    /// Of the estimate of unshadowed diffuse light by one sample, over the squared mean: mean over the points. Exact for one candidate,
    /// by trials for more.
    pub variance: f64,
}

pub(super) fn structures(
    subjects: &mut [Box<dyn Subject>],
    frame: &Frame<'_>,
    updates: Vec<Updates>,
    points: &[ShadingPoint],
    budget: &Budget,
) -> Result<Vec<Structure>, HostError> {
    let lights = frame.lights;
    let triangles = lights.triangles();
    let sent: Vec<Vec<f64>> = points
        .par_iter()
        .map(|point| triangles.iter().map(|t| irradiance(t, point)).collect())
        .collect();
    let mut times = vec![Times::default(); subjects.len()];
    for turn in 0..budget.turns {
        // Each turn begins elsewhere, so that no configuration always follows the same one.
        for k in 0..subjects.len() {
            let at = (k + turn as usize) % subjects.len();
            let (subject, times) = (&mut subjects[at], &mut times[at]);
            let mut time = 0.0;
            for pass in 0..budget.passes {
                time += ms(subject.sample(points, hash(turn * budget.passes + pass)));
            }
            times
                .sample
                .push(1e6 * time / f64::from(budget.passes) / points.len() as f64);
            if turn < 3 {
                times.build.push(ms(subject.build(frame)?));
            }
        }
    }
    let default = times[0].sample.clone();
    subjects
        .iter_mut()
        .zip(times)
        .zip(updates)
        .map(|((subject, times), updates)| {
            Ok(Structure {
                bytes_per_light: subject.bytes() as f64 / triangles.len() as f64,
                build_ms: Interval::of(times.build).median,
                refit_ms: updates.refit_ms(),
                update_ms: updates.mean_ms(),
                sample_ratio: Interval::of_ratios(&times.sample, &default),
                ns_per_sample: Interval::of(times.sample).median,
                variance: variance(&**subject, lights, points, &sent),
            })
        })
        .collect()
}

#[derive(Clone, Debug, Default)]
struct Times {
    sample: Vec<f64>,
    build: Vec<f64>,
}

fn variance(subject: &dyn Subject, lights: &Lights, points: &[ShadingPoint], sent: &[Vec<f64>]) -> f64 {
    let (mut sum, mut lit) = (0.0, 0);
    let mut found = Vec::new();
    for (number, (point, sent)) in (0u32..).zip(points.iter().zip(sent)) {
        let mean: f64 = sent.iter().sum();
        if mean <= 0.0 {
            continue;
        }
        lit += 1;
        if subject.config().candidates == 1 {
            let of = |(light, &sent): (u32, &f64)| match sent {
                0.0 => 0.0,
                _ => sent * sent / f64::from(subject.pmf(lights, point, light)),
            };
            let square: f64 = (0..).zip(sent).map(of).sum();
            sum += (square / (mean * mean) - 1.0).max(0.0);
        } else {
            for trial in 0..TRIALS {
                let random = Random64::from(hash(number * TRIALS + trial));
                subject.candidates(point, random, &mut found);
                let of = |&(light, pmf): &(u32, f32)| match pmf {
                    0.0 => 0.0,
                    _ => sent.get(light as usize).copied().unwrap_or(0.0) / f64::from(pmf),
                };
                let estimate = found.iter().map(of).sum::<f64>() / found.len() as f64;
                sum += (estimate / mean - 1.0).powi(2) / f64::from(TRIALS);
            }
        }
    }
    sum / f64::from(lit.max(1))
}

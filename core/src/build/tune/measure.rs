//! Times and variances of one configuration.

use alloc::vec::Vec;
use core::hint::black_box;

use super::Lighting;
use crate::bvh::Bvh;
use crate::exact::hash;
use crate::importance::ImportanceModel;
use crate::light::EmissiveTriangle;
use crate::node::{Holds, LightNode};
use crate::point::ShadingPoint;
use crate::traverse::{Random64, SampledLight};

/// Most lights times points that are asked for their probabilities.
const MOST_PMFS: usize = 1 << 20;
/// Trials at each point, where a mean is known and where it is not.
const TRIALS: u32 = 64;
const TRIALS_ALONE: u32 = 512;

/// Light above counts as that much, so that sums of squares over probabilities are finite.
const GREATEST: f64 = 1e100;

/// Light without shadows, and the share that is seen.
type Sent = (f64, f64);

/// A light BVH of some type.
pub(super) trait Configuration {
    fn candidates(&self) -> u32;
    /// Samples each point `passes` times, by numbers of its own for each `round`.
    fn run(&self, points: &[ShadingPoint], passes: u32, round: u32);
    fn draw(&self, point: &ShadingPoint, number: Random64, found: &mut [SampledLight]);
    fn pmf(&self, point: &ShadingPoint, light: u32, instance: u32) -> f32;
    fn triangle(&self, sampled: &SampledLight) -> Option<EmissiveTriangle>;
    fn world_lights(&self) -> Vec<EmissiveTriangle>;
    fn count(&self) -> usize;
}

pub(super) struct Sampling<'a, N: Holds, I, const W: usize> {
    pub bvh: &'a Bvh<N, I, W>,
    pub candidates: u32,
}

impl<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize> Configuration for Sampling<'_, N, I, W> {
    fn candidates(&self) -> u32 {
        self.candidates
    }

    fn run(&self, points: &[ShadingPoint], passes: u32, round: u32) {
        let mut found = alloc::vec![SampledLight::NONE; self.candidates as usize];
        let mut number = hash(round);
        for _ in 0..passes {
            for point in points {
                number = number.wrapping_add(1);
                self.draw(point, Random64::from(hash(number)), &mut found);
                black_box(&found);
            }
        }
    }

    fn draw(&self, point: &ShadingPoint, number: Random64, found: &mut [SampledLight]) {
        match found {
            [one] => *one = self.bvh.sample(point, number),
            many => self.bvh.sample_spaced(point, number, 0, self.candidates, many),
        }
    }

    fn pmf(&self, point: &ShadingPoint, light: u32, instance: u32) -> f32 {
        self.bvh.pmf(point, light, instance)
    }

    fn triangle(&self, sampled: &SampledLight) -> Option<EmissiveTriangle> {
        self.bvh.triangle(sampled.light, sampled.instance)
    }

    fn world_lights(&self) -> Vec<EmissiveTriangle> {
        self.bvh.world_lights()
    }

    fn count(&self) -> usize {
        self.bvh.light_count()
    }
}

/// [`Measured::variance`](super::Measured::variance); nothing where no light arrives.
pub(super) fn variances(
    choice: &dyn Configuration,
    points: &[ShadingPoint],
    lighting: &dyn Lighting,
) -> Option<f64> {
    let listed = choice.count().saturating_mul(points.len()) <= MOST_PMFS;
    let lights = if listed { choice.world_lights() } else { Vec::new() };
    let moments: Vec<[f64; 2]> = (0..)
        .zip(points)
        .map(|(number, point)| {
            if !listed {
                return by_trials(choice, number, point, lighting, None);
            }
            let sent = lights.iter().map(|light| sent(lighting, point, light));
            let sent: Vec<Sent> = sent.collect();
            let mean = sent.iter().map(|(light, seen)| light * seen).sum();
            match choice.candidates() {
                1 => [mean, exact_variance(choice, point, &lights, &sent, mean)],
                _ => by_trials(choice, number, point, lighting, Some(mean)),
            }
        })
        .collect();
    let average = moments.iter().map(|[mean, _]| mean).sum::<f64>() / points.len() as f64;
    let relative = |&[mean, variance]: &[f64; 2]| variance / (mean * mean + average * average);
    (average > 0.0).then(|| moments.iter().map(relative).sum::<f64>() / points.len() as f64)
}

fn sent(lighting: &dyn Lighting, point: &ShadingPoint, light: &EmissiveTriangle) -> Sent {
    match lighting.light(point, light) {
        of if of > 0.0 && of.is_finite() => (of.min(GREATEST), lighting.seen(point, light).clamp(0.0, 1.0)),
        _ => (0.0, 0.0),
    }
}

/// Of one candidate: the sum over all lights.
fn exact_variance(
    choice: &dyn Configuration,
    point: &ShadingPoint,
    lights: &[EmissiveTriangle],
    sent: &[Sent],
    mean: f64,
) -> f64 {
    let mut square = 0.0;
    for ((number, light), (of, seen)) in (0..).zip(lights).zip(sent) {
        if of * seen > 0.0 {
            square += of * of * seen / f64::from(choice.pmf(point, number, light.mesh));
        }
    }
    (square - mean * mean).max(0.0)
}

/// Mean and variance: over trials, and over which candidate is taken. Around the `mean` where it is known, so that few trials do.
fn by_trials(
    choice: &dyn Configuration,
    number: u32,
    point: &ShadingPoint,
    lighting: &dyn Lighting,
    mean: Option<f64>,
) -> [f64; 2] {
    let trials = if mean.is_some() { TRIALS } else { TRIALS_ALONE };
    let mut found = alloc::vec![SampledLight::NONE; choice.candidates() as usize];
    let mut estimates = Vec::with_capacity(trials as usize);
    for trial in 0..trials {
        let random = Random64::from(hash(hash(number).wrapping_add(trial)));
        choice.draw(point, random, &mut found);
        let (mut sum, mut visible) = (0.0, 0.0);
        for sampled in found.iter().filter(|sampled| sampled.pmf > 0.0) {
            if let Some(light) = choice.triangle(sampled) {
                let (of, seen) = sent(lighting, point, &light);
                sum += of / f64::from(sampled.pmf);
                visible += of / f64::from(sampled.pmf) * seen;
            }
        }
        let share = if sum > 0.0 { visible / sum } else { 0.0 };
        estimates.push((sum / found.len() as f64, share));
    }
    let count = f64::from(trials);
    let mean = mean.unwrap_or_else(|| estimates.iter().map(|(of, seen)| of * seen).sum::<f64>() / count);
    let around = |(of, seen): &(f64, f64)| seen * (of - mean) * (of - mean) + (1.0 - seen) * mean * mean;
    [mean, estimates.iter().map(around).sum::<f64>() / count]
}

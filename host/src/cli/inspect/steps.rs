//! From the default to the chosen model, one part at a time, each checked on the scene's own points.

use lightbvh::ShadingPoint;
use lightbvh::exact::hash;
use lightbvh::refit::Instance;
use lightbvh::requirements::{Layout, Model, Orientation, Requirements, Structure, TransformKind};
use rayon::prelude::*;
use serde::Serialize;

use super::subject::{Source, Subject, build};
use crate::cli::times::ms;
use crate::cli::trade::quantile::Interval;
use crate::cli::variance::irradiance::irradiance;
use crate::error::HostError;

/// Where probabilities may differ, the mean variance of a sample rises by no more than a twentieth.
pub(super) const MOST_VARIANCE: f64 = 1.05;
/// Samples of a point that are compared where no probability of a given light can be asked for.
const SAMPLES: u32 = 64;
/// Rounds of timing, and how often each point is sampled in one.
const TURNS: u32 = 21;
const SAMPLES_IN_A_TURN: u32 = 40_000;

/// What a step promises.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Promise {
    /// Every probability has the same bits.
    Bits,
    /// The same bits at the point as the identity of an instance leaves it, which may turn the last bit of a normal.
    BitsThroughIdentity,
    /// The mean variance of a sample stays below [`MOST_VARIANCE`] times what it was.
    Variance,
}

/// A part of the model that is another one than before.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Step {
    pub part: &'static str,
    pub promise: Promise,
    /// Probabilities, or where there are none samples, that were compared, and how many differ.
    pub compared: u64,
    pub different: u64,
    /// Greatest difference of two probabilities.
    pub most: f64,
    /// Mean over the points of the relative variance of one sample.
    pub variance: f64,
    /// That of the step before.
    pub variance_before: f64,
    /// Whether the promise holds.
    pub kept: bool,
    #[serde(flatten)]
    pub cost: Cost,
}

/// What a model costs.
#[derive(Clone, Copy, Debug, Serialize)]
pub(super) struct Cost {
    /// Bytes that sampling reads, and bytes of all arrays.
    pub bytes_per_light: f64,
    pub memory_per_light: f64,
    pub ns_per_sample: f64,
    /// Less than the default's, turn by turn.
    pub ns_saved: Interval,
}

/// What was measured.
pub(super) struct Checked {
    /// The default's variance and cost.
    pub variance: f64,
    pub default: Cost,
    pub steps: Vec<Step>,
}

/// Each part that `model` has another than the default, and the model with it and those before.
fn chain(model: &Model) -> Vec<(&'static str, Model)> {
    let mut now = Model::DEFAULT;
    let mut out = Vec::new();
    let mut next = |part, then: Model| {
        if then != now {
            out.push((part, then));
        }
        now = then;
        now
    };
    let then = next(
        "layout",
        Model {
            layout: model.layout,
            ..Model::DEFAULT
        },
    );
    let then = next(
        "levels",
        Model {
            structure: model.structure,
            ..then
        },
    );
    let then = next(
        "width",
        Model {
            width: model.width,
            ..then
        },
    );
    let then = next(
        "uniform share",
        Model {
            uniform_halvings: model.uniform_halvings,
            ..then
        },
    );
    let then = next(
        "trails",
        Model {
            trails: model.trails,
            ..then
        },
    );
    next(
        "refit data",
        Model {
            refit: model.refit,
            ..then
        },
    );
    out
}

fn promise(part: &str, model: &Model, requirements: &Requirements) -> Promise {
    let is_identity = requirements.is_one_mesh()
        && requirements.transform() == TransformKind::Identity
        && requirements.dimmed == 0;
    match part {
        "layout"
            if model.layout == Layout::TwoSidedMoments && requirements.orientation == Orientation::Absent =>
        {
            Promise::Bits
        }
        "levels" if model.structure == Structure::SingleLevel && is_identity => Promise::BitsThroughIdentity,
        "trails" | "refit data" => Promise::Bits,
        _ => Promise::Variance,
    }
}

/// What the lights of a scene send to its points.
struct Light<'a> {
    source: &'a Source<'a>,
    /// By point and light.
    sent: Vec<Vec<f64>>,
}

/// Builds the default and each step of the way to `model`, compares them, and times them in turns.
pub(super) fn check(
    model: &Model,
    requirements: &Requirements,
    source: &Source<'_>,
    points: &[ShadingPoint],
) -> Result<Checked, HostError> {
    let triangles = source.lights.triangles();
    let sent = points.par_iter();
    let sent = sent.map(|point| triangles.iter().map(|t| irradiance(t, point)).collect());
    let light = Light {
        source,
        sent: sent.collect(),
    };
    let chain = chain(model);
    let mut subjects = vec![build(&Model::DEFAULT, source)?];
    for (_, model) in &chain {
        subjects.push(build(model, source)?);
    }
    let costs = costs(&subjects, points, triangles.len());
    let mut before = light.pmfs(&*subjects[0], points);
    let first = light.variance(before.as_deref().unwrap_or_default());
    let mut variance = first;
    let mut steps = Vec::new();
    for (k, (part, model)) in (1..).zip(&chain) {
        let (old, new) = (&*subjects[k - 1], &*subjects[k]);
        let promise = promise(part, model, requirements);
        let pmfs = light.pmfs(new, points);
        let compared = match (promise, &before, &pmfs) {
            (Promise::BitsThroughIdentity, Some(before), Some(_)) => {
                let seen: Vec<_> = points
                    .iter()
                    .map(|point| Instance::IDENTITY.to_local(point))
                    .collect();
                Compared::of(before, &light.pmfs(new, &seen).unwrap_or_default())
            }
            (_, Some(before), Some(pmfs)) => Compared::of(before, pmfs),
            _ => Compared::of_samples(old, new, points),
        };
        let variance_before = variance;
        if let Some(pmfs) = &pmfs {
            variance = light.variance(pmfs);
        }
        steps.push(Step {
            part,
            promise,
            compared: compared.count,
            different: compared.different,
            most: compared.most,
            variance,
            variance_before,
            kept: match promise {
                Promise::Variance => variance <= MOST_VARIANCE * variance_before,
                _ => compared.different == 0,
            },
            cost: costs[k],
        });
        before = pmfs;
    }
    Ok(Checked {
        variance: first,
        default: costs[0],
        steps,
    })
}

impl Light<'_> {
    /// Every probability, point by point; `None` where none can be asked for.
    fn pmfs(&self, subject: &dyn Subject, points: &[ShadingPoint]) -> Option<Vec<f32>> {
        let lights = self.source.lights.triangles();
        let of = |point: &ShadingPoint| -> Option<Vec<f32>> {
            let each = (0..).zip(lights);
            each.map(|(light, triangle)| subject.probability(point, light, triangle.mesh))
                .collect()
        };
        let all: Option<Vec<Vec<f32>>> = points.par_iter().map(of).collect();
        Some(all?.concat())
    }

    /// Mean relative variance of one sample by these probabilities, over the points that any light reaches.
    fn variance(&self, pmfs: &[f32]) -> f64 {
        let lights = self.source.lights.triangles().len();
        let (mut sum, mut lit) = (0.0, 0_u32);
        for (sent, pmfs) in self.sent.iter().zip(pmfs.chunks(lights)) {
            let mean: f64 = sent.iter().sum();
            if mean > 0.0 {
                let pairs = sent.iter().zip(pmfs).filter(|(sent, _)| **sent > 0.0);
                let square: f64 = pairs.map(|(sent, &pmf)| sent * sent / f64::from(pmf)).sum();
                sum += (square / (mean * mean) - 1.0).max(0.0);
                lit += 1;
            }
        }
        sum / f64::from(lit.max(1))
    }
}

/// Words of two models.
struct Compared {
    count: u64,
    different: u64,
    most: f64,
}

impl Compared {
    fn of(before: &[f32], after: &[f32]) -> Self {
        let mut own = Self {
            // What is missing differs.
            different: before.len().abs_diff(after.len()) as u64,
            count: before.len() as u64,
            most: 0.0,
        };
        for (a, b) in before.iter().zip(after) {
            own.different += u64::from(a.to_bits() != b.to_bits());
            own.most = own.most.max((f64::from(*a) - f64::from(*b)).abs());
        }
        own
    }

    fn of_samples(old: &dyn Subject, new: &dyn Subject, points: &[ShadingPoint]) -> Self {
        let mut own = Self {
            count: 0,
            different: 0,
            most: 0.0,
        };
        for (point, index) in points.iter().zip(0_u32..) {
            for k in 0..SAMPLES {
                let number = hash(index * SAMPLES + k);
                let (a, b) = (old.choose(point, number), new.choose(point, number));
                own.count += 1;
                own.different += u64::from(a.light != b.light || a.pmf.to_bits() != b.pmf.to_bits());
                own.most = own.most.max((f64::from(a.pmf) - f64::from(b.pmf)).abs());
            }
        }
        own
    }
}

/// Bytes, and times in turns that each begin with another subject.
fn costs(subjects: &[Box<dyn Subject>], points: &[ShadingPoint], lights: usize) -> Vec<Cost> {
    let passes = SAMPLES_IN_A_TURN.div_ceil(points.len() as u32);
    let mut times: Vec<Vec<f64>> = vec![Vec::new(); subjects.len()];
    for turn in 0..TURNS {
        for k in 0..subjects.len() {
            let at = (k + turn as usize) % subjects.len();
            let time = ms(subjects[at].time(points, hash(turn), passes));
            times[at].push(1e6 * time / f64::from(passes) / points.len() as f64);
        }
    }
    let lights = lights as f64;
    let both = subjects.iter().zip(&times);
    both.map(|(subject, own)| Cost {
        bytes_per_light: subject.read_bytes() as f64 / lights,
        memory_per_light: subject.all_bytes() as f64 / lights,
        ns_per_sample: Interval::of(own.clone()).median,
        ns_saved: Interval::of(times[0].iter().zip(own).map(|(a, b)| a - b).collect()),
    })
    .collect()
}

//! From the default to the chosen model, one part at a time, each checked on the scene's own points.

use lightbvh::ShadingPoint;
use lightbvh::exact::hash;
use lightbvh::refit::Instance;
use lightbvh::requirements::{Layout, Model, Requirements, TransformKind};
use serde::Serialize;

use super::compare::{Compared, Light};
use super::options::Args;
use super::ratio::MeanRatio;
use super::subject::{Source, Subject, build};
use crate::cli::measure::interval::Interval;
use crate::cli::measure::mean_of;
use crate::cli::measure::times::in_turns;
use crate::error::HostError;

/// Where probabilities may differ, the mean variance of a sample surely rises by no more than a twentieth.
pub(super) const MOST_VARIANCE: f64 = 1.05;
/// Rounds of timing, and about how many samples are taken in one.
pub(super) const TURNS: u32 = 21;
pub(super) const SAMPLES_IN_A_TURN: u32 = 40_000;

/// What a step promises.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Promise {
    /// Every probability has the same bits.
    Bits,
    /// The same bits at the point as an instance at the identity hands it on, which may turn the last bit of a normal.
    BitsBelowInstance,
    /// The mean variance of a sample stays below [`MOST_VARIANCE`] times what it was: its whole interval does, so that no part
    /// is taken because of which points were looked at.
    Variance,
}

/// A part of the model that is to be another one than before.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Step {
    pub part: &'static str,
    pub promise: Promise,
    /// Probabilities, or where there are none samples, that were compared, and how many differ.
    pub compared: u64,
    pub different: u64,
    /// Greatest difference of two probabilities.
    pub most: f64,
    /// Mean over the points that any light reaches of the relative variance of one sample; where there is none, nothing is known.
    pub variance: Option<f64>,
    /// That of the step before.
    pub variance_before: Option<f64>,
    /// The one over the other.
    pub variance_ratio: Option<MeanRatio>,
    /// Whether the promise holds.
    pub held: bool,
    /// Whether the part stays as it was because it does not.
    pub put_back: bool,
    #[serde(flatten)]
    pub cost: Cost,
}

/// What a model costs.
#[derive(Clone, Copy, Debug, Default, Serialize)]
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
    /// What is left of the model without what was put back, and its cost.
    pub model: Model,
    pub cost: Cost,
    /// The default's variance and cost.
    pub variance: Option<f64>,
    pub default: Cost,
    pub steps: Vec<Step>,
}

/// A part of a model, and how one model takes it from another.
type Part = (&'static str, fn(&mut Model, &Model));

/// Each is taken after those before it: without a share of uniform choice trails can go.
const PARTS: [Part; 5] = [
    ("layout", |to, from| to.layout = from.layout),
    ("levels", |to, from| to.single_level = from.single_level),
    ("uniform share", |to, from| {
        to.uniform_halvings = from.uniform_halvings;
    }),
    ("trails", |to, from| {
        to.trails = from.trails || to.uniform_halvings > 0;
    }),
    ("updates", |to, from| to.updates = from.updates),
];

fn promise(part: &str, model: &Model, requirements: &Requirements) -> Promise {
    let is_identity = requirements.is_one_mesh()
        && requirements.transform() == TransformKind::Identity
        && requirements.dimmed == 0;
    match part {
        "layout" if model.layout == Layout::TwoSidedMoments && requirements.one_sided == 0 => Promise::Bits,
        "levels" if model.single_level && is_identity => Promise::BitsBelowInstance,
        "trails" | "updates" => Promise::Bits,
        _ => Promise::Variance,
    }
}

/// Builds the default and each step of the way to `model`, compares them, and times them in turns. A part that was not asked for
/// is put back where it costs more variance than promised.
pub(super) fn check(
    model: &Model,
    args: &Args,
    requirements: &Requirements,
    source: &Source<'_>,
    points: &[ShadingPoint],
) -> Result<Checked, HostError> {
    let lights = source.lights.triangles();
    let light = Light::of(lights, points);
    let mut now = Model::DEFAULT;
    let mut subjects = vec![build(&now, source)?];
    let mut before = light.pmfs(&*subjects[0], points);
    let first = light.variances(before.as_deref().unwrap_or_default());
    let variance = mean_of(&first);
    let (mut last, mut variances_before) = (0, first);
    let mut steps = Vec::new();
    for (part, take) in PARTS {
        let mut then = now;
        take(&mut then, model);
        if then == now {
            continue;
        }
        let new = build(&then, source)?;
        let promise = promise(part, &then, requirements);
        let pmfs = light.pmfs(&*new, points);
        let compared = match (promise, &before, &pmfs) {
            (Promise::BitsBelowInstance, Some(before), Some(_)) => {
                let seen = points.iter().map(|point| Instance::IDENTITY.to_local(point));
                let pmfs = light.pmfs(&*new, &seen.collect::<Vec<_>>());
                Compared::of(before, &pmfs.unwrap_or_default())
            }
            (_, Some(before), Some(pmfs)) => Compared::of(before, pmfs),
            _ => Compared::of_samples(&*subjects[last], &*new, points),
        };
        let variances = pmfs
            .as_deref()
            .map_or_else(|| variances_before.clone(), |pmfs| light.variances(pmfs));
        let is_known = !variances.is_empty();
        let variance_ratio = is_known.then(|| MeanRatio::of(&variances_before, &variances));
        let held = match promise {
            Promise::Variance => variance_ratio.is_none_or(|ratio| ratio.high <= MOST_VARIANCE),
            _ => compared.different == 0,
        };
        let put_back = !held && promise == Promise::Variance && !args.asks_for(part);
        subjects.push(new);
        steps.push(Step {
            part,
            promise,
            compared: compared.count,
            different: compared.different,
            most: compared.most,
            variance: mean_of(&variances),
            variance_before: mean_of(&variances_before),
            variance_ratio,
            held,
            put_back,
            cost: Cost::default(),
        });
        if !put_back {
            (now, last, before, variances_before) = (then, subjects.len() - 1, pmfs, variances);
        }
    }
    let costs = costs(&subjects, points, lights.len())?;
    for (step, cost) in steps.iter_mut().zip(&costs[1..]) {
        step.cost = *cost;
    }
    Ok(Checked {
        model: now,
        variance,
        default: costs[0],
        cost: costs[last],
        steps,
    })
}

/// Bytes, and times in turns that each begin with another subject.
fn costs(
    subjects: &[Box<dyn Subject>],
    points: &[ShadingPoint],
    lights: usize,
) -> Result<Vec<Cost>, HostError> {
    let passes = SAMPLES_IN_A_TURN.div_ceil((points.len() as u32).max(1));
    let samples = passes * points.len() as u32;
    let time = |at: usize, turn| Ok(subjects[at].time(points, hash(turn), passes));
    let times = in_turns(subjects.len(), TURNS, samples, time)?;
    let lights = lights.max(1) as f64;
    let both = subjects.iter().zip(&times);
    let costs = both.map(|(subject, own)| Cost {
        bytes_per_light: subject.read_bytes() as f64 / lights,
        memory_per_light: subject.all_bytes() as f64 / lights,
        ns_per_sample: Interval::of(own.clone()).median,
        ns_saved: Interval::of(times[0].iter().zip(own).map(|(a, b)| a - b).collect()),
    });
    Ok(costs.collect())
}

#[cfg(test)]
mod tests {
    use clap::{Args as _, FromArgMatches};
    use lightbvh::importance::DefaultImportance;
    use lightbvh::requirements::Declared;
    use lightbvh::{BuildParams, Lights};
    use lightbvh_kernels::bvh::{Node, WIDTH};

    use super::*;
    use crate::cli::measure::{points, tests::room};
    use crate::scene::Instances;
    use crate::workload::lights_at;

    fn checked(is_lit: bool) -> Checked {
        let scene = room(is_lit, None);
        let lights: Lights = lights_at(&scene, 0).expect("lights");
        let (bvh, _) = Instances::new::<Node, DefaultImportance, WIDTH>(&scene, 0, BuildParams::default())
            .expect("a tree");
        let requirements = Requirements::of(&bvh, Declared::STATIC);
        let given = Args::augment_args(clap::Command::new("inspect")).get_matches_from(["inspect", "room"]);
        let args = Args::from_arg_matches(&given).expect("options");
        let source = Source {
            scene: &scene,
            frame: 0,
            moved: 0,
            lights: &lights,
        };
        let points = points::on_surfaces(&scene, 0, 16);
        check(&requirements.model(), &args, &requirements, &source, &points).expect("trees")
    }

    #[test]
    fn what_is_not_measured_has_no_figure() {
        for is_lit in [false, true] {
            let found = checked(is_lit);
            assert_eq!(found.variance.is_some(), is_lit);
            assert!(!found.steps.is_empty());
            for step in &found.steps {
                assert!(step.held);
                assert_eq!(step.variance.is_some(), is_lit);
                assert_eq!(step.variance_before.is_some(), is_lit);
                assert_eq!(step.variance_ratio.is_some(), is_lit);
            }
        }
    }
}

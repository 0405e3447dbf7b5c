//! The costs of a tree and how well it chooses: bytes, times, the variance of unshadowed light.

use lightbvh::exact::hash;
use lightbvh::{Lights, ShadingPoint};
use serde::Serialize;

use super::image::Budget;
use super::subject::Subject;
use crate::cli::measure::interval::Interval;
use crate::cli::measure::times::in_turns;
use crate::cli::measure::{self, mean_of};
use crate::error::HostError;
use crate::method::Step;

/// Builds of each tree.
const BUILDS: u32 = 3;

#[derive(Clone, Debug, Serialize)]
pub(super) struct Structure {
    pub bytes_per_light: f64,
    pub build_ms: f64,
    /// Edits and new bounds of a frame; 0 where every frame has a new tree.
    pub refit_ms: f64,
    /// All that a frame waits for by the update policy, on average over the animation.
    pub update_ms: f64,
    /// Build of a top level in the background; 0 if the policy has none.
    #[serde(rename = "beside_ms")]
    pub background_ms: f64,
    /// All candidates of a sample.
    pub ns_per_sample: f64,
    /// Time of a sample over the default's, turn by turn.
    pub sample_ratio: Interval,
    #[serde(flatten)]
    pub variances: Variances,
}

/// Of the estimate of diffuse light by one sample without shadows, over the squared mean; `None` for several candidates.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Variances {
    /// Mean over the points that any light reaches; `None` if there is no such point.
    pub variance: Option<f64>,
    pub variance_median: Option<f64>,
}

pub(super) fn structures(
    subjects: &[Box<dyn Subject>],
    frame: &Step<'_>,
    points: &[ShadingPoint],
    budget: &Budget,
) -> Result<Vec<Structure>, HostError> {
    let items = budget.passes * points.len() as u32;
    let sampled = in_turns(subjects.len(), budget.turns, items, |at, turn| {
        let first = |pass| hash(turn * budget.passes + pass);
        let passes = (0..budget.passes).map(|pass| subjects[at].sample(points, first(pass)));
        Ok(passes.sum())
    })?;
    let built = in_turns(subjects.len(), BUILDS, 1, |at, _| subjects[at].build(frame))?;
    let all = subjects.iter().zip(&sampled).zip(built);
    let all = all.map(|((subject, own), built)| Structure {
        bytes_per_light: subject.bytes() as f64 / frame.lights.all().len() as f64,
        build_ms: 1e-6 * Interval::of(built).median,
        refit_ms: subject.updates().refit_ms(),
        update_ms: subject.updates().mean_ms(),
        background_ms: subject.updates().background_ms(),
        sample_ratio: Interval::of_ratios(own, &sampled[0]),
        ns_per_sample: Interval::of(own.clone()).median,
        variances: variances(&**subject, frame.lights, points),
    });
    Ok(all.collect())
}

/// Exact, by all lights.
fn variances(subject: &dyn Subject, lights: &Lights, points: &[ShadingPoint]) -> Variances {
    let points = if subject.config().candidates > 1 {
        &[]
    } else {
        points
    };
    let pmf = |k: usize, light| subject.pmf(lights, &points[k], light);
    let all = measure::variances(lights.all(), points, pmf);
    let all: Vec<f64> = all.into_iter().flatten().collect();
    Variances {
        variance: mean_of(&all),
        variance_median: (!all.is_empty()).then(|| Interval::of(all).median),
    }
}

//! From the default to the chosen model, one part at a time, each checked on the scene's own points.

use lightbvh::importance::DefaultImportance;
use lightbvh::refit::Instance;
use lightbvh::requirements::{Choice, Layout, Requirements};
use lightbvh::{
    BuildParams, Bvh, ImportanceModel, LightNode, Lights, MomentNode, ShadingPoint, TwoSidedMomentNode,
};
use lightbvh_kernels::bvh::WIDTH;
use rayon::prelude::*;
use serde::Serialize;

use crate::cli::measure::{mean_of, variances};
use crate::error::HostError;
use crate::scene::{Instances, Scene};

/// Where probabilities may differ, the mean variance of a sample surely rises by no more than a twentieth.
pub(super) const MOST_VARIANCE: f64 = 1.05;

/// The promise of a part.
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

/// The default, then each part of the model that is to be another one than before.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Row {
    pub part: &'static str,
    /// None of the default.
    pub promise: Option<Promise>,
    /// Probabilities that were compared, and how many differ.
    pub compared: usize,
    pub different: usize,
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

/// Bytes that sampling reads, and bytes of all arrays.
#[derive(Clone, Copy, Debug, Serialize)]
pub(super) struct Cost {
    pub bytes_per_light: f64,
    pub memory_per_light: f64,
}

pub(super) struct Checked {
    /// The model without what was put back, and its row.
    pub model: Choice,
    pub last: usize,
    pub rows: Vec<Row>,
}

impl Checked {
    /// Whether bits are equal wherever that is promised.
    pub fn holds(&self) -> bool {
        self.rows.iter().all(|row| row.held || row.put_back)
    }
}

/// A mean over another one of the same points, and its interval of 95 % for points picked at random.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(super) struct MeanRatio {
    pub ratio: f64,
    pub low: f64,
    pub high: f64,
}

impl MeanRatio {
    /// The mean of `after` over that of `before`, which are of the same points. The interval is that of a ratio estimator (W.
    /// G. Cochran, "Sampling Techniques", 1977, section 6.3): a few points far above the others in both widen it little, one
    /// model's alone much.
    fn of(before: &[f64], after: &[f64]) -> Self {
        let (old, new): (f64, f64) = (before.iter().sum(), after.iter().sum());
        let ratio = if old == new { 1.0 } else { new / old };
        let half = match old == new || old == 0.0 {
            true => 0.0,
            false => {
                let left = before.iter().zip(after).map(|(a, b)| (b - ratio * a).powi(2));
                let count = before.len() as f64;
                1.96 * (left.sum::<f64>() * count / (count - 1.0).max(1.0)).sqrt() / old
            }
        };
        Self {
            ratio,
            low: (ratio - half).max(0.0),
            high: ratio + half,
        }
    }
}

/// A light BVH of some model.
struct Subject {
    cost: Cost,
    /// Every probability, point by point.
    pmfs: Vec<f32>,
    /// Relative variances of one sample, at the points that any light reaches.
    variances: Vec<f64>,
}

/// A scene's lights in the frame that trees are looked at in.
struct Source<'a> {
    scene: &'a Scene,
    /// Trees are built in the first, and moved to the second.
    frames: [u32; 2],
    lights: &'a Lights,
}

impl Source<'_> {
    fn build(&self, model: &Choice, points: &[ShadingPoint]) -> Result<Subject, HostError> {
        match model.layout {
            Layout::TwoSidedMoments => self.of::<TwoSidedMomentNode<WIDTH>, DefaultImportance>(model, points),
            _ => self.of::<MomentNode<WIDTH>, DefaultImportance>(model, points),
        }
    }

    fn of<N, I>(&self, model: &Choice, points: &[ShadingPoint]) -> Result<Subject, HostError>
    where
        N: LightNode<WIDTH>,
        I: ImportanceModel<N, WIDTH> + Sync,
    {
        let bvh = self.bvh::<N, I>(model)?;
        let lights = self.lights.all();
        let of = |point: &ShadingPoint| -> Vec<f32> {
            let lights = (0..).zip(lights);
            lights
                .map(|(light, triangle)| bvh.tree().pmf(point, light, triangle.mesh))
                .collect()
        };
        let pmfs: Vec<f32> = points.par_iter().flat_map_iter(of).collect();
        let pmf = |k: usize, light: u32| pmfs[k * lights.len() + light as usize];
        let variances = variances(lights, points, pmf).into_iter().flatten().collect();
        let [bytes_per_light, memory_per_light] =
            [bvh.view().bytes(), bvh.view().memory()].map(|own| own as f64 / lights.len().max(1) as f64);
        Ok(Subject {
            cost: Cost {
                bytes_per_light,
                memory_per_light,
            },
            pmfs,
            variances,
        })
    }

    /// A light BVH, moved and refitted if its lights move.
    fn bvh<N: LightNode<WIDTH>, I>(&self, model: &Choice) -> Result<Bvh<(N, I), WIDTH>, HostError> {
        let params = BuildParams::default();
        if model.single_level {
            return Ok(Bvh::single_level(self.lights, &params));
        }
        let [frame, moved] = self.frames;
        let refused = |error| HostError::in_frame(self.scene.name(), frame, error);
        let (mut bvh, mut instances) = Instances::new(self.scene, frame, params).map_err(refused)?;
        bvh.apply(instances.edits(self.scene, moved)).map_err(refused)?;
        bvh.refit();
        Ok(bvh)
    }
}

/// A part of a model, and how one model takes it from another.
type Part = (&'static str, fn(&mut Choice, &Choice));

/// Each is taken after those before it.
const PARTS: [Part; 2] = [
    ("layout", |to, from| to.layout = from.layout),
    ("levels", |to, from| to.single_level = from.single_level),
];

fn promise(part: &str, model: &Choice, requirements: &Requirements) -> Promise {
    let is_identity = requirements.is_one_mesh() && requirements.placed == 0;
    match part {
        "layout" if model.layout == Layout::TwoSidedMoments && requirements.one_sided == 0 => Promise::Bits,
        "levels" if model.single_level && is_identity => Promise::BitsBelowInstance,
        _ => Promise::Variance,
    }
}

/// Builds the default and each step of the way to the chosen model, and compares them. A part that costs more variance than
/// promised is put back.
pub(super) fn check(
    requirements: &Requirements,
    scene: &Scene,
    frames: [u32; 2],
    lights: &Lights,
    points: &[ShadingPoint],
) -> Result<Checked, HostError> {
    let source = Source {
        scene,
        frames,
        lights,
    };
    let mut model = Choice::DEFAULT;
    let mut subject = source.build(&model, points)?;
    let mut rows = vec![Row {
        part: "default",
        promise: None,
        compared: 0,
        different: 0,
        most: 0.0,
        variance: mean_of(&subject.variances),
        variance_before: None,
        variance_ratio: None,
        held: true,
        put_back: false,
        cost: subject.cost,
    }];
    let mut last = 0;
    for (part, take) in PARTS {
        let mut then = model;
        take(&mut then, &requirements.model());
        if then == model {
            continue;
        }
        let new = source.build(&then, points)?;
        let promise = promise(part, &then, requirements);
        let seen = match promise {
            Promise::BitsBelowInstance => {
                let seen = points.iter().map(|point| Instance::IDENTITY.to_local(point));
                &source.build(&then, &seen.collect::<Vec<_>>())?.pmfs
            }
            _ => &new.pmfs,
        };
        let pairs = subject.pmfs.iter().zip(seen);
        let different = pairs.clone().filter(|(a, b)| a.to_bits() != b.to_bits()).count();
        let most = pairs.clone().map(|(a, b)| (f64::from(*a) - f64::from(*b)).abs());
        let (compared, most) = (pairs.clone().count(), most.fold(0.0, f64::max));
        let [before, variances] = [&subject.variances, &new.variances];
        let variance_ratio = (!variances.is_empty()).then(|| MeanRatio::of(before, variances));
        let held = match promise {
            Promise::Variance => variance_ratio.is_none_or(|ratio| ratio.high <= MOST_VARIANCE),
            _ => different == 0,
        };
        let put_back = !held && promise == Promise::Variance;
        rows.push(Row {
            part,
            promise: Some(promise),
            compared,
            different,
            most,
            variance: mean_of(variances),
            variance_before: mean_of(before),
            variance_ratio,
            held,
            put_back,
            cost: new.cost,
        });
        if !put_back {
            (model, subject) = (then, new);
            last = rows.len() - 1;
        }
    }
    Ok(Checked { model, last, rows })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_shared_by_both_widen_no_interval() {
        // One point has nearly all of the mean, in both.
        let before: Vec<f64> = (0..256).map(|k| if k == 7 { 1e6 } else { 1.0 }).collect();
        let after: Vec<f64> = before.iter().map(|v| 1.02 * v).collect();
        let both = MeanRatio::of(&before, &after);
        assert!(
            (both.ratio - 1.02).abs() < 1e-9 && both.high - both.low < 1e-9,
            "{both:?}"
        );
        // The standard error of a mean over 256 points of which one differs by d is d / 256.
        let mut after = [1.0; 256];
        after[7] = 1.0 + 0.04 * 256.0;
        let alone = MeanRatio::of(&[1.0; 256], &after);
        assert!((alone.high - (1.04 + 1.96 * 0.04)).abs() < 1e-3, "{alone:?}");
        assert_eq!(MeanRatio::of(&[0.0; 4], &[0.0; 4]).high, 1.0);
        assert_eq!(MeanRatio::of(&[0.0; 4], &[1.0; 4]).high, f64::INFINITY);
    }
}

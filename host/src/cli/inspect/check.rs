//! From the default to the chosen model, one part at a time, each checked on the scene's own points.

use lightbvh::importance::DefaultImportance;
use lightbvh::refit::Instance;
use lightbvh::requirements::{Layout, Model, Requirements, Updates};
use lightbvh::{
    BuildParams, Bvh, ImportanceModel, LightNode, Lights, MomentNode, ShadingPoint, TwoSidedMomentNode,
};
use lightbvh_kernels::bvh::WIDTH;
use rayon::prelude::*;
use serde::Serialize;

use crate::cli::measure::{irradiance::irradiance, mean_of, variance};
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

/// Bytes that sampling reads, and bytes of all arrays.
#[derive(Clone, Copy, Debug, Serialize)]
pub(super) struct Cost {
    pub bytes_per_light: f64,
    pub memory_per_light: f64,
}

pub(super) struct Checked {
    /// The model without what was put back, and its row.
    pub model: Model,
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

type Pmf = dyn Fn(&ShadingPoint, u32, u32) -> f32 + Sync;

/// A light BVH of some model.
struct Subject {
    /// Bytes that sampling reads, and bytes of all its arrays.
    bytes: [usize; 2],
    pmf: Box<Pmf>,
}

impl Subject {
    fn new<N, I>(bvh: Bvh<N, I, WIDTH>, updates: Updates) -> Self
    where
        N: LightNode<WIDTH> + 'static,
        I: ImportanceModel<N, WIDTH> + Send + Sync + 'static,
    {
        match updates {
            Updates::Nothing => {
                let bvh = bvh.into_static();
                Self {
                    bytes: [bvh.bytes(); 2],
                    pmf: Box::new(move |point, light, instance| bvh.pmf(point, light, instance)),
                }
            }
            Updates::All => Self {
                bytes: [bvh.bytes(), bvh.memory()],
                pmf: Box::new(move |point, light, instance| bvh.pmf(point, light, instance)),
            },
        }
    }
}

/// A scene's lights in the frame that trees are looked at in, and the light that they send to its points.
struct Source<'a> {
    scene: &'a Scene,
    /// Trees are built in the first, and moved to the second.
    frames: [u32; 2],
    lights: &'a Lights,
    /// Light that arrives, by point and light.
    sent: Vec<Vec<f64>>,
}

impl Source<'_> {
    fn build(&self, model: &Model) -> Result<Subject, HostError> {
        Ok(match model.layout {
            Layout::TwoSidedMoments => Subject::new(
                self.bvh::<TwoSidedMomentNode<WIDTH>, DefaultImportance>(model)?,
                model.updates,
            ),
            _ => Subject::new(
                self.bvh::<MomentNode<WIDTH>, DefaultImportance>(model)?,
                model.updates,
            ),
        })
    }

    /// A light BVH, moved and refitted if its lights move.
    fn bvh<N: LightNode<WIDTH>, I>(&self, model: &Model) -> Result<Bvh<N, I, WIDTH>, HostError> {
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

    /// Every probability, point by point.
    fn pmfs(&self, subject: &Subject, points: &[ShadingPoint]) -> Vec<f32> {
        let lights = self.lights.triangles();
        let of = |point: &ShadingPoint| -> Vec<f32> {
            let each = (0..).zip(lights);
            each.map(|(light, triangle)| (subject.pmf)(point, light, triangle.mesh))
                .collect()
        };
        points.par_iter().flat_map_iter(of).collect()
    }

    /// Relative variances of one sample by these probabilities, at the points that any light reaches.
    fn variances(&self, pmfs: &[f32]) -> Vec<f64> {
        let points = self
            .sent
            .iter()
            .zip(pmfs.chunks(self.lights.triangles().len().max(1)));
        let of = |sent: &Vec<f64>, pmfs: &[f32]| {
            variance(sent.iter().zip(pmfs).map(|(&sent, &pmf)| (sent, f64::from(pmf))))
        };
        points.filter_map(|(sent, pmfs)| of(sent, pmfs)).collect()
    }

    fn cost(&self, subject: &Subject) -> Cost {
        let [bytes_per_light, memory_per_light] = subject
            .bytes
            .map(|bytes| bytes as f64 / self.lights.triangles().len().max(1) as f64);
        Cost {
            bytes_per_light,
            memory_per_light,
        }
    }
}

/// Counts what differs in pairs of probabilities, and the greatest difference.
fn compared<'a>(pairs: impl Iterator<Item = (&'a f32, &'a f32)>) -> (u64, u64, f64) {
    pairs.fold((0, 0, 0.0), |(count, different, most), (&a, &b)| {
        let differs = a.to_bits() != b.to_bits();
        let by = (f64::from(a) - f64::from(b)).abs();
        (count + 1, different + u64::from(differs), f64::max(most, by))
    })
}

/// A part of a model, and how one model takes it from another.
type Part = (&'static str, fn(&mut Model, &Model));

/// Each is taken after those before it.
const PARTS: [Part; 3] = [
    ("layout", |to, from| to.layout = from.layout),
    ("levels", |to, from| to.single_level = from.single_level),
    ("updates", |to, from| to.updates = from.updates),
];

fn promise(part: &str, model: &Model, requirements: &Requirements) -> Promise {
    let is_identity = requirements.is_one_mesh() && requirements.placed == 0;
    match part {
        "layout" if model.layout == Layout::TwoSidedMoments && requirements.one_sided == 0 => Promise::Bits,
        "levels" if model.single_level && is_identity => Promise::BitsBelowInstance,
        "updates" => Promise::Bits,
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
    let sent = points.par_iter();
    let sent = sent.map(|point| lights.triangles().iter().map(|t| irradiance(t, point)).collect());
    let source = Source {
        scene,
        frames,
        lights,
        sent: sent.collect(),
    };
    let mut model = Model::DEFAULT;
    let subject = source.build(&model)?;
    let mut before = source.pmfs(&subject, points);
    let mut variances_before = source.variances(&before);
    let mut rows = vec![Row {
        part: "default",
        promise: None,
        compared: 0,
        different: 0,
        most: 0.0,
        variance: mean_of(&variances_before),
        variance_before: None,
        variance_ratio: None,
        held: true,
        put_back: false,
        cost: source.cost(&subject),
    }];
    let mut last = 0;
    for (part, take) in PARTS {
        let mut then = model;
        take(&mut then, &requirements.model());
        if then == model {
            continue;
        }
        let new = source.build(&then)?;
        let promise = promise(part, &then, requirements);
        let pmfs = source.pmfs(&new, points);
        let seen = (promise == Promise::BitsBelowInstance).then(|| {
            let seen = points.iter().map(|point| Instance::IDENTITY.to_local(point));
            source.pmfs(&new, &seen.collect::<Vec<_>>())
        });
        let (compared, different, most) = compared(before.iter().zip(seen.as_ref().unwrap_or(&pmfs)));
        let variances = source.variances(&pmfs);
        let variance_ratio = (!variances.is_empty()).then(|| MeanRatio::of(&variances_before, &variances));
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
            variance: mean_of(&variances),
            variance_before: mean_of(&variances_before),
            variance_ratio,
            held,
            put_back,
            cost: source.cost(&new),
        });
        if !put_back {
            (model, before, variances_before) = (then, pmfs, variances);
            last = rows.len() - 1;
        }
    }
    Ok(Checked { model, last, rows })
}

#[cfg(test)]
mod tests {
    use lightbvh::requirements::Declared;
    use lightbvh_kernels::bvh::Node;

    use super::*;
    use crate::cli::measure::{points, tests::room};
    use crate::workload::lights_at;

    #[test]
    fn points_without_light_have_no_figure() {
        for is_lit in [false, true] {
            let scene = room(is_lit, None);
            let lights: Lights = lights_at(&scene, 0).expect("lights");
            let (bvh, _) =
                Instances::new::<Node, DefaultImportance, WIDTH>(&scene, 0, BuildParams::default())
                    .expect("a tree");
            let requirements = Requirements::of(&bvh, Declared::STATIC);
            let points = points::on_surfaces(&scene, 0, 16);
            let found = check(&requirements, &scene, [0; 2], &lights, &points).expect("trees");
            assert!(found.rows.len() > 1);
            for row in &found.rows {
                assert!(row.held);
                assert_eq!(row.variance.is_some(), is_lit);
            }
        }
    }

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

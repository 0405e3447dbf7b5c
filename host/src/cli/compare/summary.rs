//! Means and confidence intervals of what was measured.

use std::collections::BTreeMap;

use serde::Serialize;

use super::measure::Results;
use super::plan::Args;
use crate::method::Method;
use crate::metrics::{Estimate, Quality};

type Measure = fn(&Quality) -> f64;

/// The measures of an image by their names in JSON; errors after them have names that end in `_ci95`.
const MEASURES: [(&str, Measure); 6] = [
    ("mse", |q| q.mse),
    ("ssim", |q| q.ssim),
    ("psnr", Quality::psnr),
    ("flip", |q| q.flip),
    ("linear_mse", |q| q.linear_mse),
    ("relative_mse", |q| q.relative_mse),
];

/// Every measure as a mean over seeds, and half the 95 % confidence interval of each: `null` in JSON for one seed, as the PSNR of
/// images without any error.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Errors {
    #[serde(flatten)]
    measures: BTreeMap<String, Option<f64>>,
    pub seeds: usize,
}

/// Milliseconds, averaged over the timed frames of the animation; nothing where no frame was timed.
#[derive(Clone, Debug, Default, Serialize)]
pub(super) struct Times {
    pub refit_ms: Option<f64>,
    pub rebuild_ms: Option<f64>,
    pub wait_ms: Option<f64>,
    pub image_ms: Option<f64>,
    pub frame_ms: Option<f64>,
    pub frame_ms_ci95: Option<f64>,
    pub timed_frames: usize,
}

/// A method in one frame or over all, each seed's mean over the frames being one measurement.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Row {
    pub scene: String,
    /// None over all frames.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frame: Option<u32>,
    pub method: Method,
    pub backend: String,
    #[serde(flatten)]
    pub errors: Errors,
    #[serde(flatten)]
    pub times: Times,
    /// Change of the MSE over the moving frames (all but frame 0) from other methods' to this one's.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub mse_change: Vec<Change>,
}

/// How far one method's MSE is from another's, the same seeds paired; negative is better.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Change {
    pub from: Method,
    pub percent: f64,
    pub percent_ci95: Option<f64>,
    pub linear_percent: f64,
    pub linear_percent_ci95: Option<f64>,
}

/// Methods that others are held against.
const BASELINES: [Method; 3] = [
    Method::SingleLevelRefit,
    Method::SingleLevelRebuilt,
    Method::TwoLevelSaoh,
];

impl Errors {
    /// Of the images of each seed, frame by frame: each seed's mean over the frames is one measurement, as in the paper's last
    /// column, PSNR included.
    fn of(seeds: &[Vec<Quality>]) -> Option<Self> {
        let mut measures = BTreeMap::new();
        for (name, measure) in MEASURES {
            let values: Vec<f64> = seeds.iter().map(|frames| mean(frames, measure)).collect();
            let estimate = Estimate::of(&values)?;
            measures.insert(name.to_owned(), Some(estimate.mean));
            measures.insert(format!("{name}_ci95"), estimate.ci95);
        }
        let seeds = seeds.len();
        Some(Self { measures, seeds })
    }

    /// The mean of a measure, and half its interval.
    pub fn get(&self, measure: &str) -> (f64, Option<f64>) {
        let of = |name: &str| self.measures.get(name).copied().flatten();
        (of(measure).unwrap_or(f64::NAN), of(&format!("{measure}_ci95")))
    }
}

/// Rows of one scene on one backend: of each frame, and of all.
pub(super) fn summarize(plan: &Args, scene: &str, backend: &str, results: &Results) -> [Vec<Row>; 2] {
    let mut qualities: BTreeMap<(Method, u32), Vec<Quality>> = BTreeMap::new();
    for (&(method, frame, _), &(quality, _)) in &results.images {
        qualities.entry((method, frame)).or_default().push(quality);
    }
    let row = |method, frame: Option<u32>| {
        let frames = frame.as_ref().map_or(&plan.frames[..], std::slice::from_ref);
        Some(Row {
            scene: scene.to_owned(),
            frame,
            method,
            backend: backend.to_owned(),
            errors: Errors::of(&by_seed(&qualities, method, frames))?,
            times: times(results, method),
            mse_change: match frame {
                Some(_) => Vec::new(),
                None => changes(plan, &qualities, method),
            },
        })
    };
    let (mut rows, mut averages) = (Vec::new(), Vec::new());
    for &method in &plan.method {
        rows.extend(plan.frames.iter().filter_map(|&frame| row(method, Some(frame))));
        averages.extend(row(method, None));
    }
    [rows, averages]
}

/// Each seed's means over the frames.
fn by_seed(
    qualities: &BTreeMap<(Method, u32), Vec<Quality>>,
    method: Method,
    frames: &[u32],
) -> Vec<Vec<Quality>> {
    let columns: Vec<&Vec<Quality>> = frames
        .iter()
        .filter_map(|&frame| qualities.get(&(method, frame)))
        .collect();
    let seeds = columns.iter().map(|column| column.len()).min().unwrap_or(0);
    (0..seeds)
        .map(|seed| columns.iter().map(|column| column[seed]).collect())
        .collect()
}

fn mean(qualities: &[Quality], measure: impl Fn(&Quality) -> f64) -> f64 {
    qualities.iter().map(measure).sum::<f64>() / qualities.len() as f64
}

fn changes(plan: &Args, qualities: &BTreeMap<(Method, u32), Vec<Quality>>, method: Method) -> Vec<Change> {
    let moving: Vec<u32> = plan.frames.iter().copied().filter(|&frame| frame > 0).collect();
    let own = by_seed(qualities, method, &moving);
    let against = BASELINES
        .into_iter()
        .filter(|&from| from != method && plan.method.contains(&from));
    against
        .filter_map(|from| {
            let theirs = by_seed(qualities, from, &moving);
            let percent = |measure: fn(&Quality) -> f64| {
                let pairs = own.iter().zip(&theirs);
                let ratios: Vec<f64> = pairs
                    .map(|(own, theirs)| 100.0 * (mean(own, measure) / mean(theirs, measure) - 1.0))
                    .filter(|ratio| ratio.is_finite())
                    .collect();
                Estimate::of(&ratios)
            };
            let (shown, linear) = (percent(|q| q.mse)?, percent(|q| q.linear_mse)?);
            Some(Change {
                from,
                percent: shown.mean,
                percent_ci95: shown.ci95,
                linear_percent: linear.mean,
                linear_percent_ci95: linear.ci95,
            })
        })
        .collect()
}

fn times(results: &Results, method: Method) -> Times {
    let Some(all) = results.times.get(&method) else {
        return Times::default();
    };
    let mean = |at: usize| Some(all.iter().map(|times| times[at]).sum::<f64>() / all.len() as f64);
    // The frame's own thread refits, waits and renders, one after the other.
    let frame: Vec<f64> = all.iter().map(|times| times[0] + times[2] + times[3]).collect();
    let frame = Estimate::of(&frame);
    Times {
        refit_ms: mean(0),
        rebuild_ms: mean(1),
        wait_ms: mean(2),
        image_ms: mean(3),
        frame_ms: frame.map(|e| e.mean),
        frame_ms_ci95: frame.and_then(|e| e.ci95),
        timed_frames: all.len(),
    }
}

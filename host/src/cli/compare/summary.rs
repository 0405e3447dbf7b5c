//! Means and confidence intervals of what was measured.

use std::collections::BTreeMap;

use serde::Serialize;

use super::measure::Results;
use super::plan::Args;
use crate::method::Method;
use crate::metrics::{Estimate, Quality};

type Measure = fn(&Quality) -> f64;
type Time = fn(&[f64; 4]) -> f64;

/// The measures of an image by their names in JSON; errors after them have names that end in `_ci95`.
const MEASURES: [(&str, Measure); 6] = [
    ("mse", |q| q.mse),
    ("ssim", |q| q.ssim),
    ("psnr", Quality::psnr),
    ("flip", |q| q.flip),
    ("linear_mse", |q| q.linear_mse),
    ("relative_mse", |q| q.relative_mse),
];

/// Times of a frame, ms, out of refit, rebuild, wait and image. The frame's own thread refits, waits and renders, one after the
/// other.
const TIMES: [(&str, Time); 5] = [
    ("refit_ms", |t| t[0]),
    ("rebuild_ms", |t| t[1]),
    ("wait_ms", |t| t[2]),
    ("image_ms", |t| t[3]),
    ("frame_ms", |t| t[0] + t[2] + t[3]),
];

/// A method in one frame or over all, each seed's mean over the frames being one measurement.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Row {
    pub scene: String,
    /// None over all frames.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frame: Option<u32>,
    pub method: Method,
    pub backend: String,
    /// Every measure as a mean over seeds, times as means over the timed frames of the animation, and half the 95 % confidence
    /// interval of each: `null` in JSON for one seed, for the PSNR of images without any error, and where no frame was timed.
    #[serde(flatten)]
    figures: BTreeMap<String, Option<f64>>,
    pub seeds: usize,
    pub timed_frames: usize,
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

impl Row {
    fn add(&mut self, name: &str, values: &[f64]) {
        let estimate = Estimate::of(values);
        self.figures
            .insert(name.to_owned(), estimate.map(|estimate| estimate.mean));
        self.figures.insert(
            format!("{name}_ci95"),
            estimate.and_then(|estimate| estimate.ci95),
        );
    }

    /// The mean of a measure or a time, and half its interval.
    pub fn get(&self, name: &str) -> (Option<f64>, Option<f64>) {
        let of = |name: &str| self.figures.get(name).copied().flatten();
        (of(name), of(&format!("{name}_ci95")))
    }
}

/// Rows of one scene on one backend: of each frame, and of all.
pub(super) fn summarize(plan: &Args, scene: &str, backend: &str, results: &Results) -> [Vec<Row>; 2] {
    let row = |method, frame: Option<u32>| {
        let frames = frame.as_ref().map_or(&plan.frames[..], std::slice::from_ref);
        let (seeds, times) = (by_seed(results, method, frames), results.times.get(&method));
        let times = times.map_or(&[][..], |times| times);
        let mut row = Row {
            scene: scene.to_owned(),
            frame,
            method,
            backend: backend.to_owned(),
            figures: BTreeMap::new(),
            seeds: seeds.len(),
            timed_frames: times.len(),
            mse_change: Vec::new(),
        };
        for (name, measure) in MEASURES {
            let values: Vec<f64> = seeds.iter().map(|frames| mean(frames, measure)).collect();
            row.add(name, &values);
        }
        for (name, time) in TIMES {
            row.add(name, &times.iter().map(time).collect::<Vec<f64>>());
        }
        if frame.is_none() {
            row.mse_change = changes(plan, results, method);
        }
        row
    };
    let each = plan.method.iter().map(|&method| (method, &plan.frames));
    let of_frames = each.flat_map(|(method, frames)| frames.iter().map(move |&frame| (method, frame)));
    [
        of_frames
            .map(|(method, frame)| row(method, Some(frame)))
            .collect(),
        plan.method.iter().map(|&method| row(method, None)).collect(),
    ]
}

/// The images of each seed, one of each frame.
fn by_seed(results: &Results, method: Method, frames: &[u32]) -> Vec<Vec<Quality>> {
    let image = |seed, &frame: &u32| Some(results.images.get(&(method, frame, seed))?.0);
    let seeds = (0..).map_while(|seed| frames.iter().map(|frame| image(seed, frame)).collect());
    if frames.is_empty() {
        Vec::new()
    } else {
        seeds.collect()
    }
}

fn mean(qualities: &[Quality], measure: Measure) -> f64 {
    qualities.iter().map(measure).sum::<f64>() / qualities.len() as f64
}

fn changes(plan: &Args, results: &Results, method: Method) -> Vec<Change> {
    let moving: Vec<u32> = plan.frames.iter().copied().filter(|&frame| frame > 0).collect();
    let own = by_seed(results, method, &moving);
    let against = BASELINES.into_iter();
    let against = against.filter(|&from| from != method && plan.method.contains(&from));
    let change = |from| {
        let theirs = by_seed(results, from, &moving);
        let percent = |measure| {
            let pairs = own.iter().zip(&theirs);
            let ratio = |(own, theirs): (&Vec<_>, &Vec<_>)| mean(own, measure) / mean(theirs, measure);
            let changes = pairs.map(|pair| 100.0 * (ratio(pair) - 1.0));
            Estimate::of(&changes.filter(|change| change.is_finite()).collect::<Vec<f64>>())
        };
        let (shown, linear) = (percent(|q| q.mse)?, percent(|q| q.linear_mse)?);
        Some(Change {
            from,
            percent: shown.mean,
            percent_ci95: shown.ci95,
            linear_percent: linear.mean,
            linear_percent_ci95: linear.ci95,
        })
    };
    against.filter_map(change).collect()
}

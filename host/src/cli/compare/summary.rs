//! Means and confidence intervals of what was measured.

use std::collections::BTreeMap;

use serde::Serialize;

use super::measure::Results;
use super::plan::Plan;
use crate::method::Method;
use crate::metrics::{Estimate, Quality};

/// Every measure as a mean over seeds; `null` in JSON for the PSNR of images without any error.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Errors {
    pub mse: f64,
    pub ssim: f64,
    pub psnr: f64,
    pub flip: f64,
    pub linear_mse: f64,
    pub relative_mse: f64,
    /// Half the 95 % confidence interval of each; `null` for one seed.
    pub mse_ci95: Option<f64>,
    pub ssim_ci95: Option<f64>,
    pub psnr_ci95: Option<f64>,
    pub flip_ci95: Option<f64>,
    pub linear_mse_ci95: Option<f64>,
    pub relative_mse_ci95: Option<f64>,
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

/// One frame of one method.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Row {
    pub scene: String,
    pub frame: u32,
    pub method: Method,
    pub backend: String,
    #[serde(flatten)]
    pub errors: Errors,
    #[serde(flatten)]
    pub times: Times,
}

/// One method over all frames, each seed's mean over the frames being one measurement.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Average {
    pub scene: String,
    pub method: Method,
    pub backend: String,
    /// Over all measured frames.
    #[serde(flatten)]
    pub errors: Errors,
    #[serde(flatten)]
    pub times: Times,
    /// Change of the MSE over the moving frames (all but frame 0) from other methods' to this one's.
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
const BASELINES: [Method; 4] = [
    Method::SingleLevelRefit,
    Method::SingleLevelRebuilt,
    Method::TwoLevelSaoh,
    Method::Restir,
];

impl Errors {
    /// Of several measurements, at least one.
    fn of(qualities: &[Quality]) -> Option<Self> {
        let estimate = |measure: fn(&Quality) -> f64| {
            let values: Vec<f64> = qualities.iter().map(measure).collect();
            Estimate::of(&values)
        };
        let mse = estimate(|q| q.mse)?;
        let ssim = estimate(|q| q.ssim)?;
        let psnr = estimate(Quality::psnr)?;
        let flip = estimate(|q| q.flip)?;
        let linear = estimate(|q| q.linear_mse)?;
        let relative = estimate(|q| q.relative_mse)?;
        Some(Self {
            mse: mse.mean,
            ssim: ssim.mean,
            psnr: psnr.mean,
            flip: flip.mean,
            linear_mse: linear.mean,
            relative_mse: relative.mean,
            mse_ci95: mse.ci95,
            ssim_ci95: ssim.ci95,
            psnr_ci95: psnr.ci95,
            flip_ci95: flip.ci95,
            linear_mse_ci95: linear.ci95,
            relative_mse_ci95: relative.ci95,
            seeds: mse.count,
        })
    }
}

/// Rows and averages of one scene on one backend.
pub(super) fn summarize(
    plan: &Plan,
    scene: &str,
    backend: &str,
    results: &Results,
) -> (Vec<Row>, Vec<Average>) {
    let mut qualities: BTreeMap<(Method, u32), Vec<Quality>> = BTreeMap::new();
    for (&(method, frame, _), measured) in &results.images {
        qualities
            .entry((method, frame))
            .or_default()
            .push(measured.quality);
    }
    let (mut rows, mut averages) = (Vec::new(), Vec::new());
    for &method in &plan.methods {
        let times = times(results, method);
        for &frame in &plan.frames {
            let Some(errors) = qualities.get(&(method, frame)).and_then(|all| Errors::of(all)) else {
                continue;
            };
            rows.push(Row {
                scene: scene.to_owned(),
                frame,
                method,
                backend: backend.to_owned(),
                errors,
                times: times.clone(),
            });
        }
        if let Some(errors) = averaged(&qualities, method, &plan.frames) {
            averages.push(Average {
                scene: scene.to_owned(),
                method,
                backend: backend.to_owned(),
                errors,
                times,
                mse_change: changes(plan, &qualities, method),
            });
        }
    }
    (rows, averages)
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

/// As the paper's last column: the mean of the frames' values, PSNR included.
fn averaged(
    qualities: &BTreeMap<(Method, u32), Vec<Quality>>,
    method: Method,
    frames: &[u32],
) -> Option<Errors> {
    let seeds = by_seed(qualities, method, frames);
    let means: Vec<Quality> = seeds
        .iter()
        .map(|frames| Quality {
            mse: mean(frames, |q| q.mse),
            ssim: mean(frames, |q| q.ssim),
            flip: mean(frames, |q| q.flip),
            linear_mse: mean(frames, |q| q.linear_mse),
            relative_mse: mean(frames, |q| q.relative_mse),
        })
        .collect();
    let psnrs: Vec<f64> = seeds.iter().map(|frames| mean(frames, Quality::psnr)).collect();
    let psnr = Estimate::of(&psnrs)?;
    let errors = Errors::of(&means)?;
    Some(Errors {
        psnr: psnr.mean,
        psnr_ci95: psnr.ci95,
        ..errors
    })
}

fn changes(plan: &Plan, qualities: &BTreeMap<(Method, u32), Vec<Quality>>, method: Method) -> Vec<Change> {
    let moving: Vec<u32> = plan.frames.iter().copied().filter(|&frame| frame > 0).collect();
    let own = by_seed(qualities, method, &moving);
    let against = BASELINES
        .into_iter()
        .filter(|&from| from != method && plan.methods.contains(&from));
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
    let estimate = |time: fn(&super::measure::FrameTimes) -> f64| {
        let values: Vec<f64> = all.iter().map(time).collect();
        Estimate::of(&values)
    };
    let frame = estimate(super::measure::FrameTimes::frame_ms);
    let mean = |estimate: Option<Estimate>| estimate.map(|e| e.mean);
    Times {
        refit_ms: mean(estimate(|t| t.refit_ms)),
        rebuild_ms: mean(estimate(|t| t.rebuild_ms)),
        wait_ms: mean(estimate(|t| t.wait_ms)),
        image_ms: mean(estimate(|t| t.image_ms)),
        frame_ms: mean(frame),
        frame_ms_ci95: frame.and_then(|e| e.ci95),
        timed_frames: all.len(),
    }
}

//! The images that others are measured against: many samples of an unbiased method, and how far these are from the truth.

use indicatif::ProgressBar;
use lightbvh::BuildParams;
use serde::Serialize;

use super::frames::Frames;
use super::plan::Plan;
use crate::backend::{Backend, Bvh, CpuBackend, Integrator, Sampler};
use crate::cli::measure::reference::Reference;
use crate::error::HostError;
use crate::workload::{RenderSettings, build};

/// Samples of one pass.
const PASS: u32 = 64;
/// Seeds from here on belong to references, so that these share no random numbers with what they judge.
const FIRST_SEED: u32 = 1 << 31;

/// The noise of a reference.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Noise {
    pub frame: u32,
    pub samples: u32,
    /// Of the displayed bytes.
    pub mse: f64,
    pub linear_mse: f64,
}

/// The references of all measured frames, displayed at one exposure: that of the first.
pub(super) fn references(
    frames: &mut Frames<'_>,
    plan: &Plan,
    progress: &ProgressBar,
) -> Result<Vec<Reference>, HostError> {
    let mut exposure = None;
    let mut references = Vec::new();
    for &frame in &plan.frames {
        let halves = [
            half(frames, plan, progress, frame, 0)?,
            half(frames, plan, progress, frame, 1)?,
        ];
        frames.clear();
        let reference = Reference::new(plan.size(), halves, exposure)?;
        exposure = Some(reference.judge.exposure());
        references.push(reference);
    }
    Ok(references)
}

fn half(
    frames: &mut Frames<'_>,
    plan: &Plan,
    progress: &ProgressBar,
    frame: u32,
    half: u32,
) -> Result<Vec<[f32; 3]>, HostError> {
    progress.set_message(format!("{} frame {frame}: reference", frames.scene().name()));
    frames.prepare(frame, true)?;
    let arrays = frames.arrays(frame);
    let bvh: Bvh = build(&arrays.lights, Sampler::TwoLevel, &BuildParams::default());
    let mut cpu: CpuBackend = CpuBackend::new(bvh);
    let all = plan.reference_samples / 2;
    let mut sum = vec![[0.0_f64; 3]; plan.width as usize * plan.height as usize];
    for (pass, first) in (0..).zip((0..all).step_by(PASS as usize)) {
        let samples = PASS.min(all - first);
        let settings = RenderSettings {
            frame,
            width: plan.width,
            height: plan.height,
            samples,
            seed: FIRST_SEED + (half << 24) + pass,
        };
        let params = settings.params(frames.scene().data().background);
        let image = cpu
            .render(arrays, &params, Sampler::TwoLevel, Integrator::Direct)?
            .value;
        for (sum, pixel) in sum.iter_mut().flatten().zip(image.iter().flatten()) {
            *sum += f64::from(*pixel) * f64::from(samples);
        }
        progress.inc(plan.work(samples));
    }
    let pixels = sum.iter().map(|pixel| pixel.map(|c| (c / f64::from(all)) as f32));
    Ok(pixels.collect())
}

//! The images that others are measured against: many samples of an unbiased method, and how far these are from the truth.

use indicatif::ProgressBar;
use lightbvh::BuildParams;
use lightbvh_gpu::KERNELS;
use serde::Serialize;
use serde_json::{Value, json};

use super::frames::Frames;
use super::plan::Plan;
use super::store::{Store, fingerprint, stem};
use crate::backend::{Backend, Bvh, CpuBackend, Integrator, Sampler};
use crate::error::HostError;
use crate::metrics::{Judge, mean_squared_error};
use crate::render::Film;
use crate::workload::{RenderSettings, build};

/// Samples of one pass.
const PASS: u32 = 64;
/// Seeds from here on belong to references, so that these share no random numbers with what they judge.
const FIRST_SEED: u32 = 1 << 31;

/// A frame's reference.
pub(super) struct Reference {
    pub judge: Judge,
    pub noise: Noise,
}

/// What a reference's own noise adds to the error of every image that is measured against it, from the difference of its
/// two halves: the variance of their mean is a quarter of their mean squared difference.
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
    store: &Store,
    progress: &ProgressBar,
) -> Result<Vec<Reference>, HostError> {
    let mut exposure = None;
    let mut references = Vec::new();
    for &frame in &plan.frames {
        let halves = [
            half(frames, plan, store, progress, frame, 0)?,
            half(frames, plan, store, progress, frame, 1)?,
        ];
        frames.clear();
        let pairs = halves[0].pixels().iter().zip(halves[1].pixels());
        let mean = pairs.map(|(a, b)| std::array::from_fn(|k| (a[k] + b[k]) * 0.5));
        let film = Film::new(plan.width, plan.height, mean.collect())?;
        let exposure = *exposure.get_or_insert_with(|| film.auto_exposure());
        let shown = halves.each_ref().map(|half| half.shown(exposure));
        let noise = Noise {
            frame,
            samples: plan.reference_samples,
            mse: mean_squared_error(shown[0].as_chunks::<3>().0, shown[1].as_chunks::<3>().0) / 4.0,
            linear_mse: mean_squared_error(halves[0].pixels(), halves[1].pixels()) / 4.0,
        };
        references.push(Reference {
            judge: Judge::new(film, exposure)?,
            noise,
        });
    }
    Ok(references)
}

fn entry(frames: &mut Frames<'_>, plan: &Plan, frame: u32, half: u32) -> (String, Value) {
    let scene = frames.scene().name();
    // Different for every change of a kernel that changes what it does.
    let kernels: Vec<u8> = KERNELS.iter().flat_map(|kernel| kernel.bytes).copied().collect();
    let key = json!({
        "what": "reference", "kernels": fingerprint(&kernels), "scene": scene, "print": frames.print(frame),
        "frame": frame, "width": plan.width, "height": plan.height, "samples": plan.reference_samples / 2,
        "half": half,
    });
    (format!("{}/reference-f{frame:03}-half{half}", stem(scene)), key)
}

fn half(
    frames: &mut Frames<'_>,
    plan: &Plan,
    store: &Store,
    progress: &ProgressBar,
    frame: u32,
    half: u32,
) -> Result<Film, HostError> {
    let (name, key) = entry(frames, plan, frame, half);
    if let Some(film) = store.load_image(&name, &key, plan.size()) {
        progress.inc(plan.work(plan.reference_samples / 2));
        return Ok(film);
    }
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
    let film = Film::new(plan.width, plan.height, pixels.collect())?;
    store.save_image(&name, &key, &film)?;
    Ok(film)
}

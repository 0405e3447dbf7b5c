//! The image that all methods are measured against, in two halves that tell its own noise.

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::job::Job;
use super::subject::Subject;
use crate::error::HostError;
use crate::method::{Method, MethodLight, Target};
use crate::metrics::{Judge, mean_squared_error};
use crate::render::Film;
use crate::workload::RenderSettings;

/// Samples of one pass.
const PASS: u32 = 64;
/// Seeds from here on belong to references, so that these share no random numbers with what they judge.
const FIRST_SEED: u32 = 1 << 31;
/// What renders references: unbiased, and it takes every kind of light.
const METHOD: Method = Method::TwoLevelMoments;

/// What a reference's own noise adds to the error of every image that is measured against it: the variance of the mean of its
/// halves is a quarter of their mean squared difference.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Noise {
    /// Shadow rays per pixel.
    pub samples: u32,
    /// Of the displayed bytes, 0 to 255².
    pub mse: f64,
    /// Of radiance.
    pub linear_mse: f64,
}

/// A reference, displayed at the exposure that all images have.
pub(super) struct Reference {
    pub judge: Judge,
    pub noise: Noise,
    /// What is worth a word: how little of it is lit.
    pub darkness: Option<String>,
}

impl Reference {
    pub fn of<L: MethodLight>(job: &Job<'_>, subject: &Subject<'_, L>) -> Result<Self, HostError> {
        let halves = [half(job, subject, 0)?, half(job, subject, 1)?];
        let pairs = halves[0].pixels().iter().zip(halves[1].pixels());
        let mean = pairs.map(|(a, b)| std::array::from_fn(|k| (a[k] + b[k]) * 0.5));
        let film = Film::new(job.plan.width, job.plan.height, mean.collect())?;
        let exposure = film.auto_exposure();
        let shown = halves.each_ref().map(|half| half.shown(exposure));
        Ok(Self {
            noise: Noise {
                samples: job.plan.reference_samples,
                mse: mean_squared_error(shown[0].as_chunks::<3>().0, shown[1].as_chunks::<3>().0) / 4.0,
                linear_mse: mean_squared_error(halves[0].pixels(), halves[1].pixels()) / 4.0,
            },
            darkness: film.darkness(),
            judge: Judge::new(film, exposure)?,
        })
    }
}

fn half<L: MethodLight>(job: &Job<'_>, subject: &Subject<'_, L>, half: u32) -> Result<Film, HostError> {
    let all = job.plan.reference_samples / 2;
    let mut key = job.key();
    key["what"] = Value::from("reference");
    key["samples"] = all.into();
    key["half"] = half.into();
    let name = job.name(&format!("reference-half{half}"));
    if let Some(film) = job
        .store
        .load_image(&name, &key, (job.plan.width, job.plan.height))
    {
        job.progress.inc(1);
        return Ok(film);
    }
    job.says("reference");
    let mut runner = METHOD
        .recipe()
        .runner(&subject.step(subject.frame), Target::Cpu)?;
    let mut sum = vec![[0.0_f64; 3]; job.plan.width as usize * job.plan.height as usize];
    for (pass, first) in (0..).zip((0..all).step_by(PASS as usize)) {
        let samples = PASS.min(all - first);
        let settings = RenderSettings {
            samples,
            ..job.settings(subject.frame, FIRST_SEED + (half << 24) + pass)
        };
        let step = subject.step(subject.frame);
        let image = runner.image(&step, subject.arrays(subject.frame), &settings, 0)?;
        for (sum, pixel) in sum.iter_mut().flatten().zip(image.value.iter().flatten()) {
            *sum += f64::from(*pixel) * f64::from(samples);
        }
    }
    let pixels = sum.iter().map(|pixel| pixel.map(|c| (c / f64::from(all)) as f32));
    let film = Film::new(job.plan.width, job.plan.height, pixels.collect())?;
    job.store.save_image(&name, &key, &film)?;
    job.progress.inc(1);
    Ok(film)
}

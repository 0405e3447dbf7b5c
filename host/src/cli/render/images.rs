//! Images of frames in a row: by independent samples, or by ReSTIR.

use std::sync::Arc;

use lightbvh::BuildParams;
use lightbvh::exact::hash;
use lightbvh_kernels::bvh::Choice;
use serde_json::{Value, json};

use crate::backend::{CandidateSource, MAX_SAMPLES_PER_INVOCATION, RestirOptions, Sampler, SceneArrays};
use crate::error::HostError;
use crate::method::{Chain, Count, NoTree, Reservoirs, Runner, SingleLevel, Step, Target, TwoLevel};
use crate::render::Film;
use crate::workload::Shot;

/// Number of camera rays per pixel that makes edges smooth; the light samples of a pixel are shared out among them.
const MAX_CAMERA_RAYS: u32 = 8;
/// What light is followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Integrator {
    /// Reflected once.
    Direct,
    /// Reflected up to `bounces` times.
    Path {
        /// 1 to [`MAX_BOUNCES`](lightbvh_kernels::shading::path::MAX_BOUNCES).
        bounces: u32,
    },
}

impl Integrator {
    /// Into how many parts the samples of a pixel are shared out, each with a camera ray of its own: of light samples, as
    /// few as make edges smooth; of paths, one part each. A part is one invocation on a device.
    fn parts(self, samples: u32) -> u32 {
        let fits =
            |&parts: &u32| samples.is_multiple_of(parts) && samples / parts <= MAX_SAMPLES_PER_INVOCATION;
        match self {
            Self::Direct if samples <= MAX_CAMERA_RAYS => samples,
            Self::Direct => (MAX_CAMERA_RAYS..=samples).find(fits).unwrap_or(samples),
            Self::Path { .. } => samples,
        }
    }
}

/// How a pixel's light is sampled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Method {
    /// Samples that know nothing of each other.
    Independent {
        /// How lights are chosen.
        sampler: Sampler,
        /// Whether a single level is built anew in every frame.
        rebuilt: bool,
        /// What light is followed.
        integrator: Integrator,
    },
    /// Samples resampled over pixels and frames.
    Restir(RestirOptions),
}

impl Method {
    /// Whether the method chooses lights by the power table.
    pub(super) fn needs_power_table(self) -> bool {
        match self {
            Self::Independent { sampler, .. } => sampler == Sampler::Power,
            Self::Restir(options) => options.source == CandidateSource::Power,
        }
    }

    /// What a report says of it besides its name.
    pub(super) fn report(self) -> Option<Value> {
        match self {
            Self::Independent { .. } => None,
            Self::Restir(options) => Some(json!({
                "mode": options.combination.name(),
                "unbiased": options.combination.is_unbiased(),
                "candidates": options.candidates,
                "most_shadow_rays_per_sample": options.most_shadow_rays(),
            })),
        }
    }
}

/// An image and what it cost.
pub(super) struct Image {
    pub film: Film,
    pub seconds: f64,
    /// Shadow rays per pixel that were traced for it, where they are counted.
    pub shadow_rays: Option<f64>,
}

/// All images are of one sequence.
const CHAIN: Chain = 0;

/// Renders a scene frame after frame.
pub(super) struct Images<'d> {
    runner: Box<dyn Runner + 'd>,
    /// Of single images; `None` for ReSTIR.
    independent: Option<(Sampler, Integrator)>,
    started: bool,
}

impl<'d> Images<'d> {
    /// The images of `method` on `target` from the frame `first` on, by light BVHs of choice `C`.
    pub fn new<C: Choice<W>, const W: usize>(
        method: Method,
        params: BuildParams,
        target: Target<'d>,
        first: &Step<'_>,
    ) -> Result<Self, HostError> {
        let runner: Box<dyn Runner + 'd> = match method {
            Method::Independent { sampler, rebuilt, .. } => match sampler {
                Sampler::Uniform => Box::new(NoTree::uniform(first, target)?),
                Sampler::Power => Box::new(NoTree::power(first, target)?),
                Sampler::SingleLevel if rebuilt => {
                    Box::new(SingleLevel::<C, W>::rebuilt(first, target, params)?)
                }
                Sampler::SingleLevel => Box::new(SingleLevel::<C, W>::refitted(first, target, params)?),
                Sampler::TwoLevel => Box::new(TwoLevel::<C, W>::new(first, target, params)?),
            },
            Method::Restir(options) => {
                let count = Count::Histories;
                Box::new(Reservoirs::<C, W>::new(first, target, options, params, count)?)
            }
        };
        let independent = match method {
            Method::Independent {
                sampler, integrator, ..
            } => Some((sampler, integrator)),
            Method::Restir(_) => None,
        };
        Ok(Self {
            runner,
            independent,
            started: false,
        })
    }

    /// The image of the first frame, then of each next one.
    pub fn next(
        &mut self,
        step: &Step<'_>,
        arrays: &Arc<SceneArrays>,
        shot: &Shot,
    ) -> Result<Image, HostError> {
        if self.started {
            self.runner.advance(step)?;
        }
        self.started = true;
        if let (Some((sampler, integrator)), Some(backend)) = (self.independent, self.runner.backend()) {
            let parts = integrator.parts(shot.samples);
            let mut sum = Sum::new(shot, parts);
            for part in 0..parts {
                let mut params = shot.params(step.scene.data().background);
                params.samples = shot.samples / parts;
                params.seed = hash(shot.seed).wrapping_add(part);
                params.jitter = part;
                let image = match integrator {
                    Integrator::Direct => backend.render(arrays, &params, sampler)?,
                    Integrator::Path { bounces } => backend.render_path(arrays, &params, bounces, sampler)?,
                };
                sum.add(&image.value, image.time.as_secs_f64());
            }
            return sum.image();
        }
        let image = self.runner.image(step, arrays, shot, CHAIN)?;
        let pixels = f64::from(shot.width) * f64::from(shot.height);
        Ok(Image {
            film: Film::new(shot.width, shot.height, image.value)?,
            seconds: image.time.as_secs_f64(),
            shadow_rays: self.runner.shadow_rays(CHAIN).map(|rays| rays as f64 / pixels),
        })
    }
}

/// The mean of images.
struct Sum {
    size: (u32, u32),
    pixels: Vec<[f32; 3]>,
    share: f32,
    seconds: f64,
}

impl Sum {
    fn new(shot: &Shot, parts: u32) -> Self {
        Self {
            size: (shot.width, shot.height),
            pixels: vec![[0.0; 3]; shot.width as usize * shot.height as usize],
            share: parts as f32,
            seconds: 0.0,
        }
    }

    fn add(&mut self, part: &[[f32; 3]], seconds: f64) {
        self.seconds += seconds;
        for (sum, part) in self.pixels.iter_mut().zip(part) {
            for k in 0..3 {
                sum[k] += part[k] / self.share;
            }
        }
    }

    fn image(self) -> Result<Image, HostError> {
        Ok(Image {
            film: Film::new(self.size.0, self.size.1, self.pixels)?,
            seconds: self.seconds,
            shadow_rays: None,
        })
    }
}

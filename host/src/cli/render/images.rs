//! Images of frames in a row: by independent samples, or by ReSTIR.

use std::sync::Arc;

use lightbvh::BuildParams;
use lightbvh::exact::hash;
use serde_json::{Value, json};

use crate::backend::{
    Backend, Bvh, CandidateSource, CpuBackend, CpuRestir, DeviceBackend, DeviceRestir,
    MAX_SAMPLES_PER_INVOCATION, Restir, RestirFrame, RestirOptions, Sampler, SceneArrays, picker,
};
use crate::render::Film;
use crate::vulkan::{Device, VulkanError};
use crate::workload::{Shot, build};

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

/// Renders a scene frame after frame.
pub(super) trait Images {
    /// The next frame.
    fn next(
        &mut self,
        arrays: &Arc<SceneArrays>,
        shot: &Shot,
        background: [f32; 3],
    ) -> Result<Image, VulkanError>;
}

/// The images of `method`, on `device` or, without one, on the CPU, from a frame with the lights of `first` on.
pub(super) fn images<'d>(
    method: Method,
    heuristic: &BuildParams,
    device: Option<&'d Device>,
    first: &SceneArrays,
    samples: u32,
) -> Result<Box<dyn Images + 'd>, VulkanError> {
    let sampler = match method {
        Method::Independent { sampler, .. } => sampler,
        Method::Restir(_) => Sampler::TwoLevel,
    };
    let bvh = build(&first.lights, sampler, heuristic);
    Ok(match method {
        Method::Independent { sampler, integrator } => Box::new(Independent {
            sampler,
            integrator,
            backend: match device {
                Some(device) => Box::new(DeviceBackend::new(device, &bvh, &first.lights)?),
                None => Box::new(CpuBackend::new(bvh, first.lights.clone())),
            },
            started: false,
        }),
        Method::Restir(options) => Box::new(Histories {
            bvh,
            histories: (0..samples)
                .map(|_| -> Box<dyn Restir + 'd> {
                    match device {
                        Some(device) => Box::new(DeviceRestir::new(device, options)),
                        None => Box::new(CpuRestir::new(options)),
                    }
                })
                .collect(),
            started: false,
        }),
    })
}

/// Images by a backend; its light BVH is refitted from frame to frame.
struct Independent<'d> {
    sampler: Sampler,
    integrator: Integrator,
    backend: Box<dyn Backend + 'd>,
    started: bool,
}

impl Images for Independent<'_> {
    fn next(
        &mut self,
        arrays: &Arc<SceneArrays>,
        shot: &Shot,
        background: [f32; 3],
    ) -> Result<Image, VulkanError> {
        if self.started {
            self.backend.refit(&arrays.lights)?;
        }
        self.started = true;
        let parts = self.integrator.parts(shot.samples);
        let mut sum = Sum::new(shot, parts);
        for part in 0..parts {
            let mut params = shot.params(background);
            params.samples = shot.samples / parts;
            params.seed = hash(shot.seed).wrapping_add(part);
            params.jitter = part;
            let image = match self.integrator {
                Integrator::Direct => self.backend.render(arrays, &params, self.sampler)?,
                Integrator::Path { bounces } => {
                    self.backend.render_path(arrays, &params, bounces, self.sampler)?
                }
            };
            sum.add(&image.value, image.time.as_secs_f64());
        }
        Ok(sum.image(None))
    }
}

/// As many histories of ReSTIR as samples are wanted, independent of each other; each looks at its own points in the
/// pixels, the same in every frame.
struct Histories<'d> {
    bvh: Bvh,
    histories: Vec<Box<dyn Restir + 'd>>,
    started: bool,
}

impl Images for Histories<'_> {
    fn next(
        &mut self,
        arrays: &Arc<SceneArrays>,
        shot: &Shot,
        background: [f32; 3],
    ) -> Result<Image, VulkanError> {
        if self.started {
            self.bvh.refit(&arrays.lights);
        }
        self.started = true;
        let mut sum = Sum::new(shot, self.histories.len() as u32);
        let mut shadow_rays = 0;
        for (number, history) in (0..).zip(&mut self.histories) {
            let part = history.frame(&RestirFrame {
                scene: arrays,
                bvh: picker(&self.bvh),
                width: shot.width,
                height: shot.height,
                seed: hash(hash(shot.seed).wrapping_add(number)).wrapping_add(shot.frame),
                jitter: number,
                background,
                remap: None,
            })?;
            shadow_rays += history.shadow_rays();
            sum.add(&part.value, part.time.as_secs_f64());
        }
        let pixels = f64::from(shot.width) * f64::from(shot.height);
        Ok(sum.image(Some(shadow_rays as f64 / pixels)))
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

    fn image(self, shadow_rays: Option<f64>) -> Image {
        Image {
            film: Film::new(self.size.0, self.size.1, self.pixels).expect("as many pixels as the image has"),
            seconds: self.seconds,
            shadow_rays,
        }
    }
}

//! The measurements: every method over the animation of a scene on one backend, one after the other, so that background
//! builds have the time they would have in an application.

use std::collections::BTreeMap;
use std::hash::{DefaultHasher, Hasher};

use bytemuck::cast_slice;
use lightbvh::BuildParams;

use super::plan::{Args, TIMED};
use crate::backend::{Backend, Bvh, CpuBackend, Integrator, Sampler, SceneArrays};
use crate::cli::measure::reference::Reference;
use crate::cli::measure::times::ms;
use crate::error::HostError;
use crate::method::{Method, Step, Target, UpdateTimes};
use crate::metrics::Quality;
use crate::render::Film;
use crate::scene::Scene;
use crate::workload::{arrays_at, build, lights_at, render_params};

/// Seeds from here on belong to references, so that these share no random numbers with the images measured against them.
const FIRST_SEED: u32 = 1 << 31;
/// Seed of images that are rendered for their time.
const TIMING_SEED: u32 = FIRST_SEED - 1;

/// Results of the methods on one backend.
#[derive(Clone, Default)]
pub(super) struct Results {
    /// By method, frame and seed: how good an image is, and the hash of its words, equal on all exact devices.
    pub images: BTreeMap<(Method, u32, u32), (Quality, u64)>,
    /// By method: refit, rebuild, wait and image of each timed frame, ms.
    pub times: BTreeMap<Method, Vec<[f64; 4]>>,
}

impl Results {
    /// Number of images that others have with other words.
    pub fn different_from(&self, others: &Self) -> u64 {
        let differs = |(key, own): &(&(Method, u32, u32), &(Quality, u64))| {
            others.images.get(key).is_some_and(|other| other.1 != own.1)
        };
        self.images.iter().filter(differs).count() as u64
    }
}

/// A scene, with the arrays of frames that images are rendered of.
pub(super) struct Job<'a> {
    plan: &'a Args,
    scene: &'a Scene,
    arrays: BTreeMap<u32, SceneArrays>,
    /// Of the measured frames, displayed at the exposure of the first.
    pub references: BTreeMap<u32, Reference>,
}

impl<'a> Job<'a> {
    /// Renders the references.
    pub fn new(plan: &'a Args, scene: &'a Scene) -> Result<Self, HostError> {
        let rendered = (0..=plan.last()).filter(|&frame| plan.is_rendered(frame));
        let arrays = rendered.map(|frame| Ok((frame, arrays_at(scene, frame, plan.width, plan.height)?)));
        let arrays = arrays.collect::<Result<BTreeMap<_, _>, HostError>>()?;
        let mut references: BTreeMap<u32, Reference> = BTreeMap::new();
        for &frame in &plan.frames {
            let arrays = &arrays[&frame];
            let bvh: Bvh = build(&arrays.lights, Sampler::TwoLevel, &BuildParams::default());
            let mut cpu: CpuBackend = CpuBackend::new(bvh);
            let mut half = |half| {
                let samples = plan.reference_samples / 2;
                let background = scene.data().background;
                let params = render_params(plan.size(), samples, FIRST_SEED + half, background);
                cpu.render(arrays, &params, Sampler::TwoLevel, Integrator::Direct)
            };
            let halves = [half(0)?.value, half(1)?.value];
            let exposure = references.values().next().map(|first| first.judge.exposure());
            references.insert(frame, Reference::new(plan.size(), halves, exposure)?);
        }
        Ok(Self {
            plan,
            scene,
            arrays,
            references,
        })
    }

    /// Runs a method over all frames, with the given number of images of each measured frame.
    pub fn run(
        &self,
        method: Method,
        target: Target<'_>,
        seeds: u32,
        results: &mut Results,
    ) -> Result<(), HostError> {
        let (plan, scene) = (self.plan, self.scene);
        let first = lights_at(scene, 0)?;
        let mut runner = method.recipe().runner(&Step::new(scene, 0, &first), target)?;
        for frame in 0..=plan.last() {
            let lights = lights_at(scene, frame)?;
            let step = Step::new(scene, frame, &lights);
            // The first frame's structures are built already.
            let update = match frame {
                0 => UpdateTimes::default(),
                _ => runner.advance(&step)?,
            };
            let Some(arrays) = self.arrays.get(&frame) else {
                continue;
            };
            let mut image = |seed| {
                let params = render_params(plan.size(), plan.samples, seed, scene.data().background);
                runner.image(&step, arrays, &params)
            };
            if frame + TIMED >= plan.last() {
                let image = ms(image(TIMING_SEED)?.time);
                // A build beside the first of them had no image to run beside.
                if frame > 0 && frame + TIMED > plan.last() {
                    let [refit, rebuild, wait] = [update.refit, update.rebuild, update.wait].map(ms);
                    let times = results.times.entry(method).or_default();
                    times.push([refit, rebuild, wait, image]);
                }
            }
            let Some(reference) = self.references.get(&frame) else {
                continue;
            };
            for seed in 0..seeds {
                let image = image(seed)?.value;
                let mut words = DefaultHasher::new();
                words.write(cast_slice(&image));
                let film = Film::new(plan.width, plan.height, image)?;
                let quality = reference.judge.judge(&film)?.quality;
                let own = (quality, words.finish());
                results.images.insert((method, frame, seed), own);
            }
        }
        Ok(())
    }
}

//! The measurements: every method over the animation of a scene on one backend.

use std::collections::BTreeMap;
use std::hash::{DefaultHasher, Hasher};
use std::time::Duration;

use bytemuck::cast_slice;
use indicatif::ProgressBar;

use super::frames::Frames;
use super::plan::{BLOCK, Plan};
use crate::cli::measure::reference::Reference;
use crate::cli::measure::times::ms;
use crate::error::HostError;
use crate::method::{Method, Runner, Target, UpdateTimes};
use crate::metrics::Quality;
use crate::render::Film;
use crate::workload::RenderSettings;

/// Seed of images that are rendered for their time.
const TIMING_SEED: u32 = (1 << 31) - 1;

/// The times of a frame, milliseconds.
#[derive(Clone, Copy, Debug)]
pub(super) struct FrameTimes {
    pub refit_ms: f64,
    pub rebuild_ms: f64,
    pub wait_ms: f64,
    pub image_ms: f64,
}

/// What there is to know about the methods on one backend.
#[derive(Default)]
pub(super) struct Results {
    /// By method, frame and seed: how good an image is, and the hash of its words, equal on all exact devices.
    pub images: BTreeMap<(Method, u32, u32), (Quality, u64)>,
    pub times: BTreeMap<Method, Vec<FrameTimes>>,
    /// The images of the last frame with the first seed.
    pub films: BTreeMap<Method, Film>,
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

/// One scene on one backend.
pub(super) struct Job<'a, 'd> {
    pub plan: &'a Plan,
    pub references: &'a [Reference],
    pub target: Target<'d>,
    /// Images per frame, and blocks that are timed.
    pub seeds: u32,
    pub blocks: Vec<u32>,
    pub progress: &'a ProgressBar,
}

/// A method at work.
struct Lane<'d> {
    method: Method,
    runner: Option<Box<dyn Runner + 'd>>,
}

impl<'d> Job<'_, 'd> {
    /// Measures all methods.
    pub fn run(&self, frames: &mut Frames<'_>) -> Result<Results, HostError> {
        let mut results = Results::default();
        let lane = |&method: &Method| Lane { method, runner: None };
        let mut lanes: Vec<Lane<'d>> = self.plan.methods.iter().map(lane).collect();
        for block in 0..=self.plan.last() / BLOCK {
            for lane in &mut lanes {
                self.block(lane, block, frames, &mut results)?;
            }
            frames.clear();
        }
        Ok(results)
    }

    /// One method over one block of frames.
    fn block(
        &self,
        lane: &mut Lane<'d>,
        block: u32,
        frames: &mut Frames<'_>,
        results: &mut Results,
    ) -> Result<(), HostError> {
        let is_timed = self.blocks.contains(&block);
        let mut times = Vec::new();
        for frame in block * BLOCK..=self.plan.last().min(block * BLOCK + BLOCK - 1) {
            let runner = match &mut lane.runner {
                Some(runner) => runner,
                none => {
                    frames.prepare(frame, false)?;
                    let recipe = lane.method.recipe();
                    none.insert(recipe.runner(&frames.step(frame), self.target)?)
                }
            };
            let is_shown = self.plan.frames.contains(&frame);
            let idle = !is_shown && !is_timed;
            if idle && (frame == 0 || runner.may_skip()) {
                continue;
            }
            frames.prepare(frame, !idle)?;
            let step = frames.step(frame);
            // What begins at frame 0 is there already.
            let update = if frame == 0 {
                UpdateTimes::default()
            } else {
                runner.advance(&step)?
            };
            if idle {
                continue;
            }
            let (scene, method) = (step.scene.name(), lane.method.name());
            self.progress.set_message(format!(
                "{scene} frame {frame}: {method} on {}",
                self.target.name()
            ));
            let arrays = frames.arrays(frame);
            if is_timed {
                let image = runner.image(&step, arrays, &self.settings(frame, TIMING_SEED))?;
                self.progress.inc(self.plan.work(self.plan.samples));
                // The first frame of a block follows other methods' work, see `BLOCK`.
                if frame > block * BLOCK {
                    times.push(FrameTimes::new(&update, image.time));
                }
            }
            for seed in 0..if is_shown { self.seeds } else { 0 } {
                let image = runner.image(&step, arrays, &self.settings(frame, seed))?;
                self.progress.inc(self.plan.work(self.plan.samples));
                self.keep((lane.method, frame, seed), image.value, results)?;
            }
        }
        if is_timed {
            results.times.entry(lane.method).or_default().extend(times);
        }
        Ok(())
    }

    /// Measures an image.
    fn keep(
        &self,
        (method, frame, seed): (Method, u32, u32),
        image: Vec<[f32; 3]>,
        results: &mut Results,
    ) -> Result<(), HostError> {
        let mut words = DefaultHasher::new();
        words.write(cast_slice(&image));
        let film = Film::new(self.plan.width, self.plan.height, image)?;
        let at = self.plan.frames.iter().position(|&own| own == frame);
        let quality = self.references[at.unwrap_or(0)].judge.quality(&film)?;
        // For close-ups.
        if frame == self.plan.last() && seed == 0 {
            results.films.insert(method, film);
        }
        results
            .images
            .insert((method, frame, seed), (quality, words.finish()));
        Ok(())
    }

    fn settings(&self, frame: u32, seed: u32) -> RenderSettings {
        RenderSettings {
            frame,
            width: self.plan.width,
            height: self.plan.height,
            samples: self.plan.samples,
            seed,
        }
    }
}

impl FrameTimes {
    fn new(update: &UpdateTimes, image: Duration) -> Self {
        Self {
            refit_ms: ms(update.refit),
            rebuild_ms: ms(update.rebuild),
            wait_ms: ms(update.wait),
            image_ms: ms(image),
        }
    }

    /// The whole frame: what the frame's own thread does, one after the other.
    pub fn frame_ms(&self) -> f64 {
        self.refit_ms + self.wait_ms + self.image_ms
    }
}

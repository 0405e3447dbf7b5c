//! The measurements: every method over the animation of a scene on one backend.

use std::collections::BTreeMap;
use std::time::Duration;

use bytemuck::cast_slice;
use serde::{Deserialize, Serialize};

use super::frames::Frames;
use super::job::{Job, Wanted};
use super::plan::BLOCK;
use super::store::fingerprint;
use crate::cli::times::ms;
use crate::error::HostError;
use crate::method::{Method, Runner, SequenceId, UpdateTimes, runner};
use crate::metrics::Quality;
use crate::render::Film;
use crate::workload::RenderSettings;

/// Seed of images that are rendered for their time.
const TIMING_SEED: u32 = (1 << 31) - 1;

/// An image as measured.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Measured {
    pub quality: Quality,
    /// Fingerprint of the image's words: equal on all exact devices.
    pub words: String,
}

/// The times of a frame, milliseconds.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(super) struct FrameTimes {
    pub frame: u32,
    pub refit_ms: f64,
    pub rebuild_ms: f64,
    pub wait_ms: f64,
    pub image_ms: f64,
}

/// What there is to know about the methods on one backend.
#[derive(Default)]
pub(super) struct Results {
    /// By method, frame and seed.
    pub images: BTreeMap<(Method, u32, u32), Measured>,
    pub times: BTreeMap<Method, Vec<FrameTimes>>,
    /// The images of the last frame with the first seed.
    pub films: BTreeMap<Method, Film>,
    /// Results computed and results found.
    pub computed: u64,
    pub reused: u64,
}

impl Results {
    /// Number of images that others have with other words.
    pub fn different_from(&self, others: &Self) -> u64 {
        let differs = |(key, own): &(&(Method, u32, u32), &Measured)| {
            others
                .images
                .get(key)
                .is_some_and(|other| other.words != own.words)
        };
        self.images.iter().filter(differs).count() as u64
    }
}

/// A method at work, and what is still wanted of it.
struct Lane<'d> {
    method: Method,
    runner: Option<Box<dyn Runner + 'd>>,
    images: Vec<Wanted>,
    blocks: Vec<Wanted>,
}

impl<'d> Job<'_, 'd> {
    /// Measures what is not known yet.
    pub fn run(&self, frames: &mut Frames<'_>) -> Result<Results, HostError> {
        let mut results = Results::default();
        let mut lanes = self.lanes(frames, &mut results);
        for block in 0..=self.plan.last() / BLOCK {
            for lane in &mut lanes {
                self.block(lane, block, frames, &mut results)?;
            }
            frames.clear();
        }
        for times in results.times.values_mut() {
            times.sort_by_key(|times| times.frame);
        }
        Ok(results)
    }

    /// The methods of which something is unknown; what is known goes into `results`.
    fn lanes(&self, frames: &mut Frames<'_>, results: &mut Results) -> Vec<Lane<'d>> {
        let mut lanes = Vec::new();
        for &method in &self.plan.methods {
            let mut lane = Lane {
                method,
                runner: None,
                images: Vec::new(),
                blocks: Vec::new(),
            };
            for (&frame, reference) in self.plan.frames.iter().zip(self.references) {
                for seed in 0..self.seeds {
                    let wanted = self.wanted_image(frames, method, frame, seed, reference);
                    if !self.find(&wanted, method, results) {
                        lane.images.push(wanted);
                    }
                }
            }
            for &block in &self.blocks {
                let wanted = self.wanted_times(frames, method, block);
                match self.store.load::<Vec<FrameTimes>>(&wanted.name, &wanted.key) {
                    Some(times) => {
                        results.times.entry(method).or_default().extend(times);
                        results.reused += 1;
                        self.progress
                            .inc(u64::from(BLOCK) * self.plan.work(self.plan.samples));
                    }
                    None => lane.blocks.push(wanted),
                }
            }
            if !(lane.images.is_empty() && lane.blocks.is_empty()) {
                lanes.push(lane);
            }
        }
        lanes
    }

    /// One method over one block of frames.
    fn block(
        &self,
        lane: &mut Lane<'d>,
        block: u32,
        frames: &mut Frames<'_>,
        results: &mut Results,
    ) -> Result<(), HostError> {
        let timed = lane.blocks.iter().find(|wanted| wanted.at == block);
        let mut times = Vec::new();
        for frame in block * BLOCK..=self.plan.last().min(block * BLOCK + BLOCK - 1) {
            let runner = match &mut lane.runner {
                Some(runner) => runner,
                none => {
                    frames.prepare(frame, false)?;
                    none.insert(runner(lane.method, &frames.step(frame), self.target)?)
                }
            };
            let history = runner.history();
            let counts = |wanted: &&Wanted| (wanted.at.saturating_sub(history)..=wanted.at).contains(&frame);
            let images: Vec<&Wanted> = lane.images.iter().filter(counts).collect();
            let idle = images.is_empty() && timed.is_none();
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
            if timed.is_some() {
                let image =
                    runner.image(&step, arrays, &self.settings(frame, TIMING_SEED), SequenceId::MAX)?;
                self.progress.inc(self.plan.work(self.plan.samples));
                // The first frame of a block follows other methods' work, see `BLOCK`.
                if frame > block * BLOCK {
                    times.push(FrameTimes::new(frame, &update, image.time));
                }
            }
            for wanted in images {
                let chain = u64::from(wanted.at) << 32 | u64::from(wanted.seed);
                let image = runner.image(&step, arrays, &self.settings(frame, wanted.seed), chain)?;
                self.progress.inc(self.plan.work(self.plan.samples));
                if frame == wanted.at {
                    runner.end(chain);
                    self.keep(wanted, lane.method, image.value, results)?;
                } else {
                    self.progress.inc_length(self.plan.work(self.plan.samples));
                }
            }
        }
        if let Some(wanted) = timed {
            if let Some(runner) = &mut lane.runner {
                runner.end(SequenceId::MAX);
            }
            self.store.save(&wanted.name, &wanted.key, &times)?;
            results.times.entry(lane.method).or_default().extend(times);
            results.computed += 1;
        }
        Ok(())
    }

    /// Measures an image and keeps what came out.
    fn keep(
        &self,
        wanted: &Wanted,
        method: Method,
        image: Vec<[f32; 3]>,
        results: &mut Results,
    ) -> Result<(), HostError> {
        let words = fingerprint(cast_slice(&image));
        let film = Film::new(self.plan.width, self.plan.height, image)?;
        let at = self.plan.frames.iter().position(|&frame| frame == wanted.at);
        let judge = &self.references[at.unwrap_or(0)].judge;
        let quality = judge.quality(&film)?;
        let measured = Measured { quality, words };
        // The image first: a result whose image is missing is computed again.
        if self.keeps_film(wanted) {
            self.store.save_image(&wanted.name, &wanted.key, &film)?;
            results.films.insert(method, film);
        }
        self.store.save(&wanted.name, &wanted.key, &measured)?;
        results.images.insert((method, wanted.at, wanted.seed), measured);
        results.computed += 1;
        Ok(())
    }

    /// Takes over a result that is known.
    fn find(&self, wanted: &Wanted, method: Method, results: &mut Results) -> bool {
        let Some(measured) = self.store.load(&wanted.name, &wanted.key) else {
            return false;
        };
        if self.keeps_film(wanted) {
            let Some(film) = self.store.load_image(&wanted.name, &wanted.key, self.plan.size()) else {
                return false;
            };
            results.films.insert(method, film);
        }
        results.images.insert((method, wanted.at, wanted.seed), measured);
        results.reused += 1;
        self.progress.inc(self.plan.work(self.plan.samples));
        true
    }

    /// Whether the image itself is wanted, for close-ups.
    fn keeps_film(&self, wanted: &Wanted) -> bool {
        wanted.at == self.plan.last() && wanted.seed == 0
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
    fn new(frame: u32, update: &UpdateTimes, image: Duration) -> Self {
        Self {
            frame,
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

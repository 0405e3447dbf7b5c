//! The measurements: every method over the animation of a scene on one backend.

use std::collections::BTreeMap;
use std::hash::{DefaultHasher, Hasher};

use bytemuck::cast_slice;
use indicatif::ProgressBar;

use super::plan::{Args, BLOCK};
use crate::backend::SceneArrays;
use crate::cli::measure::reference::Reference;
use crate::cli::measure::times::ms;
use crate::error::HostError;
use crate::method::{Method, Runner, Step, Target, UpdateTimes};
use crate::metrics::Quality;
use crate::render::Film;
use crate::scene::Scene;
use crate::workload::{arrays_at, render_params};

/// Seed of images that are rendered for their time.
const TIMING_SEED: u32 = (1 << 31) - 1;

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

/// One scene on one backend.
pub(super) struct Job<'a, 'd> {
    pub plan: &'a Args,
    pub scene: &'a Scene,
    pub references: &'a [Reference],
    pub target: Target<'d>,
    /// Images per frame, and blocks that are timed.
    pub seeds: u32,
    pub blocks: Vec<u32>,
    pub progress: &'a ProgressBar,
}

type Lane<'d> = (Method, Option<Box<dyn Runner + 'd>>);

impl<'d> Job<'_, 'd> {
    /// Measures all methods, block by block.
    pub fn run(&self) -> Result<Results, HostError> {
        let mut results = Results::default();
        let mut lanes: Vec<Lane<'d>> = self.plan.method.iter().map(|&method| (method, None)).collect();
        for block in 0..=self.plan.last() / BLOCK {
            let mut arrays = BTreeMap::new();
            for lane in &mut lanes {
                self.block(lane, block, &mut arrays, &mut results)?;
                self.progress.inc(1);
            }
        }
        Ok(results)
    }

    /// One method over one block of frames, whose arrays all methods share.
    fn block(
        &self,
        (method, lane): &mut Lane<'d>,
        block: u32,
        arrays: &mut BTreeMap<u32, SceneArrays>,
        results: &mut Results,
    ) -> Result<(), HostError> {
        let (plan, scene) = (self.plan, self.scene);
        let is_timed = self.blocks.contains(&block);
        for frame in block * BLOCK..=plan.last().min(block * BLOCK + BLOCK - 1) {
            let shown = plan.frames.iter().position(|&own| own == frame);
            let arrays = match arrays.entry(frame) {
                std::collections::btree_map::Entry::Occupied(own) => own.into_mut(),
                std::collections::btree_map::Entry::Vacant(none) => {
                    none.insert(arrays_at(scene, frame, plan.width, plan.height)?)
                }
            };
            let step = Step::new(scene, frame, &arrays.lights);
            // The first frame's structures are built already.
            let update = match lane.as_mut() {
                Some(runner) => runner.advance(&step)?,
                None => UpdateTimes::default(),
            };
            if lane.is_none() {
                *lane = Some(method.recipe().runner(&step, self.target)?);
            }
            let Some(runner) = lane.as_mut() else { continue };
            let (name, on) = (method.name(), self.target.name());
            self.progress
                .set_message(format!("{} frame {frame}: {name} on {on}", scene.name()));
            let mut image = |seed| {
                let params = render_params(plan.size(), plan.samples, seed, scene.data().background);
                runner.image(&step, arrays, &params)
            };
            if is_timed {
                let image = ms(image(TIMING_SEED)?.time);
                // The first frame of a block follows other methods' work, see `BLOCK`.
                if frame > block * BLOCK {
                    let [refit, rebuild, wait] = [update.refit, update.rebuild, update.wait].map(ms);
                    let times = results.times.entry(*method).or_default();
                    times.push([refit, rebuild, wait, image]);
                }
            }
            let Some(at) = shown else { continue };
            for seed in 0..self.seeds {
                let image = image(seed)?.value;
                let mut words = DefaultHasher::new();
                words.write(cast_slice(&image));
                let film = Film::new(plan.width, plan.height, image)?;
                let quality = self.references[at].judge.judge(&film)?.quality;
                let own = (quality, words.finish());
                results.images.insert((*method, frame, seed), own);
            }
        }
        Ok(())
    }
}

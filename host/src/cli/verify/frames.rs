//! Frames of an animation: every method brought from frame to frame on the CPU and on each device, rebuilds included, and
//! everything that it computes compared in each frame.

use std::ops::Range;

use indicatif::ProgressBar;
use lightbvh::exact::hash;
use lightbvh_kernels::query::Query;

use super::tally::{Kind, Side, Tallies};
use crate::backend::{Sampler, SceneArrays};
use crate::error::HostError;
use crate::method::{Importance, Method, MethodLight, Recipe, Runner, Step, Target};
use crate::scene::{Scene, SceneLight};
use crate::words::Record;
use crate::workload::{arrays_lit_by, queries, render_params};

/// Images are small: an animation has thousands of them, and SwiftShader takes a millisecond for a pixel of some.
const SIZE: (u32, u32) = (16, 9);

/// The work of each frame.
pub(super) struct Plan {
    pub frames: Range<u32>,
    /// Lights sampled and pmfs evaluated per frame and method.
    pub queries: u32,
    pub seed: u32,
    /// Only methods by these, and those without a light BVH.
    pub importances: &'static [Importance],
}

/// A method on the CPU and on each device.
struct Lane<'d, L: SceneLight> {
    recipe: Recipe,
    cpu: Box<dyn Runner<L> + 'd>,
    devices: Vec<Box<dyn Runner<L> + 'd>>,
}

/// Compares all methods over the frames of `scene` with `targets`, which `tallies` are of.
pub(super) fn compare<L: MethodLight>(
    scene: &Scene,
    plan: &Plan,
    targets: &[Target<'_>],
    tallies: &mut Tallies,
    progress: &ProgressBar,
) -> Result<(), HostError> {
    let mut lanes = Vec::new();
    for frame in plan.frames.clone() {
        let arrays = arrays_lit_by::<L>(scene, frame, SIZE.0, SIZE.1)?;
        let step = Step::new(scene, frame, &arrays.lights);
        let asked = queries(&arrays, hash(plan.seed.wrapping_add(frame)), 0, plan.queries);
        if lanes.is_empty() {
            lanes = start(plan, &step, &arrays, targets)?;
        } else {
            for lane in &mut lanes {
                lane.advance(&step)?;
            }
        }
        for lane in &mut lanes {
            progress.set_message(format!("{} frame {frame}: {}", scene.name(), lane.recipe.name));
            lane.compare(&step, &arrays, &asked, plan.seed, tallies)?;
        }
        progress.inc(1);
    }
    Ok(())
}

/// All methods at the first frame; those that choose by power only where there is a table for it.
fn start<'d, L: MethodLight>(
    plan: &Plan,
    step: &Step<'_, L>,
    arrays: &SceneArrays<L>,
    targets: &[Target<'d>],
) -> Result<Vec<Lane<'d, L>>, HostError> {
    let mut lanes = Vec::new();
    for recipe in Method::ALL.iter().map(|method| method.recipe()) {
        let known = L::IMPORTANCES.contains(&recipe.importance);
        let wanted = known && (!recipe.lights.needs_bvh() || plan.importances.contains(&recipe.importance));
        if wanted && (recipe.lights != Sampler::Power || !arrays.thresholds.is_empty()) {
            lanes.push(Lane {
                recipe,
                cpu: recipe.runner(step, Target::Cpu)?,
                devices: targets
                    .iter()
                    .map(|&target| recipe.runner(step, target))
                    .collect::<Result<_, _>>()?,
            });
        }
    }
    Ok(lanes)
}

impl<L: MethodLight> Lane<'_, L> {
    fn advance(&mut self, step: &Step<'_, L>) -> Result<(), HostError> {
        self.cpu.advance(step)?;
        for device in &mut self.devices {
            device.advance(step)?;
        }
        Ok(())
    }

    /// Everything that the method has at the frame last advanced to.
    fn compare(
        &mut self,
        step: &Step<'_, L>,
        arrays: &SceneArrays<L>,
        asked: &[Query],
        seed: u32,
        tallies: &mut Tallies,
    ) -> Result<(), HostError> {
        let recipe = self.recipe;
        let what = |kernel: &str| {
            let (scene, frame) = (step.scene.name(), step.frame);
            format!("{scene} {} frame {frame} {kernel}", recipe.name)
        };
        // Candidates change the image alone.
        if recipe.lights.needs_bvh() && recipe.candidates == 1 {
            let (record, expected) = nodes(&mut *self.cpu)?;
            for (device, tally) in self.devices.iter_mut().zip(&mut tallies.devices) {
                let (_, found) = nodes(&mut **device)?;
                tally.take(Kind::Nodes, &what("refit"), &record, &expected, &found)?;
            }
            let devices = self.devices.iter_mut().map(|device| device.backend());
            let mut side = Side {
                cpu: self.cpu.backend(),
                devices: devices.collect(),
            };
            let lights = (arrays.lights.triangles(), recipe.lights == Sampler::SingleLevel);
            side.compare_queries(tallies, &what, asked.to_vec(), lights)?;
        }

        let background = step.scene.data().background;
        let params = render_params(SIZE, 1, seed.wrapping_add(step.frame), background);
        let expected = self.cpu.image(step, arrays, &params)?.value;
        for (device, tally) in self.devices.iter_mut().zip(&mut tallies.devices) {
            let found = device.image(step, arrays, &params)?.value;
            tally.take_pixels(&what("render"), &expected, &found)?;
        }
        Ok(())
    }
}

/// The words of the nodes of a method that are in use.
fn nodes<L: MethodLight>(runner: &mut dyn Runner<L>) -> Result<(Record, Vec<u32>), HostError> {
    let backend = runner.backend();
    let (record, words) = (backend.node_record(), backend.nodes()?);
    Ok((record, runner.words_in_use(words)))
}

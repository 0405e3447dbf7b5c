//! Frames of an animation: every method brought from frame to frame on the CPU and on each device, rebuilds included, and
//! everything that it computes compared in each frame.

use std::ops::Range;

use lightbvh::exact::hash;
use serde::Serialize;

use crate::backend::{Integrator, PIXEL_RECORD, Sampler, SceneArrays};
use crate::cli::table::news;
use crate::error::HostError;
use crate::method::{Method, MethodLight, Recipe, Runner, Step, Target};
use crate::scene::{Scene, SceneLight};
use crate::tally::{Kind, Side, Tallies};
use crate::workload::{arrays_lit_by, queries, render_params};

/// Images are small: an animation has thousands of them, and SwiftShader takes a millisecond for a pixel of some. Those of the
/// last frame are larger.
const SIZES: [(u32, u32); 2] = [(16, 9), (48, 27)];
/// Most reflections of the paths of the last frame: enough for some to end by chance.
const BOUNCES: u32 = 5;
/// Queries answered at a time.
const BATCH: u64 = 1 << 19;
/// Methods by a light BVH of their own.
pub(super) const METHODS: u64 = 6;

/// The work of each frame.
pub(super) struct Plan {
    pub frames: Range<u32>,
    /// Lights sampled and pmfs evaluated per frame and method.
    pub queries: u64,
    pub seed: u32,
}

/// A tree in one frame, and whether every invariant of it holds.
#[derive(Debug, Serialize)]
pub(super) struct Tree {
    pub scene: String,
    pub method: &'static str,
    pub importance: &'static str,
    pub structure: Sampler,
    pub frame: u32,
    pub valid: bool,
    pub said: String,
    pub lights: usize,
    pub mesh_lights: usize,
    pub nodes: usize,
    pub depth: u32,
    pub bytes_per_light: f64,
}

/// A method on the CPU and on each device.
struct Lane<'d, L: SceneLight> {
    recipe: Recipe,
    cpu: Box<dyn Runner<L> + 'd>,
    devices: Vec<Box<dyn Runner<L> + 'd>>,
}

/// Compares all methods over the frames of `scene` with `targets`, which `tallies` are of; returns the trees.
pub(super) fn compare<L: MethodLight>(
    scene: &Scene,
    plan: &Plan,
    targets: &[Target<'_>],
    tallies: &mut Tallies,
) -> Result<Vec<Tree>, HostError> {
    let (mut lanes, mut trees) = (Vec::new(), Vec::new());
    for frame in plan.frames.clone() {
        let arrays = arrays_lit_by::<L>(scene, frame, SIZES[0].0, SIZES[0].1)?;
        let step = Step::new(scene, frame, &arrays.lights);
        if lanes.is_empty() {
            lanes = start(&step, &arrays, targets)?;
        } else {
            for lane in &mut lanes {
                lane.advance(&step)?;
            }
        }
        for lane in &mut lanes {
            lane.compare(&step, &arrays, plan, tallies)?;
            trees.extend(lane.tree(&step));
        }
        news!("{}: frame {frame} compared", scene.name());
    }
    Ok(trees)
}

/// All methods at the first frame; those that choose by power only where there is a table for it.
fn start<'d, L: MethodLight>(
    step: &Step<'_, L>,
    arrays: &SceneArrays<L>,
    targets: &[Target<'d>],
) -> Result<Vec<Lane<'d, L>>, HostError> {
    let mut lanes = Vec::new();
    for recipe in Method::ALL.iter().map(|method| method.recipe()) {
        let is_known = L::IMPORTANCES.contains(&recipe.importance);
        if is_known && (recipe.lights != Sampler::Power || !arrays.thresholds.is_empty()) {
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

impl<'d, L: MethodLight> Lane<'d, L> {
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
        plan: &Plan,
        tallies: &mut Tallies,
    ) -> Result<(), HostError> {
        let recipe = self.recipe;
        let what = |kernel: &str| {
            let (scene, frame) = (step.scene.name(), step.frame);
            format!("{scene} {} frame {frame} {kernel}", recipe.name)
        };
        // Candidates change the image alone.
        if recipe.lights.needs_bvh() && recipe.candidates == 1 {
            self.side()
                .compare_held(tallies, &what("refit"), |runner| runner.held())?;
            let lights = (arrays.lights.all(), recipe.lights == Sampler::SingleLevel);
            let seed = hash(plan.seed.wrapping_add(step.frame));
            for first in (0..plan.queries).step_by(BATCH as usize) {
                let count = u64::min(plan.queries - first, BATCH) as u32;
                let asked = queries(arrays, seed, first as u32, count);
                let mut side = Side {
                    cpu: self.cpu.backend(),
                    devices: self.devices.iter_mut().map(|device| device.backend()).collect(),
                };
                side.compare_queries(tallies, &what, asked, lights)?;
            }
        }

        let is_last = step.frame + 1 == plan.frames.end;
        let background = step.scene.data().background;
        let seed = plan.seed.wrapping_add(step.frame);
        let params = render_params(SIZES[usize::from(is_last)], 1, seed, background);
        let mut side = self.side();
        if is_last && recipe.candidates == 1 {
            let path = Integrator::Path { bounces: BOUNCES };
            side.compare(tallies, Kind::Pixels, &what("path"), &PIXEL_RECORD, |runner| {
                let backend = runner.backend();
                Ok(backend.render(arrays, &params, recipe.lights, path)?.value)
            })?;
        }
        side.compare(tallies, Kind::Pixels, &what("render"), &PIXEL_RECORD, |runner| {
            Ok(runner.image(step, arrays, &params)?.value)
        })?;
        Ok(())
    }

    fn side(&mut self) -> Side<'_, dyn Runner<L> + 'd> {
        Side {
            cpu: &mut *self.cpu,
            devices: self.devices.iter_mut().map(|device| &mut **device).collect(),
        }
    }

    fn tree(&self, step: &Step<'_, L>) -> Option<Tree> {
        let lights = step.lights.all().len();
        // Candidates change the image alone.
        let found = self.cpu.tree().filter(|_| self.recipe.candidates == 1);
        found.map(|found| Tree {
            scene: step.scene.name().to_owned(),
            method: self.recipe.name,
            importance: self.recipe.importance.name(),
            structure: self.recipe.lights,
            frame: step.frame,
            valid: found.violation.is_none(),
            said: found.violation.unwrap_or_else(|| "hold".to_owned()),
            lights,
            mesh_lights: step.lights.mesh_count(),
            nodes: found.nodes,
            depth: found.depth,
            bytes_per_light: found.bytes as f64 / lights.max(1) as f64,
        })
    }
}

//! ReSTIR (Bitterli et al. 2020): candidates by power, as in its paper, or from a light BVH.

use std::collections::BTreeMap;
use std::sync::Arc;

use lightbvh::exact::hash;
use lightbvh_kernels::bvh::Choice;

use super::moving::Moving;
use super::{Recipe, Runner, SampleBudget, SequenceId, Step, Target, UpdateTimes, mean_of, time_power_table};
use crate::backend::{Follow, History, Restir, RestirFrame, RestirOptions, SceneArrays, Timed};
use crate::error::HostError;
use crate::scene::SceneLight;
use crate::workload::RenderSettings;

/// Frames that a history runs through before the image that counts.
const HISTORY: u32 = 8;

/// ReSTIR with one history per pixel or several that know nothing of each other.
pub(super) struct Reservoirs<'d, C: Choice<W, Light: SceneLight>, const W: usize> {
    recipe: Recipe,
    options: RestirOptions,
    backend: Box<dyn Follow<C, W> + 'd>,
    moving: Moving<C, W>,
    sequences: BTreeMap<SequenceId, Vec<Restir<C::Light>>>,
}

impl<'d, C: Choice<W, Light: SceneLight>, const W: usize> Reservoirs<'d, C, W> {
    /// Before the first image.
    pub fn new(
        recipe: Recipe,
        options: RestirOptions,
        first: &Step<'_, C::Light>,
        target: Target<'d>,
    ) -> Result<Self, HostError> {
        let moving = Moving::<C, W>::new(first, recipe.builder.params())?;
        Ok(Self {
            recipe,
            options,
            backend: target.backend::<C, W>(moving.scene().clone())?,
            moving,
            sequences: BTreeMap::new(),
        })
    }
}

impl<C: Choice<W, Light: SceneLight>, const W: usize> Runner<C::Light> for Reservoirs<'_, C, W> {
    fn advance(&mut self, step: &Step<'_, C::Light>) -> Result<UpdateTimes, HostError> {
        if self.recipe.lights.needs_bvh() {
            self.moving.advance(step, Some(&mut *self.backend))
        } else {
            Ok(time_power_table(step))
        }
    }

    fn image(
        &mut self,
        step: &Step<'_, C::Light>,
        arrays: &Arc<SceneArrays<C::Light>>,
        settings: &RenderSettings,
        sequence: SequenceId,
    ) -> Result<Timed<Vec<[f32; 3]>>, HostError> {
        let (options, budget) = (self.options, self.recipe.budget);
        self.recipe.require_power_table(step, arrays)?;
        let histories = self.sequences.entry(sequence).or_insert_with(|| {
            let count = match budget {
                SampleBudget::ShadowRays => (settings.samples / options.most_shadow_rays()).max(1),
                SampleBudget::CameraRays => settings.samples,
            };
            (0..count).map(|_| Restir::new(options)).collect()
        });
        mean_of(histories.len() as u32, settings, |number| {
            let frame = RestirFrame {
                scene: arrays,
                width: settings.width,
                height: settings.height,
                seed: hash(hash(settings.seed).wrapping_add(number)).wrapping_add(step.frame),
                jitter: match budget {
                    SampleBudget::ShadowRays => 0,
                    SampleBudget::CameraRays => number,
                },
                background: step.scene.data().background,
                remap: None,
            };
            Ok(self.backend.restir(&mut histories[number as usize], &frame)?)
        })
    }

    fn end(&mut self, sequence: SequenceId) {
        self.sequences.remove(&sequence);
    }

    fn histories(&self, sequence: SequenceId) -> Result<Vec<History>, HostError> {
        let histories = self.sequences.get(&sequence).into_iter().flatten();
        Ok(histories
            .map(|history| history.state())
            .collect::<Result<_, _>>()?)
    }

    fn shadow_rays(&self, sequence: SequenceId) -> Option<u64> {
        let histories = self.sequences.get(&sequence)?;
        Some(histories.iter().map(|history| history.shadow_rays()).sum())
    }

    fn may_skip(&self) -> bool {
        !self.recipe.lights.needs_bvh()
    }

    fn history(&self) -> u32 {
        HISTORY
    }
}

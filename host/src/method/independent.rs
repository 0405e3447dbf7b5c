//! Samples that know nothing of each other: lights chosen by a table, by a tree over all triangles, or by the paper's two
//! levels.

use std::sync::Arc;

use lightbvh::exact::hash;
use lightbvh_kernels::bvh::Choice;

use super::moving::Moving;
use super::{Recipe, Runner, SampleBudget, SequenceId, Step, Target, UpdateTimes, mean_of, time_power_table};
use crate::backend::{
    Backend, BackendError, Bvh, Follow, Integrator, Sampler, SceneArrays, Timed, all_candidates,
};
use crate::error::HostError;
use crate::scene::SceneLight;
use crate::workload::{RenderSettings, build, words_in_use};

/// Camera rays per pixel that make edges smooth; the light samples of a pixel are shared out among them.
const MAX_CAMERA_RAYS: u32 = 8;

/// A method of independent samples.
pub(super) struct Independent<'d, C: Choice<W, Light: SceneLight>, const W: usize> {
    recipe: Recipe,
    target: Target<'d>,
    backend: Box<dyn Follow<C, W> + 'd>,
    /// The lights of two levels.
    moving: Option<Moving<C, W>>,
    /// The tree over all lights, where it is refitted from frame to frame.
    single: Option<Bvh<C, W>>,
}

impl<'d, C: Choice<W, Light: SceneLight>, const W: usize> Independent<'d, C, W> {
    pub fn new(recipe: Recipe, first: &Step<'_, C::Light>, target: Target<'d>) -> Result<Self, HostError> {
        let params = recipe.builder.params();
        let moving = (recipe.lights == Sampler::TwoLevel)
            .then(|| Moving::<C, W>::new(first, params))
            .transpose()?;
        let bvh: Bvh<C, W> = match &moving {
            Some(moving) => moving.scene().clone(),
            // Backends come with a tree, which no table walks.
            None => build(first.lights, recipe.lights, &params),
        };
        let is_refitted = recipe.lights == Sampler::SingleLevel && !recipe.rebuilt;
        Ok(Self {
            recipe,
            target,
            single: is_refitted.then(|| bvh.clone()),
            backend: target.backend::<C, W>(bvh)?,
            moving,
        })
    }
}

impl<C: Choice<W, Light: SceneLight>, const W: usize> Runner<C::Light> for Independent<'_, C, W> {
    fn advance(&mut self, step: &Step<'_, C::Light>) -> Result<UpdateTimes, HostError> {
        if let Some(moving) = &mut self.moving {
            return moving.advance(step, Some(&mut *self.backend));
        }
        if let Some(bvh) = &mut self.single {
            let followed = Timed::of(|| bvh.follow(step.lights));
            followed.value.map_err(BackendError::from)?;
            return Ok(UpdateTimes {
                refit: followed.time + self.backend.follow(bvh)?.time,
                ..UpdateTimes::default()
            });
        }
        match self.recipe.lights {
            Sampler::Power => Ok(time_power_table(step)),
            Sampler::SingleLevel => {
                let params = self.recipe.builder.params();
                let built = Timed::of(|| build(step.lights, Sampler::SingleLevel, &params));
                self.backend = self.target.backend::<C, W>(built.value)?;
                Ok(UpdateTimes::waited(built.time))
            }
            Sampler::Uniform | Sampler::TwoLevel => Ok(UpdateTimes::default()),
        }
    }

    fn image(
        &mut self,
        step: &Step<'_, C::Light>,
        arrays: &Arc<SceneArrays<C::Light>>,
        settings: &RenderSettings,
        _sequence: SequenceId,
    ) -> Result<Timed<Vec<[f32; 3]>>, HostError> {
        let recipe = self.recipe;
        recipe.require_power_table(step, arrays)?;
        let mut all = settings.params(step.scene.data().background);
        all.candidates = recipe.candidates;
        all.scattered = recipe.scattered;
        let mut render = |params| {
            self.backend
                .render(arrays, &params, recipe.lights, recipe.integrator)
        };
        match recipe.budget {
            SampleBudget::ShadowRays => Ok(render(all)?),
            SampleBudget::CameraRays => {
                let parts = parts(
                    recipe.integrator,
                    settings.samples,
                    all_candidates(recipe.candidates, recipe.scattered),
                );
                mean_of(parts, settings, |part| {
                    let mut params = all;
                    params.samples = settings.samples / parts;
                    params.jitter = part;
                    match recipe.integrator {
                        Integrator::Direct => (params.part, params.parts) = (part, parts),
                        Integrator::Path { .. } => params.seed = hash(settings.seed).wrapping_add(part),
                    }
                    Ok(render(params)?)
                })
            }
        }
    }

    fn backend(&mut self) -> Option<&mut dyn Backend<C::Light>> {
        Some(&mut *self.backend)
    }

    fn words_in_use(&self, nodes: Vec<u32>) -> Vec<u32> {
        match self.moving.as_ref().map(Moving::scene).or(self.single.as_ref()) {
            Some(bvh) => words_in_use(bvh, &nodes),
            None => nodes,
        }
    }

    /// A single level has the shape of the first frame or of this one.
    fn may_skip(&self) -> bool {
        self.moving.is_none()
    }
}

/// Into how many parts the samples of a pixel are shared out, each with a camera ray of its own: of light samples, as few as
/// make edges smooth; of paths, one part each. A part is one invocation on a device.
fn parts(integrator: Integrator, samples: u32, candidates: u32) -> u32 {
    let most = integrator.samples_per_invocation(candidates);
    let fits = |&parts: &u32| samples.is_multiple_of(parts) && samples / parts <= most;
    match integrator {
        Integrator::Direct if samples > MAX_CAMERA_RAYS => {
            (MAX_CAMERA_RAYS..=samples).find(fits).unwrap_or(samples)
        }
        Integrator::Direct | Integrator::Path { .. } => samples,
    }
}

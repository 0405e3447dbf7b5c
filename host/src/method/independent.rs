//! Samples that know nothing of each other: lights chosen by a table, by a tree over all triangles, or by the paper's two
//! levels.

use lightbvh::exact::hash;
use lightbvh_kernels::bvh::Choice;
use lightbvh_kernels::render::RenderParams;

use super::moving::Moving;
use super::{Recipe, Runner, SampleBudget, Step, Target, TreeFacts, UpdateTimes};
use crate::backend::{
    Backend, BackendError, Bvh, Follow, Integrator, Sampler, SceneArrays, Timed, mean_image,
};
use crate::error::HostError;
use crate::scene::SceneLight;
use crate::workload::{build, words_in_use};

/// Camera rays per pixel that make edges smooth; the light samples of a pixel are shared out among them.
const MAX_CAMERA_RAYS: u32 = 8;

/// A method of independent samples.
pub(super) struct Independent<'d, C: Choice<W, Light: SceneLight>, const W: usize> {
    recipe: Recipe,
    target: Target<'d>,
    backend: Box<dyn Follow<C, W> + 'd>,
    /// The lights of two levels.
    moving: Option<Moving<C, W>>,
    /// The tree over all lights.
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
        Ok(Self {
            recipe,
            target,
            single: (recipe.lights == Sampler::SingleLevel).then(|| bvh.clone()),
            backend: target.backend::<C, W>(bvh)?,
            moving,
        })
    }

    fn bvh(&self) -> Option<&Bvh<C, W>> {
        self.moving.as_ref().map(Moving::scene).or(self.single.as_ref())
    }
}

impl<C: Choice<W, Light: SceneLight>, const W: usize> Runner<C::Light> for Independent<'_, C, W> {
    fn advance(&mut self, step: &Step<'_, C::Light>) -> Result<UpdateTimes, HostError> {
        if let Some(moving) = &mut self.moving {
            return moving.advance(step, &mut *self.backend);
        }
        if let Some(bvh) = &mut self.single {
            if self.recipe.rebuilt {
                let params = self.recipe.builder.params();
                let built = Timed::of(|| build(step.lights, Sampler::SingleLevel, &params));
                *bvh = built.value;
                self.backend = self.target.backend::<C, W>(bvh.clone())?;
                return Ok(UpdateTimes::waited(built.time));
            }
            let followed = Timed::of(|| bvh.follow(step.lights));
            followed.value.map_err(BackendError::from)?;
            return Ok(UpdateTimes {
                refit: followed.time + self.backend.follow(bvh)?.time,
                ..UpdateTimes::default()
            });
        }
        Ok(UpdateTimes::default())
    }

    fn image(
        &mut self,
        step: &Step<'_, C::Light>,
        arrays: &SceneArrays<C::Light>,
        params: &RenderParams,
    ) -> Result<Timed<Vec<[f32; 3]>>, HostError> {
        let recipe = self.recipe;
        if recipe.lights == Sampler::Power && arrays.thresholds.is_empty() {
            return Err(HostError::Sampler {
                scene: step.scene.name().to_owned(),
                sampler: recipe.name,
                lights: arrays.lights.triangles().len(),
            });
        }
        let all = RenderParams {
            candidates: recipe.candidates,
            ..*params
        };
        let mut render = |params| {
            self.backend
                .render(arrays, &params, recipe.lights, recipe.integrator)
        };
        match recipe.budget {
            SampleBudget::ShadowRays => Ok(render(all)?),
            SampleBudget::CameraRays => {
                let count = parts(recipe.integrator, all.samples, recipe.candidates);
                let parts = (0..count).map(|part| {
                    let samples = all.samples / count;
                    let mut own = RenderParams {
                        samples,
                        jitter: part,
                        ..all
                    };
                    match recipe.integrator {
                        Integrator::Direct => (own.part, own.parts) = (part, count),
                        Integrator::Path { .. } => own.seed = hash(all.seed).wrapping_add(part),
                    }
                    own
                });
                Ok(mean_image(parts, |params| render(*params))?)
            }
        }
    }

    fn backend(&mut self) -> &mut dyn Backend<C::Light> {
        &mut *self.backend
    }

    fn nodes(&mut self) -> Result<Vec<u32>, HostError> {
        let nodes = self.backend.nodes()?;
        Ok(self.bvh().map_or_else(Vec::new, |bvh| words_in_use(bvh, &nodes)))
    }

    fn tree(&self) -> Option<TreeFacts> {
        self.bvh().map(|bvh| TreeFacts {
            violation: bvh.validate().err().map(|violation| violation.to_string()),
            nodes: bvh.nodes().len() + bvh.top_nodes().len(),
            depth: bvh.depth(),
            bytes: bvh.bytes(),
        })
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

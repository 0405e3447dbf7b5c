//! Samples that know nothing of each other: lights chosen by a table, by a tree over all triangles, or by the paper's two
//! levels.

use lightbvh::device::bvh::follow;
use lightbvh::tree::Model;
use std::time::Instant;

use lightbvh::bvh::Swap;
use lightbvh::exact::hash;
use lightbvh::{Rebuilder, RebuilderParams};
use lightbvh_kernels::bvh::Compiled;
use lightbvh_kernels::render::RenderParams;

use super::{Recipe, Runner, SampleBudget, Step, Target, TreeFacts, UpdateTimes};
use crate::backend::{
    Backend, BackendError, Bvh, Follow, Held, Integrator, Sampler, SceneArrays, Timed, mean_image,
};
use crate::error::HostError;
use crate::scene::{Instances, SceneLight};
use crate::workload::build;

/// Camera rays per pixel that make edges smooth; the light samples of a pixel are shared out among them.
const MAX_CAMERA_RAYS: u32 = 8;

/// Where moving lights stand, and what builds their trees in the background.
type Moving<C, const W: usize> = (Instances<<C as Model<W>>::Light>, Rebuilder<C, W>);

/// A method of independent samples.
pub(super) struct Independent<'d, C: Compiled<W, Light: SceneLight>, const W: usize> {
    recipe: Recipe,
    target: Target<'d>,
    backend: Box<dyn Follow<C, W> + 'd>,
    /// No table walks it.
    bvh: Bvh<C, W>,
    /// Of two levels.
    moving: Option<Moving<C, W>>,
}

impl<'d, C: Compiled<W, Light: SceneLight>, const W: usize> Independent<'d, C, W> {
    pub fn new(recipe: Recipe, first: &Step<'_, C::Light>, target: Target<'d>) -> Result<Self, HostError> {
        let params = recipe.builder.params();
        let (bvh, moving) = match recipe.lights {
            Sampler::TwoLevel => {
                let made = Instances::new(first.scene, first.frame, params);
                let (bvh, instances) = made.map_err(|source| first.refused(source))?;
                // A tree for every frame, as in the paper, and the same one on all backends, for which a frame may wait.
                let mut params = RebuilderParams::default();
                (params.swap, params.idle) = (Swap::Deterministic, 0.0);
                let mut rebuilder = Rebuilder::new(params);
                rebuilder.end_frame(&bvh);
                (bvh, Some((instances, rebuilder)))
            }
            lights => (build(first.lights, lights, &params), None),
        };
        Ok(Self {
            recipe,
            target,
            backend: target.backend::<C, W>(bvh.clone())?,
            bvh,
            moving,
        })
    }
}

impl<C: Compiled<W, Light: SceneLight>, const W: usize> Runner<C::Light> for Independent<'_, C, W> {
    /// Time of refit is all that the frame's thread does for it: swapping in trees built in the background (paper sections 3.4 and
    /// 3.5), the edits, and new summaries, and those of the backend.
    fn advance(&mut self, step: &Step<'_, C::Light>) -> Result<UpdateTimes, HostError> {
        let bvh = &mut self.bvh;
        if let Some((instances, rebuilder)) = &mut self.moving {
            // Following the animation is the scene's business, whichever method renders it.
            let edits = instances.edits(step.scene, step.frame);
            let began = Instant::now();
            let start = rebuilder.begin_frame(bvh)?;
            bvh.apply(edits).map_err(|source| step.refused(source))?;
            bvh.refit();
            let own = began.elapsed().saturating_sub(start.waited);
            let refit = own + self.backend.follow(bvh)?.time;
            rebuilder.end_frame(bvh);
            return Ok(UpdateTimes {
                refit,
                rebuild: start.built,
                wait: start.waited,
            });
        }
        if !self.recipe.lights.needs_bvh() {
            return Ok(UpdateTimes::default());
        }
        if self.recipe.rebuilt {
            let params = self.recipe.builder.params();
            let built = Timed::of(|| build(step.lights, Sampler::SingleLevel, &params));
            *bvh = built.value;
            self.backend = self.target.backend::<C, W>(bvh.clone())?;
            return Ok(UpdateTimes {
                rebuild: built.time,
                wait: built.time,
                ..UpdateTimes::default()
            });
        }
        let followed = Timed::of(|| follow(bvh, step.lights));
        followed.value.map_err(BackendError::from)?;
        Ok(UpdateTimes {
            refit: followed.time + self.backend.follow(bvh)?.time,
            ..UpdateTimes::default()
        })
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
                lights: arrays.lights.all().len(),
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

    fn held(&mut self) -> Result<Vec<Held>, HostError> {
        Ok(self.backend.held(&self.bvh)?)
    }

    fn tree(&self) -> Option<TreeFacts> {
        let bvh = &self.bvh;
        self.recipe.lights.needs_bvh().then(|| TreeFacts {
            violation: bvh.view().validate().err().map(|violation| violation.to_string()),
            nodes: bvh.view().nodes().len() + bvh.view().top_nodes().len(),
            depth: bvh.view().depth(),
            bytes: bvh.view().bytes(),
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

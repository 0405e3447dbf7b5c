//! The lights of a scene kept in a two-level light BVH from frame to frame: instances moved, what changed refitted, trees
//! rebuilt in the background and swapped in at the start of the next frame (paper sections 3.4 and 3.5).

use std::time::Instant;

use lightbvh::bvh::Swap;
use lightbvh::{BuildParams, Rebuilder, RebuilderParams};
use lightbvh_kernels::bvh::Choice;

use super::{Step, UpdateTimes};
use crate::backend::{Bvh, Follow};
use crate::error::HostError;
use crate::scene::{Instances, SceneLight};

/// Moving lights, their rebuilder, and where they stand.
pub(super) struct Moving<C: Choice<W, Light: SceneLight>, const W: usize> {
    scene: Bvh<C, W>,
    instances: Instances<C::Light>,
    rebuilder: Rebuilder<C::Node, W>,
}

impl<C: Choice<W, Light: SceneLight>, const W: usize> Moving<C, W> {
    /// The lights at the first frame, built.
    pub fn new(first: &Step<'_, C::Light>, params: BuildParams) -> Result<Self, HostError> {
        let (scene, instances) =
            Instances::new(first.scene, first.frame, params).map_err(|source| first.refused(source))?;
        // A tree for every frame, as in the paper, and the same one on all backends, for which a frame may wait.
        let mut params = RebuilderParams::default();
        (params.swap, params.idle) = (Swap::Deterministic, 0.0);
        let mut rebuilder = Rebuilder::new(params);
        rebuilder.end_frame(&scene);
        Ok(Self {
            scene,
            instances,
            rebuilder,
        })
    }

    /// The lights as last advanced to.
    pub fn scene(&self) -> &Bvh<C, W> {
        &self.scene
    }

    /// Updates the lights to the next frame, then `backend`. Time of refit is all that the frame's thread does for it:
    /// swapping in the new trees, the edits, and new summaries, and those of `backend`.
    pub fn advance(
        &mut self,
        step: &Step<'_, C::Light>,
        backend: &mut (dyn Follow<C, W> + '_),
    ) -> Result<UpdateTimes, HostError> {
        // Following the animation is the scene's business, whichever method renders it.
        let edits = self.instances.edits(step.scene, step.frame);
        let began = Instant::now();
        let start = self.rebuilder.begin_frame(&mut self.scene)?;
        self.scene.apply(edits).map_err(|source| step.refused(source))?;
        self.scene.refit();
        let own = began.elapsed().saturating_sub(start.waited);
        let refit = own + backend.follow(&self.scene)?.time;
        self.rebuilder.end_frame(&self.scene);
        Ok(UpdateTimes {
            refit,
            rebuild: start.built,
            wait: start.waited,
        })
    }
}

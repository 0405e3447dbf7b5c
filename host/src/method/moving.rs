//! The lights of a scene kept in a two-level light BVH from frame to frame: instances moved, what changed refitted, the
//! top level rebuilt beside the frame and swapped in at the start of the next (paper sections 3.4 and 3.5).

use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use lightbvh::bvh::{RebuildParams, Rebuilt, Swap};
use lightbvh::{BuildParams, Heuristic, Rebuilder, RebuilderParams};
use lightbvh_kernels::bvh::Choice;

use super::{Step, UpdateTimes};
use crate::backend::{Bvh, Follow, Timed};
use crate::error::HostError;
use crate::scene::{Instances, SceneLight};

/// Moving lights, their rebuilder, and where they stand.
pub(super) struct Moving<C: Choice<W, Light: SceneLight>, const W: usize> {
    scene: Bvh<C, W>,
    instances: Instances<C::Light>,
    rebuilds: Rebuilds<C, W>,
}

/// How what lost its shape is built anew.
enum Rebuilds<C: Choice<W>, const W: usize> {
    /// By parts: what a user would run.
    Parts(Box<Rebuilder<C::Node, W>>),
    /// The top level as a whole, beside each frame: what the paper does.
    Whole(Option<JoinHandle<Timed<Rebuilt<C::Node, W>>>>),
}

impl<C: Choice<W, Light: SceneLight>, const W: usize> Rebuilds<C, W> {
    fn of(params: &BuildParams) -> Self {
        if matches!(params.heuristic, Heuristic::Sah | Heuristic::Saoh) {
            Self::Whole(None)
        } else {
            // Every frame the same on all backends, for which it may wait.
            Self::Parts(Box::new(Rebuilder::new(RebuilderParams {
                swap: Swap::Deterministic,
                // As the paper does.
                rebuild: RebuildParams::eager(),
                ..RebuilderParams::default()
            })))
        }
    }

    /// Swaps in what was built; how long that took to build, and how long this waited.
    fn begin_frame(&mut self, scene: &mut Bvh<C, W>) -> Result<[Duration; 2], HostError> {
        match self {
            Self::Parts(rebuilder) => {
                let start = rebuilder.begin_frame(scene)?;
                Ok([start.built, start.waited])
            }
            Self::Whole(thread) => {
                let Some(thread) = thread.take() else {
                    return Ok([Duration::ZERO; 2]);
                };
                let began = Instant::now();
                let rebuilt = thread
                    .join()
                    .unwrap_or_else(|panic| std::panic::resume_unwind(panic));
                let waited = began.elapsed();
                scene.install(rebuilt.value).expect("it is this one's");
                Ok([rebuilt.time, waited])
            }
        }
    }

    fn end_frame(&mut self, scene: &Bvh<C, W>) {
        match self {
            Self::Parts(rebuilder) => rebuilder.end_frame(scene),
            Self::Whole(thread) => {
                let rebuild = scene.rebuild(&RebuildParams::eager());
                *thread = Some(std::thread::spawn(|| Timed::of(|| rebuild.run())));
            }
        }
    }
}

impl<C: Choice<W, Light: SceneLight>, const W: usize> Moving<C, W> {
    /// The lights at the first frame, built.
    pub fn new(first: &Step<'_, C::Light>, params: BuildParams) -> Result<Self, HostError> {
        let (scene, instances) =
            Instances::new(first.scene, first.frame, params).map_err(|source| first.refused(source))?;
        let mut rebuilds = Rebuilds::of(&params);
        rebuilds.end_frame(&scene);
        Ok(Self {
            scene,
            instances,
            rebuilds,
        })
    }

    /// The lights as last advanced to.
    pub fn scene(&self) -> &Bvh<C, W> {
        &self.scene
    }

    /// Brings the lights to the next frame, and `backend`, if any, after them. Refit is all that the frame's thread does for
    /// it: swapping in the rebuilt tree, noting what moved, and new summaries (those of `backend`, where there is one).
    pub fn advance(
        &mut self,
        step: &Step<'_, C::Light>,
        backend: Option<&mut (dyn Follow<C, W> + '_)>,
    ) -> Result<UpdateTimes, HostError> {
        // Following the animation is the scene's business, whichever method renders it.
        let edits = self.instances.edits(step.scene, step.frame);
        let began = Instant::now();
        let [rebuild, wait] = self.rebuilds.begin_frame(&mut self.scene)?;
        self.scene.apply(edits).map_err(|source| step.refused(source))?;
        self.scene.plan();
        let mut refit = began.elapsed().saturating_sub(wait);
        let followed = backend.map(|backend| backend.follow(&self.scene)).transpose()?;
        let own = Timed::of(|| self.scene.refit());
        refit += followed.map_or(own.time, |followed| followed.time);
        self.rebuilds.end_frame(&self.scene);
        Ok(UpdateTimes { refit, rebuild, wait })
    }
}

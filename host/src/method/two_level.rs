//! The paper's two levels: a light BVH over mesh lights, over one over the triangles of each.
//!
//! Both levels are built anew each frame, before it is rendered: the frame waits for all of it.

use std::time::Instant;

use lightbvh::{BuildParams, Heuristic};

use super::{Chain, Runner, Step, Target, UpdateTimes, render};
use crate::backend::{Backend, Sampler, SceneArrays, Timed};
use crate::error::HostError;
use crate::workload::{Shot, build};

/// A two-level light BVH.
pub(super) struct TwoLevel<'d> {
    params: BuildParams,
    target: Target<'d>,
    backend: Box<dyn Backend + 'd>,
}

impl<'d> TwoLevel<'d> {
    pub(super) fn new(first: &Step<'_>, target: Target<'d>, heuristic: Heuristic) -> Result<Self, HostError> {
        let params = BuildParams {
            heuristic,
            ..BuildParams::default()
        };
        let bvh = build(first.lights, Sampler::TwoLevel, &params);
        Ok(Self {
            params,
            target,
            backend: target.backend(bvh, first.lights)?,
        })
    }
}

impl Runner for TwoLevel<'_> {
    fn advance(&mut self, step: &Step<'_>) -> Result<UpdateTimes, HostError> {
        let start = Instant::now();
        let bvh = build(step.lights, Sampler::TwoLevel, &self.params);
        let rebuild = start.elapsed();
        self.backend = self.target.backend(bvh, step.lights)?;
        Ok(UpdateTimes {
            rebuild,
            wait: rebuild,
            ..UpdateTimes::default()
        })
    }

    fn image(
        &mut self,
        step: &Step<'_>,
        arrays: &SceneArrays,
        shot: &Shot,
        _chain: Chain,
    ) -> Result<Timed<Vec<[f32; 3]>>, HostError> {
        render(&mut *self.backend, step, arrays, shot, Sampler::TwoLevel)
    }

    fn may_skip(&self) -> bool {
        true
    }
}

//! One light BVH over all triangles: refitted only, as in Mogwai, the paper's baseline; or built anew every frame, the best
//! that a single level can do.

use std::marker::PhantomData;
use std::sync::Arc;
use std::time::Instant;

use lightbvh::BuildParams;
use lightbvh_kernels::bvh::{Choice, Standard, WIDTH};

use super::{Chain, Runner, Step, Target, UpdateTimes, render};
use crate::backend::{Backend, Bvh, Sampler, SceneArrays, Timed};
use crate::error::HostError;
use crate::workload::{Shot, build};

/// A single-level light BVH.
pub struct SingleLevel<'d, C: Choice<W> = Standard, const W: usize = WIDTH> {
    params: BuildParams,
    rebuilds: bool,
    target: Target<'d>,
    backend: Box<dyn Backend + 'd>,
    choice: PhantomData<C>,
}

impl<'d, C: Choice<W>, const W: usize> SingleLevel<'d, C, W> {
    /// Built as `params` say at the first frame and refitted ever after.
    ///
    /// # Errors
    /// [`HostError`] from a device.
    pub fn refitted(first: &Step<'_>, target: Target<'d>, params: BuildParams) -> Result<Self, HostError> {
        Self::new(first, target, params, false)
    }

    /// Built anew every frame.
    ///
    /// # Errors
    /// [`HostError`] from a device.
    pub fn rebuilt(first: &Step<'_>, target: Target<'d>, params: BuildParams) -> Result<Self, HostError> {
        Self::new(first, target, params, true)
    }

    fn new(
        first: &Step<'_>,
        target: Target<'d>,
        params: BuildParams,
        rebuilds: bool,
    ) -> Result<Self, HostError> {
        let bvh: Bvh<C, W> = build(first.lights, Sampler::SingleLevel, &params);
        Ok(Self {
            params,
            rebuilds,
            target,
            backend: target.backend::<C, W>(bvh)?,
            choice: PhantomData,
        })
    }
}

impl<C: Choice<W>, const W: usize> Runner for SingleLevel<'_, C, W> {
    fn advance(&mut self, step: &Step<'_>) -> Result<UpdateTimes, HostError> {
        let mut times = UpdateTimes::default();
        if self.rebuilds {
            let start = Instant::now();
            let bvh: Bvh<C, W> = build(step.lights, Sampler::SingleLevel, &self.params);
            times.rebuild = start.elapsed();
            times.wait = times.rebuild;
            self.backend = self.target.backend::<C, W>(bvh)?;
        } else {
            times.refit = self.backend.refit(step.lights)?.time;
        }
        Ok(times)
    }

    fn image(
        &mut self,
        step: &Step<'_>,
        arrays: &Arc<SceneArrays>,
        shot: &Shot,
        _chain: Chain,
    ) -> Result<Timed<Vec<[f32; 3]>>, HostError> {
        render(&mut *self.backend, step, arrays, shot, Sampler::SingleLevel)
    }

    fn backend(&mut self) -> Option<&mut dyn Backend> {
        Some(&mut *self.backend)
    }

    /// The tree's shape is that of the first frame or of this one.
    fn may_skip(&self) -> bool {
        true
    }
}

//! The paper's two levels: a light BVH over instances of mesh lights, over one over the triangles of each mesh.

use std::sync::Arc;

use lightbvh::BuildParams;
use lightbvh_kernels::bvh::{Choice, Standard, WIDTH};

use super::moving::Moving;
use super::{Chain, Runner, Step, Target, UpdateTimes, render};
use crate::backend::{Backend, CpuBackend, DeviceBackend, Follow, Sampler, SceneArrays, Timed};
use crate::error::HostError;
use crate::workload::Shot;

/// A two-level light BVH.
pub struct TwoLevel<'d, C: Choice<W> = Standard, const W: usize = WIDTH> {
    moving: Moving<C, W>,
    backend: Box<dyn Follow<C, W> + 'd>,
}

impl<'d, C: Choice<W>, const W: usize> TwoLevel<'d, C, W> {
    /// Built as `params` say at the first frame.
    ///
    /// # Errors
    /// [`HostError`] from a device, or for lights outside the domain.
    pub fn new(first: &Step<'_>, target: Target<'d>, params: BuildParams) -> Result<Self, HostError> {
        let moving = Moving::<C, W>::new(first, params)?;
        let backend: Box<dyn Follow<C, W> + 'd> = match target {
            Target::Cpu => Box::new(CpuBackend::<C, W>::new(moving.scene().clone())),
            Target::Device(device) => Box::new(DeviceBackend::<C, W>::new(device, moving.scene())?),
        };
        Ok(Self { moving, backend })
    }
}

impl<C: Choice<W>, const W: usize> Runner for TwoLevel<'_, C, W> {
    fn advance(&mut self, step: &Step<'_>) -> Result<UpdateTimes, HostError> {
        self.moving.advance(step, Some(&mut *self.backend))
    }

    fn image(
        &mut self,
        step: &Step<'_>,
        arrays: &Arc<SceneArrays>,
        shot: &Shot,
        _chain: Chain,
    ) -> Result<Timed<Vec<[f32; 3]>>, HostError> {
        render(&mut *self.backend, step, arrays, shot, Sampler::TwoLevel)
    }

    fn backend(&mut self) -> Option<&mut dyn Backend> {
        Some(&mut *self.backend)
    }
}

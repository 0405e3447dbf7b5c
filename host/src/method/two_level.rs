//! The paper's two levels: a light BVH over instances of mesh lights, over one over the triangles of each mesh.

use std::sync::Arc;

use lightbvh::BuildParams;

use super::moving::Moving;
use super::{Chain, Runner, Step, Target, UpdateTimes, render};
use crate::backend::{Backend, CpuBackend, DeviceBackend, Sampler, SceneArrays, Timed};
use crate::error::HostError;
use crate::workload::Shot;

/// A two-level light BVH.
pub struct TwoLevel<'d> {
    moving: Moving,
    backend: Box<dyn Backend + 'd>,
}

impl<'d> TwoLevel<'d> {
    /// Built as `params` say at the first frame.
    ///
    /// # Errors
    /// [`HostError`] from a device, or for lights outside the domain.
    pub fn new(first: &Step<'_>, target: Target<'d>, params: BuildParams) -> Result<Self, HostError> {
        let moving = Moving::new(first, params)?;
        let backend: Box<dyn Backend + 'd> = match target {
            Target::Cpu => Box::new(CpuBackend::new(moving.scene().clone(), first.lights.clone())),
            Target::Device(device) => {
                Box::new(DeviceBackend::of_scene(device, moving.scene(), first.lights)?)
            }
        };
        Ok(Self { moving, backend })
    }
}

impl Runner for TwoLevel<'_> {
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

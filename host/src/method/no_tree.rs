//! The baselines without a tree: uniform, and in proportion to power.

use std::hint::black_box;
use std::sync::Arc;
use std::time::Instant;

use lightbvh::BuildParams;
use lightbvh_kernels::bvh::{Standard, WIDTH};

use super::{Chain, Runner, Step, Target, UpdateTimes, render};
use crate::backend::{Backend, Sampler, SceneArrays, Timed};
use crate::error::HostError;
use crate::render::power_thresholds;
use crate::workload::{Shot, build};

/// Lights chosen without a tree.
pub struct NoTree<'d> {
    sampler: Sampler,
    backend: Box<dyn Backend + 'd>,
}

impl<'d> NoTree<'d> {
    /// Every light alike.
    ///
    /// # Errors
    /// [`HostError`] from a device.
    pub fn uniform(first: &Step<'_>, target: Target<'d>) -> Result<Self, HostError> {
        Self::new(first, target, Sampler::Uniform)
    }

    /// In proportion to power.
    ///
    /// # Errors
    /// [`HostError`] from a device.
    pub fn power(first: &Step<'_>, target: Target<'d>) -> Result<Self, HostError> {
        Self::new(first, target, Sampler::Power)
    }

    fn new(first: &Step<'_>, target: Target<'d>, sampler: Sampler) -> Result<Self, HostError> {
        // Backends come with a tree; this one is never walked.
        let bvh = build(first.lights, Sampler::TwoLevel, &BuildParams::default());
        let backend = target.backend::<Standard, WIDTH>(bvh)?;
        Ok(Self { sampler, backend })
    }
}

impl Runner for NoTree<'_> {
    fn advance(&mut self, step: &Step<'_>) -> Result<UpdateTimes, HostError> {
        let mut times = UpdateTimes::default();
        if self.sampler == Sampler::Power {
            // The renderer reads the table that comes with the frame's arrays; here it is made once more, for its time.
            let start = Instant::now();
            let _ = black_box(power_thresholds(step.lights.triangles()));
            times.rebuild = start.elapsed();
            times.wait = times.rebuild;
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
        if self.sampler == Sampler::Power && arrays.thresholds.is_empty() {
            return Err(HostError::Sampler {
                scene: step.scene.name().to_owned(),
                sampler: self.sampler.name(),
                lights: arrays.lights.triangles().len(),
            });
        }
        render(&mut *self.backend, step, arrays, shot, self.sampler)
    }

    fn backend(&mut self) -> Option<&mut dyn Backend> {
        Some(&mut *self.backend)
    }

    fn may_skip(&self) -> bool {
        true
    }
}

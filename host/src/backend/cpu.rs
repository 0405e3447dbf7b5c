//! The passes on the CPU, over all cores of the current rayon pool.

use std::time::Instant;

use bytemuck::cast_slice;
use lightbvh::{Lights, SampledLight};
use lightbvh_kernels::bvh::{Choice, Standard, WIDTH};
use lightbvh_kernels::query::{Query, pmf_query, sample_query};
use lightbvh_kernels::render::RenderParams;
use lightbvh_kernels::shading::path::MAX_BOUNCES;
use lightbvh_kernels::shading::pick::{PickLight, Power, Uniform};
use rayon::prelude::*;

use super::parts::{MAX_SAMPLES_PER_INVOCATION, in_parts, paths_per_invocation};
use super::{Backend, BackendError, Bvh, Follow, Sampler, SceneArrays, Timed, node_record};
use crate::compare::Record;
use crate::render::{render, render_path};

/// The CPU as a backend: the reference that devices are compared with.
pub struct CpuBackend<C: Choice<W> = Standard, const W: usize = WIDTH> {
    bvh: Bvh<C, W>,
}

impl<C: Choice<W>, const W: usize> CpuBackend<C, W> {
    /// Takes a BVH.
    #[must_use]
    pub fn new(bvh: Bvh<C, W>) -> Self {
        Self { bvh }
    }

    /// The BVH as last refitted.
    #[must_use]
    pub fn bvh(&self) -> &Bvh<C, W> {
        &self.bvh
    }
}

impl<C: Choice<W>, const W: usize> Backend for CpuBackend<C, W> {
    fn name(&self) -> &str {
        "cpu"
    }

    fn node_record(&self) -> Record {
        node_record::<C::Node, W>()
    }

    fn refit(&mut self, lights: &Lights) -> Result<Timed<Vec<u32>>, BackendError> {
        let start = Instant::now();
        self.bvh.follow(lights).map_err(BackendError::Lights)?;
        Ok(Timed {
            time: start.elapsed(),
            value: self.words(),
        })
    }

    fn nodes(&mut self) -> Result<Vec<u32>, BackendError> {
        Ok(self.words())
    }

    fn sample(&mut self, queries: &[Query]) -> Result<Timed<Vec<SampledLight>>, BackendError> {
        let start = Instant::now();
        let tree = self.bvh.tree();
        let value = queries
            .par_iter()
            .with_min_len(256)
            .map(|query| sample_query::<C, W>(&tree, query))
            .collect();
        Ok(Timed {
            value,
            time: start.elapsed(),
        })
    }

    fn pmf(&mut self, queries: &[Query]) -> Result<Timed<Vec<f32>>, BackendError> {
        let start = Instant::now();
        let tree = self.bvh.tree();
        let value = queries
            .par_iter()
            .with_min_len(256)
            .map(|query| pmf_query::<C, W>(&tree, query))
            .collect();
        Ok(Timed {
            value,
            time: start.elapsed(),
        })
    }

    fn render(
        &mut self,
        scene: &SceneArrays,
        params: &RenderParams,
        sampler: Sampler,
    ) -> Result<Timed<Vec<[f32; 3]>>, BackendError> {
        in_parts(params, MAX_SAMPLES_PER_INVOCATION, |params| {
            Ok(self.shade(scene, sampler, Direct(params)))
        })
    }

    fn render_path(
        &mut self,
        scene: &SceneArrays,
        params: &RenderParams,
        bounces: u32,
        sampler: Sampler,
    ) -> Result<Timed<Vec<[f32; 3]>>, BackendError> {
        in_parts(params, paths_per_invocation(bounces.min(MAX_BOUNCES)), |params| {
            Ok(self.shade(scene, sampler, Paths(params, bounces)))
        })
    }
}

/// An integrator, for whichever picker: what a closure cannot be.
trait Integrate {
    fn image<P: PickLight + Sync>(&self, scene: &SceneArrays, picker: &P) -> Vec<[f32; 3]>;
}

struct Direct<'a>(&'a RenderParams);

impl Integrate for Direct<'_> {
    fn image<P: PickLight + Sync>(&self, scene: &SceneArrays, picker: &P) -> Vec<[f32; 3]> {
        render(&scene.view(), &scene.camera, self.0, picker)
    }
}

struct Paths<'a>(&'a RenderParams, u32);

impl Integrate for Paths<'_> {
    fn image<P: PickLight + Sync>(&self, scene: &SceneArrays, picker: &P) -> Vec<[f32; 3]> {
        render_path(&scene.view(), &scene.camera, self.0, self.1, picker)
    }
}

impl<C: Choice<W>, const W: usize> Follow<C, W> for CpuBackend<C, W> {
    fn follow(&mut self, bvh: &Bvh<C, W>) -> Result<Timed<()>, BackendError> {
        let mut own = bvh.clone();
        let start = Instant::now();
        own.refit();
        let time = start.elapsed();
        self.bvh = own;
        Ok(Timed { time, value: () })
    }
}

impl<C: Choice<W>, const W: usize> CpuBackend<C, W> {
    /// The words of all nodes.
    fn words(&self) -> Vec<u32> {
        cast_slice(self.bvh.tree().nodes).to_vec()
    }

    /// The image by `integrator` with the picker of `sampler`.
    fn shade(
        &self,
        scene: &SceneArrays,
        sampler: Sampler,
        integrator: impl Integrate,
    ) -> Timed<Vec<[f32; 3]>> {
        let start = Instant::now();
        let value = match sampler {
            Sampler::Uniform => {
                let count = scene.lights.triangles().len() as u32;
                integrator.image(scene, &Uniform { count })
            }
            Sampler::Power => {
                let thresholds = &scene.thresholds;
                integrator.image(scene, &Power { thresholds })
            }
            Sampler::SingleLevel | Sampler::TwoLevel => integrator.image(scene, &self.bvh.tree()),
        };
        Timed {
            value,
            time: start.elapsed(),
        }
    }
}

//! The passes on the CPU, over all cores of the current rayon pool.

use std::time::{Duration, Instant};

use lightbvh::{INVALID, Lights, traverse};
use lightbvh_kernels::bvh::{Importance, Node, WIDTH};
use lightbvh_kernels::query::{Query, Sampled};
use lightbvh_kernels::render::RenderParams;
use lightbvh_kernels::shading::path::MAX_BOUNCES;
use lightbvh_kernels::shading::pick::{PickLight, Power, Uniform};
use rayon::prelude::*;

use super::parts::{MAX_SAMPLES_PER_INVOCATION, in_parts, paths_per_invocation};
use super::{Backend, LightScene, Sampler, SceneArrays, Structure, Timed, climb};
use crate::render::{render, render_path};
use crate::vulkan::VulkanError;

/// The CPU as a backend: the reference that devices are compared with.
pub struct CpuBackend {
    structure: Structure,
    lights: Lights,
}

impl CpuBackend {
    /// Takes a BVH, or moving lights, over `lights` in the world.
    #[must_use]
    pub fn new(structure: impl Into<Structure>, lights: Lights) -> Self {
        Self {
            structure: structure.into(),
            lights,
        }
    }

    /// What lights are chosen by, as last refitted.
    #[must_use]
    pub fn structure(&self) -> &Structure {
        &self.structure
    }

    /// The lights as last refitted to.
    #[must_use]
    pub fn lights(&self) -> &Lights {
        &self.lights
    }
}

impl Backend for CpuBackend {
    fn name(&self) -> &str {
        "cpu"
    }

    fn refit(&mut self, lights: &Lights) -> Result<Timed<Vec<Node>>, VulkanError> {
        self.lights = lights.clone();
        let start = Instant::now();
        if let Structure::Bvh(bvh) = &mut self.structure {
            bvh.refit(lights);
        }
        Ok(Timed {
            time: start.elapsed(),
            value: self.structure.tree().nodes.to_vec(),
        })
    }

    fn refit_once(&mut self, lights: &Lights) -> Result<Timed<Vec<Node>>, VulkanError> {
        self.lights = lights.clone();
        let time = match &mut self.structure {
            Structure::Bvh(bvh) => climb::refit_once(bvh, lights),
            Structure::Scene(_) => Duration::ZERO,
        };
        Ok(Timed {
            time,
            value: self.structure.tree().nodes.to_vec(),
        })
    }

    fn follow(&mut self, scene: &LightScene, lights: &Lights) -> Result<Timed<()>, VulkanError> {
        self.lights = lights.clone();
        let mut own = scene.clone();
        let start = Instant::now();
        own.refit();
        let time = start.elapsed();
        self.structure = own.into();
        Ok(Timed { time, value: () })
    }

    fn nodes(&mut self) -> Result<Vec<Node>, VulkanError> {
        Ok(self.structure.tree().nodes.to_vec())
    }

    fn sample(&mut self, queries: &[Query]) -> Result<Timed<Vec<Sampled>>, VulkanError> {
        let start = Instant::now();
        let tree = self.structure.tree();
        let value = queries
            .par_iter()
            .with_min_len(256)
            .map(|query| {
                let sampled = traverse::sample::<Node, Importance, _, WIDTH>(
                    &tree,
                    &query.point,
                    query.random_or_light,
                );
                Sampled {
                    light: sampled.light,
                    pmf: sampled.pmf,
                }
            })
            .collect();
        Ok(Timed {
            value,
            time: start.elapsed(),
        })
    }

    fn pmf(&mut self, queries: &[Query]) -> Result<Timed<Vec<f32>>, VulkanError> {
        let start = Instant::now();
        let (tree, two_level) = (self.structure.tree(), self.structure.is_two_level());
        let lights = self.lights.triangles();
        let value = queries
            .par_iter()
            .with_min_len(256)
            .map(|query| {
                let light = query.random_or_light;
                let mesh = lights.get(light as usize).map(|triangle| triangle.mesh);
                let mesh = mesh.map(|mesh| if two_level { mesh } else { INVALID });
                mesh.map_or(0.0, |mesh| {
                    traverse::pmf::<Node, Importance, _, WIDTH>(&tree, &query.point, light, mesh)
                })
            })
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
    ) -> Result<Timed<Vec<[f32; 3]>>, VulkanError> {
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
    ) -> Result<Timed<Vec<[f32; 3]>>, VulkanError> {
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

impl CpuBackend {
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
            Sampler::SingleLevel | Sampler::TwoLevel => integrator.image(scene, &self.structure.picker()),
        };
        Timed {
            value,
            time: start.elapsed(),
        }
    }
}

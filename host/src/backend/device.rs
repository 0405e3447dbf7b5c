//! The passes on a Vulkan device.

use std::sync::Arc;
use std::time::Duration;

use bytemuck::bytes_of;
use lightbvh::refit::BlasRoot;
use lightbvh::{EmissiveTriangle, Instance, Lights, SampledLight};
use lightbvh_gpu::{Buffer as Array, Mirror, Refit};
use lightbvh_kernels::WORKGROUP;
use lightbvh_kernels::bvh::{Choice, Standard, TreePush, WIDTH};
use lightbvh_kernels::path::PathPush;
use lightbvh_kernels::query::{Query, QueryPush};
use lightbvh_kernels::render::{RenderParams, RenderPush};
use lightbvh_kernels::shading::path::MAX_BOUNCES;

use super::parts::{MAX_SAMPLES_PER_INVOCATION, in_parts, paths_per_invocation};
use super::{Backend, BackendError, Bvh, Sampler, SceneArrays, Timed, node_record};
use crate::compare::Record;
use crate::vulkan::{Binding, Buffer, Device, Kernel, Pass, Timings};

/// Queries per dispatch: 28 MiB of them, within the smallest storage buffer range seen (128 MiB).
const QUERIES_PER_PASS: usize = 1 << 20;
/// Light samples per render dispatch: keeps one dispatch well below the seconds after which a driver gives up on it.
const SAMPLES_PER_PASS: usize = 1 << 20;
/// Surfaces met by paths per dispatch, for the same reason; each costs two rays, a sampled light and a pmf.
const SURFACES_PER_PASS: usize = 1 << 18;

/// A light BVH on a device.
pub struct DeviceBackend<'d, C: Choice<W> = Standard, const W: usize = WIDTH> {
    pub(super) device: &'d Device,
    pub(super) nodes: Buffer<C::Node>,
    pub(super) instances: Buffer<Instance>,
    pub(super) roots: Buffer<BlasRoot>,
    pub(super) trails: Buffer<u32>,
    /// The triangles of the bottom levels, in the spaces of their meshes.
    pub(super) triangles: Buffer<EmissiveTriangle>,
    /// The refit of everything.
    refit: Refit,
    /// By which edits are followed.
    pub(super) mirror: Mirror,
    pub(super) tree: TreePush,
}

impl<'d, C: Choice<W>, const W: usize> DeviceBackend<'d, C, W> {
    /// Uploads a BVH, planned or refitted.
    ///
    /// # Errors
    /// [`BackendError`] when it does not fit, or the device fails.
    pub fn new(device: &'d Device, bvh: &Bvh<C, W>) -> Result<Self, BackendError> {
        let tree = bvh.tree();
        // All of it is uploaded here.
        let mut mirror = Mirror::default();
        mirror.follow(bvh);
        let plan = bvh.plan_of_everything();
        Ok(Self {
            device,
            nodes: device.upload(tree.nodes)?,
            instances: device.upload(tree.instances)?,
            trails: device.upload(tree.trails)?,
            triangles: device.upload(bvh.triangles())?,
            roots: device.upload(bvh.roots())?,
            refit: Refit::new(&plan),
            mirror,
            tree: TreePush::of(&tree),
        })
    }

    /// Overwrites the device's nodes, so that a refit has something to change.
    ///
    /// # Errors
    /// [`BackendError`] from the device.
    pub fn write_nodes(&mut self, nodes: &[C::Node]) -> Result<(), BackendError> {
        Ok(self.nodes.write(nodes)?)
    }

    /// The kernel of this choice.
    fn kernel(&self, name: &str) -> Result<Arc<Kernel>, BackendError> {
        Ok(self.device.kernel(&format!("{name}{}", C::SUFFIX))?)
    }

    /// Runs the dispatches of a refit.
    pub(super) fn refit_by(&self, refit: &Refit) -> Result<Duration, BackendError> {
        if refit.dispatches.is_empty() {
            return Ok(Duration::ZERO);
        }
        let list = self.device.upload(&refit.list)?;
        let mut steps = Vec::new();
        for dispatch in &refit.dispatches {
            let kernel = self.kernel(dispatch.pass.name())?;
            let buffers = self.buffers(&kernel, &list);
            steps.push((kernel, buffers, dispatch));
        }
        let mut pass = Pass::new();
        for (kernel, buffers, dispatch) in &steps {
            pass.dispatch(kernel, buffers, bytes_of(&dispatch.push()), dispatch.count);
        }
        Ok(device_time(&self.device.run(&pass)?))
    }

    /// What a kernel of a refit takes, by the names of its bindings.
    fn buffers<'a>(&'a self, kernel: &Kernel, list: &'a Buffer<u32>) -> Vec<Binding<'a>> {
        let bind = |name| match Array::named(name) {
            Some(Array::Nodes) => self.nodes.bind(),
            Some(Array::Triangles) => self.triangles.bind(),
            Some(Array::Instances) => self.instances.bind(),
            Some(Array::Roots) => self.roots.bind(),
            Some(Array::Trails) => self.trails.bind(),
            None => list.bind(),
        };
        let known = lightbvh_gpu::Kernel::named(kernel.name()).map_or(&[][..], |known| known.bindings);
        known.iter().map(|binding| bind(binding.name)).collect()
    }

    /// Answers queries pass by pass.
    fn query<T: bytemuck::Pod>(
        &self,
        kernel: &str,
        queries: &[Query],
        bindings: &[Binding<'_>],
    ) -> Result<Timed<Vec<T>>, BackendError> {
        let kernel = self.kernel(kernel)?;
        let mut all = Timed {
            value: Vec::with_capacity(queries.len()),
            time: Duration::ZERO,
        };
        for part in queries.chunks(QUERIES_PER_PASS) {
            let input = self.device.upload(part)?;
            let output = self.device.output::<T>(part.len())?;
            let push = QueryPush {
                count: part.len() as u32,
                tree: self.tree,
            };
            let mut bindings = bindings.to_vec();
            bindings.extend([input.bind(), output.bind()]);
            let mut pass = Pass::new();
            pass.dispatch(&kernel, &bindings, bytes_of(&push), push.count);
            all.time += device_time(&self.device.run(&pass)?);
            all.value.extend(output.read()?);
        }
        Ok(all)
    }
}

impl<C: Choice<W>, const W: usize> Backend for DeviceBackend<'_, C, W> {
    fn name(&self) -> &str {
        self.device.name()
    }

    fn node_record(&self) -> Record {
        node_record::<C::Node, W>()
    }

    fn refit(&mut self, lights: &Lights) -> Result<Timed<Vec<u32>>, BackendError> {
        self.triangles.write(lights.triangles())?;
        let time = self.refit_by(&self.refit)?;
        Ok(Timed {
            value: self.nodes.read_words()?,
            time,
        })
    }

    fn nodes(&mut self) -> Result<Vec<u32>, BackendError> {
        Ok(self.nodes.read_words()?)
    }

    fn sample(&mut self, queries: &[Query]) -> Result<Timed<Vec<SampledLight>>, BackendError> {
        self.query(
            "sample",
            queries,
            &[self.nodes.bind(), self.instances.bind(), self.trails.bind()],
        )
    }

    fn pmf(&mut self, queries: &[Query]) -> Result<Timed<Vec<f32>>, BackendError> {
        self.query(
            "pmf",
            queries,
            &[self.nodes.bind(), self.instances.bind(), self.trails.bind()],
        )
    }

    fn render(
        &mut self,
        scene: &SceneArrays,
        params: &RenderParams,
        sampler: Sampler,
    ) -> Result<Timed<Vec<[f32; 3]>>, BackendError> {
        let kernel = match sampler {
            Sampler::Uniform => self.device.kernel("render_uniform")?,
            Sampler::Power => self.device.kernel("render_power")?,
            Sampler::SingleLevel | Sampler::TwoLevel => self.kernel("render_bvh")?,
        };
        let tree = self.tree;
        let per_pass = SAMPLES_PER_PASS / params.samples.clamp(1, MAX_SAMPLES_PER_INVOCATION) as usize;
        in_parts(params, MAX_SAMPLES_PER_INVOCATION, |params| {
            self.shade(scene, params, sampler, &kernel, per_pass, |first, count| {
                RenderPush {
                    params: *params,
                    first,
                    count,
                    tree,
                }
            })
        })
    }

    fn render_path(
        &mut self,
        scene: &SceneArrays,
        params: &RenderParams,
        bounces: u32,
        sampler: Sampler,
    ) -> Result<Timed<Vec<[f32; 3]>>, BackendError> {
        let kernel = match sampler {
            Sampler::Uniform => self.device.kernel("path_uniform")?,
            Sampler::Power => self.device.kernel("path_power")?,
            Sampler::SingleLevel | Sampler::TwoLevel => self.kernel("path_bvh")?,
        };
        let tree = self.tree;
        let bounces = bounces.min(MAX_BOUNCES);
        let most = paths_per_invocation(bounces);
        let per_pass = SURFACES_PER_PASS / (params.samples.clamp(1, most) * (bounces + 1)) as usize;
        in_parts(params, most, |params| {
            self.shade(scene, params, sampler, &kernel, per_pass, |first, count| {
                PathPush {
                    params: *params,
                    bounces,
                    first,
                    count,
                    tree,
                }
            })
        })
    }
}

impl<C: Choice<W>, const W: usize> DeviceBackend<'_, C, W> {
    /// Runs a kernel over all pixels of an image, `per_pass` pixels to a dispatch, but at least a workgroup's.
    fn shade<T: bytemuck::Pod>(
        &self,
        scene: &SceneArrays,
        params: &RenderParams,
        sampler: Sampler,
        kernel: &Kernel,
        per_pass: usize,
        push: impl Fn(u32, u32) -> T,
    ) -> Result<Timed<Vec<[f32; 3]>>, BackendError> {
        let device = self.device;
        let ray_nodes = device.upload(&scene.rays.nodes)?;
        let surfaces = device.upload(&scene.rays.triangles)?;
        let materials = device.upload(&scene.materials)?;
        let lights = device.upload(scene.lights.triangles())?;
        let camera = device.upload(&[scene.camera])?;
        let thresholds = device.upload(&scene.thresholds)?;
        let common = [
            ray_nodes.bind(),
            surfaces.bind(),
            materials.bind(),
            lights.bind(),
            camera.bind(),
        ];
        let own = match sampler {
            Sampler::Uniform => vec![],
            Sampler::Power => vec![thresholds.bind()],
            Sampler::SingleLevel | Sampler::TwoLevel => {
                vec![self.nodes.bind(), self.instances.bind(), self.trails.bind()]
            }
        };

        let pixels = params.width as usize * params.height as usize;
        let per_pass = per_pass.max(WORKGROUP as usize);
        let mut all = Timed {
            value: Vec::with_capacity(pixels),
            time: Duration::ZERO,
        };
        for first in (0..pixels).step_by(per_pass) {
            let count = usize::min(per_pass, pixels - first);
            let output = device.output::<[f32; 3]>(count)?;
            let push = push(first as u32, count as u32);
            let bindings: Vec<Binding<'_>> = common
                .iter()
                .chain(&own)
                .copied()
                .chain([output.bind()])
                .collect();
            let mut pass = Pass::new();
            pass.dispatch(kernel, &bindings, bytes_of(&push), count as u32);
            all.time += device_time(&device.run(&pass)?);
            all.value.extend(output.read()?);
        }
        Ok(all)
    }
}

/// The kernels' own time by the device's clock, or else by ours.
pub(super) fn device_time(timings: &Timings) -> Duration {
    match &timings.dispatch_ns {
        Some(ns) => Duration::from_nanos(ns.iter().sum::<f64>() as u64),
        None => timings.wall,
    }
}

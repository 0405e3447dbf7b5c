//! The passes on a Vulkan device.

use std::sync::Arc;
use std::time::Duration;

use bytemuck::bytes_of;
use lightbvh::bvh::MeshCounts;
use lightbvh::refit::BlasRoot;
use lightbvh::{Lights, SampledLight};
use lightbvh_gpu::{Buffer as Array, Mirror, Refit};
use lightbvh_kernels::WORKGROUP;
use lightbvh_kernels::bvh::{Choice, Standard, WIDTH};
use lightbvh_kernels::path::PathPush;
use lightbvh_kernels::query::{Query, QueryPush};
use lightbvh_kernels::render::{RenderParams, RenderPush};
use lightbvh_kernels::shading::path::MAX_BOUNCES;

use super::batches::{all_candidates, in_batches};
use super::device_arrays::{DeviceEmitters, DeviceScene, DeviceTree, device_time, kernel_name, own};
use super::restir::device::resample;
use super::{
    Backend, BackendError, Bvh, Integrator, Restir, RestirFrame, Sampler, SceneArrays, Timed, node_record,
};
use crate::vulkan::{Binding, Buffer, Device, Kernel, Pass};
use crate::words::Record;

/// Queries per dispatch: 28 MiB of them, within the smallest storage buffer range seen (128 MiB).
const QUERIES_PER_PASS: usize = 1 << 20;
/// Light samples per render dispatch: keeps one dispatch well below the seconds after which a driver gives up on it.
const SAMPLES_PER_PASS: usize = 1 << 20;
/// Surfaces met by paths per dispatch, for the same reason; each costs two rays, a sampled light and a pmf.
const SURFACES_PER_PASS: usize = 1 << 18;

/// A light BVH on a device.
pub struct DeviceBackend<'d, C: Choice<W> = Standard, const W: usize = WIDTH> {
    pub(super) device: &'d Device,
    pub(super) tree: DeviceTree<C::Node>,
    pub(super) roots: Buffer<BlasRoot>,
    /// The refit of everything, and of how many triangles the meshes are then.
    pub(super) refit: Refit,
    pub(super) counts: MeshCounts,
    /// By which edits are followed.
    pub(super) mirror: Mirror,
}

impl<'d, C: Choice<W>, const W: usize> DeviceBackend<'d, C, W> {
    /// Uploads a BVH and refits all of it, for its own nodes may wait for that.
    ///
    /// # Errors
    /// [`BackendError`] when it does not fit, or the device fails.
    pub fn new(device: &'d Device, bvh: &Bvh<C, W>) -> Result<Self, BackendError> {
        let new = Self::as_built(device, bvh)?;
        new.refit_by(&new.refit)?;
        Ok(new)
    }

    /// Uploads a BVH whose own nodes wait for nothing, as of one that was built a moment ago: choices without kernels of a refit have
    /// such.
    ///
    /// # Errors
    /// [`BackendError`] when it does not fit, or the device fails.
    pub(crate) fn as_built(device: &'d Device, bvh: &Bvh<C, W>) -> Result<Self, BackendError> {
        // The copies of the first frame are the upload.
        let mut mirror = Mirror::default();
        let refit = mirror.follow(bvh).refit;
        Ok(Self {
            device,
            tree: DeviceTree::upload::<C, W>(device, &bvh.tree(), bvh.triangles())?,
            roots: device.upload(bvh.roots())?,
            refit,
            counts: bvh.mesh_counts(),
            mirror,
        })
    }

    /// Overwrites the device's nodes, so that a refit has something to change.
    ///
    /// # Errors
    /// [`BackendError`] from the device.
    pub fn write_nodes(&mut self, nodes: &[C::Node]) -> Result<(), BackendError> {
        Ok(self.tree.nodes.write(nodes)?)
    }

    /// The lights that `sampler` chooses among, where they are the light BVH's.
    pub(super) fn emitters(&self, sampler: Sampler) -> Option<DeviceEmitters> {
        sampler.needs_bvh().then(|| self.tree.emitters.clone())
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
            Some(Array::Nodes) => self.tree.nodes.bind(),
            Some(Array::Triangles) => self.tree.emitters.triangles.bind(),
            Some(Array::Instances) => self.tree.emitters.instances.bind(),
            Some(Array::Roots) => self.roots.bind(),
            Some(Array::Trails) => self.tree.trails.bind(),
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
    ) -> Result<Timed<Vec<T>>, BackendError> {
        self.query_by(&*self.kernel(kernel)?, queries)
    }

    /// Answers queries pass by pass, by a kernel that takes what `sample` takes.
    pub(crate) fn query_by<T: bytemuck::Pod>(
        &self,
        kernel: &Kernel,
        queries: &[Query],
    ) -> Result<Timed<Vec<T>>, BackendError> {
        let mut all = Timed {
            value: Vec::with_capacity(queries.len()),
            time: Duration::ZERO,
        };
        for part in queries.chunks(QUERIES_PER_PASS) {
            let input = self.device.upload(part)?;
            let output = self.device.output::<T>(part.len())?;
            let push = QueryPush {
                count: part.len() as u32,
                tree: self.tree.push,
            };
            let mut bindings = self.tree.bindings().to_vec();
            bindings.extend([input.bind(), output.bind()]);
            let mut pass = Pass::new();
            pass.dispatch(kernel, &bindings, bytes_of(&push), push.count);
            all.time += device_time(&self.device.run(&pass)?);
            all.value.extend(output.read()?);
        }
        Ok(all)
    }
}

impl<C: Choice<W>, const W: usize> Backend for DeviceBackend<'_, C, W> {
    fn node_record(&self) -> Record {
        node_record::<C::Node, W>()
    }

    fn refit(&mut self, lights: &Lights) -> Result<Timed<Vec<u32>>, BackendError> {
        self.counts.check(lights)?;
        own(&mut self.tree.emitters.triangles)?.write(lights.triangles())?;
        let time = self.refit_by(&self.refit)?;
        Ok(Timed {
            value: self.tree.nodes.read_words()?,
            time,
        })
    }

    fn nodes(&mut self) -> Result<Vec<u32>, BackendError> {
        Ok(self.tree.nodes.read_words()?)
    }

    fn sample(&mut self, queries: &[Query]) -> Result<Timed<Vec<SampledLight>>, BackendError> {
        self.query("sample", queries)
    }

    fn pmf(&mut self, queries: &[Query]) -> Result<Timed<Vec<f32>>, BackendError> {
        self.query("pmf", queries)
    }

    fn render(
        &mut self,
        scene: &SceneArrays,
        params: &RenderParams,
        sampler: Sampler,
        integrator: Integrator,
    ) -> Result<Timed<Vec<[f32; 3]>>, BackendError> {
        let device = self.device;
        let tree = self.tree.push;
        let candidates = all_candidates(params.candidates, params.scattered);
        let most = integrator.samples_per_invocation(candidates);
        let samples = params.samples.clamp(1, most) as usize;
        let (pass, per_pass) = match integrator {
            Integrator::Direct => {
                // Eight candidates take about as long as the sample's ray.
                (
                    "render",
                    SAMPLES_PER_PASS / (samples * candidates.div_ceil(8) as usize),
                )
            }
            Integrator::Path { bounces } => {
                let surfaces = bounces.min(MAX_BOUNCES) as usize + 1;
                ("path", SURFACES_PER_PASS / (samples * surfaces))
            }
        };
        let per_pass = per_pass.max(WORKGROUP as usize);
        let kernel = device.kernel(&kernel_name::<C, W>(pass, sampler))?;
        let scene = DeviceScene::upload(device, scene, self.emitters(sampler))?;
        let inputs = scene.with_lights(sampler, &self.tree);
        let pixels = params.width as usize * params.height as usize;
        in_batches(params, integrator, |&params| {
            let mut all = Timed {
                value: Vec::with_capacity(pixels),
                time: Duration::ZERO,
            };
            for first in (0..pixels).step_by(per_pass) {
                let count = usize::min(per_pass, pixels - first) as u32;
                let output = device.output::<[f32; 3]>(count as usize)?;
                let bindings = [inputs.as_slice(), &[output.bind()]].concat();
                let first = first as u32;
                let push = match integrator {
                    Integrator::Direct => bytes_of(&RenderPush {
                        params,
                        first,
                        count,
                        tree,
                    })
                    .to_vec(),
                    Integrator::Path { bounces } => bytes_of(&PathPush {
                        params,
                        bounces: bounces.min(MAX_BOUNCES),
                        first,
                        count,
                        tree,
                    })
                    .to_vec(),
                };
                let mut pass = Pass::new();
                pass.dispatch(&kernel, &bindings, &push, count);
                all.time += device_time(&device.run(&pass)?);
                all.value.extend(output.read()?);
            }
            Ok(all)
        })
    }

    fn restir(
        &mut self,
        restir: &mut Restir,
        frame: &RestirFrame<'_>,
    ) -> Result<Timed<Vec<[f32; 3]>>, BackendError> {
        resample::<C, W>(restir, frame, self)
    }
}

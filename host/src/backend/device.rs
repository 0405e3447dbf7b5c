//! The passes on a Vulkan device.

use std::time::Duration;

use bytemuck::bytes_of;
use lightbvh::SampledLight;
use lightbvh_gpu::{EQ4, KernelSet, MOMENTS};
use lightbvh_kernels::WORKGROUP;
use lightbvh_kernels::bvh::{Compiled, Triangles, WIDTH};
use lightbvh_kernels::query::{Query, QueryPush};
use lightbvh_kernels::render::{RenderParams, RenderPush};
use lightbvh_kernels::shading::direct::MAX_CANDIDATES;
use lightbvh_kernels::shading::path::MAX_BOUNCES;

use super::batches::in_batches;
use super::device_arrays::{bind, choosing};
use super::follow::{Mirrored, device_time};
use super::{Backend, BackendError, Bvh, Follow, Held, Integrator, Sampler, SceneArrays, Timed};
use crate::scene::SceneLight;
use crate::vulkan::{Device, Pass};

/// Queries per dispatch: 28 MiB of them, within the smallest storage buffer range seen (128 MiB).
const QUERIES_PER_PASS: usize = 1 << 20;
/// Light samples per render dispatch: keeps one dispatch well below the seconds after which a driver gives up on it.
const SAMPLES_PER_PASS: usize = 1 << 20;
/// Surfaces met by paths per dispatch, for the same reason; each costs two rays, a sampled light and a pmf.
const SURFACES_PER_PASS: usize = 1 << 18;

/// A light BVH on a device.
pub struct DeviceBackend<'d, C: Compiled<W> = Triangles, const W: usize = WIDTH> {
    tree: Mirrored<'d, C::Node, W>,
}

impl<'d, C: Compiled<W>, const W: usize> DeviceBackend<'d, C, W> {
    /// Uploads a BVH and refits all of it, for its own nodes may wait for that.
    pub fn new(device: &'d Device, bvh: &Bvh<C, W>) -> Result<Self, BackendError> {
        let kernels = match C::SUFFIX {
            "" => MOMENTS,
            "_eq4" => EQ4,
            _ => KernelSet::ANY,
        };
        let tree = Mirrored::new(device, kernels)?;
        let mut new = Self { tree };
        // The copies of the first frame are the upload.
        new.tree.follow(bvh)?;
        Ok(new)
    }

    /// Overwrites the device's nodes, those of bottom levels and of the top level, so that a refit has something to change.
    pub fn write_nodes(&mut self, nodes: &[C::Node], top: &[C::Node]) -> Result<(), BackendError> {
        let parts = [(0, nodes), (self.tree.top(), top)];
        Ok(self.tree.nodes.write(&parts)?)
    }

    /// Answers queries pass by pass.
    fn query<T: bytemuck::Pod>(
        &mut self,
        kernel: &lightbvh_gpu::Kernel,
        queries: &[Query],
    ) -> Result<Timed<Vec<T>>, BackendError> {
        let mut all = Timed {
            value: Vec::with_capacity(queries.len()),
            time: Duration::ZERO,
        };
        for part in queries.chunks(QUERIES_PER_PASS) {
            let input = self.tree.device().upload(part)?;
            let push = QueryPush {
                count: part.len() as u32,
                tree: self.tree.words(),
            };
            let others = [("queries", input.bind())];
            let answers = self.tree.ask::<T>(kernel, part.len(), bytes_of(&push), &others)?;
            all.time += answers.time;
            all.value.extend(answers.value);
        }
        Ok(all)
    }
}

impl<C: Compiled<W, Light: SceneLight>, const W: usize> Backend<C::Light> for DeviceBackend<'_, C, W> {
    fn sample(&mut self, queries: &[Query]) -> Result<Timed<Vec<SampledLight>>, BackendError> {
        self.query(self.tree.kernels().sample, queries)
    }

    fn pmf(&mut self, queries: &[Query]) -> Result<Timed<Vec<f32>>, BackendError> {
        self.query(self.tree.kernels().pmf, queries)
    }

    fn render(
        &mut self,
        scene: &SceneArrays<C::Light>,
        params: &RenderParams,
        sampler: Sampler,
        integrator: Integrator,
    ) -> Result<Timed<Vec<[f32; 3]>>, BackendError> {
        let device = self.tree.device();
        let tree = self.tree.words();
        let candidates = params.candidates.clamp(1, MAX_CANDIDATES);
        let most = integrator.samples_per_invocation(candidates);
        let samples = params.samples.clamp(1, most) as usize;
        let (pass, bounces, per_pass) = match integrator {
            // Eight candidates take about as long as the sample's ray.
            Integrator::Direct => (
                "render",
                0,
                SAMPLES_PER_PASS / (samples * candidates.div_ceil(8) as usize),
            ),
            Integrator::Path { bounces } => {
                let bounces = bounces.min(MAX_BOUNCES);
                let surfaces = bounces as usize + 1;
                ("render_paths", bounces, SURFACES_PER_PASS / (samples * surfaces))
            }
        };
        let per_pass = per_pass.max(WORKGROUP as usize);
        let kernel = device.kernel(&format!("{pass}{}", C::SUFFIX))?;
        let inputs = bind(device, scene, sampler, &self.tree)?;
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
                let push = RenderPush {
                    params,
                    bounces,
                    by: choosing(sampler),
                    first: first as u32,
                    count,
                    tree,
                };
                let mut pass = Pass::new();
                pass.dispatch(&kernel, &bindings, bytes_of(&push), count);
                all.time += device_time(&device.run(&pass)?);
                all.value.extend(output.read()?);
            }
            Ok(all)
        })
    }
}

impl<C: Compiled<W, Light: SceneLight>, const W: usize> Follow<C, W> for DeviceBackend<'_, C, W> {
    fn follow(&mut self, bvh: &Bvh<C, W>) -> Result<Timed<()>, BackendError> {
        let time = self.tree.follow(bvh)?;
        Ok(Timed { time, value: () })
    }

    fn held(&mut self, bvh: &Bvh<C, W>) -> Result<Vec<Held>, BackendError> {
        self.tree.held(bvh)
    }
}

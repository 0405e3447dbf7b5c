//! The passes on a Vulkan device.

use std::sync::Arc;
use std::time::Duration;

use bytemuck::bytes_of;
use lightbvh::SampledLight;
use lightbvh::refit::BlasRoot;
use lightbvh_gpu::{Buffer as Array, Mirror};
use lightbvh_kernels::WORKGROUP;
use lightbvh_kernels::bvh::{Choice, Standard, WIDTH};
use lightbvh_kernels::query::{Query, QueryPush};
use lightbvh_kernels::render::{RenderParams, RenderPush};
use lightbvh_kernels::shading::path::MAX_BOUNCES;

use super::batches::{all_candidates, in_batches};
use super::device_arrays::{DeviceTree, choosing, device_time, scene_bindings};
use super::held::Held;
use super::{Backend, BackendError, Bvh, Integrator, Sampler, SceneArrays, Timed, node_record};
use crate::scene::SceneLight;
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
    pub(super) tree: DeviceTree<C::Node, C::Light>,
    pub(super) roots: Buffer<BlasRoot>,
    /// What refits are listed in.
    pub(super) list: Buffer<u32>,
    /// By which a refit's passes hand over from children to nodes.
    pub(super) children: Buffer<u32>,
    /// By which edits are followed.
    pub(super) mirror: Mirror,
    /// What was followed and is not yet submitted.
    pub(super) pending: Option<Pass<'static>>,
    /// The scene rendered last.
    scene: Held,
}

impl<'d, C: Choice<W>, const W: usize> DeviceBackend<'d, C, W> {
    /// Uploads a BVH and refits all of it, for its own nodes may wait for that.
    ///
    /// # Errors
    /// [`BackendError`] when it does not fit, or the device fails.
    pub fn new(device: &'d Device, bvh: &Bvh<C, W>) -> Result<Self, BackendError> {
        let mut new = Self {
            device,
            tree: DeviceTree::new(device)?,
            roots: device.buffer(0, 1)?,
            list: device.buffer(0, 1)?,
            children: device.buffer(0, 1)?,
            mirror: Mirror::default(),
            pending: None,
            scene: Held::default(),
        };
        // The copies of the first frame are the upload.
        new.follow_ahead(bvh)?;
        new.flush()?;
        Ok(new)
    }

    /// Overwrites the device's nodes, those of bottom levels and of the top level, so that a refit has something to change.
    ///
    /// # Errors
    /// [`BackendError`] from the device.
    pub fn write_nodes(&mut self, nodes: &[C::Node], top: &[C::Node]) -> Result<(), BackendError> {
        let mut pass = self.led();
        pass.write(&self.tree.nodes, 0, nodes)?;
        pass.write(&self.tree.nodes, self.tree.top.start, top)?;
        self.submit(&pass)?;
        Ok(())
    }

    /// The kernel of this choice.
    pub(super) fn kernel(&self, name: &str) -> Result<Arc<Kernel>, BackendError> {
        Ok(self.device.kernel(&format!("{name}{}", C::SUFFIX))?)
    }

    /// What a kernel of a refit takes, by the names of its bindings.
    pub(super) fn buffers(&self, kernel: &Kernel) -> Vec<Binding> {
        let bind = |name: &str, stride: u32| match Array::named(name) {
            Some(Array::Nodes) => self.tree.nodes.bind(),
            Some(Array::Triangles) => self.tree.triangles.bind(),
            Some(Array::Instances) => self.tree.instances.bind(),
            Some(Array::Roots) => self.roots.bind(),
            Some(Array::Trails) => self.tree.trails.bind(),
            None if name == "children" => self.children.bind().of_elements(stride),
            None => self.list.bind(),
        };
        let known = lightbvh_gpu::Kernel::named(kernel.name()).map_or(&[][..], |known| known.bindings);
        known
            .iter()
            .map(|binding| bind(binding.name, binding.stride))
            .collect()
    }

    /// Answers queries pass by pass.
    fn query<T: bytemuck::Pod>(
        &mut self,
        kernel: &str,
        queries: &[Query],
    ) -> Result<Timed<Vec<T>>, BackendError> {
        self.query_by(&self.kernel(kernel)?, queries)
    }

    /// Answers queries pass by pass, by a kernel that takes what `sample` takes. A pass is one submission, with what was
    /// followed before it.
    #[doc(hidden)]
    pub fn query_by<T: bytemuck::Pod>(
        &mut self,
        kernel: &Arc<Kernel>,
        queries: &[Query],
    ) -> Result<Timed<Vec<T>>, BackendError> {
        let mut all = Timed {
            value: Vec::with_capacity(queries.len()),
            time: Duration::ZERO,
        };
        for part in queries.chunks(QUERIES_PER_PASS) {
            let input = self.device.buffer(part.len(), 0)?;
            let output = self.device.buffer::<T>(part.len(), 0)?;
            let push = QueryPush {
                count: part.len() as u32,
                tree: self.tree.push,
            };
            let mut bindings = self.tree.bindings().to_vec();
            bindings.extend([input.bind(), output.bind()]);
            let mut pass = self.led();
            let followed = pass.len();
            pass.clear(&output);
            pass.write(&input, 0, part)?;
            pass.dispatch(kernel, &bindings, bytes_of(&push), push.count);
            let submitted = self.submit(&pass)?;
            all.value.extend(output.read()?);
            all.time += device_time(&submitted.wait()?.after(followed));
        }
        Ok(all)
    }
}

impl<C: Choice<W, Light: SceneLight>, const W: usize> Backend<C::Light> for DeviceBackend<'_, C, W> {
    fn node_record(&self) -> Record {
        node_record::<C::Node, W>()
    }

    fn nodes(&mut self) -> Result<Vec<u32>, BackendError> {
        self.flush()?;
        Ok(self.tree.node_words()?)
    }

    fn sample(&mut self, queries: &[Query]) -> Result<Timed<Vec<SampledLight>>, BackendError> {
        self.query("sample", queries)
    }

    fn pmf(&mut self, queries: &[Query]) -> Result<Timed<Vec<f32>>, BackendError> {
        self.query("pmf", queries)
    }

    fn render(
        &mut self,
        scene: &SceneArrays<C::Light>,
        params: &RenderParams,
        sampler: Sampler,
        integrator: Integrator,
    ) -> Result<Timed<Vec<[f32; 3]>>, BackendError> {
        let device = self.device;
        let tree = self.tree.push;
        let candidates = all_candidates(params.candidates, params.scattered);
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
        let kernel = device.kernel_with(&format!("{pass}{}", C::SUFFIX), choosing(sampler))?;
        let mut pass = self.led();
        let mut followed = pass.len();
        let inputs = scene_bindings(device, &mut self.scene, scene, sampler, &self.tree, &mut pass);
        let inputs = inputs.inspect_err(|_| self.scene = Held::default())?;
        let pixels = params.width as usize * params.height as usize;
        // The first part comes with the scene.
        let mut first_pass = Some(pass);
        let image = in_batches(params, integrator, |&params| {
            let mut all = Timed {
                value: Vec::with_capacity(pixels),
                time: Duration::ZERO,
            };
            let mut parts = Vec::new();
            for first in (0..pixels).step_by(per_pass) {
                let count = usize::min(per_pass, pixels - first) as u32;
                let output = device.buffer::<[f32; 3]>(count as usize, 0)?;
                let bindings = [inputs.as_slice(), &[output.bind()]].concat();
                let push = RenderPush {
                    params,
                    bounces,
                    first: first as u32,
                    count,
                    tree,
                };
                let mut pass = first_pass.take().unwrap_or_default();
                pass.clear(&output);
                pass.dispatch(&kernel, &bindings, bytes_of(&push), count);
                parts.push((self.submit(&pass)?, output, std::mem::take(&mut followed)));
            }
            for (submitted, output, followed) in parts {
                all.value.extend(output.read()?);
                all.time += device_time(&submitted.wait()?.after(followed));
            }
            Ok(all)
        });
        if image.is_err() {
            // What the device holds is not known.
            self.scene = Held::default();
        }
        image
    }
}

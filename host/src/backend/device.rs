//! The passes on a Vulkan device.

use std::time::Duration;

use bytemuck::bytes_of;
use lightbvh::refit::BlasRoot;
use lightbvh::{EmissiveTriangle, Instance, Lights};
use lightbvh_kernels::WORKGROUP;
use lightbvh_kernels::bvh::{Node, TreePush};
use lightbvh_kernels::path::PathPush;
use lightbvh_kernels::query::{Query, QueryPush, Sampled};
use lightbvh_kernels::refit::RefitPush;
use lightbvh_kernels::render::{RenderParams, RenderPush};
use lightbvh_kernels::shading::path::MAX_BOUNCES;

use super::climb::Climb;
use super::parts::{MAX_SAMPLES_PER_INVOCATION, in_parts, paths_per_invocation};
use super::{Backend, Bvh, LightScene, Sampler, SceneArrays, Timed};
use crate::vulkan::{Binding, Buffer, Device, Pass, Timings, VulkanError};

/// Queries per dispatch: 28 MiB of them, within the smallest storage buffer range seen (128 MiB).
const QUERIES_PER_PASS: usize = 1 << 20;
/// Light samples per render dispatch: keeps one dispatch well below the seconds after which a driver gives up on it.
const SAMPLES_PER_PASS: usize = 1 << 20;
/// Surfaces met by paths per dispatch, for the same reason; each costs two rays, a sampled light and a pmf.
const SURFACES_PER_PASS: usize = 1 << 18;

/// A light BVH on a device.
pub struct DeviceBackend<'d> {
    pub(super) device: &'d Device,
    pub(super) nodes: Buffer<Node>,
    pub(super) meshes: Buffer<Instance>,
    pub(super) roots: Buffer<BlasRoot>,
    pub(super) trails: Buffer<u32>,
    /// The lights in the world.
    pub(super) triangles: Buffer<EmissiveTriangle>,
    /// The triangles of bottom levels, where those are not the lights in the world.
    pub(super) local: Option<Buffer<EmissiveTriangle>>,
    /// The lists that refit runs over, one after the other; the dispatches below are parts of it.
    lists: Buffer<u32>,
    /// Nodes of the bottom levels, then those with inner children level by level.
    bottom_nodes: RefitPush,
    bottom: Vec<RefitPush>,
    bottom_roots: RefitPush,
    /// Nodes of the top level, then those with inner children level by level.
    top_nodes: RefitPush,
    top: Vec<RefitPush>,
    /// The plan of refits with one dispatch, made by the first of them.
    pub(super) climb: Option<Climb>,
    pub(super) tree: TreePush,
}

impl<'d> DeviceBackend<'d> {
    /// Uploads a BVH and its lights.
    ///
    /// # Errors
    /// [`VulkanError`] when they do not fit, or the device fails.
    pub fn new(device: &'d Device, bvh: &Bvh, lights: &Lights) -> Result<Self, VulkanError> {
        let tree = bvh.tree();
        let two_level = bvh.is_two_level();
        let node_count = tree.nodes.len() as u32;
        let bottom_count = if two_level { tree.root } else { node_count };
        let mut lists = Vec::new();
        let mut list = |entries: &mut dyn Iterator<Item = u32>| {
            let first = lists.len() as u32;
            lists.extend(entries);
            let count = lists.len() as u32 - first;
            RefitPush { first, count }
        };
        let bottom_nodes = list(&mut (0..bottom_count));
        let (bottom_levels, top_levels) = (bvh.bottom_levels(), bvh.top_levels());
        let bottom = bottom_levels
            .ranges()
            .map(|range| list(&mut bottom_levels.nodes()[range].iter().copied()))
            .collect();
        let bottom_roots = list(&mut (0..bvh.roots().len() as u32));
        let top_nodes = list(&mut (bottom_count..node_count));
        let top = top_levels
            .ranges()
            .map(|range| list(&mut top_levels.nodes()[range].iter().copied()))
            .collect();
        Ok(Self {
            device,
            nodes: device.upload(tree.nodes)?,
            meshes: device.upload(tree.meshes)?,
            trails: device.upload(tree.trails)?,
            triangles: device.upload(lights.triangles())?,
            local: None,
            roots: device.upload(bvh.roots())?,
            lists: device.upload(&lists)?,
            bottom_nodes,
            bottom,
            bottom_roots,
            top_nodes,
            top,
            climb: None,
            tree: TreePush {
                root: tree.root,
                trail_words: tree.trail_words,
                two_level: u32::from(two_level),
            },
        })
    }

    /// Uploads moving lights, planned or refitted; `lights` are those in the world.
    ///
    /// # Errors
    /// [`VulkanError`] when they do not fit, or the device fails.
    pub fn of_scene(device: &'d Device, scene: &LightScene, lights: &Lights) -> Result<Self, VulkanError> {
        let tree = scene.tree();
        let none = RefitPush { first: 0, count: 0 };
        Ok(Self {
            device,
            nodes: device.upload(tree.nodes)?,
            meshes: device.upload(tree.meshes)?,
            trails: device.upload(tree.trails)?,
            triangles: device.upload(lights.triangles())?,
            local: Some(device.upload(scene.triangles())?),
            roots: device.upload(scene.roots())?,
            lists: device.upload(&[])?,
            bottom_nodes: none,
            bottom: Vec::new(),
            bottom_roots: none,
            top_nodes: none,
            top: Vec::new(),
            climb: None,
            tree: TreePush {
                root: tree.root,
                trail_words: tree.trail_words,
                two_level: 1,
            },
        })
    }

    /// Overwrites the device's nodes, so that a refit has something to change.
    ///
    /// # Errors
    /// [`VulkanError`] from the device.
    pub fn write_nodes(&mut self, nodes: &[Node]) -> Result<(), VulkanError> {
        self.climb = None;
        self.nodes.write(nodes)
    }

    /// Answers queries pass by pass.
    fn query<T: bytemuck::Pod>(
        &self,
        kernel: &str,
        queries: &[Query],
        bindings: &[Binding<'_>],
    ) -> Result<Timed<Vec<T>>, VulkanError> {
        let kernel = self.device.kernel(kernel)?;
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

impl Backend for DeviceBackend<'_> {
    fn name(&self) -> &str {
        self.device.name()
    }

    fn refit(&mut self, lights: &Lights) -> Result<Timed<Vec<Node>>, VulkanError> {
        self.triangles.write(lights.triangles())?;
        let leaves = self.device.kernel("refit_leaves")?;
        let level = self.device.kernel("refit_level")?;
        let roots = self.device.kernel("refit_roots")?;
        let instances = self.device.kernel("refit_instances")?;
        let (lists, nodes) = (self.lists.bind(), self.nodes.bind());
        let by_triangle = [lists, self.triangles.bind(), nodes];
        let by_level = [lists, nodes];
        let by_root = [lists, nodes, self.roots.bind()];
        let by_instance = [lists, self.meshes.bind(), self.roots.bind(), nodes];

        let mut pass = Pass::new();
        let dispatches = std::iter::once((&leaves, &by_triangle[..], &self.bottom_nodes))
            .chain(self.bottom.iter().map(|push| (&level, &by_level[..], push)))
            .chain([
                (&roots, &by_root[..], &self.bottom_roots),
                (&instances, &by_instance[..], &self.top_nodes),
            ])
            .chain(self.top.iter().map(|push| (&level, &by_level[..], push)));
        for (kernel, bindings, push) in dispatches {
            if push.count > 0 {
                pass.dispatch(kernel, bindings, bytes_of(push), push.count);
            }
        }
        let time = device_time(&self.device.run(&pass)?);
        Ok(Timed {
            value: self.nodes.read()?,
            time,
        })
    }

    fn refit_once(&mut self, lights: &Lights) -> Result<Timed<Vec<Node>>, VulkanError> {
        self.refit_bvh_once(lights)
    }

    fn follow(&mut self, scene: &LightScene, lights: &Lights) -> Result<Timed<()>, VulkanError> {
        self.follow_scene(scene, lights)
    }

    fn nodes(&mut self) -> Result<Vec<Node>, VulkanError> {
        self.nodes.read()
    }

    fn sample(&mut self, queries: &[Query]) -> Result<Timed<Vec<Sampled>>, VulkanError> {
        self.query(
            "sample",
            queries,
            &[self.nodes.bind(), self.meshes.bind(), self.trails.bind()],
        )
    }

    fn pmf(&mut self, queries: &[Query]) -> Result<Timed<Vec<f32>>, VulkanError> {
        let bindings = [
            self.nodes.bind(),
            self.meshes.bind(),
            self.trails.bind(),
            self.triangles.bind(),
        ];
        self.query("pmf", queries, &bindings)
    }

    fn render(
        &mut self,
        scene: &SceneArrays,
        params: &RenderParams,
        sampler: Sampler,
    ) -> Result<Timed<Vec<[f32; 3]>>, VulkanError> {
        let kernel = match sampler {
            Sampler::Uniform => "render_uniform",
            Sampler::Power => "render_power",
            Sampler::SingleLevel | Sampler::TwoLevel => "render_bvh",
        };
        let tree = self.tree;
        let per_pass = SAMPLES_PER_PASS / params.samples.clamp(1, MAX_SAMPLES_PER_INVOCATION) as usize;
        in_parts(params, MAX_SAMPLES_PER_INVOCATION, |params| {
            self.shade(scene, params, sampler, kernel, per_pass, |first, count| {
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
    ) -> Result<Timed<Vec<[f32; 3]>>, VulkanError> {
        let kernel = match sampler {
            Sampler::Uniform => "path_uniform",
            Sampler::Power => "path_power",
            Sampler::SingleLevel | Sampler::TwoLevel => "path_bvh",
        };
        let tree = self.tree;
        let bounces = bounces.min(MAX_BOUNCES);
        let most = paths_per_invocation(bounces);
        let per_pass = SURFACES_PER_PASS / (params.samples.clamp(1, most) * (bounces + 1)) as usize;
        in_parts(params, most, |params| {
            self.shade(scene, params, sampler, kernel, per_pass, |first, count| {
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

impl DeviceBackend<'_> {
    /// Runs a kernel over all pixels of an image, `per_pass` pixels to a dispatch, but at least a workgroup's.
    fn shade<T: bytemuck::Pod>(
        &self,
        scene: &SceneArrays,
        params: &RenderParams,
        sampler: Sampler,
        kernel: &str,
        per_pass: usize,
        push: impl Fn(u32, u32) -> T,
    ) -> Result<Timed<Vec<[f32; 3]>>, VulkanError> {
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
                vec![self.nodes.bind(), self.meshes.bind(), self.trails.bind()]
            }
        };
        let kernel = device.kernel(kernel)?;

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
            pass.dispatch(&kernel, &bindings, bytes_of(&push), count as u32);
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

//! The passes on a Vulkan device.

use std::time::Duration;

use bytemuck::bytes_of;
use lightbvh::{EmissiveTriangle, Lights, MeshLight};
use lightbvh_kernels::bvh::{Node, TreePush};
use lightbvh_kernels::query::{Query, QueryPush, Sampled};
use lightbvh_kernels::refit::RefitPush;
use lightbvh_kernels::render::{RenderParams, RenderPush};

use super::{Backend, Bvh, Sampler, SceneArrays, Timed};
use crate::vulkan::{Binding, Buffer, Device, Pass, Timings, VulkanError};

/// Queries per dispatch: 28 MiB of them, within the smallest storage buffer range seen (128 MiB).
const QUERIES_PER_PASS: usize = 1 << 20;
/// Light samples per render dispatch: keeps one dispatch well below the seconds after which a driver gives up on it.
const SAMPLES_PER_PASS: usize = 1 << 20;

/// A light BVH on a device.
pub struct DeviceBackend<'d> {
    device: &'d Device,
    nodes: Buffer<Node>,
    meshes: Buffer<MeshLight>,
    trails: Buffer<u32>,
    triangles: Buffer<EmissiveTriangle>,
    levels: Buffer<u32>,
    /// Dispatches of `refit_level` as (first entry, count), those of the bottom levels and those of the top level.
    bottom: Vec<RefitPush>,
    top: Vec<RefitPush>,
    /// Nodes of the bottom levels and of the top level.
    bottom_nodes: RefitPush,
    top_nodes: RefitPush,
    tree: TreePush,
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
        let list = [bvh.bottom_levels().nodes(), bvh.top_levels().nodes()].concat();
        let at = bvh.bottom_levels().nodes().len() as u32;
        let push = |offset: u32, range: std::ops::Range<usize>| RefitPush {
            first: offset + range.start as u32,
            count: range.len() as u32,
        };
        Ok(Self {
            device,
            nodes: device.upload(tree.nodes)?,
            meshes: device.upload(tree.meshes)?,
            trails: device.upload(tree.trails)?,
            triangles: device.upload(lights.triangles())?,
            levels: device.upload(&list)?,
            bottom: bvh.bottom_levels().ranges().map(|range| push(0, range)).collect(),
            top: bvh.top_levels().ranges().map(|range| push(at, range)).collect(),
            bottom_nodes: RefitPush {
                first: 0,
                count: bottom_count,
            },
            top_nodes: RefitPush {
                first: bottom_count,
                count: node_count - bottom_count,
            },
            tree: TreePush {
                root: tree.root,
                trail_words: tree.trail_words,
                two_level: u32::from(two_level),
            },
        })
    }

    /// Overwrites the device's nodes, so that a refit has something to change.
    ///
    /// # Errors
    /// [`VulkanError`] from the device.
    pub fn write_nodes(&mut self, nodes: &[Node]) -> Result<(), VulkanError> {
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
        let mesh_leaves = self.device.kernel("refit_mesh_leaves")?;
        let mut pass = Pass::new();
        let by_triangle = [self.triangles.bind(), self.nodes.bind()];
        let by_level = [self.levels.bind(), self.nodes.bind()];
        let by_mesh = [self.meshes.bind(), self.nodes.bind()];
        pass.dispatch(
            &leaves,
            &by_triangle,
            bytes_of(&self.bottom_nodes),
            self.bottom_nodes.count,
        );
        for push in &self.bottom {
            pass.dispatch(&level, &by_level, bytes_of(push), push.count);
        }
        if self.top_nodes.count > 0 {
            pass.dispatch(
                &mesh_leaves,
                &by_mesh,
                bytes_of(&self.top_nodes),
                self.top_nodes.count,
            );
        }
        for push in &self.top {
            pass.dispatch(&level, &by_level, bytes_of(push), push.count);
        }
        let time = device_time(&self.device.run(&pass)?);
        Ok(Timed {
            value: self.nodes.read()?,
            time,
        })
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
        let (kernel, own) = match sampler {
            Sampler::Uniform => ("render_uniform", vec![]),
            Sampler::Power => ("render_power", vec![thresholds.bind()]),
            Sampler::SingleLevel | Sampler::TwoLevel => (
                "render_bvh",
                vec![self.nodes.bind(), self.meshes.bind(), self.trails.bind()],
            ),
        };
        let kernel = device.kernel(kernel)?;

        let pixels = params.width as usize * params.height as usize;
        let per_pass = (SAMPLES_PER_PASS / usize::max(params.samples as usize, 1)).max(64);
        let mut all = Timed {
            value: Vec::with_capacity(pixels),
            time: Duration::ZERO,
        };
        for first in (0..pixels).step_by(per_pass) {
            let count = usize::min(per_pass, pixels - first);
            let output = device.output::<[f32; 3]>(count)?;
            let push = RenderPush {
                params: *params,
                first: first as u32,
                count: count as u32,
                tree: self.tree,
            };
            let bindings: Vec<Binding<'_>> = common
                .iter()
                .chain(&own)
                .copied()
                .chain([output.bind()])
                .collect();
            let mut pass = Pass::new();
            pass.dispatch(&kernel, &bindings, bytes_of(&push), push.count);
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

//! A frame of a scene, and what its lights are chosen by, on a device.

use std::ops::Range;
use std::time::Duration;

use bytemuck::Pod;
use lightbvh::Instance;
use lightbvh::TreeWords;
use lightbvh_kernels::shading::pick::by;

use super::held::Held;
use super::{Sampler, SceneArrays};
use crate::scene::SceneLight;
use crate::vulkan::{Binding, Buffer, Device, Pass, Timings, VulkanError};

/// The buffers of a frame's arrays, in the order in which the render passes take them, once `pass` has run, which writes what
/// differs from the frame before. Lights that `sampler` finds in `tree` are the tree's, others those that the frame lists.
pub(super) fn scene_bindings<'a, N: Pod, L: SceneLight>(
    device: &Device,
    held: &mut Held,
    scene: &'a SceneArrays<L>,
    sampler: Sampler,
    tree: &DeviceTree<N, L>,
    pass: &mut Pass<'a>,
) -> Result<Vec<Binding>, VulkanError> {
    let listed = scene.emitters();
    let thresholds = match sampler {
        Sampler::Power => &scene.thresholds[..],
        _ => &[],
    };
    let camera = std::slice::from_ref(&scene.camera);
    let mut bindings = vec![
        held.bring(device, "ray_nodes", &scene.rays.nodes, pass)?,
        held.bring(device, "surfaces", &scene.rays.blocks, pass)?,
        held.bring(device, "materials", &scene.materials, pass)?,
    ];
    bindings.extend(match sampler.needs_bvh() {
        true => [tree.triangles.bind(), tree.instances.bind()],
        false => [
            held.bring(device, "triangles", listed.triangles, pass)?,
            held.bring(device, "instances", listed.instances, pass)?,
        ],
    });
    bindings.extend([
        held.bring(device, "camera", camera, pass)?,
        tree.nodes.bind(),
        tree.trails.bind(),
        held.bring(device, "thresholds", thresholds, pass)?,
    ]);
    if L::IS_ANY {
        let sky = scene.sky.view();
        bindings.extend([
            held.bring(device, "suns", sky.suns, pass)?,
            held.bring(device, "sky_counts", sky.counts, pass)?,
            held.bring(device, "sky_radiance", sky.radiance, pass)?,
            held.bring(device, "corners", &scene.skin.corners, pass)?,
            held.bring(device, "paint", &scene.skin.words, pass)?,
        ]);
    }
    Ok(bindings)
}

/// The arrays of a light BVH on the device.
pub(super) struct DeviceTree<N, L> {
    pub nodes: Buffer<N>,
    /// How many of them are of bottom levels, and which are of the top level.
    pub bottoms: usize,
    pub top: Range<usize>,
    /// In the spaces of their meshes.
    pub triangles: Buffer<L>,
    pub instances: Buffer<Instance>,
    pub trails: Buffer<u32>,
    pub push: TreeWords,
}

impl<N: Pod, L: Pod> DeviceTree<N, L> {
    /// Empty arrays on `device`.
    pub fn new(device: &Device) -> Result<Self, VulkanError> {
        Ok(Self {
            nodes: device.buffer(0, 1)?,
            bottoms: 0,
            top: 0..0,
            triangles: device.buffer(0, 1)?,
            instances: device.buffer(0, 1)?,
            trails: device.buffer(0, 1)?,
            push: TreeWords::default(),
        })
    }

    /// The words of all nodes: those of bottom levels, then of the top level.
    pub fn node_words(&self) -> Result<Vec<u32>, VulkanError> {
        let words = self.nodes.read_words()?;
        let own = size_of::<N>() / size_of::<u32>();
        let top = &words[self.top.start * own..self.top.end * own];
        Ok([&words[..self.bottoms * own], top].concat())
    }

    /// What the passes of queries take.
    pub fn bindings(&self) -> [Binding; 3] {
        [self.nodes.bind(), self.instances.bind(), self.trails.bind()]
    }
}

/// What says in kernels that lights are chosen by `sampler`.
pub(super) fn choosing(sampler: Sampler) -> u32 {
    match sampler {
        Sampler::Uniform => by::UNIFORM,
        Sampler::Power => by::POWER,
        Sampler::SingleLevel | Sampler::TwoLevel => by::TREE,
    }
}

/// The kernels' own time by the device's clock, or else by ours.
pub(super) fn device_time(timings: &Timings) -> Duration {
    match &timings.dispatch_ns {
        Some(ns) => Duration::from_nanos(ns.iter().sum::<f64>() as u64),
        None => timings.wall,
    }
}

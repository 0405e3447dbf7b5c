//! A frame of a scene, and what its lights are chosen by, on a device.

use std::sync::Arc;
use std::time::Duration;

use bytemuck::Pod;
use lightbvh::TreeWords;
use lightbvh::{EmissiveTriangle, Instance};
use lightbvh_kernels::bvh::{Choice, TreeOf};
use lightbvh_kernels::shading::camera::Camera;
use lightbvh_kernels::shading::material::Material;
use lightbvh_kernels::shading::trace::{RayNode, TriangleBlock};

use super::{Sampler, SceneArrays};
use crate::vulkan::{Binding, Buffer, Device, Timings, VulkanError};

/// Lights on the device: triangles in the spaces of their meshes, and where the meshes stand. Who shares them reads them as they
/// were when it took them.
#[derive(Clone)]
pub(super) struct DeviceEmitters {
    pub triangles: Arc<Buffer<EmissiveTriangle>>,
    pub instances: Arc<Buffer<Instance>>,
}

impl DeviceEmitters {
    pub fn upload(
        device: &Device,
        triangles: &[EmissiveTriangle],
        instances: &[Instance],
    ) -> Result<Self, VulkanError> {
        Ok(Self {
            triangles: Arc::new(device.upload(triangles)?),
            instances: Arc::new(device.upload(instances)?),
        })
    }
}

/// The buffer to be written: a copy on the device where something else reads it as it is.
pub(super) fn own<T: Pod>(buffer: &mut Arc<Buffer<T>>) -> Result<&mut Buffer<T>, VulkanError> {
    if Arc::get_mut(buffer).is_none() {
        *buffer = Arc::new(buffer.duplicate()?);
    }
    Ok(Arc::get_mut(buffer).expect("no one else has the copy"))
}

/// A frame's arrays on the device.
pub(super) struct DeviceScene {
    pub ray_nodes: Buffer<RayNode>,
    pub surfaces: Buffer<TriangleBlock>,
    pub materials: Buffer<Material>,
    pub emitters: DeviceEmitters,
    pub camera: Buffer<Camera>,
    pub thresholds: Buffer<u32>,
}

impl DeviceScene {
    /// Uploads a frame, lit by `emitters` or, without, by the lights that it lists.
    pub fn upload(
        device: &Device,
        scene: &SceneArrays,
        emitters: Option<DeviceEmitters>,
    ) -> Result<Self, VulkanError> {
        let listed = scene.emitters();
        Ok(Self {
            ray_nodes: device.upload(&scene.rays.nodes)?,
            surfaces: device.upload(&scene.rays.blocks)?,
            materials: device.upload(&scene.materials)?,
            emitters: match emitters {
                Some(emitters) => emitters,
                None => DeviceEmitters::upload(device, listed.triangles, listed.instances)?,
            },
            camera: device.upload(&[scene.camera])?,
            thresholds: device.upload(&scene.thresholds)?,
        })
    }

    /// The buffers that a [`Scene`](lightbvh_kernels::shading::pixel::Scene) is made of.
    pub fn view(&self) -> [Binding<'_>; 5] {
        [
            self.ray_nodes.bind(),
            self.surfaces.bind(),
            self.materials.bind(),
            self.emitters.triangles.bind(),
            self.emitters.instances.bind(),
        ]
    }

    /// What a kernel that chooses lights by `sampler` takes from the scene on: the scene, who looks, and what lights are
    /// chosen by.
    pub fn with_lights<'a, N: Pod>(&'a self, sampler: Sampler, tree: &'a DeviceTree<N>) -> Vec<Binding<'a>> {
        let mut bindings = self.view().to_vec();
        bindings.push(self.camera.bind());
        match sampler {
            Sampler::Uniform => {}
            Sampler::Power => bindings.push(self.thresholds.bind()),
            Sampler::SingleLevel | Sampler::TwoLevel => {
                bindings.extend([tree.nodes.bind(), tree.trails.bind()]);
            }
        }
        bindings
    }
}

/// The arrays of a light BVH on the device.
pub(super) struct DeviceTree<N> {
    pub nodes: Buffer<N>,
    pub emitters: DeviceEmitters,
    pub trails: Buffer<u32>,
    pub push: TreeWords,
}

impl<N: Pod> DeviceTree<N> {
    pub fn upload<C: Choice<W, Node = N>, const W: usize>(
        device: &Device,
        tree: &TreeOf<'_, C, W>,
        triangles: &[EmissiveTriangle],
    ) -> Result<Self, VulkanError> {
        Ok(Self {
            nodes: device.upload(tree.nodes)?,
            emitters: DeviceEmitters::upload(device, triangles, tree.instances)?,
            trails: device.upload(tree.trails)?,
            push: TreeWords::of(tree),
        })
    }

    /// What the passes of queries take.
    pub fn bindings(&self) -> [Binding<'_>; 3] {
        [
            self.nodes.bind(),
            self.emitters.instances.bind(),
            self.trails.bind(),
        ]
    }
}

/// The name of the kernel of `pass` that chooses lights by `sampler`.
pub(super) fn kernel_name<C: Choice<W>, const W: usize>(pass: &str, sampler: Sampler) -> String {
    match sampler {
        Sampler::Uniform => format!("{pass}_uniform"),
        Sampler::Power => format!("{pass}_power"),
        Sampler::SingleLevel | Sampler::TwoLevel => format!("{pass}_bvh{}", C::SUFFIX),
    }
}

/// The kernels' own time by the device's clock, or else by ours.
pub(super) fn device_time(timings: &Timings) -> Duration {
    match &timings.dispatch_ns {
        Some(ns) => Duration::from_nanos(ns.iter().sum::<f64>() as u64),
        None => timings.wall,
    }
}

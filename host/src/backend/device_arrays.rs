//! A frame of a scene on a device.

use std::collections::BTreeMap;
use std::time::Duration;

use bytemuck::{Pod, cast_slice};
use lightbvh_kernels::shading::pick::by;

use super::follow::DeviceTree;
use super::{Sampler, SceneArrays};
use crate::scene::SceneLight;
use crate::vulkan::{Binding, Device, Timings, VulkanError};

/// A frame's arrays on the device. Who keeps them reads them as they were.
pub(super) struct DeviceScene {
    ray_nodes: Binding,
    surfaces: Binding,
    materials: Binding,
    /// In the spaces of their meshes.
    triangles: Binding,
    instances: Binding,
    pub camera: Binding,
    /// Empty where lights are not chosen by power.
    thresholds: Binding,
    /// Suns and a map beyond all surfaces, for kernels that know of them.
    sky: Vec<Binding>,
    /// What is painted on surfaces, for the same.
    skin: Vec<Binding>,
}

/// The arrays of the scene that was rendered last, by name: their bytes, and where they are on the device.
#[derive(Default)]
pub(super) struct HeldScene(BTreeMap<&'static str, (Vec<u8>, Binding)>);

impl HeldScene {
    /// A frame's arrays for a kernel that chooses lights by `sampler`; what differs from the frame before is uploaded. They are
    /// lit by the light BVH's `emitters` or, without, by the lights that the frame lists.
    pub fn bring<L: SceneLight>(
        &mut self,
        device: &Device,
        scene: &SceneArrays<L>,
        sampler: Sampler,
        emitters: Option<[Binding; 2]>,
    ) -> Result<DeviceScene, VulkanError> {
        let listed = scene.emitters();
        let thresholds = match sampler {
            Sampler::Power => &scene.thresholds[..],
            _ => &[],
        };
        let [triangles, instances] = match emitters {
            Some(emitters) => emitters,
            None => [
                self.array(device, "triangles", listed.triangles)?,
                self.array(device, "instances", listed.instances)?,
            ],
        };
        let (mut sky, mut skin) = (Vec::new(), Vec::new());
        if L::IS_ANY {
            let own = scene.sky.view();
            sky.push(self.array(device, "suns", own.suns)?);
            sky.push(self.array(device, "sky_counts", own.counts)?);
            sky.push(self.array(device, "sky_radiance", own.radiance)?);
            skin.push(self.array(device, "corners", &scene.skin.corners)?);
            skin.push(self.array(device, "paint", &scene.skin.words)?);
        }
        Ok(DeviceScene {
            ray_nodes: self.array(device, "ray_nodes", &scene.rays.nodes)?,
            surfaces: self.array(device, "surfaces", &scene.rays.blocks)?,
            materials: self.array(device, "materials", &scene.materials)?,
            triangles,
            instances,
            camera: self.array(device, "camera", &[scene.camera])?,
            thresholds: self.array(device, "thresholds", thresholds)?,
            sky,
            skin,
        })
    }

    /// The array as `data`: the buffer that there is if it holds the same bytes, else a new one.
    fn array<T: Pod>(
        &mut self,
        device: &Device,
        name: &'static str,
        data: &[T],
    ) -> Result<Binding, VulkanError> {
        let bytes: &[u8] = cast_slice(data);
        if let Some((_, binding)) = self.0.get(name).filter(|(held, _)| held == bytes) {
            return Ok(binding.clone());
        }
        let binding = device.upload(data)?.bind();
        self.0.insert(name, (bytes.to_vec(), binding.clone()));
        Ok(binding)
    }
}

impl DeviceScene {
    /// The last buffers of kernels that know what is beyond all surfaces, and painted on them.
    pub fn surroundings(&self) -> Vec<Binding> {
        [&self.sky[..], &self.skin].concat()
    }

    /// The last buffers of kernels that know what is painted on surfaces alone.
    pub fn skin(&self) -> &[Binding] {
        &self.skin
    }

    /// The buffers that a [`Scene`](lightbvh_kernels::shading::pixel::Scene) is made of.
    pub fn view(&self) -> [Binding; 5] {
        [
            &self.ray_nodes,
            &self.surfaces,
            &self.materials,
            &self.triangles,
            &self.instances,
        ]
        .map(Binding::clone)
    }

    /// What a kernel that chooses lights takes from the scene on: the scene, who looks, what lights are chosen by, and what is beyond
    /// surfaces and painted on them.
    pub fn with_lights<N: Pod, L: Pod>(&self, tree: &DeviceTree<N, L>) -> Vec<Binding> {
        let mut bindings = self.view().to_vec();
        bindings.extend([
            self.camera.clone(),
            tree.nodes.bind(),
            tree.trails.bind(),
            self.thresholds.clone(),
        ]);
        bindings.extend(self.surroundings());
        bindings
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
    timings.kernels.unwrap_or(timings.wall)
}

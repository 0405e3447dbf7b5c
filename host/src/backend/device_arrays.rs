//! A frame of a scene, and what its lights are chosen by, on a device.

use std::sync::Arc;
use std::time::Duration;

use bytemuck::Pod;
use lightbvh::Instance;
use lightbvh::light::infinite::DistantLight;
use lightbvh_kernels::shading::camera::Camera;
use lightbvh_kernels::shading::material::Material;
use lightbvh_kernels::shading::pick::by;
use lightbvh_kernels::shading::skin::Corner;
use lightbvh_kernels::shading::trace::{RayNode, TriangleBlock};

use super::follow::DeviceTree;
use super::held::Held;
use super::{Sampler, SceneArrays};
use crate::scene::SceneLight;
use crate::vulkan::{Binding, Buffer, Device, Timings, VulkanError};

/// Lights on the device: triangles in the spaces of their meshes, and where the meshes stand. Who shares them reads them as they
/// were when it took them.
pub(super) struct DeviceEmitters<L> {
    pub triangles: Arc<Buffer<L>>,
    pub instances: Arc<Buffer<Instance>>,
}

/// A frame's arrays on the device. Who keeps them reads them as they were.
pub(super) struct DeviceScene<L> {
    ray_nodes: Arc<Buffer<RayNode>>,
    surfaces: Arc<Buffer<TriangleBlock>>,
    materials: Arc<Buffer<Material>>,
    emitters: DeviceEmitters<L>,
    pub camera: Arc<Buffer<Camera>>,
    /// Empty where lights are not chosen by power.
    thresholds: Arc<Buffer<u32>>,
    /// What is beyond all surfaces and painted on them, for kernels that know of it.
    surroundings: Option<Surroundings>,
}

/// A map, suns and paint on the device.
struct Surroundings {
    suns: Arc<Buffer<DistantLight>>,
    counts: Arc<Buffer<u32>>,
    radiance: Arc<Buffer<[f32; 3]>>,
    corners: Arc<Buffer<Corner>>,
    words: Arc<Buffer<u32>>,
}

/// The arrays of the scene that was rendered last.
pub(super) struct HeldScene<L> {
    ray_nodes: Held<RayNode>,
    surfaces: Held<TriangleBlock>,
    materials: Held<Material>,
    triangles: Held<L>,
    instances: Held<Instance>,
    camera: Held<Camera>,
    thresholds: Held<u32>,
    suns: Held<DistantLight>,
    sky_counts: Held<u32>,
    sky_radiance: Held<[f32; 3]>,
    corners: Held<Corner>,
    paint: Held<u32>,
}

impl<L> Clone for DeviceEmitters<L> {
    fn clone(&self) -> Self {
        Self {
            triangles: Arc::clone(&self.triangles),
            instances: Arc::clone(&self.instances),
        }
    }
}

impl<L> Default for HeldScene<L> {
    fn default() -> Self {
        Self {
            ray_nodes: Held::default(),
            surfaces: Held::default(),
            materials: Held::default(),
            triangles: Held::default(),
            instances: Held::default(),
            camera: Held::default(),
            thresholds: Held::default(),
            suns: Held::default(),
            sky_counts: Held::default(),
            sky_radiance: Held::default(),
            corners: Held::default(),
            paint: Held::default(),
        }
    }
}

impl<L: SceneLight> HeldScene<L> {
    /// A frame's arrays for a kernel that chooses lights by `sampler`; what differs from the frame before is uploaded. They are
    /// lit by `emitters` or, without, by the lights that the frame lists.
    pub fn bring(
        &mut self,
        device: &Device,
        scene: &SceneArrays<L>,
        sampler: Sampler,
        emitters: Option<DeviceEmitters<L>>,
    ) -> Result<DeviceScene<L>, VulkanError> {
        let listed = scene.emitters();
        let thresholds = match sampler {
            Sampler::Power => &scene.thresholds[..],
            _ => &[],
        };
        let sky = scene.sky.view();
        let surroundings = match L::IS_ANY {
            true => Some(Surroundings {
                suns: self.suns.bring(device, sky.suns)?,
                counts: self.sky_counts.bring(device, sky.counts)?,
                radiance: self.sky_radiance.bring(device, sky.radiance)?,
                corners: self.corners.bring(device, &scene.skin.corners)?,
                words: self.paint.bring(device, &scene.skin.words)?,
            }),
            false => None,
        };
        Ok(DeviceScene {
            ray_nodes: self.ray_nodes.bring(device, &scene.rays.nodes)?,
            surfaces: self.surfaces.bring(device, &scene.rays.blocks)?,
            materials: self.materials.bring(device, &scene.materials)?,
            emitters: match emitters {
                Some(emitters) => emitters,
                None => DeviceEmitters {
                    triangles: self.triangles.bring(device, listed.triangles)?,
                    instances: self.instances.bring(device, listed.instances)?,
                },
            },
            camera: self.camera.bring(device, std::slice::from_ref(&scene.camera))?,
            thresholds: self.thresholds.bring(device, thresholds)?,
            surroundings,
        })
    }
}

impl<L: SceneLight> DeviceScene<L> {
    /// The last buffers of kernels that know what is beyond all surfaces, and painted on them.
    pub fn surroundings(&self) -> Vec<Binding> {
        let sky = self.surroundings.as_ref();
        let mut bindings = sky.map_or(Vec::new(), |sky| {
            vec![sky.suns.bind(), sky.counts.bind(), sky.radiance.bind()]
        });
        bindings.extend(self.skin());
        bindings
    }

    /// The last buffers of kernels that know what is painted on surfaces alone.
    pub fn skin(&self) -> Vec<Binding> {
        let skin = self.surroundings.as_ref();
        skin.map_or(Vec::new(), |skin| vec![skin.corners.bind(), skin.words.bind()])
    }

    /// The buffers that a [`Scene`](lightbvh_kernels::shading::pixel::Scene) is made of.
    pub fn view(&self) -> [Binding; 5] {
        [
            self.ray_nodes.bind(),
            self.surfaces.bind(),
            self.materials.bind(),
            self.emitters.triangles.bind(),
            self.emitters.instances.bind(),
        ]
    }

    /// What a kernel that chooses lights takes from the scene on: the scene, who looks, what lights are chosen by, and what is beyond
    /// surfaces and painted on them.
    pub fn with_lights<N: Pod>(&self, tree: &DeviceTree<N, L>) -> Vec<Binding> {
        let mut bindings = self.view().to_vec();
        bindings.extend([
            self.camera.bind(),
            tree.nodes.bind(),
            tree.trails.bind(),
            self.thresholds.bind(),
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

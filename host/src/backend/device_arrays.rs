//! A frame of a scene, and what its lights are chosen by, on a device.

use std::ops::Range;
use std::sync::Arc;
use std::time::Duration;

use bytemuck::Pod;
use lightbvh::Instance;
use lightbvh::TreeWords;
use lightbvh::light::infinite::DistantLight;
use lightbvh_kernels::shading::camera::Camera;
use lightbvh_kernels::shading::material::Material;
use lightbvh_kernels::shading::pick::by;
use lightbvh_kernels::shading::skin::Corner;
use lightbvh_kernels::shading::trace::{RayNode, TriangleBlock};

use super::held::Held;
use super::{Sampler, SceneArrays};
use crate::scene::SceneLight;
use crate::vulkan::{Binding, Buffer, Device, Pass, Timings, VulkanError};

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
    /// What is beyond all surfaces, for kernels that know of it.
    sky: Option<DeviceSky>,
    /// What is painted on them, for the same.
    skin: Option<DeviceSkin>,
}

/// Paint on the device.
struct DeviceSkin {
    corners: Arc<Buffer<Corner>>,
    words: Arc<Buffer<u32>>,
}

/// A map and suns on the device.
struct DeviceSky {
    suns: Arc<Buffer<DistantLight>>,
    counts: Arc<Buffer<u32>>,
    radiance: Arc<Buffer<[f32; 3]>>,
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
    /// A frame's arrays for a kernel that chooses lights by `sampler`, once `pass` has run, which writes what differs from
    /// those of the frame before. They are lit by `emitters` or, without, by the lights that the frame lists. Where `pass` does
    /// not run, what is held is not known any more: make it new then.
    pub fn bring<'a>(
        &mut self,
        device: &Device,
        scene: &'a SceneArrays<L>,
        sampler: Sampler,
        emitters: Option<DeviceEmitters<L>>,
        pass: &mut Pass<'a>,
    ) -> Result<DeviceScene<L>, VulkanError> {
        let listed = scene.emitters();
        Ok(DeviceScene {
            ray_nodes: self.ray_nodes.bring(device, &scene.rays.nodes, pass)?,
            surfaces: self.surfaces.bring_known(device, &scene.rays.blocks, pass)?,
            materials: self.materials.bring(device, &scene.materials, pass)?,
            emitters: match emitters {
                Some(emitters) => emitters,
                None => DeviceEmitters {
                    triangles: self.triangles.bring(device, listed.triangles, pass)?,
                    instances: self.instances.bring(device, listed.instances, pass)?,
                },
            },
            camera: self
                .camera
                .bring(device, std::slice::from_ref(&scene.camera), pass)?,
            thresholds: match sampler {
                Sampler::Power => self.thresholds.bring(device, &scene.thresholds, pass)?,
                _ => self.thresholds.bring(device, &[], pass)?,
            },
            sky: match L::IS_ANY {
                true => {
                    let sky = scene.sky.view();
                    Some(DeviceSky {
                        suns: self.suns.bring(device, sky.suns, pass)?,
                        counts: self.sky_counts.bring(device, sky.counts, pass)?,
                        radiance: self.sky_radiance.bring(device, sky.radiance, pass)?,
                    })
                }
                false => None,
            },
            skin: match L::IS_ANY {
                true => Some(DeviceSkin {
                    corners: self.corners.bring(device, &scene.skin.corners, pass)?,
                    words: self.paint.bring(device, &scene.skin.words, pass)?,
                }),
                false => None,
            },
        })
    }
}

impl<L: SceneLight> DeviceScene<L> {
    /// The last buffers of kernels that know what is beyond all surfaces, and painted on them.
    pub fn surroundings(&self) -> Vec<Binding> {
        let sky = self.sky.as_ref();
        let mut bindings = sky.map_or(Vec::new(), |sky| {
            vec![sky.suns.bind(), sky.counts.bind(), sky.radiance.bind()]
        });
        bindings.extend(self.skin());
        bindings
    }

    /// The last buffers of kernels that know what is painted on surfaces alone.
    pub fn skin(&self) -> Vec<Binding> {
        let skin = self.skin.as_ref();
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

/// The arrays of a light BVH on the device.
pub(super) struct DeviceTree<N, L> {
    pub nodes: Arc<Buffer<N>>,
    /// How many of them are of bottom levels, and which are of the top level.
    pub bottoms: usize,
    pub top: Range<usize>,
    pub emitters: DeviceEmitters<L>,
    pub trails: Arc<Buffer<u32>>,
    pub push: TreeWords,
}

impl<N: Pod, L: Pod> DeviceTree<N, L> {
    /// Empty arrays on `device`.
    pub fn new(device: &Device) -> Result<Self, VulkanError> {
        Ok(Self {
            nodes: Arc::new(device.buffer(0, 1)?),
            bottoms: 0,
            top: 0..0,
            emitters: DeviceEmitters {
                triangles: Arc::new(device.buffer(0, 1)?),
                instances: Arc::new(device.buffer(0, 1)?),
            },
            trails: Arc::new(device.buffer(0, 1)?),
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
        [
            self.nodes.bind(),
            self.emitters.instances.bind(),
            self.trails.bind(),
        ]
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

//! A frame of a scene on a device.

use std::collections::BTreeMap;

use bytemuck::{Pod, cast_slice};
use lightbvh_kernels::shading::pick::by;

use super::follow::DeviceTree;
use super::{Sampler, SceneArrays};
use crate::scene::SceneLight;
use crate::vulkan::{Binding, Device, VulkanError};

/// The arrays of the scene that was rendered last, by name: their bytes, and where they are on the device.
#[derive(Default)]
pub(super) struct HeldScene(BTreeMap<&'static str, (Vec<u8>, Binding)>);

impl HeldScene {
    /// The buffers of a frame's arrays, in the order in which the render passes take them; what differs from the frame before is
    /// uploaded. Lights that `sampler` finds in `tree` are the tree's, others those that the frame lists.
    pub fn bind<N: Pod, L: SceneLight>(
        &mut self,
        device: &Device,
        scene: &SceneArrays<L>,
        sampler: Sampler,
        tree: &DeviceTree<N, L>,
    ) -> Result<Vec<Binding>, VulkanError> {
        let listed = scene.emitters();
        let thresholds = match sampler {
            Sampler::Power => &scene.thresholds[..],
            _ => &[],
        };
        let mut bindings = vec![
            self.array(device, "ray_nodes", &scene.rays.nodes)?,
            self.array(device, "surfaces", &scene.rays.blocks)?,
            self.array(device, "materials", &scene.materials)?,
        ];
        bindings.extend(match sampler.needs_bvh() {
            true => [tree.triangles.bind(), tree.instances.bind()],
            false => [
                self.array(device, "triangles", listed.triangles)?,
                self.array(device, "instances", listed.instances)?,
            ],
        });
        bindings.extend([
            self.array(device, "camera", &[scene.camera])?,
            tree.nodes.bind(),
            tree.trails.bind(),
            self.array(device, "thresholds", thresholds)?,
        ]);
        if L::IS_ANY {
            bindings.extend([
                self.array(device, "corners", &scene.skin.corners)?,
                self.array(device, "paint", &scene.skin.words)?,
            ]);
        }
        Ok(bindings)
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

/// The push constant by which kernels choose lights by `sampler`.
pub(super) fn choosing(sampler: Sampler) -> u32 {
    match sampler {
        Sampler::Uniform => by::UNIFORM,
        Sampler::Power => by::POWER,
        Sampler::SingleLevel | Sampler::TwoLevel => by::TREE,
    }
}

//! A frame of a scene on a device.

use lightbvh::node::Node;
use lightbvh_gpu::DeviceBuffer;
use lightbvh_kernels::shading::pick::by;

use super::follow::Mirrored;
use super::{Sampler, SceneArrays};
use crate::scene::SceneLight;
use crate::vulkan::{Binding, Device, VulkanError};

/// Uploads a frame's arrays: the buffers in the order in which the render passes take them. Lights that `sampler` finds in `tree`
/// are the tree's, others those that the frame lists.
pub(super) fn bind<N: Node<W, Light = L>, L: SceneLight, const W: usize>(
    device: &Device,
    scene: &SceneArrays<L>,
    sampler: Sampler,
    tree: &Mirrored<'_, N, W>,
) -> Result<Vec<Binding>, VulkanError> {
    let thresholds = match sampler {
        Sampler::Power => &scene.thresholds[..],
        _ => &[],
    };
    let mut bindings = vec![
        device.upload(&scene.rays.nodes)?.bind(),
        device.upload(&scene.rays.blocks)?.bind(),
        device.upload(&scene.materials)?.bind(),
    ];
    let listed = scene.emitters();
    bindings.extend(match sampler.needs_bvh() {
        true => [
            tree.bind(DeviceBuffer::Lights),
            tree.bind(DeviceBuffer::Instances),
        ],
        false => [
            device.upload(listed.lights)?.bind(),
            device.upload(listed.instances)?.bind(),
        ],
    });
    bindings.extend([
        device.upload(&[scene.camera])?.bind(),
        tree.nodes.bind(),
        tree.trails.bind(),
        device.upload(thresholds)?.bind(),
    ]);
    if L::IS_ANY {
        bindings.extend([
            device.upload(&scene.textures.corners)?.bind(),
            device.upload(&scene.textures.words)?.bind(),
        ]);
    }
    Ok(bindings)
}

/// The push constant by which kernels choose lights by `sampler`.
pub(super) fn choosing(sampler: Sampler) -> u32 {
    match sampler {
        Sampler::Uniform => by::UNIFORM,
        Sampler::Power => by::POWER,
        Sampler::SingleLevel | Sampler::TwoLevel => by::TREE,
    }
}

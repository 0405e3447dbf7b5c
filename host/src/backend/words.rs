//! The arrays of a device as words, for comparing.

use bytemuck::{Pod, pod_collect_to_vec};
use lightbvh_kernels::bvh::Choice;

use super::{BackendError, DeviceBackend};
use crate::vulkan::{Buffer, VulkanError};

/// The words of all arrays of a light BVH, as a device holds them.
#[derive(Clone, Debug)]
pub struct DeviceArrays {
    /// In the order of [`node_words`](super::node_words).
    pub nodes: Vec<u32>,
    /// Of [`lightbvh::Bvh::roots`].
    pub roots: Vec<u32>,
    /// Of [`lightbvh::Bvh::instances`].
    pub instances: Vec<u32>,
    /// Of [`lightbvh::Bvh::triangles`].
    pub triangles: Vec<u32>,
    /// Trails and links of a [`lightbvh::LightTree`], as the device has them.
    pub trails: Vec<u32>,
}

impl<C: Choice<W>, const W: usize> DeviceBackend<'_, C, W> {
    /// All arrays as they are, after all that was followed.
    ///
    /// # Errors
    /// [`BackendError`] from the device.
    pub fn arrays(&mut self) -> Result<DeviceArrays, BackendError> {
        Ok(DeviceArrays {
            nodes: pod_collect_to_vec(&self.tree.all_nodes()?),
            roots: words(&self.tree.roots)?,
            instances: words(&self.tree.instances)?,
            triangles: words(&self.tree.triangles)?,
            trails: words(&self.tree.trails)?,
        })
    }
}

fn words<T: Pod>(buffer: &Buffer<T>) -> Result<Vec<u32>, VulkanError> {
    buffer.read_words()
}

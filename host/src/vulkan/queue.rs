//! The queue of a device, which does one thing at a time: commands are recorded, submitted and waited for.

use super::error::{CallContext, VulkanError};
use ash::vk;

/// The compute queue, and what its submissions are recorded into.
#[derive(Default)]
pub(crate) struct Queue {
    pub(super) raw: vk::Queue,
    pub(super) pool: vk::CommandPool,
    pub(super) commands: vk::CommandBuffer,
    pub(super) fence: vk::Fence,
    /// Two timestamps; null where the device keeps no time.
    pub(super) queries: vk::QueryPool,
}

impl Queue {
    /// The queue of a device that was created with one of this family.
    pub(crate) fn new(
        device: &ash::Device,
        family: u32,
        has_clock: bool,
        name: &str,
    ) -> Result<Self, VulkanError> {
        let mut queue = Self::default();
        match queue.fill(device, family, has_clock, name) {
            Ok(()) => Ok(queue),
            Err(error) => {
                queue.destroy(device);
                Err(error)
            }
        }
    }

    fn fill(
        &mut self,
        device: &ash::Device,
        family: u32,
        has_clock: bool,
        name: &str,
    ) -> Result<(), VulkanError> {
        // SAFETY: the device was created with one queue of this family.
        self.raw = unsafe { device.get_device_queue(family, 0) };
        let info = vk::CommandPoolCreateInfo::default().queue_family_index(family);
        // SAFETY: the device is alive; the same holds for the creations below.
        self.pool = unsafe { device.create_command_pool(&info, None) }.during("vkCreateCommandPool", name)?;
        let info = vk::CommandBufferAllocateInfo::default()
            .command_pool(self.pool)
            .level(vk::CommandBufferLevel::PRIMARY)
            .command_buffer_count(1);
        // SAFETY: the pool belongs to this device and no other thread sees it yet.
        let commands =
            unsafe { device.allocate_command_buffers(&info) }.during("vkAllocateCommandBuffers", name)?;
        self.commands = commands[0];
        // SAFETY: as above.
        self.fence = unsafe { device.create_fence(&vk::FenceCreateInfo::default(), None) }
            .during("vkCreateFence", name)?;
        if has_clock {
            let info = vk::QueryPoolCreateInfo::default()
                .query_type(vk::QueryType::TIMESTAMP)
                .query_count(2);
            // SAFETY: as above.
            self.queries =
                unsafe { device.create_query_pool(&info, None) }.during("vkCreateQueryPool", name)?;
        }
        Ok(())
    }

    /// Destroys the queue's objects; null ones are skipped by Vulkan.
    pub(crate) fn destroy(&self, device: &ash::Device) {
        // SAFETY: all belong to this device, nothing submitted is running (the callers see to it), and the queue is not used
        // afterwards. The command buffer goes with its pool.
        unsafe {
            device.destroy_query_pool(self.queries, None);
            device.destroy_fence(self.fence, None);
            device.destroy_command_pool(self.pool, None);
        }
    }
}

/// What was written so far is there for what follows, and what was read may be written.
pub(super) fn barrier(device: &ash::Device, commands: vk::CommandBuffer) {
    let stages = vk::PipelineStageFlags::COMPUTE_SHADER | vk::PipelineStageFlags::TRANSFER;
    let memory = [vk::MemoryBarrier::default()
        .src_access_mask(vk::AccessFlags::SHADER_WRITE | vk::AccessFlags::TRANSFER_WRITE)
        .dst_access_mask(
            vk::AccessFlags::SHADER_READ
                | vk::AccessFlags::SHADER_WRITE
                | vk::AccessFlags::TRANSFER_READ
                | vk::AccessFlags::TRANSFER_WRITE,
        )];
    // SAFETY: the command buffer is recording, outside any render pass.
    unsafe {
        device.cmd_pipeline_barrier(
            commands,
            stages,
            stages,
            vk::DependencyFlags::empty(),
            &memory,
            &[],
            &[],
        );
    }
}

//! The queue of a device, and what waits for it.

use super::error::{CallContext, VulkanError};
use ash::vk;
use gpu_allocator::vulkan::Allocation;

/// An object whose owner has gone.
pub(crate) enum Retired {
    Buffer(vk::Buffer, Option<Allocation>),
    Sets(vk::DescriptorPool),
    Queries(vk::QueryPool),
}

/// The compute queue with its one command buffer and fence.
pub(crate) struct Queue {
    pub(super) raw: vk::Queue,
    pub(super) pool: vk::CommandPool,
    pub(super) commands: vk::CommandBuffer,
    pub(super) fence: vk::Fence,
    /// A submission ran into its time limit and its fence has not been seen signalled since.
    pub(super) unfinished: bool,
    /// What that submission may still use and nobody holds any more.
    pub(super) retired: Vec<Retired>,
}

impl Queue {
    pub(crate) fn new(device: &ash::Device, family: u32, name: &str) -> Result<Self, VulkanError> {
        // SAFETY: the device was created with one queue of this family.
        let raw = unsafe { device.get_device_queue(family, 0) };
        let info = vk::CommandPoolCreateInfo::default().queue_family_index(family);
        // SAFETY: the device is alive.
        let pool = unsafe { device.create_command_pool(&info, None) }.during("vkCreateCommandPool", name)?;
        let mut queue = Self {
            raw,
            pool,
            commands: vk::CommandBuffer::null(),
            fence: vk::Fence::null(),
            unfinished: false,
            retired: Vec::new(),
        };
        match queue.fill(device, name) {
            Ok(()) => Ok(queue),
            Err(error) => {
                queue.destroy(device);
                Err(error)
            }
        }
    }

    fn fill(&mut self, device: &ash::Device, name: &str) -> Result<(), VulkanError> {
        let info = vk::CommandBufferAllocateInfo::default()
            .command_pool(self.pool)
            .level(vk::CommandBufferLevel::PRIMARY)
            .command_buffer_count(1);
        // SAFETY: the pool belongs to this device and no other thread sees it yet.
        let commands =
            unsafe { device.allocate_command_buffers(&info) }.during("vkAllocateCommandBuffers", name)?;
        self.commands = commands[0];
        // SAFETY: the device is alive.
        self.fence = unsafe { device.create_fence(&vk::FenceCreateInfo::default(), None) }
            .during("vkCreateFence", name)?;
        Ok(())
    }

    /// Destroys the queue's objects; null ones are skipped by Vulkan.
    pub(crate) fn destroy(&self, device: &ash::Device) {
        // SAFETY: both belong to this device, nothing submitted is running (the callers see to it), and the queue is
        // not used afterwards. The command buffer goes with its pool.
        unsafe {
            device.destroy_fence(self.fence, None);
            device.destroy_command_pool(self.pool, None);
        }
    }

    /// Nothing is running afterwards, or [`VulkanError::Busy`].
    pub(crate) fn settle(&mut self, device: &ash::Device, name: &str) -> Result<(), VulkanError> {
        if self.unfinished {
            // SAFETY: the fence belongs to this device.
            match unsafe { device.get_fence_status(self.fence) } {
                Ok(false) => return Err(VulkanError::Busy { device: name.into() }),
                // Signalled, or the device is lost: in both cases it runs nothing any more.
                Ok(true) | Err(_) => self.unfinished = false,
            }
        }
        Ok(())
    }
}

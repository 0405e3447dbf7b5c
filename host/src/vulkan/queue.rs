//! The queue of a device: what is under way on it, and what waits for it.

use super::error::{CallContext, VulkanError};
use super::ring::Ring;
use ash::vk;
use gpu_allocator::vulkan::Allocation;
use std::collections::VecDeque;

/// Submissions under way at most: one more waits until the first of them has ended.
pub(super) const IN_FLIGHT: usize = 3;

/// An object whose owner has gone.
pub(crate) enum Retired {
    Buffer(vk::Buffer, Option<Allocation>),
    Sets(vk::DescriptorPool),
    Queries(vk::QueryPool),
}

/// What a submission is recorded into.
#[derive(Default)]
pub(super) struct Slot {
    pub pool: vk::CommandPool,
    pub commands: vk::CommandBuffer,
    pub fence: vk::Fence,
    /// Number of the submission that used it last; 0 for none.
    pub number: u64,
    /// What that one does, for the error of a time limit.
    pub work: String,
}

/// The compute queue. Submissions are numbered from 1 and end in order.
pub(crate) struct Queue {
    pub(super) raw: vk::Queue,
    pub(super) slots: Vec<Slot>,
    /// The submission made last.
    pub(super) last: u64,
    /// It and all before it have ended.
    pub(super) ended: u64,
    /// A wait ran into its time limit, and not everything has ended since.
    pub(super) unfinished: bool,
    /// What nobody holds any more, and the last submission that may use it.
    pub(super) retired: VecDeque<(u64, Retired)>,
    /// Through which the host's bytes go.
    pub(super) ring: Ring,
}

impl Queue {
    pub(crate) fn new(device: &ash::Device, family: u32, name: &str) -> Result<Self, VulkanError> {
        // SAFETY: the device was created with one queue of this family.
        let raw = unsafe { device.get_device_queue(family, 0) };
        let mut queue = Self {
            raw,
            slots: Vec::new(),
            last: 0,
            ended: 0,
            unfinished: false,
            retired: VecDeque::new(),
            ring: Ring::default(),
        };
        for _ in 0..IN_FLIGHT {
            queue.slots.push(Slot::default());
            let filled = queue.slots.last_mut().map(|slot| slot.fill(device, family, name));
            if let Some(Err(error)) = filled {
                queue.destroy(device);
                return Err(error);
            }
        }
        Ok(queue)
    }

    /// Destroys the queue's objects but for its ring; null ones are skipped by Vulkan.
    pub(crate) fn destroy(&self, device: &ash::Device) {
        for slot in &self.slots {
            // SAFETY: both belong to this device, nothing submitted is running (the callers see to it), and the queue is
            // not used afterwards. The command buffer goes with its pool.
            unsafe {
                device.destroy_fence(slot.fence, None);
                device.destroy_command_pool(slot.pool, None);
            }
        }
    }

    /// The slot that submission `number` is recorded into.
    pub(super) fn slot(&mut self, number: u64) -> &mut Slot {
        &mut self.slots[number as usize % IN_FLIGHT]
    }
}

impl Slot {
    fn fill(&mut self, device: &ash::Device, family: u32, name: &str) -> Result<(), VulkanError> {
        let info = vk::CommandPoolCreateInfo::default().queue_family_index(family);
        // SAFETY: the device is alive.
        self.pool = unsafe { device.create_command_pool(&info, None) }.during("vkCreateCommandPool", name)?;
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
}

//! One submission at a time: record, submit, wait.

use super::error::{CallContext, VulkanError};
use super::retired::Retired;
use super::shared::Shared;
use ash::vk;
use std::time::{Duration, Instant};

/// The compute queue with its one command buffer and fence.
pub(crate) struct Queue {
    raw: vk::Queue,
    pool: vk::CommandPool,
    commands: vk::CommandBuffer,
    fence: vk::Fence,
    /// A submission ran into its time limit and its fence has not been seen signalled since.
    unfinished: bool,
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

impl Shared {
    /// Records commands, submits them and waits until they are done; returns the time from submission to the end.
    ///
    /// All writes of earlier submissions are visible to the commands, and all theirs to the host afterwards. `work`
    /// names what is done, for the error of a time limit.
    pub(crate) fn submit(
        &self,
        work: impl FnOnce() -> String,
        record: impl FnOnce(&ash::Device, vk::CommandBuffer),
    ) -> Result<Duration, VulkanError> {
        let (device, name) = (&self.raw, self.probe.name.as_str());
        let mut queue = self.idle_queue()?;

        let begin = vk::CommandBufferBeginInfo::default().flags(vk::CommandBufferUsageFlags::ONE_TIME_SUBMIT);
        let accesses = vk::AccessFlags::SHADER_READ
            | vk::AccessFlags::SHADER_WRITE
            | vk::AccessFlags::TRANSFER_READ
            | vk::AccessFlags::TRANSFER_WRITE;
        let writes = vk::AccessFlags::SHADER_WRITE | vk::AccessFlags::TRANSFER_WRITE;
        let stages = vk::PipelineStageFlags::COMPUTE_SHADER | vk::PipelineStageFlags::TRANSFER;
        let before = [vk::MemoryBarrier::default()
            .src_access_mask(writes)
            .dst_access_mask(accesses)];
        let after = [vk::MemoryBarrier::default()
            .src_access_mask(writes)
            .dst_access_mask(vk::AccessFlags::HOST_READ | vk::AccessFlags::HOST_WRITE)];
        let none = vk::DependencyFlags::empty();
        // SAFETY: pool, command buffer and fence belong to this device, are used under the queue's lock only, and
        // nothing is running (`idle_queue`), so resetting them is allowed. `record` is given a command buffer in the
        // recording state; its callers keep what they record alive until this function returns,
        // and then retire it.
        unsafe {
            device
                .reset_command_pool(queue.pool, vk::CommandPoolResetFlags::empty())
                .during("vkResetCommandPool", name)?;
            device
                .begin_command_buffer(queue.commands, &begin)
                .during("vkBeginCommandBuffer", name)?;
            device.cmd_pipeline_barrier(queue.commands, stages, stages, none, &before, &[], &[]);
            record(device, queue.commands);
            let host = vk::PipelineStageFlags::HOST;
            device.cmd_pipeline_barrier(queue.commands, stages, host, none, &after, &[], &[]);
            device
                .end_command_buffer(queue.commands)
                .during("vkEndCommandBuffer", name)?;
            device
                .reset_fences(&[queue.fence])
                .during("vkResetFences", name)?;
        }
        let commands = [queue.commands];
        let submits = [vk::SubmitInfo::default().command_buffers(&commands)];
        let limit = self.options.time_limit;
        let start = Instant::now();
        // SAFETY: as above; the command buffer is recorded to its end and the fence unsignalled.
        unsafe { device.queue_submit(queue.raw, &submits, queue.fence) }.during("vkQueueSubmit", name)?;
        let nanoseconds = u64::try_from(limit.as_nanos()).unwrap_or(u64::MAX);
        // SAFETY: the fence belongs to this device and was submitted above.
        match unsafe { device.wait_for_fences(&[queue.fence], true, nanoseconds) } {
            Ok(()) => {}
            Err(vk::Result::TIMEOUT) => {
                queue.unfinished = true;
                return Err(VulkanError::Timeout {
                    device: name.into(),
                    after: limit,
                    work: work(),
                });
            }
            failed => {
                // Out of memory in the wait itself says nothing about the work; a lost device settles at once.
                queue.unfinished = true;
                failed.during("vkWaitForFences", name)?;
            }
        }
        let elapsed = start.elapsed();
        drop(queue);
        self.check_validation()?;
        Ok(elapsed)
    }
}

//! One submission at a time: record, submit, wait.

use super::error::{CallContext, VulkanError};
use super::shared::Shared;
use ash::vk;
use std::time::{Duration, Instant};

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

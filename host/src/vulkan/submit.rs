//! One submission at a time: recorded, submitted and waited for.

use super::error::{CallContext, VulkanError};
use super::queue::{Queue, barrier};
use super::shared::Shared;
use ash::vk;
use std::time::Duration;

impl Shared {
    /// Records commands, submits them and waits for their end; returns their time on the device's clock, if it keeps one. They
    /// see what the host and earlier commands wrote, and the host sees what they wrote.
    pub(super) fn run(
        &self,
        record: impl FnOnce(&ash::Device, vk::CommandBuffer),
    ) -> Result<Option<Duration>, VulkanError> {
        let queue = self.queue();
        let (device, name) = (&self.raw, self.probe.name.as_str());
        self.record(&queue, record)?;
        let commands = [queue.commands];
        let submits = [vk::SubmitInfo::default().command_buffers(&commands)];
        self.faults
            .before(device)
            // SAFETY: all belong to this device and are used under the queue's lock; the command buffer is recorded to its end and
            // the fence unsignalled.
            .and_then(|()| unsafe { device.queue_submit(queue.raw, &submits, queue.fence) })
            .during("vkQueueSubmit", name)?;
        let waited = self
            .faults
            .before(device)
            // SAFETY: the fence belongs to this device and was submitted above.
            .and_then(|()| unsafe { device.wait_for_fences(&[queue.fence], true, u64::MAX) });
        if waited.is_err() {
            // SAFETY: the device is alive. What the work uses may be destroyed afterwards.
            let _ = unsafe { device.device_wait_idle() };
        }
        waited.during("vkWaitForFences", name)?;
        let time = self.time(&queue)?;
        drop(queue);
        self.check_validation()?;
        Ok(time)
    }

    fn record(
        &self,
        queue: &Queue,
        record: impl FnOnce(&ash::Device, vk::CommandBuffer),
    ) -> Result<(), VulkanError> {
        let (device, name, commands) = (&self.raw, self.probe.name.as_str(), queue.commands);
        let begin = vk::CommandBufferBeginInfo::default().flags(vk::CommandBufferUsageFlags::ONE_TIME_SUBMIT);
        let after = [vk::MemoryBarrier::default()
            .src_access_mask(vk::AccessFlags::SHADER_WRITE | vk::AccessFlags::TRANSFER_WRITE)
            .dst_access_mask(vk::AccessFlags::HOST_READ | vk::AccessFlags::HOST_WRITE)];
        let compute = vk::PipelineStageFlags::COMPUTE_SHADER;
        let stages = compute | vk::PipelineStageFlags::TRANSFER;
        let host = vk::PipelineStageFlags::HOST;
        let stamp = |index| {
            if queue.queries != vk::QueryPool::null() {
                // SAFETY: the command buffer is recording, the query is reset before the first stamp and unused, and the queue
                // family has timestamps.
                unsafe { device.cmd_write_timestamp(commands, compute, queue.queries, index) };
            }
        };
        // SAFETY: pool, command buffer, queries and fence belong to this device, are used under the queue's lock only, and what was
        // submitted last has ended (`run` waits), so resetting them is allowed. `record` is given a command buffer in the
        // recording state; its callers keep what they record alive until `run` returns.
        unsafe {
            device
                .reset_command_pool(queue.pool, vk::CommandPoolResetFlags::empty())
                .during("vkResetCommandPool", name)?;
            device
                .begin_command_buffer(commands, &begin)
                .during("vkBeginCommandBuffer", name)?;
            if queue.queries != vk::QueryPool::null() {
                device.cmd_reset_query_pool(commands, queue.queries, 0, 2);
            }
            barrier(device, commands);
            stamp(0);
            record(device, commands);
            stamp(1);
            let none = vk::DependencyFlags::empty();
            device.cmd_pipeline_barrier(commands, stages, host, none, &after, &[], &[]);
            device
                .end_command_buffer(commands)
                .during("vkEndCommandBuffer", name)?;
            device.reset_fences(&[queue.fence]).during("vkResetFences", name)
        }
    }

    /// From the first timestamp of what has ended to the second.
    fn time(&self, queue: &Queue) -> Result<Option<Duration>, VulkanError> {
        if queue.queries == vk::QueryPool::null() {
            return Ok(None);
        }
        let mut ticks = [0_u64; 2];
        let flags = vk::QueryResultFlags::TYPE_64 | vk::QueryResultFlags::WAIT;
        self.faults
            .before(&self.raw)
            // SAFETY: the pool belongs to this device and both queries were written by the submission that has ended.
            .and_then(|()| unsafe {
                self.raw
                    .get_query_pool_results(queue.queries, 0, &mut ticks, flags)
            })
            .during("vkGetQueryPoolResults", &self.probe.name)?;
        let elapsed = elapsed(ticks[0], ticks[1], self.probe.timestamp_valid_bits);
        let nanoseconds = elapsed as f64 * f64::from(self.probe.limits.timestamp_period);
        Ok(Some(Duration::from_nanos(nanoseconds as u64)))
    }
}

/// Ticks between two readings of a counter that wraps after `bits` bits.
fn elapsed(from: u64, to: u64, bits: u32) -> u64 {
    let mask = u64::MAX >> 64u32.saturating_sub(bits).min(63);
    to.wrapping_sub(from) & mask
}

#[cfg(test)]
mod tests {
    use super::elapsed;

    #[test]
    fn counters_wrap() {
        assert_eq!(elapsed(5, 12, 64), 7);
        assert_eq!(elapsed(u64::MAX, 1, 64), 2);
        assert_eq!(elapsed((1 << 36) - 1, 2, 36), 3);
        // Bits above the valid ones are undefined.
        assert_eq!(elapsed(0xabc << 36 | 1, 0xdef << 36 | 4, 36), 3);
        assert_eq!(elapsed(0, 1, 1), 1);
    }
}

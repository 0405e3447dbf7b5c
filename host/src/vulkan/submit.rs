//! Submissions: record, submit, and wait only where someone asks.

use super::counts::count;
use super::error::{CallContext, VulkanError};
use super::memory::create;
use super::queue::{Queue, Retired};
use super::ring::Ring;
use super::shared::Shared;
use ash::vk;
use gpu_allocator::MemoryLocation;

impl Shared {
    /// Records commands and submits them; returns the submission's number. All writes of earlier submissions are visible to the
    /// commands, and all theirs to the host once they have ended.
    ///
    /// `bytes` of the host's, at most a [`PART`](super::ring::PART), are written by `stage` and lie in the ring from the place
    /// that `record` is told. `work` names what is done, for the error of a time limit. It waits where as many submissions are
    /// under way as there may be, or where they use the ring's bytes.
    pub(super) fn submit(
        &self,
        work: String,
        bytes: u64,
        stage: impl FnOnce(&mut [u8]),
        record: impl FnOnce(&ash::Device, vk::CommandBuffer, vk::Buffer, u64),
    ) -> Result<u64, VulkanError> {
        let mut queue = self.queue();
        self.settle(&mut queue)?;
        let number = queue.last + 1;
        let before = queue.slot(number).number;
        self.wait_for(&mut queue, before)?;
        let place = self.place(&mut queue, bytes)?;
        let start = place.start as u64;
        if let Some(place) = queue.ring.bytes(place) {
            count(&self.counters.bytes, bytes);
            stage(place);
        }
        let ring = queue.ring.buffer;
        let submitted = self.record(&mut queue, number, |device, commands| {
            record(device, commands, ring, start);
        });
        if let Err(error) = submitted {
            queue.ring.cancel();
            return Err(error);
        }
        count(&self.counters.submissions, 1);
        queue.ring.submit(number);
        queue.last = number;
        let slot = queue.slot(number);
        (slot.number, slot.work) = (number, work);
        drop(queue);
        self.check_validation()?;
        Ok(number)
    }

    /// Records into the slot of `number`, whose last submission has ended, and submits it.
    fn record(
        &self,
        queue: &mut Queue,
        number: u64,
        record: impl FnOnce(&ash::Device, vk::CommandBuffer),
    ) -> Result<(), VulkanError> {
        let (device, name, raw) = (&self.raw, self.probe.name.as_str(), queue.raw);
        let slot = queue.slot(number);
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
        // SAFETY: pool, command buffer and fence belong to this device, are used under the queue's lock only, and the
        // submission that used them last has ended (`submit`), so resetting them is allowed. `record` is given a command buffer
        // in the recording state; what its callers record is kept alive until the submission has ended, for all that it may use
        // is destroyed through `retire`.
        unsafe {
            device
                .reset_command_pool(slot.pool, vk::CommandPoolResetFlags::empty())
                .during("vkResetCommandPool", name)?;
            device
                .begin_command_buffer(slot.commands, &begin)
                .during("vkBeginCommandBuffer", name)?;
            device.cmd_pipeline_barrier(slot.commands, stages, stages, none, &before, &[], &[]);
            record(device, slot.commands);
            let host = vk::PipelineStageFlags::HOST;
            device.cmd_pipeline_barrier(slot.commands, stages, host, none, &after, &[], &[]);
            device
                .end_command_buffer(slot.commands)
                .during("vkEndCommandBuffer", name)?;
            device.reset_fences(&[slot.fence]).during("vkResetFences", name)?;
        }
        // Whatever used it has ended, and its fence says nothing until it is submitted.
        slot.number = 0;
        let commands = [slot.commands];
        let submits = [vk::SubmitInfo::default().command_buffers(&commands)];
        self.faults
            .before(device)
            // SAFETY: as above; the command buffer is recorded to its end and the fence unsignalled.
            .and_then(|()| unsafe { device.queue_submit(raw, &submits, slot.fence) })
            .during("vkQueueSubmit", name)
    }

    /// Finds `bytes` of the ring, in a larger one where it must be, or once earlier submissions have ended.
    fn place(&self, queue: &mut Queue, bytes: u64) -> Result<std::ops::Range<usize>, VulkanError> {
        if bytes == 0 {
            return Ok(0..0);
        }
        if let Some(larger) = queue.ring.outgrown(bytes) {
            let usage = vk::BufferUsageFlags::TRANSFER_SRC | vk::BufferUsageFlags::STORAGE_BUFFER;
            let (buffer, allocation) = create(self, larger, usage, MemoryLocation::CpuToGpu)?;
            let old = std::mem::replace(&mut queue.ring, Ring::new(buffer, allocation, larger));
            let retired = Retired::Buffer(old.buffer, old.allocation);
            queue.retired.push_back((queue.last, retired));
        }
        self.poll(queue);
        loop {
            if let Some(place) = queue.ring.place(bytes) {
                return Ok(place);
            }
            // A free ring has a place for a part, so something is under way.
            let first = queue.ended + 1;
            self.wait_for(queue, first)?;
        }
    }

    /// Sees what has ended, without waiting. A lost device runs nothing any more.
    pub(super) fn poll(&self, queue: &mut Queue) {
        while queue.ended < queue.last {
            let next = queue.ended + 1;
            let fence = queue.slot(next).fence;
            // SAFETY: the fence belongs to this device and was submitted with the next submission that ends.
            let status =
                (self.faults.before(&self.raw)).and_then(|()| unsafe { self.raw.get_fence_status(fence) });
            match status {
                Ok(false) => break,
                Ok(true) => queue.ended = next,
                Err(_) => queue.ended = queue.last,
            }
        }
        self.tidy(queue);
    }

    /// Frees what the submissions used that have ended.
    fn tidy(&self, queue: &mut Queue) {
        let ended = queue.ended;
        queue.unfinished &= ended < queue.last;
        queue.ring.end(ended);
        while let Some((_, object)) = queue.retired.pop_front_if(|(number, _)| *number <= ended) {
            self.destroy_retired(object);
        }
    }

    /// [`VulkanError::Busy`] while work runs on that a wait has given up.
    pub(super) fn settle(&self, queue: &mut Queue) -> Result<(), VulkanError> {
        if queue.unfinished {
            self.poll(queue);
        }
        match queue.unfinished {
            true => Err(VulkanError::Busy {
                device: self.probe.name.clone(),
            }),
            false => Ok(()),
        }
    }

    /// Waits until submission `number` has ended.
    pub(super) fn wait_for(&self, queue: &mut Queue, number: u64) -> Result<(), VulkanError> {
        if number <= queue.ended {
            return Ok(());
        }
        self.settle(queue)?;
        self.poll(queue);
        if number <= queue.ended {
            return Ok(());
        }
        let (name, limit) = (self.probe.name.as_str(), self.options.time_limit);
        let nanoseconds = u64::try_from(limit.as_nanos()).unwrap_or(u64::MAX);
        let fence = queue.slot(number).fence;
        count(&self.counters.waits, 1);
        // SAFETY: the fence belongs to this device and was submitted with `number`, which has not ended: no later submission
        // has its slot.
        let waited = (self.faults.before(&self.raw))
            .and_then(|()| unsafe { self.raw.wait_for_fences(&[fence], true, nanoseconds) });
        match waited {
            Ok(()) => queue.ended = number,
            Err(vk::Result::TIMEOUT) => {
                queue.unfinished = true;
                return Err(VulkanError::Timeout {
                    device: name.into(),
                    after: limit,
                    work: queue.slot(number).work.clone(),
                });
            }
            failed => {
                // Out of memory in the wait itself says nothing about the work; a lost device runs nothing any more.
                match failed {
                    Err(vk::Result::ERROR_DEVICE_LOST) => queue.ended = queue.last,
                    _ => queue.unfinished = true,
                }
                self.tidy(queue);
                return failed.during("vkWaitForFences", name);
            }
        }
        self.tidy(queue);
        Ok(())
    }

    /// Nothing is running while the queue is held: then the host may touch mapped memory.
    pub(super) fn idle_queue(&self) -> Result<std::sync::MutexGuard<'_, Queue>, VulkanError> {
        let mut queue = self.queue();
        self.settle(&mut queue)?;
        let last = queue.last;
        self.wait_for(&mut queue, last)?;
        Ok(queue)
    }
}

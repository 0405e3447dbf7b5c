//! Device memory behind a buffer, and the copies in and out of it.

use super::error::{CallContext, VulkanError};
use super::shared::Shared;
use ash::vk;
use gpu_allocator::MemoryLocation;
use gpu_allocator::vulkan::{Allocation, AllocationCreateDesc, AllocationScheme};
use std::sync::Arc;

/// A Vulkan buffer with its memory.
pub(crate) struct Memory {
    pub(crate) shared: Arc<Shared>,
    pub(crate) buffer: vk::Buffer,
    pub(crate) bytes: u64,
    allocation: Option<Allocation>,
}

/// Bytes of a staging buffer at most.
const PART: u64 = 16 << 20;

impl Memory {
    /// `bytes` of storage; more than 0, a multiple of 4.
    pub(crate) fn new(
        shared: &Arc<Shared>,
        bytes: u64,
        location: MemoryLocation,
    ) -> Result<Self, VulkanError> {
        let range = shared.probe.limits.max_storage_buffer_range;
        for (limit_name, limit) in [
            ("maxStorageBufferRange", range.into()),
            ("maxMemoryAllocationSize", shared.probe.max_memory_allocation_size),
        ] {
            if bytes > limit {
                return Err(VulkanError::BufferTooLarge {
                    device: shared.probe.name.clone(),
                    bytes,
                    limit_name,
                    limit,
                });
            }
        }
        let (device, name) = (&shared.raw, shared.probe.name.as_str());
        let usage = vk::BufferUsageFlags::STORAGE_BUFFER
            | vk::BufferUsageFlags::TRANSFER_SRC
            | vk::BufferUsageFlags::TRANSFER_DST;
        let info = vk::BufferCreateInfo::default().size(bytes).usage(usage);
        // SAFETY: the device is alive; the size is not zero.
        let buffer = unsafe { device.create_buffer(&info, None) }.during("vkCreateBuffer", name)?;
        // Destroyed with all that it has by then, if what follows fails.
        let mut memory = Self {
            shared: Arc::clone(shared),
            buffer,
            bytes,
            allocation: None,
        };
        // SAFETY: the buffer belongs to this device.
        let requirements = unsafe { device.get_buffer_memory_requirements(buffer) };
        let allocated = shared.allocator().allocate(&AllocationCreateDesc {
            name: "storage",
            requirements,
            location,
            linear: true,
            allocation_scheme: AllocationScheme::GpuAllocatorManaged,
        });
        let allocation = allocated.map_err(|error| VulkanError::OutOfMemory {
            device: name.into(),
            bytes,
            reserved: shared.allocator().capacity(),
            reason: error.to_string(),
        })?;
        let allocation = memory.allocation.insert(allocation);
        // SAFETY: the memory was allocated for this buffer's requirements and is bound once, at the offset that the
        // allocator chose to meet their alignment.
        unsafe { device.bind_buffer_memory(buffer, allocation.memory(), allocation.offset()) }
            .during("vkBindBufferMemory", name)?;
        Ok(memory)
    }

    /// Copies each part's bytes to its place in the buffer, which holds them: through a staging buffer, many parts by one copy.
    pub(crate) fn write(&self, parts: &[(u64, &[u8])]) -> Result<(), VulkanError> {
        let all: u64 = parts.iter().map(|(_, data)| data.len() as u64).sum();
        if all == 0 {
            return Ok(());
        }
        let mut staging = Self::new(&self.shared, all.min(PART), MemoryLocation::GpuToCpu)?;
        let (mut regions, mut used) = (Vec::new(), 0);
        for &(mut at, mut data) in parts {
            while !data.is_empty() {
                let room = (staging.bytes - used) as usize;
                let (now, later) = data.split_at(data.len().min(room));
                staging.mapped()[used as usize..][..now.len()].copy_from_slice(now);
                let bytes = now.len() as u64;
                regions.push(region(used, at, bytes));
                (used, at, data) = (used + bytes, at + bytes, later);
                if used == staging.bytes {
                    self.copy(&staging, &regions)?;
                    regions.clear();
                    used = 0;
                }
            }
        }
        self.copy(&staging, &regions)
    }

    /// Copies from the start of the buffer; not more than it holds.
    pub(crate) fn read(&self, data: &mut [u8]) -> Result<(), VulkanError> {
        if data.is_empty() {
            return Ok(());
        }
        let part = PART.min(data.len() as u64);
        let mut staging = Self::new(&self.shared, part, MemoryLocation::GpuToCpu)?;
        for (index, data) in (0..).zip(data.chunks_mut(part as usize)) {
            staging.copy(self, &[region(index * part, 0, data.len() as u64)])?;
            data.copy_from_slice(&staging.mapped()[..data.len()]);
        }
        Ok(())
    }

    /// Copies regions of another buffer, which both hold, on the device; those here do not overlap.
    pub(crate) fn copy(&self, from: &Self, regions: &[vk::BufferCopy]) -> Result<(), VulkanError> {
        if regions.is_empty() {
            return Ok(());
        }
        let copied = self.shared.run(|device, commands| {
            // SAFETY: the command buffer is recording; both buffers belong to this device, were made for transfers, hold the
            // regions (the callers see to it), and are borrowed until the submission has ended.
            unsafe { device.cmd_copy_buffer(commands, from.buffer, self.buffer, regions) };
        });
        copied.map(drop)
    }

    /// Sets every word of the buffer.
    pub(crate) fn fill(&self, word: u32) -> Result<(), VulkanError> {
        let filled = self.shared.run(|device, commands| {
            // SAFETY: the command buffer is recording; the buffer belongs to this device, was made for transfers, is `bytes` long,
            // a multiple of 4, and is borrowed until the submission has ended.
            unsafe { device.cmd_fill_buffer(commands, self.buffer, 0, self.bytes, word) };
        });
        filled.map(drop)
    }

    /// The bytes of a staging buffer. Submissions are waited for, so none reads or writes them meanwhile.
    fn mapped(&mut self) -> &mut [u8] {
        let mapped = self.allocation.as_mut().and_then(Allocation::mapped_slice_mut);
        mapped.expect("staging buffers lie where the host reaches them")
    }
}

impl Drop for Memory {
    fn drop(&mut self) {
        // SAFETY: the buffer belongs to this device, and nothing runs that uses it: `Shared::run` waits for its end.
        unsafe { self.shared.raw.destroy_buffer(self.buffer, None) };
        // An error would be an inconsistency of the allocator itself; there is nothing to undo.
        let _ = self
            .allocation
            .take()
            .map(|allocation| self.shared.allocator().free(allocation));
    }
}

/// Bytes of one buffer that are copied to another.
pub(super) fn region(from: u64, to: u64, bytes: u64) -> vk::BufferCopy {
    vk::BufferCopy {
        src_offset: from,
        dst_offset: to,
        size: bytes,
    }
}

//! Device memory behind a buffer, and the copies in and out of it.

use super::error::{CallContext, VulkanError};
use super::queue::Retired;
use super::shared::Shared;
use ash::vk;
use gpu_allocator::MemoryLocation;
use gpu_allocator::vulkan::{Allocation, AllocationCreateDesc, AllocationScheme};
use std::sync::Arc;

/// Copies to and from memory that the host cannot reach go through a staging buffer of at most this size.
const STAGING_BYTES: u64 = 32 << 20;

/// A Vulkan buffer with its memory.
pub(crate) struct Memory {
    pub(crate) shared: Arc<Shared>,
    pub(crate) buffer: vk::Buffer,
    pub(crate) bytes: u64,
    allocation: Option<Allocation>,
    location: MemoryLocation,
}

impl Memory {
    /// `bytes` of storage; more than 0, a multiple of 4.
    pub(crate) fn new(
        shared: &Arc<Shared>,
        bytes: u64,
        location: MemoryLocation,
    ) -> Result<Self, VulkanError> {
        let (device, name) = (&shared.raw, shared.probe.name.as_str());
        let limits = &shared.probe.limits;
        for (limit_name, limit) in [
            ("maxStorageBufferRange", limits.max_storage_buffer_range),
            ("maxMemoryAllocationSize", limits.max_memory_allocation_size),
        ] {
            if bytes > limit {
                return Err(VulkanError::BufferTooLarge {
                    device: name.into(),
                    bytes,
                    limit_name,
                    limit,
                });
            }
        }
        let usage = vk::BufferUsageFlags::STORAGE_BUFFER
            | vk::BufferUsageFlags::TRANSFER_SRC
            | vk::BufferUsageFlags::TRANSFER_DST;
        let info = vk::BufferCreateInfo::default().size(bytes).usage(usage);
        // SAFETY: the device is alive; the size is neither zero nor over the limits.
        let buffer = unsafe { device.create_buffer(&info, None) }.during("vkCreateBuffer", name)?;
        // From here on dropping cleans up.
        let mut memory = Self {
            shared: Arc::clone(shared),
            buffer,
            bytes,
            allocation: None,
            location,
        };
        // SAFETY: the buffer belongs to this device.
        let requirements = unsafe { device.get_buffer_memory_requirements(buffer) };
        let mut allocator = shared.allocator();
        let allocation = allocator
            .allocate(&AllocationCreateDesc {
                name: "storage",
                requirements,
                location,
                linear: true,
                allocation_scheme: AllocationScheme::GpuAllocatorManaged,
            })
            .map_err(|error| VulkanError::OutOfMemory {
                device: name.into(),
                bytes,
                reserved: allocator.capacity(),
                reason: error.to_string(),
            })?;
        drop(allocator);
        let allocation = memory.allocation.insert(allocation);
        // SAFETY: the memory was allocated for this buffer's requirements and is bound once, at the offset that the
        // allocator chose to meet their alignment.
        unsafe { device.bind_buffer_memory(buffer, allocation.memory(), allocation.offset()) }
            .during("vkBindBufferMemory", name)?;
        Ok(memory)
    }

    /// Copies `data` to the start of the buffer; not longer than it.
    pub(crate) fn write(&mut self, data: &[u8]) -> Result<(), VulkanError> {
        self.write_at(0, data)
    }

    /// Copies to `at` bytes from the start of the buffer; not more than it holds from there.
    pub(crate) fn write_at(&mut self, at: usize, data: &[u8]) -> Result<(), VulkanError> {
        let shared = Arc::clone(&self.shared);
        let idle = shared.idle_queue()?;
        if let Some(mapped) = self.mapped_mut() {
            mapped[at..at + data.len()].copy_from_slice(data);
            return Ok(());
        }
        drop(idle);
        let Some(mut staging) = self.staging(data.len(), MemoryLocation::CpuToGpu)? else {
            return Ok(());
        };
        for (offset, chunk) in chunks(data.len()) {
            staging.write(&data[offset..offset + chunk])?;
            staging.copy_to(self, 0, (at + offset) as u64, chunk as u64)?;
        }
        Ok(())
    }

    /// Copies from the start of the buffer; not more than it holds.
    pub(crate) fn read(&self, data: &mut [u8]) -> Result<(), VulkanError> {
        let idle = self.shared.idle_queue()?;
        if let Some(mapped) = self.mapped() {
            data.copy_from_slice(&mapped[..data.len()]);
            return Ok(());
        }
        drop(idle);
        let Some(staging) = self.staging(data.len(), MemoryLocation::GpuToCpu)? else {
            return Ok(());
        };
        for (offset, chunk) in chunks(data.len()) {
            self.copy_to(&staging, offset as u64, 0, chunk as u64)?;
            staging.read(&mut data[offset..offset + chunk])?;
        }
        Ok(())
    }

    /// Sets every word of the buffer.
    pub(crate) fn fill(&mut self, word: u32) -> Result<(), VulkanError> {
        let shared = Arc::clone(&self.shared);
        let idle = shared.idle_queue()?;
        if let Some(mapped) = self.mapped_mut() {
            for bytes in mapped.chunks_exact_mut(4) {
                bytes.copy_from_slice(&word.to_ne_bytes());
            }
            return Ok(());
        }
        drop(idle);
        let (buffer, bytes) = (self.buffer, self.bytes);
        let work = || format!("filling a buffer of {bytes} bytes");
        let done = shared.submit(work, |device, commands| {
            // SAFETY: the buffer belongs to this device, was made for transfers and is `bytes` long, a multiple of 4;
            // it outlives the submission (`drop`).
            unsafe { device.cmd_fill_buffer(commands, buffer, 0, bytes, word) };
        });
        done.map(drop)
    }

    /// Copies between two buffers of the device.
    pub(crate) fn copy_to(&self, target: &Self, from: u64, to: u64, bytes: u64) -> Result<(), VulkanError> {
        let regions = [vk::BufferCopy {
            src_offset: from,
            dst_offset: to,
            size: bytes,
        }];
        let (source, target) = (self.buffer, target.buffer);
        let work = || format!("copying {bytes} bytes");
        let done = self.shared.submit(work, |device, commands| {
            // SAFETY: both buffers belong to this device, were made for transfers, hold the regions (`chunks`, `Buffer::duplicate`), and
            // outlive the submission (`drop`).
            unsafe { device.cmd_copy_buffer(commands, source, target, &regions) };
        });
        done.map(drop)
    }

    /// A buffer for copies of `bytes`, in memory the host reaches; none for no bytes.
    fn staging(&self, bytes: usize, location: MemoryLocation) -> Result<Option<Self>, VulkanError> {
        let bytes = (bytes as u64).min(STAGING_BYTES);
        (bytes > 0)
            .then(|| Self::new(&self.shared, bytes, location))
            .transpose()
    }

    /// The memory as bytes where host and device may both reach it.
    fn mapped(&self) -> Option<&[u8]> {
        let mapped = self.allocation.as_ref()?.mapped_slice()?;
        (self.location != MemoryLocation::GpuOnly).then(|| &mapped[..self.bytes as usize])
    }

    fn mapped_mut(&mut self) -> Option<&mut [u8]> {
        let (location, bytes) = (self.location, self.bytes as usize);
        let mapped = self.allocation.as_mut()?.mapped_slice_mut()?;
        (location != MemoryLocation::GpuOnly).then(|| &mut mapped[..bytes])
    }
}

impl Drop for Memory {
    fn drop(&mut self) {
        self.shared
            .retire(Retired::Buffer(self.buffer, self.allocation.take()));
    }
}

/// Offset and length of each staging copy.
fn chunks(bytes: usize) -> impl Iterator<Item = (usize, usize)> {
    let step = STAGING_BYTES as usize;
    (0..bytes)
        .step_by(step)
        .map(move |offset| (offset, step.min(bytes - offset)))
}

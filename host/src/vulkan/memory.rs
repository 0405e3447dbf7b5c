//! Device memory behind a buffer, and the copies in and out of it.

use super::counts::count;
use super::error::{CallContext, VulkanError};
use super::queue::Retired;
use super::ring::PART;
use super::shared::Shared;
use ash::vk;
use gpu_allocator::MemoryLocation;
use gpu_allocator::vulkan::{Allocation, AllocationCreateDesc, AllocationScheme};
use std::ptr::NonNull;
use std::sync::Arc;

/// A Vulkan buffer with its memory.
pub(crate) struct Memory {
    pub(crate) shared: Arc<Shared>,
    pub(crate) buffer: vk::Buffer,
    pub(crate) bytes: u64,
    allocation: Option<Allocation>,
    location: MemoryLocation,
}

/// A region that the device copies, bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Region {
    pub from: u64,
    pub to: u64,
    pub bytes: u64,
}

impl Memory {
    /// `bytes` of storage; more than 0, a multiple of 4.
    pub(crate) fn new(
        shared: &Arc<Shared>,
        bytes: u64,
        location: MemoryLocation,
    ) -> Result<Self, VulkanError> {
        let limits = &shared.probe.limits;
        for (limit_name, limit) in [
            ("maxStorageBufferRange", limits.max_storage_buffer_range),
            ("maxMemoryAllocationSize", limits.max_memory_allocation_size),
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
        let usage = vk::BufferUsageFlags::STORAGE_BUFFER
            | vk::BufferUsageFlags::TRANSFER_SRC
            | vk::BufferUsageFlags::TRANSFER_DST;
        let (buffer, allocation) = create(shared, bytes, usage, location)?;
        Ok(Self {
            shared: Arc::clone(shared),
            buffer,
            bytes,
            allocation: Some(allocation),
            location,
        })
    }

    /// Copies `data` to `at` bytes from the start of the buffer; not more than it holds from there. In memory that the host
    /// reaches it waits for what is under way, unless the buffer `is_new`: then nothing uses it.
    pub(crate) fn write_at(&self, at: usize, data: &[u8], is_new: bool) -> Result<(), VulkanError> {
        let shared = &self.shared;
        if data.is_empty() {
            return Ok(());
        }
        if let Some(mapped) = self.mapped() {
            let queue = (!is_new).then(|| shared.idle_queue()).transpose()?;
            count(&shared.counters.bytes, data.len() as u64);
            assert!(
                at as u64 + data.len() as u64 <= self.bytes,
                "checked by the callers"
            );
            // SAFETY: the memory is mapped for `bytes`, which hold the data (as above). No one else reaches it meanwhile: the
            // device runs nothing that uses it, and the host reads and writes buffers that are not new with the queue held.
            unsafe {
                mapped
                    .add(at)
                    .copy_from_nonoverlapping(NonNull::from(data).cast(), data.len())
            };
            drop(queue);
            return Ok(());
        }
        for (part, data) in (0..).zip(data.chunks(PART as usize)) {
            let to = at as u64 + part * PART;
            let bytes = data.len() as u64;
            let stage = |place: &mut [u8]| place.copy_from_slice(data);
            shared.submit(copying(bytes), bytes, stage, |device, commands, ring, from| {
                let region = Region { from, to, bytes };
                copy(device, commands, ring, self.buffer, &[region]);
            })?;
            count(&shared.counters.regions, 1);
        }
        Ok(())
    }

    /// Copies from the start of the buffer; not more than it holds. Waits for what is under way.
    pub(crate) fn read(&self, data: &mut [u8]) -> Result<(), VulkanError> {
        if data.is_empty() {
            return Ok(());
        }
        if let Some(mapped) = self.mapped() {
            let queue = self.shared.idle_queue()?;
            assert!(data.len() as u64 <= self.bytes, "checked by the callers");
            // SAFETY: the memory is mapped for `bytes`, which are no fewer (as above). Nothing writes it meanwhile, as in
            // `write_at`.
            unsafe { mapped.copy_to_nonoverlapping(NonNull::from(&mut *data).cast(), data.len()) };
            drop(queue);
            return Ok(());
        }
        let part = PART.min(data.len() as u64);
        let staging = Self::new(&self.shared, part, MemoryLocation::GpuToCpu)?;
        for (index, data) in (0..).zip(data.chunks_mut(part as usize)) {
            let bytes = data.len() as u64;
            let region = Region {
                from: index * part,
                to: 0,
                bytes,
            };
            self.shared.submit(
                copying(bytes),
                0,
                |_| {},
                |device, commands, _, _| {
                    copy(device, commands, self.buffer, staging.buffer, &[region]);
                },
            )?;
            count(&self.shared.counters.regions, 1);
            staging.read(data)?;
        }
        Ok(())
    }

    /// Sets every word of a new buffer, that nothing uses.
    pub(crate) fn fill_new(&self, word: u32) -> Result<(), VulkanError> {
        match self.mapped() {
            Some(mapped) => {
                let words = mapped.cast::<u32>();
                for at in 0..self.bytes as usize / 4 {
                    // SAFETY: the memory is mapped for `bytes` and aligned to more than a word; nothing else reaches a new buffer.
                    unsafe { words.add(at).write(word) };
                }
                Ok(())
            }
            None => self.fill(word),
        }
    }

    /// Sets every word of the buffer, on the device.
    pub(crate) fn fill(&self, word: u32) -> Result<(), VulkanError> {
        let work = format!("filling a buffer of {} bytes", self.bytes);
        let filled = self.shared.submit(
            work,
            0,
            |_| {},
            |device, commands, _, _| fill(device, commands, self, word),
        );
        filled.map(drop)
    }

    /// The memory where host and device may both reach it, mapped for as long as it lives.
    fn mapped(&self) -> Option<NonNull<u8>> {
        let mapped = self.allocation.as_ref()?.mapped_ptr()?.cast();
        (self.location != MemoryLocation::GpuOnly).then_some(mapped)
    }
}

impl Drop for Memory {
    fn drop(&mut self) {
        self.shared
            .retire(Retired::Buffer(self.buffer, self.allocation.take()));
    }
}

fn copying(bytes: u64) -> String {
    format!("copying {bytes} bytes")
}

/// Records one copy of many regions between two buffers that hold them; regions of the target do not overlap.
pub(super) fn copy(
    device: &ash::Device,
    commands: vk::CommandBuffer,
    source: vk::Buffer,
    target: vk::Buffer,
    regions: &[Region],
) {
    let regions: Vec<vk::BufferCopy> = regions
        .iter()
        .map(|region| vk::BufferCopy {
            src_offset: region.from,
            dst_offset: region.to,
            size: region.bytes,
        })
        .collect();
    if regions.is_empty() {
        return;
    }
    // SAFETY: the command buffer is recording; both buffers belong to this device, were made for transfers, hold the regions
    // (the callers see to it), and live until the submission has ended (`retire`).
    unsafe { device.cmd_copy_buffer(commands, source, target, &regions) };
}

/// Records that every word of a buffer is set.
pub(super) fn fill(device: &ash::Device, commands: vk::CommandBuffer, memory: &Memory, word: u32) {
    // SAFETY: the command buffer is recording; the buffer belongs to this device, was made for transfers, is `bytes` long, a
    // multiple of 4, and lives until the submission has ended (`retire`).
    unsafe { device.cmd_fill_buffer(commands, memory.buffer, 0, memory.bytes, word) };
}

/// A buffer of `bytes`, more than none, with memory of its own.
pub(super) fn create(
    shared: &Shared,
    bytes: u64,
    usage: vk::BufferUsageFlags,
    location: MemoryLocation,
) -> Result<(vk::Buffer, Allocation), VulkanError> {
    let (device, name) = (&shared.raw, shared.probe.name.as_str());
    let info = vk::BufferCreateInfo::default().size(bytes).usage(usage);
    // SAFETY: the device is alive; the size is not zero.
    let buffer = unsafe { device.create_buffer(&info, None) }.during("vkCreateBuffer", name)?;
    count(&shared.counters.buffers, 1);
    // SAFETY: the buffer belongs to this device.
    let requirements = unsafe { device.get_buffer_memory_requirements(buffer) };
    let mut allocator = shared.allocator();
    let allocated = allocator.allocate(&AllocationCreateDesc {
        name: "storage",
        requirements,
        location,
        linear: true,
        allocation_scheme: AllocationScheme::GpuAllocatorManaged,
    });
    let bound = match allocated {
        Ok(allocation) => {
            // SAFETY: the memory was allocated for this buffer's requirements and is bound once, at the offset that the
            // allocator chose to meet their alignment.
            let bound =
                unsafe { device.bind_buffer_memory(buffer, allocation.memory(), allocation.offset()) };
            match bound.during("vkBindBufferMemory", name) {
                Ok(()) => return Ok((buffer, allocation)),
                Err(error) => {
                    // An error would be an inconsistency of the allocator itself; there is nothing to undo.
                    let _ = allocator.free(allocation);
                    error
                }
            }
        }
        Err(error) => VulkanError::OutOfMemory {
            device: name.into(),
            bytes,
            reserved: allocator.capacity(),
            reason: error.to_string(),
        },
    };
    // SAFETY: it was made above, and nothing uses it.
    unsafe { device.destroy_buffer(buffer, None) };
    Err(bound)
}

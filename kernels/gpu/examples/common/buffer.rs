//! The engine's buffers.

use std::rc::Rc;

use ash::vk;

use super::Result;
use super::gpu::Gpu;

/// A buffer with memory of its own.
pub struct Buffer {
    gpu: Rc<Gpu>,
    pub raw: vk::Buffer,
    memory: vk::DeviceMemory,
    pub bytes: u64,
}

impl Buffer {
    /// A storage buffer in the device's own memory; at least one word, since Vulkan has none of no bytes.
    pub fn storage(gpu: &Rc<Gpu>, bytes: u64) -> Result<Self> {
        Self::new(gpu, bytes, vk::MemoryPropertyFlags::DEVICE_LOCAL)
    }

    /// A buffer that the CPU writes or reads, for copies.
    pub fn staging(gpu: &Rc<Gpu>, bytes: u64) -> Result<Self> {
        let host = vk::MemoryPropertyFlags::HOST_VISIBLE | vk::MemoryPropertyFlags::HOST_COHERENT;
        Self::new(gpu, bytes, host)
    }

    /// A buffer for copies that holds `data`.
    pub fn staged(gpu: &Rc<Gpu>, data: &[u8]) -> Result<Self> {
        let buffer = Self::staging(gpu, data.len() as u64)?;
        let device = &gpu.device;
        // SAFETY: the memory can be mapped, holds `data`, and the device does not use it yet.
        unsafe {
            let to = device.map_memory(buffer.memory, 0, vk::WHOLE_SIZE, vk::MemoryMapFlags::empty())?;
            std::ptr::copy_nonoverlapping(data.as_ptr(), to.cast(), data.len());
            device.unmap_memory(buffer.memory);
        }
        Ok(buffer)
    }

    fn new(gpu: &Rc<Gpu>, bytes: u64, wanted: vk::MemoryPropertyFlags) -> Result<Self> {
        let device = &gpu.device;
        let bytes = bytes.max(4);
        let usage = vk::BufferUsageFlags::STORAGE_BUFFER
            | vk::BufferUsageFlags::TRANSFER_SRC
            | vk::BufferUsageFlags::TRANSFER_DST;
        let info = vk::BufferCreateInfo::default().size(bytes).usage(usage);
        // SAFETY: the device is alive, and the size is not zero.
        let raw = unsafe { device.create_buffer(&info, None) }?;
        // SAFETY: the buffer is the device's.
        let needs = unsafe { device.get_buffer_memory_requirements(raw) };
        let kind = (0_u32..)
            .zip(gpu.memory.memory_types_as_slice())
            .find(|(index, kind)| {
                needs.memory_type_bits >> index & 1 == 1 && kind.property_flags.contains(wanted)
            })
            .ok_or("no memory of that kind")?
            .0;
        let info = vk::MemoryAllocateInfo::default()
            .allocation_size(needs.size)
            .memory_type_index(kind);
        // SAFETY: size and type are those that the buffer needs, and it is bound once.
        let memory = unsafe {
            let memory = device.allocate_memory(&info, None)?;
            device.bind_buffer_memory(raw, memory, 0)?;
            memory
        };
        let gpu = Rc::clone(gpu);
        Ok(Self {
            gpu,
            raw,
            memory,
            bytes,
        })
    }

    /// The bytes of a buffer that the CPU reads, once the device is done with it.
    pub fn mapped(&self) -> Result<Vec<u8>> {
        let device = &self.gpu.device;
        let mut data = vec![0; self.bytes as usize];
        // SAFETY: the memory can be mapped, holds as many bytes, and every submission has been waited for.
        unsafe {
            let from = device.map_memory(self.memory, 0, vk::WHOLE_SIZE, vk::MemoryMapFlags::empty())?;
            std::ptr::copy_nonoverlapping(from.cast::<u8>(), data.as_mut_ptr(), data.len());
            device.unmap_memory(self.memory);
        }
        Ok(data)
    }
}

impl Drop for Buffer {
    fn drop(&mut self) {
        // SAFETY: every submission that used it has been waited for.
        unsafe {
            self.gpu.device.destroy_buffer(self.raw, None);
            self.gpu.device.free_memory(self.memory, None);
        }
    }
}

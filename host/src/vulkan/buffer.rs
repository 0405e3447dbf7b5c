//! Typed storage buffers.

use super::device::Device;
use super::error::VulkanError;
use super::memory::Memory;
use super::shared::Shared;
use bytemuck::Pod;
use gpu_allocator::MemoryLocation;
use std::marker::PhantomData;
use std::sync::Arc;

/// What every word of an output buffer holds until a kernel writes it: a NaN as a float, no index as an integer.
pub use crate::words::UNWRITTEN;

/// An array of `T` in device memory. Lives as long as it is held, and keeps its device open.
pub struct Buffer<T> {
    memory: Arc<Memory>,
    len: usize,
    element: PhantomData<fn() -> T>,
}

/// A buffer as an argument of a dispatch, or where bytes are written to.
#[derive(Clone)]
pub struct Binding {
    pub(crate) memory: Arc<Memory>,
    pub(crate) element_bytes: usize,
    /// Bytes that are in use, from the start.
    pub(crate) bytes: u64,
}

impl Binding {
    /// The same bytes as elements of so many bytes each.
    #[must_use]
    pub fn of_elements(self, bytes: u32) -> Self {
        Self {
            element_bytes: bytes as usize,
            ..self
        }
    }

    /// The first `bytes` bytes alone, at most all.
    pub(crate) fn first(self, bytes: usize) -> Self {
        Self {
            bytes: self.bytes.min(bytes as u64),
            ..self
        }
    }

    /// A copy of the words in use.
    pub(crate) fn read(&self) -> Result<Vec<u32>, VulkanError> {
        let mut words = vec![0; self.bytes as usize / 4];
        self.memory.read(bytemuck::cast_slice_mut(&mut words))?;
        Ok(words)
    }
}

impl Device {
    /// A buffer with a copy of `data`. An empty slice gives a buffer of no elements that can be bound all the same.
    pub fn upload<T: Pod>(&self, data: &[T]) -> Result<Buffer<T>, VulkanError> {
        let buffer = self.buffer(data.len())?;
        buffer.write(&[(0, data)])?;
        Ok(buffer)
    }

    /// A buffer of `len` elements whose words are all [`UNWRITTEN`].
    pub fn output<T: Pod>(&self, len: usize) -> Result<Buffer<T>, VulkanError> {
        let buffer = self.buffer(len)?;
        buffer.memory.fill(UNWRITTEN)?;
        Ok(buffer)
    }

    /// A buffer of `len` elements. What it holds is not known until it is written.
    pub fn buffer<T: Pod>(&self, len: usize) -> Result<Buffer<T>, VulkanError> {
        Buffer::new(&self.shared, len)
    }
}

impl<T: Pod> Buffer<T> {
    const ELEMENT_BYTES: usize = {
        assert!(
            size_of::<T>() > 0 && size_of::<T>().is_multiple_of(4),
            "elements are whole 32-bit words"
        );
        size_of::<T>()
    };

    fn new(shared: &Arc<Shared>, len: usize) -> Result<Self, VulkanError> {
        let bytes = (len as u64).saturating_mul(Self::ELEMENT_BYTES as u64);
        let memory = Arc::new(Memory::new(shared, bytes.max(4), MemoryLocation::GpuOnly)?);
        if len == 0 {
            // Vulkan has no buffers of zero bytes. One word stands in, smaller than any element but a word: kernels read that as 0.
            memory.fill(0)?;
        }
        Ok(Self {
            memory,
            len,
            element: PhantomData,
        })
    }

    /// Number of elements.
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether there are no elements.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// Bytes of all elements.
    pub fn byte_len(&self) -> usize {
        self.len * Self::ELEMENT_BYTES
    }

    /// The buffer as an argument of a dispatch.
    pub fn bind(&self) -> Binding {
        Binding {
            memory: Arc::clone(&self.memory),
            element_bytes: Self::ELEMENT_BYTES,
            bytes: self.byte_len() as u64,
        }
    }

    /// Replaces elements by those of each part, from its first one on.
    pub fn write(&self, parts: &[(usize, &[T])]) -> Result<(), VulkanError> {
        for (first, data) in parts {
            if *first > self.len || data.len() > self.len - first {
                return Err(VulkanError::WrongLength {
                    given: first.saturating_add(data.len()),
                    held: self.len,
                });
            }
        }
        let mut bytes: Vec<(u64, &[u8])> = Vec::with_capacity(parts.len());
        for (first, data) in parts {
            bytes.push(((first * Self::ELEMENT_BYTES) as u64, bytemuck::cast_slice(data)));
        }
        self.memory.write(&bytes)
    }

    /// A copy of all elements.
    pub fn read(&self) -> Result<Vec<T>, VulkanError> {
        let mut data = vec![T::zeroed(); self.len];
        self.memory.read(bytemuck::cast_slice_mut(&mut data))?;
        Ok(data)
    }
}

//! Arrays that a device keeps from frame to frame.

use std::sync::Arc;

use bytemuck::{Pod, cast_slice};

use crate::vulkan::{Buffer, Device, VulkanError};

/// An array on the device, and what it holds there.
pub(super) struct Held<T> {
    shadow: Vec<T>,
    buffer: Option<Arc<Buffer<T>>>,
}

impl<T> Default for Held<T> {
    fn default() -> Self {
        Self {
            shadow: Vec::new(),
            buffer: None,
        }
    }
}

impl<T: Pod> Held<T> {
    /// The array as `data`: the buffer that there is if it holds the same bytes, else a new one.
    pub fn bring(&mut self, device: &Device, data: &[T]) -> Result<Arc<Buffer<T>>, VulkanError> {
        let is_equal = || cast_slice::<T, u8>(&self.shadow) == cast_slice::<T, u8>(data);
        if let Some(held) = self.buffer.as_ref().filter(|_| is_equal()) {
            return Ok(Arc::clone(held));
        }
        let buffer = Arc::new(device.upload(data)?);
        self.shadow = data.to_vec();
        self.buffer = Some(Arc::clone(&buffer));
        Ok(buffer)
    }
}

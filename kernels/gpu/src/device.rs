//! What a device must have to run the kernels.

#[doc(inline)]
pub use crate::memory_model::without_vulkan_memory_model;

/// Device features to be enabled, by their names in Vulkan's structures; `vulkanMemoryModel` stands in
/// `VkPhysicalDeviceVulkan12Features`.
pub const REQUIRED_FEATURES: &[&str] = &["vulkanMemoryModel"];

/// Storage buffers that the greediest kernel takes; `maxPerStageDescriptorStorageBuffers` must be at least that.
pub const STORAGE_BUFFERS: u32 = 6;

#[cfg(all(test, feature = "kernels"))]
mod tests {
    use super::*;
    use crate::KERNELS;

    /// Capabilities and push constants are the verifier's matter.
    #[test]
    fn no_kernel_takes_more_buffers() {
        let most = KERNELS.iter().map(|kernel| kernel.bindings.len()).max();
        assert_eq!(most, Some(STORAGE_BUFFERS as usize));
    }
}

//! What a device must have to run the kernels.

#[doc(inline)]
pub use crate::frame::Region;

pub use crate::memory_model::without_vulkan_memory_model;

/// Major and minor version of Vulkan: the modules are SPIR-V 1.5.
pub const VULKAN: (u32, u32) = (1, 2);

/// Device features to be enabled, by their names in Vulkan's structures; `vulkanMemoryModel` stands in
/// `VkPhysicalDeviceVulkan12Features`.
pub const REQUIRED_FEATURES: &[&str] = &["vulkanMemoryModel"];

/// Storage buffers that the greediest kernel takes; `maxPerStageDescriptorStorageBuffers` must be at least that. The passes
/// over a light BVH (refit, sample, pmf) take 5 at most.
pub const STORAGE_BUFFERS: u32 = 6;

/// Bytes of push constants that the greediest kernel takes at most: what every device has (`maxPushConstantsSize`).
pub const PUSH_CONSTANTS: u32 = 128;

#[cfg(all(test, feature = "kernels"))]
mod tests {
    use super::*;
    use crate::KERNELS;

    /// Capabilities are those that the builder's verifier permits.
    #[test]
    fn no_kernel_needs_more() {
        let most = KERNELS.iter().map(|kernel| kernel.bindings.len()).max();
        assert_eq!(most, Some(STORAGE_BUFFERS as usize));
        for kernel in KERNELS {
            assert!(kernel.push_constants <= PUSH_CONSTANTS, "{}", kernel.name);
        }
    }
}

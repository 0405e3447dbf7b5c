//! Why a backend cannot do what it was asked to.

use lightbvh::error::FollowError;

use crate::vulkan::VulkanError;

/// What went wrong in a backend.
#[derive(Debug, thiserror::Error)]
pub enum BackendError {
    /// The device.
    #[error(transparent)]
    Vulkan(#[from] VulkanError),
    /// The lights are not those that the BVH was built over.
    #[error(transparent)]
    Lights(#[from] FollowError),
}

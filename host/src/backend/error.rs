//! Why a backend cannot do what it was asked to.

use std::fmt;

use lightbvh::EditError;

use crate::vulkan::VulkanError;

/// What went wrong in a backend.
#[derive(Debug)]
pub enum BackendError {
    /// The device.
    Vulkan(VulkanError),
    /// The lights are not those that the BVH was built over.
    Lights(EditError),
}

impl fmt::Display for BackendError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Vulkan(error) => write!(f, "{error}"),
            Self::Lights(error) => write!(f, "{error}"),
        }
    }
}

impl std::error::Error for BackendError {}

impl From<VulkanError> for BackendError {
    fn from(error: VulkanError) -> Self {
        Self::Vulkan(error)
    }
}

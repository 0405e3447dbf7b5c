//! The validation layer's messages.

use super::error::VulkanError;
use ash::vk;
use std::ffi::{CStr, c_void};
use std::sync::{Mutex, MutexGuard};

/// Name of the layer.
pub(crate) const LAYER: &CStr = c"VK_LAYER_KHRONOS_validation";

/// What the layer has said so far.
#[derive(Debug, Default)]
pub(crate) struct Messages(Mutex<Vec<String>>);

impl Messages {
    /// An error once there is any message.
    pub(crate) fn check(&self, device: &str) -> Result<(), VulkanError> {
        let messages = self.all();
        match messages.is_empty() {
            true => Ok(()),
            false => Err(VulkanError::Validation {
                device: device.to_owned(),
                messages: messages.clone(),
            }),
        }
    }

    fn all(&self) -> MutexGuard<'_, Vec<String>> {
        self.0.lock().unwrap_or_else(|poisoned| poisoned.into_inner())
    }

    /// Create-info of a messenger that reports here: warnings and errors about this program's use of Vulkan.
    ///
    /// Messages of type GENERAL are left out on purpose: there the loader speaks about other drivers of the machine.
    /// The messages must outlive every Vulkan object made with the returned structure.
    pub(crate) fn messenger(&self) -> vk::DebugUtilsMessengerCreateInfoEXT<'static> {
        vk::DebugUtilsMessengerCreateInfoEXT::default()
            .message_severity(
                vk::DebugUtilsMessageSeverityFlagsEXT::WARNING | vk::DebugUtilsMessageSeverityFlagsEXT::ERROR,
            )
            .message_type(
                vk::DebugUtilsMessageTypeFlagsEXT::VALIDATION
                    | vk::DebugUtilsMessageTypeFlagsEXT::PERFORMANCE,
            )
            .pfn_user_callback(Some(receive))
            .user_data(std::ptr::from_ref(self).cast_mut().cast::<c_void>())
    }
}

/// The callback: called by the layer on whichever thread made the offending call.
unsafe extern "system" fn receive(
    _severity: vk::DebugUtilsMessageSeverityFlagsEXT,
    _kind: vk::DebugUtilsMessageTypeFlagsEXT,
    data: *const vk::DebugUtilsMessengerCallbackDataEXT<'_>,
    user: *mut c_void,
) -> vk::Bool32 {
    // SAFETY: `user` is the pointer `Messages::messenger` stored, which outlives the instance (see there) and is only
    // ever used as a shared reference; a null one is turned away.
    let messages = unsafe { user.cast::<Messages>().as_ref() };
    // SAFETY: the layer passes a valid structure for the duration of the call.
    let text = unsafe { data.as_ref() }.map(|data| {
        // SAFETY: `message` points to a null-terminated string owned by the layer during the call, or is null.
        unsafe { data.message_as_c_str() }
            .map_or_else(String::new, |text| text.to_string_lossy().into_owned())
    });
    if let Some(messages) = messages {
        messages.all().push(text.unwrap_or_default());
    }
    vk::FALSE // TRUE would abort the call that was complained about.
}

//! The validation layer's messages: counted, and the first ones kept.

use ash::vk;
use std::ffi::{CStr, c_void};
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

/// Messages kept in full; the rest only count.
const KEPT: usize = 8;

/// Name of the layer.
pub(crate) const LAYER: &CStr = c"VK_LAYER_KHRONOS_validation";

/// What the layer has said so far.
#[derive(Debug, Default)]
pub(crate) struct Messages {
    count: AtomicU64,
    first: Mutex<Vec<String>>,
}

impl Messages {
    /// Number of messages so far.
    pub(crate) fn count(&self) -> u64 {
        self.count.load(Ordering::Acquire)
    }

    /// The first few messages.
    pub(crate) fn first(&self) -> Vec<String> {
        self.first
            .lock()
            .unwrap_or_else(|poisoned| poisoned.into_inner())
            .clone()
    }

    fn add(&self, message: String) {
        self.count.fetch_add(1, Ordering::AcqRel);
        let mut first = self.first.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
        if first.len() < KEPT {
            first.push(message);
        }
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
        messages.add(text.unwrap_or_default());
    }
    vk::FALSE // TRUE would abort the call that was complained about.
}

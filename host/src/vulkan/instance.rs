//! The Vulkan loader and the instance: first to come, last to go.

use super::error::{CallContext, VulkanError};
use super::validation::{self, Messages};
use ash::vk;
use std::sync::Arc;

/// Vulkan 1.2, and no more: drivers choose floating-point defaults by the version a program says it was written for
/// (NVIDIA's contraction default moved between 1.3 and 1.4), so this stays pinned however new the driver is.
const API_VERSION: u32 = vk::API_VERSION_1_2;

/// A loaded Vulkan library with an instance in it; dropping destroys the instance, then unloads the library.
pub(crate) struct Instance {
    pub(crate) raw: ash::Instance,
    validation: Option<Validation>,
    // Holds the loaded library, so it has to be the last field.
    entry: ash::Entry,
}

struct Validation {
    functions: ash::ext::debug_utils::Instance,
    messenger: vk::DebugUtilsMessengerEXT,
    // The layer holds a pointer to these until the instance is gone.
    messages: Arc<Messages>,
}

impl Instance {
    /// Loads the Vulkan library and makes an instance, with the validation layer if `validate`.
    pub(crate) fn new(validate: bool) -> Result<Self, VulkanError> {
        // SAFETY: loading a library runs its initialisers; the Vulkan loader's are safe to run at any time, and the
        // library stays loaded for as long as `entry` lives.
        let entry = unsafe { ash::Entry::load() }.map_err(|error| VulkanError::Unavailable {
            reason: format!("no Vulkan loader ({error})"),
        })?;
        let application = vk::ApplicationInfo::default()
            .application_name(c"lightbvh")
            .api_version(API_VERSION);
        let mut info = vk::InstanceCreateInfo::default().application_info(&application);
        let layers = [validation::LAYER.as_ptr()];
        let extensions = [
            ash::ext::debug_utils::NAME.as_ptr(),
            ash::ext::validation_features::NAME.as_ptr(),
        ];
        let messages = Arc::new(Messages::default());
        let mut messenger = messages.messenger();
        // Missing barriers, which ordinary validation does not see. Layer 1.3.239 finds those between copies, but was
        // seen to miss those between dispatches; newer layers may find them.
        let checks = [vk::ValidationFeatureEnableEXT::SYNCHRONIZATION_VALIDATION];
        let mut features = vk::ValidationFeaturesEXT::default().enabled_validation_features(&checks);
        if validate {
            info = info
                .enabled_layer_names(&layers)
                .enabled_extension_names(&extensions)
                .push_next(&mut features)
                .push_next(&mut messenger);
        }

        // SAFETY: `info` and all it points to live until the call returns; `messages` lives until the instance is
        // destroyed, in `drop`.
        let raw = unsafe { entry.create_instance(&info, None) }.map_err(|result| match result {
            vk::Result::ERROR_INCOMPATIBLE_DRIVER | vk::Result::ERROR_INITIALIZATION_FAILED => {
                VulkanError::Unavailable {
                    reason: format!("no Vulkan 1.2 driver ({result})"),
                }
            }
            vk::Result::ERROR_LAYER_NOT_PRESENT => VulkanError::NoValidationLayer,
            result => VulkanError::Call {
                call: "vkCreateInstance",
                device: "the instance".into(),
                result,
            },
        })?;
        let mut instance = Self {
            raw,
            validation: None,
            entry,
        };
        if validate {
            let functions = ash::ext::debug_utils::Instance::new(&instance.entry, &instance.raw);
            // SAFETY: the extension is enabled on this instance, and `messages` outlives the messenger (`drop`).
            let messenger = unsafe { functions.create_debug_utils_messenger(&messages.messenger(), None) }
                .during("vkCreateDebugUtilsMessengerEXT", "the instance")?;
            instance.validation = Some(Validation {
                functions,
                messenger,
                messages,
            });
        }
        Ok(instance)
    }

    /// All physical devices of the machine, in the loader's order.
    pub(crate) fn physical_devices(&self) -> Result<Vec<vk::PhysicalDevice>, VulkanError> {
        // SAFETY: the instance is alive.
        match unsafe { self.raw.enumerate_physical_devices() } {
            // What loaders report when drivers are listed but none of them finds hardware.
            Err(vk::Result::ERROR_INITIALIZATION_FAILED) => Ok(Vec::new()),
            other => other.during("vkEnumeratePhysicalDevices", "the instance"),
        }
    }

    /// The validation layer's messages, if it was asked for; they can be kept beyond the instance.
    pub(crate) fn messages(&self) -> Option<&Arc<Messages>> {
        self.validation.as_ref().map(|validation| &validation.messages)
    }
}

impl Drop for Instance {
    fn drop(&mut self) {
        if let Some(validation) = &self.validation {
            // SAFETY: made from this instance, destroyed once, before the instance.
            unsafe {
                validation
                    .functions
                    .destroy_debug_utils_messenger(validation.messenger, None)
            };
        }
        // SAFETY: every object made from the instance is gone: its only owners are `Device::list`, which makes none,
        // and the device, which destroys its own objects before this field. The messages are dropped after this.
        unsafe { self.raw.destroy_instance(None) };
    }
}

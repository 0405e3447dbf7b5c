//! `VK_KHR_shader_fma`: a product and a sum that are rounded once. It is newer than ash, so what it needs of it stands here (Vulkan
//! specification 1.4, appendix "VK_KHR_shader_fma").

use ash::vk;
use std::ffi::{CStr, c_void};
use std::ptr;

/// The extension's name.
pub(super) const NAME: &CStr = c"VK_KHR_shader_fma";

/// `VkPhysicalDeviceShaderFmaFeaturesKHR`.
#[repr(C)]
#[derive(Debug)]
pub(super) struct Features {
    s_type: vk::StructureType,
    p_next: *mut c_void,
    float_16: vk::Bool32,
    float_32: vk::Bool32,
    float_64: vk::Bool32,
}

// SAFETY: it is laid out as the specification has it, and the specification lets it extend both.
unsafe impl vk::ExtendsPhysicalDeviceFeatures2 for Features {}
// SAFETY: as above.
unsafe impl vk::ExtendsDeviceCreateInfo for Features {}

impl Features {
    fn none() -> Self {
        Self {
            s_type: vk::StructureType::from_raw(1_000_579_000),
            p_next: ptr::null_mut(),
            float_16: vk::FALSE,
            float_32: vk::FALSE,
            float_64: vk::FALSE,
        }
    }

    /// What a device is created with where [`is_there`].
    pub(super) fn wanted() -> Self {
        Self {
            float_32: vk::TRUE,
            ..Self::none()
        }
    }
}

/// Whether the device has it for `f32`. A driver that cannot list its extensions has none.
pub(super) fn is_there(instance: &ash::Instance, physical: vk::PhysicalDevice) -> bool {
    // SAFETY: `physical` comes from this live instance.
    let listed = unsafe { instance.enumerate_device_extension_properties(physical) };
    let listed = listed.unwrap_or_default();
    if !(listed.iter()).any(|extension| extension.extension_name_as_c_str() == Ok(NAME)) {
        return false;
    }
    let mut fused = Features::none();
    let mut features = vk::PhysicalDeviceFeatures2::default().push_next(&mut fused);
    // SAFETY: as above; the device lists the extension that the chained structure belongs to.
    unsafe { instance.get_physical_device_features2(physical, &mut features) };
    fused.float_32 == vk::TRUE
}

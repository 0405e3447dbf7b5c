//! What a device says about itself: driver, float controls, limits.

use super::instance::Instance;
use ash::vk;
use lightbvh_gpu::FloatControls;
use serde::Serialize;
use std::ffi::CStr;
use std::fmt;

/// A device's own account of itself, as read from the driver.
#[derive(Clone, Debug, Serialize)]
pub struct Probe {
    /// Device name as the driver gives it.
    pub name: String,
    /// Highest Vulkan version of the device, `major.minor.patch`.
    pub api_version: String,
    /// The driver.
    pub driver: Driver,
    /// Floating-point execution modes for 32-bit floats that kernels get.
    #[serde(skip)]
    pub float_controls: FloatControls,
    /// `shaderDenormPreserveFloat32`.
    pub keeps_denormals: bool,
    /// `scalarBlockLayout`: arrays of 12-byte structures in buffers.
    pub scalar_block_layout: bool,
    /// `robustBufferAccess`: accesses beyond a buffer are defined.
    pub robust_buffer_access: bool,
    /// Limits.
    #[serde(skip)]
    pub limits: vk::PhysicalDeviceLimits,
    /// Largest single memory allocation, bytes.
    pub max_memory_allocation_size: u64,
    /// Meaningful low bits of a timestamp on the compute queue; 0 where there are none.
    pub timestamp_valid_bits: u32,
}

/// Driver identity; belongs into every report about bits or times.
#[derive(Clone, Debug, Serialize)]
pub struct Driver {
    /// `VkDriverId`: 10 is SwiftShader, 13 is llvmpipe.
    pub id: i32,
    /// Driver name.
    pub name: String,
    /// Free text, often with the version.
    pub info: String,
}

impl fmt::Display for Driver {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.name, self.info)
    }
}

/// A physical device that can run this program's kernels.
pub(crate) struct Candidate {
    pub(crate) physical: vk::PhysicalDevice,
    pub(crate) queue_family: u32,
    pub(crate) probe: Probe,
}

impl Candidate {
    /// Probes one physical device; `Err` says in words why it cannot be used.
    pub(crate) fn probe(instance: &Instance, physical: vk::PhysicalDevice) -> Result<Self, String> {
        let vk_instance = &instance.raw;
        // SAFETY: `physical` comes from this live instance; the same holds for the queries below.
        let basic = unsafe { vk_instance.get_physical_device_properties(physical) };
        let name = text(basic.device_name_as_c_str().ok());
        if basic.api_version < vk::API_VERSION_1_2 {
            return Err(format!(
                "{name}: Vulkan {}, 1.2 is needed",
                version(basic.api_version)
            ));
        }
        // SAFETY: as above.
        let families = unsafe { vk_instance.get_physical_device_queue_family_properties(physical) };
        let Some((queue_family, family)) = (0u32..).zip(&families).find(|(_, family)| {
            family.queue_count > 0 && family.queue_flags.contains(vk::QueueFlags::COMPUTE)
        }) else {
            return Err(format!("{name}: no compute queue"));
        };

        let mut float_controls = vk::PhysicalDeviceFloatControlsProperties::default();
        let mut driver = vk::PhysicalDeviceDriverProperties::default();
        let mut maintenance3 = vk::PhysicalDeviceMaintenance3Properties::default();
        let mut properties = vk::PhysicalDeviceProperties2::default()
            .push_next(&mut float_controls)
            .push_next(&mut driver)
            .push_next(&mut maintenance3);
        // SAFETY: as above; every chained structure is core in the device's version, 1.2 or later.
        unsafe { vk_instance.get_physical_device_properties2(physical, &mut properties) };
        let mut vulkan12 = vk::PhysicalDeviceVulkan12Features::default();
        let mut features = vk::PhysicalDeviceFeatures2::default().push_next(&mut vulkan12);
        // SAFETY: as above.
        unsafe { vk_instance.get_physical_device_features2(physical, &mut features) };
        let robust_buffer_access = features.features.robust_buffer_access == vk::TRUE;
        if vulkan12.vulkan_memory_model == vk::FALSE {
            return Err(format!("{name}: no vulkanMemoryModel, which the kernels need"));
        }

        let probe = Probe {
            name,
            api_version: version(basic.api_version),
            driver: Driver {
                id: driver.driver_id.as_raw(),
                name: text(driver.driver_name_as_c_str().ok()),
                info: text(driver.driver_info_as_c_str().ok()),
            },
            float_controls: FloatControls {
                signed_zero_inf_nan_preserve_32: float_controls.shader_signed_zero_inf_nan_preserve_float32
                    == vk::TRUE,
                rounding_mode_rte_32: float_controls.shader_rounding_mode_rte_float32 == vk::TRUE,
            },
            keeps_denormals: float_controls.shader_denorm_preserve_float32 == vk::TRUE,
            scalar_block_layout: vulkan12.scalar_block_layout == vk::TRUE,
            robust_buffer_access,
            limits: basic.limits,
            max_memory_allocation_size: maintenance3.max_memory_allocation_size,
            timestamp_valid_bits: family.timestamp_valid_bits,
        };
        Ok(Self {
            physical,
            queue_family,
            probe,
        })
    }
}

fn version(packed: u32) -> String {
    let (major, minor) = (vk::api_version_major(packed), vk::api_version_minor(packed));
    format!("{major}.{minor}.{}", vk::api_version_patch(packed))
}

fn text(name: Option<&CStr>) -> String {
    name.map_or_else(String::new, |name| name.to_string_lossy().into_owned())
}

//! Devices: list them, pick one, open it, close it.

use super::error::{CallContext, VulkanError};
use super::instance::Instance;
use super::probe::{Candidate, Probe};
use super::shared::Shared;
use ash::vk;
use lightbvh_gpu::FloatEnvironment;
use serde::Serialize;
use std::sync::Arc;

/// A device that can be opened.
#[derive(Clone, Debug, Serialize)]
pub struct DeviceInfo {
    /// Its place in the list, what `--device` takes.
    pub index: usize,
    /// What it says about itself.
    pub probe: Probe,
}

/// The devices of this machine.
#[derive(Clone, Debug, Default, Serialize)]
pub struct DeviceList {
    /// Those that can be opened, in the loader's order.
    pub devices: Vec<DeviceInfo>,
    /// One sentence for each thing that is missing: no loader, no driver, a device that cannot be used and why.
    pub notes: Vec<String>,
}

/// How to open a device.
#[derive(Clone, Copy, Debug, Default)]
pub struct Options {
    /// Run under `VK_LAYER_KHRONOS_validation`: any message of it becomes an error of the call that drew it.
    pub validation: bool,
}

/// An open device. Buffers and kernels are made from it; it closes when the last of them is dropped.
pub struct Device {
    pub(crate) shared: Arc<Shared>,
}

impl Device {
    /// All devices with a compute queue, Vulkan 1.2 and the Vulkan memory model.
    ///
    /// Without a loader, a driver or a device the list is empty and its notes say why: a reason to go on with the CPU,
    /// not an error.
    pub fn list() -> Result<DeviceList, VulkanError> {
        let instance = match Instance::new(false) {
            Ok(instance) => instance,
            Err(VulkanError::Unavailable { reason }) => {
                return Ok(DeviceList {
                    devices: Vec::new(),
                    notes: vec![reason],
                });
            }
            Err(error) => return Err(error),
        };
        let (candidates, mut notes) = candidates(&instance)?;
        if candidates.is_empty() && notes.is_empty() {
            notes.push("the Vulkan loader finds no device".into());
        }
        let devices = (0..)
            .zip(candidates)
            .map(|(index, it)| DeviceInfo {
                index,
                probe: it.probe,
            })
            .collect();
        Ok(DeviceList { devices, notes })
    }

    /// Opens a device of the list.
    pub fn open(info: &DeviceInfo, options: Options) -> Result<Self, VulkanError> {
        let instance = Instance::new(options.validation)?;
        let (candidates, _) = candidates(&instance)?;
        let names: Vec<String> = candidates.iter().map(|it| it.probe.name.clone()).collect();
        let candidate = candidates
            .into_iter()
            .nth(info.index)
            .filter(|candidate| candidate.probe.name == info.probe.name)
            .ok_or_else(|| unknown(&info.probe.name, names.iter().map(String::as_str)))?;
        let found = FloatEnvironment::current();
        if !found.is_default() {
            return Err(VulkanError::FloatEnvironment {
                device: candidate.probe.name,
                found,
            });
        }
        let raw = create(&instance, &candidate, options)?;
        let shared = Arc::new(Shared::new(instance, raw, candidate)?);
        shared.check_validation()?;
        Ok(Self { shared })
    }

    /// What the device said about itself.
    pub fn probe(&self) -> &Probe {
        &self.shared.probe
    }

    /// Device name as the driver gives it.
    pub fn name(&self) -> &str {
        &self.shared.probe.name
    }

    /// The device is lost in the call after `calls` more that may find it so: submissions, waits, times. One that was lost is there
    /// again until then. For tests; there is none of it without debug assertions.
    #[cfg(debug_assertions)]
    #[doc(hidden)]
    pub fn lose_after(&self, calls: u32) {
        self.shared.faults.lose_after(calls);
    }

    /// Closes the device and waits until all of it is gone, so that the validation layer has seen the tear-down too.
    ///
    /// Dropping does the same without a verdict.
    pub fn close(self) -> Result<(), VulkanError> {
        let device = self.shared.probe.name.clone();
        let messages = self.shared.instance.messages().cloned();
        let holders = Arc::strong_count(&self.shared) - 1;
        if Arc::into_inner(self.shared).is_none() {
            return Err(VulkanError::StillHeld { device, holders });
        }
        messages.map_or(Ok(()), |messages| messages.check(&device))
    }
}

impl DeviceList {
    /// The device that `wanted` means: an index, or a part of a name in any case. The first of several matches.
    pub fn select(&self, wanted: &str) -> Result<&DeviceInfo, VulkanError> {
        if self.devices.is_empty() {
            return Err(VulkanError::NoDevice {
                notes: self.notes.join("; "),
            });
        }
        let part = wanted.to_lowercase();
        let found = match wanted.parse::<usize>() {
            Ok(index) => self.devices.get(index),
            Err(_) if wanted.is_empty() => None,
            Err(_) => self
                .devices
                .iter()
                .find(|info| info.probe.name.to_lowercase().contains(&part)),
        };
        found.ok_or_else(|| unknown(wanted, self.devices.iter().map(|info| info.probe.name.as_str())))
    }
}

fn unknown<'a>(wanted: &str, names: impl Iterator<Item = &'a str>) -> VulkanError {
    let available: Vec<String> = names
        .enumerate()
        .map(|(index, name)| format!("{index}: {name}"))
        .collect();
    VulkanError::UnknownDevice {
        wanted: wanted.into(),
        available: available.join(", "),
    }
}

/// The usable devices, and why the others are not.
fn candidates(instance: &Instance) -> Result<(Vec<Candidate>, Vec<String>), VulkanError> {
    let mut usable = Vec::new();
    let mut notes = Vec::new();
    for physical in instance.physical_devices()? {
        match Candidate::probe(instance, physical) {
            Ok(candidate) => usable.push(candidate),
            Err(reason) => notes.push(reason),
        }
    }
    Ok((usable, notes))
}

/// Creates the logical device: one compute queue and only the features that are used.
fn create(instance: &Instance, candidate: &Candidate, options: Options) -> Result<ash::Device, VulkanError> {
    let priorities = [1.0];
    let queues = [vk::DeviceQueueCreateInfo::default()
        .queue_family_index(candidate.queue_family)
        .queue_priorities(&priorities)];
    let available = &candidate.probe;
    // Under validation an access beyond a buffer must not take the process down before the layer has reported.
    let features = vk::PhysicalDeviceFeatures::default()
        .robust_buffer_access(options.validation && available.robust_buffer_access);
    let mut vulkan12 = vk::PhysicalDeviceVulkan12Features::default()
        .vulkan_memory_model(true)
        .scalar_block_layout(available.scalar_block_layout);
    let info = vk::DeviceCreateInfo::default()
        .queue_create_infos(&queues)
        .enabled_features(&features)
        .push_next(&mut vulkan12);
    // SAFETY: the physical device comes from this instance, the queue family and every enabled feature from its own
    // report, and `info` with all it points to outlives the call.
    unsafe { instance.raw.create_device(candidate.physical, &info, None) }
        .during("vkCreateDevice", &candidate.probe.name)
}

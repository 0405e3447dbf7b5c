//! Runs a test on every Vulkan device of the machine.

use lightbvh_host::vulkan::{Device, DeviceInfo, DeviceList, Options, VulkanError};

/// Set to `1` where a missing device is a failure (continuous integration), not a reason to skip.
pub const REQUIRE: &str = "LIGHTBVH_REQUIRE_VULKAN";

/// The machine's devices. Without any: a printed line, or a panic where [`REQUIRE`] asks for one.
///
/// # Panics
/// If listing fails, or there is no device and one is required.
#[must_use]
pub fn devices() -> DeviceList {
    let list = Device::list().expect("the Vulkan loader answers");
    if list.devices.is_empty() {
        let why = list.notes.join("; ");
        assert!(
            std::env::var(REQUIRE).as_deref() != Ok("1"),
            "{REQUIRE}=1, but no Vulkan device: {why}"
        );
        eprintln!("skipped, no Vulkan device: {why}");
    }
    list
}

/// Opens a device under the validation layer, or without where the layer is not installed.
///
/// # Panics
/// If the device cannot be opened.
#[must_use]
pub fn open(info: &DeviceInfo, options: Options) -> Device {
    match Device::open(info, Options { validation: true }) {
        Err(VulkanError::NoValidationLayer) => {
            eprintln!(
                "{}: without validation, the layer is not installed",
                info.probe.name
            );
            Device::open(info, options).expect("the device opens")
        }
        device => device.expect("the device opens under validation"),
    }
}

/// Runs `test` on each device and closes it; messages of the validation layer fail the test, up to the tear-down.
///
/// # Panics
/// As [`devices`] and [`open`], and if closing finds anything wrong.
pub fn on_each_device(options: Options, test: impl Fn(&Device)) {
    for info in &devices().devices {
        let device = open(info, options);
        test(&device);
        device.close().expect("a clean tear-down");
    }
}

//! The devices that a command runs on.

use super::Context;
use crate::cli::table::news;
use crate::error::HostError;
use crate::vulkan::{Device, Exactness, Options};

/// A device, opened and self-tested.
pub(super) struct Opened {
    pub device: Device,
    pub exactness: Exactness,
}

/// Opens the device asked for, or all there are. Without any, a line on standard error says so.
pub(super) fn open(context: &Context) -> Result<Vec<Opened>, HostError> {
    let list = Device::list()?;
    let chosen = match &context.device {
        Some(wanted) => vec![list.select(wanted)?],
        None => list.devices.iter().collect(),
    };
    if chosen.is_empty() {
        let why = list.notes.join("; ");
        if std::env::var_os("LIGHTBVH_REQUIRE_VULKAN").is_some_and(|value| value != "0") {
            return Err(HostError::DeviceRequired(why));
        }
        news!("no Vulkan device, running on the CPU alone: {why}");
    }
    chosen
        .into_iter()
        .map(|info| {
            let device = Device::open(info, Options::default())?;
            let exactness = device.self_test()?;
            if !exactness.exact {
                news!("{}: {exactness}", device.name());
            }
            Ok(Opened { device, exactness })
        })
        .collect()
}

/// Ends the use of devices; under validation, messages of the tear-down are errors too.
pub(super) fn close(devices: Vec<Opened>) -> Result<(), HostError> {
    for opened in devices {
        opened.device.close()?;
    }
    Ok(())
}

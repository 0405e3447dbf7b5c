//! `lightbvh info`: devices, drivers, float controls, exact or not and why.

use serde_json::json;

use super::{Context, Outcome, devices, table};
use crate::cli::table::say;
use crate::error::HostError;

pub(super) fn run(context: &Context) -> Result<Outcome, HostError> {
    let opened = devices::open(context)?;
    if context.json {
        let devices: Vec<_> = opened
            .iter()
            .map(|o| json!({ "probe": o.device.probe(), "exact": o.exactness.exact, "self_test": o.exactness }))
            .collect();
        table::print_json(&json!({ "cpu_threads": rayon::current_num_threads(), "devices": devices }))?;
    } else {
        if !opened.is_empty() {
            table::print(
                &opened,
                &[
                    ("device", |o| o.device.name().to_owned()),
                    ("driver", |o| o.device.probe().driver.to_string()),
                    ("Vulkan", |o| o.device.probe().api_version.clone()),
                    ("exact", |o| table::yes(o.exactness.exact)),
                ],
            )?;
        }
        for o in &opened {
            say!("{}: {}", o.device.name(), o.exactness)?;
        }
        say!("cpu: {} threads", rayon::current_num_threads())?;
    }
    devices::close(opened)?;
    Ok(Outcome::Good)
}

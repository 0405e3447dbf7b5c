//! `lightbvh info`: devices, drivers, float controls, exact or not and why.

use serde_json::json;

use super::{Context, Outcome, devices, table};
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
        let rows: Vec<_> = opened
            .iter()
            .map(|o| {
                let probe = o.device.probe();
                let controls = &probe.float_controls;
                let yes = |b: bool| if b { "yes" } else { "no" }.to_owned();
                vec![
                    probe.name.clone(),
                    format!("{} {}", probe.driver.name, probe.driver.info),
                    probe.api_version.clone(),
                    yes(controls.signed_zero_inf_nan_preserve_32),
                    yes(controls.rounding_mode_rte_32),
                    yes(controls.denorm_preserve_32),
                    yes(o.exactness.exact),
                ]
            })
            .collect();
        let header = [
            "device",
            "driver",
            "Vulkan",
            "keeps ±0/inf/nan",
            "rounds to even",
            "keeps denormals",
            "exact",
        ];
        if !rows.is_empty() {
            table::print(&header, &rows)?;
        }
        for o in &opened {
            println!("{}: {}", o.device.name(), o.exactness);
        }
        println!("cpu: {} threads", rayon::current_num_threads());
    }
    devices::close(opened)?;
    Ok(Outcome::Good)
}

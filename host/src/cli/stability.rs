//! `lightbvh stability`: every extreme on the CPU and on every device, each row against its bound.

use std::collections::BTreeMap;

use serde::Serialize;

use super::{Context, Outcome, devices, table};
use crate::cli::table::news;
use crate::error::HostError;
use crate::stability::row::{Check, Row};
use crate::stability::{Effort, Found, Skipped, cases, invariance, run as run_case};
use crate::vulkan::Device;

#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// Fewer samples and smaller scenes: less than a minute.
    #[arg(long)]
    quick: bool,
}

#[derive(Serialize)]
struct Report {
    rows: Vec<Row>,
    failed: usize,
    skipped: Vec<Skipped>,
    /// The measure of each check, and the reason of its bound.
    checks: BTreeMap<&'static str, &'static str>,
}

pub(super) fn run(context: &Context, args: &Args) -> Result<Outcome, HostError> {
    let effort = if args.quick { Effort::QUICK } else { Effort::FULL };
    let opened = devices::open(context)?;
    let each: Vec<&Device> = opened.iter().map(|o| &o.device).collect();
    let small = cases::small();
    let mut found = Found::default();
    for case in &small {
        run_case(case, &effort, &each, &mut found)?;
    }
    news!("invariance");
    found.rows.extend(invariance::rows()?);
    news!("{} lights", effort.most_lights);
    run_case(&cases::many(effort.most_lights), &effort, &each, &mut found)?;
    devices::close(opened)?;

    let report = Report {
        failed: found.rows.iter().filter(|row| !row.pass).count(),
        rows: found.rows,
        skipped: found.skipped,
        checks: Check::ALL
            .iter()
            .map(|check| (check.name(), check.reason()))
            .collect(),
    };
    print(context, &report)?;
    Ok(Outcome::good_if(report.failed == 0))
}

fn print(context: &Context, report: &Report) -> Result<(), HostError> {
    if context.json {
        table::print_json(report)?;
        return Ok(());
    }
    table::print(
        &report.rows,
        &[
            ("extreme, structure: check", |r| r.name.clone()),
            ("device", |r| r.device.clone()),
            ("worst", |r| number(r.worst)),
            ("bound", |r| number(r.bound)),
            ("within", |r| if r.pass { "yes" } else { "NO" }.to_owned()),
        ],
    )?;
    let mut text = String::from("\n");
    for (check, reason) in &report.checks {
        text += &format!("{check}: {reason}\n");
    }
    for skipped in &report.skipped {
        text += &format!(
            "not compared on {}: {} is {}\n",
            skipped.device, skipped.name, skipped.why
        );
    }
    for row in report.rows.iter().filter(|row| !row.pass) {
        let at = row.at.as_deref().unwrap_or("no place is known");
        text += &format!(
            "FAILED on {}: {}: {}, at most {}; {at}\n",
            row.device,
            row.name,
            number(row.worst),
            number(row.bound)
        );
    }
    let (failed, all) = (report.failed, report.rows.len());
    text += &format!("{} of {all} rows are within their bounds\n", all - failed);
    table::print_text(&text)?;
    Ok(())
}

/// Counts as they are, everything else to three digits.
fn number(x: f64) -> String {
    if x == x.trunc() && x.abs() < 1e9 {
        format!("{x}")
    } else {
        format!("{x:.2e}")
    }
}

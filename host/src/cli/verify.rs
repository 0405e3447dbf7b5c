//! `lightbvh verify`: every invariant of the trees; refit, sample, pmf, images by every integrator, and every method over
//! frames of an animation, on every device against the CPU, word for word; or the same of a soak.

mod frames;
mod soak;

use std::ffi::OsString;
use std::ops::Range;

use lightbvh::EmissiveTriangle;
use lightbvh::light::AnyLight;
use serde::Serialize;
use serde_json::json;

use super::devices::Opened;
use super::reading::{Reading, shown};
use super::{Context, Outcome, devices, table};
use crate::cli::table::{news, say};
use crate::error::HostError;
use crate::method::{Importance, Target};
use crate::scene::BUILT_IN;
use crate::tally::{Tallies, Tally};
use frames::Tree;

#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// Lights to sample, and pmfs to evaluate, over all scenes, methods and frames together.
    #[arg(long, default_value_t = 1_000_000)]
    queries: u64,
    /// Seed of the queries, or of the edits of --soak.
    #[arg(long, default_value_t = 1)]
    seed: u32,
    /// Frames A to B (B left out) that every method goes through on the CPU and each device.
    #[arg(long, value_name = "A..B", value_parser = range, default_value = "0..3")]
    frames: Range<u32>,
    /// Scenes, built-in or files; all built-in ones by default. May be repeated.
    #[arg(long)]
    scene: Vec<OsString>,
    #[command(flatten)]
    reading: Reading,
    /// Instead of scenes, this number of frames of random edits, 100 to 10^8; memory from 4,000 on.
    #[arg(long, value_name = "FRAMES", value_parser = clap::value_parser!(u32).range(100..=100_000_000), conflicts_with_all = ["queries", "frames", "scene"])]
    soak: Option<u32>,
    /// Instances of --soak, about, 10 to 10^6.
    #[arg(long, requires = "soak", default_value_t = 2_000, value_parser = clap::value_parser!(u32).range(10..=1_000_000))]
    instances: u32,
    /// Triangles of the largest mesh of --soak, 10 to 10^6.
    #[arg(long, requires = "soak", default_value_t = 20_000, value_parser = clap::value_parser!(u32).range(10..=1_000_000))]
    mesh_triangles: u32,
}

/// Frames `A..B`, B left out.
fn range(text: &str) -> Result<Range<u32>, String> {
    let ends = text.split_once("..");
    let range = ends.and_then(|(a, b)| Some(a.parse().ok()?..b.parse().ok()?));
    range
        .filter(|range: &Range<u32>| !range.is_empty())
        .ok_or_else(|| {
            "expected two frame numbers as A..B, the second the greater, for example 0..150".to_owned()
        })
}

#[derive(Clone, Debug, Serialize)]
struct DeviceReport {
    name: String,
    driver: String,
    exact: bool,
    #[serde(flatten)]
    tally: Tally,
}

impl DeviceReport {
    fn new(opened: &Opened, tally: Tally) -> Self {
        Self {
            name: opened.device.name().to_owned(),
            driver: opened.device.probe().driver.to_string(),
            exact: opened.exactness.exact && tally.different == 0,
            tally,
        }
    }
}

#[derive(Serialize)]
struct Report {
    compared: u64,
    different: u64,
    queries: u64,
    seed: u32,
    scenes: Vec<String>,
    importances: &'static [Importance],
    frames: Range<u32>,
    /// Of each method with a light BVH, in each frame.
    frame_queries: u64,
    /// Words that the CPU computes twice (sampled pmfs, evaluated again), and how many of them differ.
    cpu_compared: u64,
    cpu_different: u64,
    devices: Vec<DeviceReport>,
    /// Whether every invariant of every tree holds.
    valid: bool,
    rows: Vec<Tree>,
}

pub(super) fn run(context: &Context, args: &Args) -> Result<Outcome, HostError> {
    if let Some(frames) = args.soak {
        let opened = devices::open(context)?;
        let report = soak::soak(frames, args, &opened)?;
        devices::close(opened)?;
        match context.json {
            true => table::print_json(&json!({ "soak": report }))?,
            false => soak::print(&report)?,
        }
        return Ok(Outcome::good_if(report.is_good()));
    }
    let names = match args.scene.is_empty() {
        true => BUILT_IN.map(OsString::from).to_vec(),
        false => args.scene.clone(),
    };
    let scenes = names.iter().map(|name| args.reading.open(name));
    let scenes = scenes.collect::<Result<Vec<_>, _>>()?;
    for scene in &scenes {
        for warning in scene.warnings() {
            news!("{}: {warning}", scene.name());
        }
    }
    let opened = devices::open(context)?;
    let mut tallies = Tallies {
        devices: vec![Tally::default(); opened.len()],
        cpu: Tally::default(),
    };
    let mut rows = Vec::new();
    // Triangles are sampled by this many methods with a light BVH.
    let shares = scenes.len() as u64 * args.frames.len() as u64 * frames::METHODS;
    let plan = frames::Plan {
        frames: args.frames.clone(),
        queries: args.queries.div_ceil(shares),
        seed: args.seed,
    };
    let targets: Vec<_> = opened.iter().map(|o| Target::Device(&o.device)).collect();
    for scene in &scenes {
        let compare = match scene.has_kinds() {
            false => frames::compare::<EmissiveTriangle>,
            true => frames::compare::<AnyLight>,
        };
        rows.extend(compare(scene, &plan, &targets, &mut tallies)?);
    }
    let valid = rows.iter().all(|tree| tree.valid);
    let report = Report {
        valid,
        rows,
        compared: tallies.devices.iter().map(|tally| tally.compared).sum(),
        different: tallies.devices.iter().map(|tally| tally.different).sum::<u64>() + tallies.cpu.different,
        queries: args.queries,
        seed: args.seed,
        scenes: shown(&names),
        importances: &Importance::ALL,
        frames: args.frames.clone(),
        frame_queries: plan.queries,
        cpu_compared: tallies.cpu.compared,
        cpu_different: tallies.cpu.different,
        devices: opened
            .iter()
            .zip(&tallies.devices)
            .map(|(o, tally)| DeviceReport::new(o, tally.clone()))
            .collect(),
    };
    drop(targets);
    devices::close(opened)?;
    print(context, &report, tallies.cpu.first_difference.as_deref())?;
    Ok(Outcome::good_if(report.different == 0 && valid))
}

fn print(context: &Context, report: &Report, cpu_difference: Option<&str>) -> Result<(), HostError> {
    if context.json {
        table::print_json(report)?;
        return Ok(());
    }
    table::print(
        &report.rows,
        &[
            ("tree", |t| format!("{} {}", t.scene, t.method)),
            ("frame", |t| t.frame.to_string()),
            ("lights", |t| t.lights.to_string()),
            ("mesh lights", |t| t.mesh_lights.to_string()),
            ("nodes", |t| t.nodes.to_string()),
            ("depth", |t| t.depth.to_string()),
            ("bytes/light", |t| format!("{:.1}", t.bytes_per_light)),
            ("invariants", |t| t.said.clone()),
        ],
    )?;
    print_devices(&report.devices)?;
    say!(
        "cpu: {} probabilities of samples against `pmf`, {} different",
        report.cpu_compared,
        report.cpu_different
    )?;
    if let Some(first) = cpu_difference {
        say!("cpu: first difference: {first}")?;
    }
    Ok(())
}

fn print_devices(devices: &[DeviceReport]) -> std::io::Result<()> {
    for DeviceReport {
        name, exact, tally, ..
    } in devices
    {
        for (kind, words) in &tally.words {
            let (count, kind) = (tally.records[kind], kind.name());
            let (compared, different) = (words.compared, words.different);
            say!("{name}: {count} {kind}, {compared} words, {different} different")?;
        }
        let first = tally.first_difference.as_deref().unwrap_or("none");
        say!("{name}: exact: {}; first difference: {first}", table::yes(*exact))?;
    }
    Ok(())
}

//! `lightbvh verify`: refit, sample, pmf, images by every integrator, and every method over frames of an animation, on every
//! device against the CPU, word for word.

mod frames;
mod receivers;
mod refits;
mod restir;
mod side;
mod structures;
mod subject;
pub(super) mod tally;

use std::ops::Range;

use indicatif::ProgressBar;
use lightbvh::EmissiveTriangle;
use lightbvh::light::AnyLight;
use lightbvh_kernels::bvh::{Kinds, Paper, Standard, WIDTH};
use serde::Serialize;

use super::{Context, Outcome, devices, progress, table};
use crate::backend::Sampler;
use crate::cli::table::{news, say};
use crate::error::HostError;
use crate::method::{Importance, MethodLight, Target};
use crate::scene::{BUILT_IN, Scene};
use subject::Subject;
use tally::{Tallies, Tally};

/// Most receivers of each sort in a scene.
const RECEIVERS: u64 = 20_000;

#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// How many lights to sample and how many pmfs to evaluate, over all scenes, importances and structures together.
    #[arg(long, default_value_t = 1_000_000)]
    queries: u64,
    /// Seed of the queries.
    #[arg(long, default_value_t = 1)]
    seed: u32,
    /// Frames A to B (B left out) that every method is brought through in order on the CPU and each device, rebuilds
    /// included, comparing nodes, samples, pmfs, images and ReSTIR's reservoirs in each; 0..150 is the paper's animation.
    #[arg(long, value_name = "A..B", value_parser = super::frames::parse, default_value = "0..3")]
    frames: Range<u32>,
    /// Lights to sample and pmfs to evaluate per method and frame of --frames.
    #[arg(long, default_value_t = 256)]
    frame_queries: u32,
    /// Refit that many more frames of every scene by either structure: this compares many words in little time.
    #[arg(long, default_value_t = 0)]
    refits: u32,
    /// What lights of a BVH are chosen by.
    #[arg(long, value_enum, default_value_t = Importances::Both)]
    importance: Importances,
    /// Scenes, built-in or files; all built-in ones by default. May be repeated.
    #[arg(long)]
    scene: Vec<String>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Importances {
    /// The default: moments of the lights, 8 children to a node.
    Moments,
    /// The paper's Eq. 4 on bounds, 4 children to a node.
    Eq4,
    /// One after the other.
    Both,
}

impl Importances {
    fn chosen(self) -> &'static [Importance] {
        match self {
            Self::Moments => &[Importance::Moments],
            Self::Eq4 => &[Importance::Eq4],
            Self::Both => &Importance::ALL,
        }
    }
}

#[derive(Serialize)]
struct DeviceReport {
    name: String,
    driver: String,
    exact: bool,
    #[serde(flatten)]
    tally: Tally,
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
    frame_queries: u32,
    refits: u32,
    /// Words that the CPU computes twice (sampled pmfs, evaluated again), and how many of them differ.
    cpu_compared: u64,
    cpu_different: u64,
    devices: Vec<DeviceReport>,
}

pub(super) fn run(context: &Context, args: &Args) -> Result<Outcome, HostError> {
    let names: Vec<String> = if args.scene.is_empty() {
        BUILT_IN.iter().map(|&name| name.to_owned()).collect()
    } else {
        args.scene.clone()
    };
    let scenes = names
        .iter()
        .map(|name| Scene::open(name))
        .collect::<Result<Vec<_>, _>>()?;
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
    let bar = progress(args.queries, "queries", context.json);
    let importances = args.importance.chosen();
    let shares = scenes.len() as u64 * 2 * importances.len() as u64;
    let asked = (args.queries.div_ceil(shares), args.seed);
    for scene in &scenes {
        let has_kinds = scene.has_kinds();
        for &importance in importances_of(scene, importances) {
            for sampler in [Sampler::SingleLevel, Sampler::TwoLevel] {
                let subject = Subject {
                    scene,
                    sampler,
                    importance: importance.name(),
                    params: importance.builder().params(),
                    treeless: importance == importances[0] && sampler == Sampler::SingleLevel,
                };
                let compare = match importance {
                    Importance::Moments if has_kinds => structures::compare::<Kinds, WIDTH>,
                    Importance::Moments => structures::compare::<Standard, WIDTH>,
                    Importance::Eq4 => structures::compare::<Paper, 4>,
                };
                compare(&subject, &opened, asked, &mut tallies, &bar)?;
            }
        }
    }
    bar.finish_and_clear();
    // The kernels of masks, leaves and fog are over triangles, by the default's importance.
    let asked_for = (asked.0.clamp(1, RECEIVERS) as u32, args.seed);
    let lit_by_triangles = scenes
        .iter()
        .filter(|scene| !scene.has_kinds() && !opened.is_empty());
    for scene in lit_by_triangles.filter(|_| importances.contains(&Importance::Moments)) {
        receivers::compare(scene, asked_for, &opened, &mut tallies)?;
    }

    let plan = frames::Plan {
        frames: args.frames.clone(),
        queries: args.frame_queries,
        seed: args.seed,
        importances,
    };
    let targets: Vec<_> = opened.iter().map(|o| Target::Device(&o.device)).collect();
    let bar = progress((args.frames.len() * scenes.len()) as u64, "frames", context.json);
    for scene in &scenes {
        let compare = match scene.has_kinds() {
            false => frames::compare::<EmissiveTriangle>,
            true => frames::compare::<AnyLight>,
        };
        compare(scene, &plan, &targets, &mut tallies, &bar)?;
    }
    bar.finish_and_clear();
    if args.refits > 0 {
        let bar = progress(
            u64::from(args.refits) * scenes.len() as u64,
            "refits",
            context.json,
        );
        for scene in &scenes {
            let known = importances_of(scene, importances);
            if !scene.has_kinds() {
                let made = |importance, lights: &_, sampler| match importance {
                    Importance::Moments => {
                        refits::structure::<Standard, WIDTH>(importance, lights, sampler, &targets)
                    }
                    Importance::Eq4 => refits::structure::<Paper, 4>(importance, lights, sampler, &targets),
                };
                refits::compare(scene, known, made, args.refits, &mut tallies, &bar)?;
            } else {
                let made = |importance, lights: &_, sampler| {
                    refits::structure::<Kinds, WIDTH>(importance, lights, sampler, &targets)
                };
                refits::compare(scene, known, made, args.refits, &mut tallies, &bar)?;
            }
        }
        bar.finish_and_clear();
    }

    let report = Report {
        compared: tallies.devices.iter().map(|tally| tally.compared).sum(),
        different: tallies.devices.iter().map(|tally| tally.different).sum::<u64>() + tallies.cpu.different,
        queries: args.queries,
        seed: args.seed,
        scenes: names,
        importances,
        frames: args.frames.clone(),
        frame_queries: args.frame_queries,
        refits: args.refits,
        cpu_compared: tallies.cpu.compared,
        cpu_different: tallies.cpu.different,
        devices: opened
            .iter()
            .zip(&tallies.devices)
            .map(|(o, tally)| DeviceReport {
                name: o.device.name().to_owned(),
                driver: o.device.probe().driver.to_string(),
                exact: o.exactness.exact && tally.different == 0,
                tally: tally.clone(),
            })
            .collect(),
    };
    drop(targets);
    devices::close(opened)?;
    print(context, &report, tallies.cpu.first_difference.as_deref())?;
    Ok(Outcome::good_if(report.different == 0))
}

/// The importances that choose among the lights of a scene; of other kinds than triangles, the default alone.
fn importances_of(scene: &Scene, asked: &'static [Importance]) -> &'static [Importance] {
    match scene.has_kinds() {
        false => asked,
        true if asked.contains(&Importance::Moments) => AnyLight::IMPORTANCES,
        true => &[],
    }
}

fn progress(length: u64, of: &str, hidden: bool) -> ProgressBar {
    let template = format!("{{bar:40}} {{pos}}/{{len}} {of}, {{eta}} left  {{wide_msg}}");
    progress::bar(length, &template, hidden)
}

fn print(context: &Context, report: &Report, cpu_difference: Option<&str>) -> Result<(), HostError> {
    if context.json {
        table::print_json(report)?;
        return Ok(());
    }
    if !report.devices.is_empty() {
        table::print(
            &report.devices,
            &[
                ("device", |d| d.name.clone()),
                ("nodes", |d| d.tally.nodes.to_string()),
                ("samples", |d| d.tally.samples.to_string()),
                ("pmfs", |d| d.tally.pmfs.to_string()),
                ("pixels", |d| d.tally.pixels.to_string()),
                ("words compared", |d| d.tally.compared.to_string()),
                ("words different", |d| d.tally.different.to_string()),
                ("exact", |d| table::yes(d.exact)),
            ],
        )?;
    }
    for device in &report.devices {
        for (kind, words) in &device.tally.words {
            say!(
                "{}: {} words of {}, {} different",
                device.name,
                words.compared,
                kind.name(),
                words.different
            )?;
        }
        if let Some(first) = &device.tally.first_difference {
            say!("{}: first difference: {first}", device.name)?;
        }
    }
    say!(
        "cpu: {} words computed twice, {} different",
        report.cpu_compared,
        report.cpu_different
    )?;
    if let Some(first) = cpu_difference {
        say!("cpu: first difference: {first}")?;
    }
    Ok(())
}

//! `lightbvh bench`: time per item and bytes per light, beside a plain copy of the same bytes; and what speed costs in
//! accuracy; or what frames of moving lights cost.

mod devices;
mod dynamic;
mod passes;
pub(super) mod scene;
mod trade;
mod worst;

use std::hint::black_box;
use std::time::Duration;

use lightbvh::{BuildParams, LightBvh, Lights};
use serde::Serialize;
use serde_json::json;

use super::range::{self, Given, given};
use super::times::median;
use super::{Context, Outcome, devices as cli_devices, table};
use crate::backend::{Bvh, CpuBackend, DeviceBackend, Sampler};
use crate::cli::table::news;
use crate::error::HostError;
use crate::workload::build;
use dynamic::lone;
use passes::{batches, library_passes, measure, passes};
use scene::{random_lights, random_queries};

#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// Number of emissive triangles, 1 to 2^24; measuring takes about 560 bytes of memory for each.
    #[arg(long, default_value_t = 100_000)]
    lights: u32,
    /// Samples, and pmfs, of one run, 1 to 10^8.
    #[arg(long, default_value_t = 200_000)]
    queries: u32,
    /// Leave out the table of accuracy against speed.
    #[arg(long)]
    no_trade: bool,
    /// Measure updates of moving lights instead: frames in which one of many changes, and such in which many do; adoption of what
    /// was rebuilt beside them.
    #[arg(long)]
    dynamic: bool,
    /// Of the frames of moving lights only those in which one changes, fewer of them and at fewer sizes: under a minute.
    #[arg(long, requires = "dynamic")]
    quick: bool,
    /// Most instances, and most triangles of a mesh, among which one changes, 10^3 to 10^6: each power of ten up to it is measured.
    /// With `--quick` as far as 45 s go.
    #[arg(long, requires = "dynamic", default_value_t = lone::SIZES[1])]
    largest: u32,
    /// Count the nodes and the time of single samples and pmfs in adversarial scenes instead.
    #[arg(long, conflicts_with = "dynamic")]
    worst: bool,
    /// Measure what frames of moving lights cost each device instead: times, bytes, regions, submissions, waits.
    #[arg(long, conflicts_with_all = ["dynamic", "worst"])]
    devices: bool,
    /// Instances of the moving scene, 1 to 10^6.
    #[arg(long, default_value_t = 10_000)]
    instances: u32,
    /// Triangles of each of its meshes, 1 to 10^6, and at most 10^7 in all instances together.
    #[arg(long, default_value_t = 100)]
    mesh_triangles: u32,
}

/// A measurement.
#[derive(Clone, Debug, Serialize)]
struct Case {
    what: &'static str,
    /// Of a refit: `levels`, one after the other.
    passes: Option<&'static str>,
    /// Of samples: `one` by one, or in a `batch`.
    variant: Option<&'static str>,
    /// Of a build: `fast`, `balanced` (the default) or `best`.
    preset: Option<&'static str>,
    structure: &'static str,
    lights: u32,
    backend: String,
    threads: usize,
    ns_per_item: f64,
    /// Least and greatest of the runs.
    ns_least: f64,
    ns_most: f64,
    bytes_per_light: f64,
    /// Time of the whole pass over that of copying the structure's bytes once with one thread.
    copies: f64,
}

pub(super) fn run(context: &Context, args: &Args) -> Result<Outcome, HostError> {
    if args.worst {
        return worst::run(context);
    }
    if args.dynamic {
        return run_dynamic(context, args);
    }
    if args.devices {
        return run_devices(context, args);
    }
    range::check(&[
        given("--lights", args.lights, 1..=1 << 24),
        given("--queries", args.queries, 1..=100_000_000),
    ])?;
    let opened = cli_devices::open(context)?;
    let lights = random_lights(args.lights);
    let queries = random_queries(args.queries);
    let one = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .expect("a pool of one thread");
    let all = rayon::current_num_threads();

    let mut cases = Vec::new();
    for structure in [Sampler::SingleLevel, Sampler::TwoLevel] {
        news!("{}", structure.name());
        let bvh: Bvh = build(&lights, structure, &BuildParams::default());
        let words: &[u32] = bytemuck::cast_slice(bvh.nodes());
        let mut target = words.to_vec();
        let copy = median(&measure(|| target.copy_from_slice(black_box(words))));
        let copy = copy.as_secs_f64() * bvh.bytes() as f64 / size_of_val(words) as f64;

        let mut push = |what: What, backend: &str, threads, times: &[Duration], items: u32| {
            let ns = |time: Duration| time.as_nanos() as f64 / f64::from(items);
            cases.push(Case {
                what: what.pass,
                passes: what.passes,
                variant: what.variant,
                preset: what.preset,
                structure: structure.name(),
                lights: args.lights,
                backend: backend.to_owned(),
                threads,
                ns_per_item: ns(median(times)),
                ns_least: ns(times.iter().copied().min().unwrap_or_default()),
                ns_most: ns(times.iter().copied().max().unwrap_or_default()),
                bytes_per_light: bvh.bytes() as f64 / f64::from(args.lights),
                copies: median(times).as_secs_f64() / copy,
            });
        };
        for (preset, params) in PRESETS {
            news!("{} {preset} build", structure.name());
            let mut times = |threads, times: &[Duration]| {
                push(What::build(preset), "cpu", threads, times, args.lights);
            };
            times(1, &one.install(|| builds(&lights, structure, &params)));
            if all > 1 {
                times(all, &builds(&lights, structure, &params));
            }
        }
        // One thread by the library alone, all threads through the backend.
        let single = one.install(|| library_passes(bvh.clone(), &lights, &queries));
        let batch = one.install(|| batches(&bvh, &queries));
        let mut results = vec![(1, single, batch)];
        if all > 1 {
            let mut cpu: CpuBackend = CpuBackend::new(bvh.clone());
            let times = passes(&mut cpu, &lights, &queries)?;
            results.push((all, times, batches(&bvh, &queries)));
        }
        for (threads, times, batch) in &results {
            push(What::REFIT, "cpu", *threads, &times.refit, args.lights);
            push(What::SAMPLE, "cpu", *threads, &times.sample, args.queries);
            push(What::BATCH, "cpu", *threads, batch, args.queries);
            push(What::PMF, "cpu", *threads, &times.pmf, args.queries);
        }
        for o in &opened {
            let mut device: DeviceBackend<'_> = DeviceBackend::new(&o.device, &bvh)?;
            let times = passes(&mut device, &lights, &queries)?;
            push(What::REFIT, o.device.name(), 0, &times.refit, args.lights);
            push(What::SAMPLE, o.device.name(), 0, &times.sample, args.queries);
            push(What::PMF, o.device.name(), 0, &times.pmf, args.queries);
        }
    }
    cli_devices::close(opened)?;
    let trade = if args.no_trade { Vec::new() } else { trade::rows() };
    print(context, &cases, &trade)?;
    Ok(Outcome::Good)
}

/// What builders may spend, by name.
const PRESETS: [(&str, BuildParams); 3] = [
    ("fast", BuildParams::FAST),
    ("balanced", BuildParams::BALANCED),
    ("best", BuildParams::BEST),
];

/// What is measured.
#[derive(Clone, Copy)]
struct What {
    pass: &'static str,
    passes: Option<&'static str>,
    variant: Option<&'static str>,
    preset: Option<&'static str>,
}

impl What {
    const PMF: Self = Self {
        pass: "pmf",
        passes: None,
        variant: None,
        preset: None,
    };
    const REFIT: Self = Self {
        pass: "refit",
        passes: Some("levels"),
        ..Self::PMF
    };
    const SAMPLE: Self = Self {
        pass: "sample",
        variant: Some("one"),
        ..Self::PMF
    };
    const BATCH: Self = Self {
        variant: Some("batch"),
        ..Self::SAMPLE
    };

    fn build(preset: &'static str) -> Self {
        Self {
            pass: "build",
            preset: Some(preset),
            ..Self::PMF
        }
    }

    /// As in the table, which has one column for what kinds of a pass there are.
    fn kind(case: &Case) -> &'static str {
        case.passes.or(case.variant).or(case.preset).unwrap_or("-")
    }
}

/// Times of builds by the threads of the current pool.
fn builds(lights: &Lights, structure: Sampler, params: &BuildParams) -> Vec<Duration> {
    measure(|| {
        let bvh: LightBvh = build(lights, structure, params);
        black_box(&bvh);
    })
}

fn run_dynamic(context: &Context, args: &Args) -> Result<Outcome, HostError> {
    let all = u64::from(args.instances) * u64::from(args.mesh_triangles);
    range::check(&[
        given("--instances", args.instances, 1..=1_000_000),
        given("--mesh-triangles", args.mesh_triangles, 1..=1_000_000),
        Given {
            of: " triangles in all",
            ..given("--instances times --mesh-triangles", all, 1..=10_000_000)
        },
    ])?;
    let largest = args.largest;
    range::check(&[given(
        "--largest",
        largest,
        u64::from(lone::SIZES[0])..=u64::from(lone::SIZES[1]),
    )])?;
    let much = if args.quick {
        None
    } else {
        let opened = cli_devices::open(context)?;
        let report = dynamic::report(args.instances, args.mesh_triangles, &opened)?;
        let rows = devices::rows(&opened, args.instances)?;
        cli_devices::close(opened)?;
        Some((report, rows))
    };
    let one = lone::report(largest, args.quick);
    if context.json {
        table::print_json(&json!({
            "rows": one.rows,
            "growth": one.growth,
            "quality": one.quality,
            "left_out": one.left_out,
            "dynamic": much.as_ref().map(|(report, _)| report),
            "devices": much.as_ref().map(|(_, rows)| rows),
        }))?;
    } else {
        lone::print(&one)?;
        if let Some((report, rows)) = much {
            dynamic::print(&report)?;
            devices::print(&rows)?;
        }
    }
    Ok(Outcome::Good)
}

fn run_devices(context: &Context, args: &Args) -> Result<Outcome, HostError> {
    range::check(&[given("--instances", args.instances, 1..=1_000_000)])?;
    let opened = cli_devices::open(context)?;
    let rows = devices::rows(&opened, args.instances)?;
    cli_devices::close(opened)?;
    if context.json {
        table::print_json(&json!({ "rows": rows }))?;
    } else {
        devices::print(&rows)?;
    }
    Ok(Outcome::Good)
}

fn print(context: &Context, cases: &[Case], trade: &[trade::Row]) -> Result<(), HostError> {
    if context.json {
        table::print_json(&json!({ "cases": cases, "trade": trade }))?;
        return Ok(());
    }
    table::print(
        cases,
        &[
            ("what", |c| c.what.to_owned()),
            ("kind", |c| What::kind(c).to_owned()),
            ("structure", |c| c.structure.to_owned()),
            ("lights", |c| c.lights.to_string()),
            ("backend", |c| c.backend.clone()),
            ("threads", |c| table::threads(c.threads)),
            ("ns/item", |c| format!("{:.1}", c.ns_per_item)),
            ("least", |c| format!("{:.1}", c.ns_least)),
            ("most", |c| format!("{:.1}", c.ns_most)),
            ("bytes/light", |c| format!("{:.1}", c.bytes_per_light)),
            ("copies", |c| format!("{:.1}", c.copies)),
        ],
    )?;
    trade::print(trade)?;
    Ok(())
}

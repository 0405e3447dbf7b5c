//! `lightbvh bench`: time per item and bytes per light, next to a plain copy of the same bytes; or what frames of
//! moving lights cost.

mod dynamic;
mod passes;
mod scene;
mod worst;

use std::hint::black_box;
use std::time::{Duration, Instant};

use lightbvh::device::bvh::follow;
use lightbvh::{BuildParams, LightBvh};
use serde::Serialize;
use serde_json::json;

use super::measure::times::{ms, quantiles, spread_ms};
use super::{Context, Outcome, devices, table};
use crate::backend::{Bvh, CpuBackend, DeviceBackend, Follow, Sampler};
use crate::cli::table::news;
use crate::error::HostError;
use crate::workload::build;
use passes::{batches, measure, passes};
use scene::{random_lights, random_queries};

#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// Number of emissive triangles, 1 to 2^24; each takes about 560 bytes of memory.
    #[arg(long, default_value_t = 100_000, value_parser = clap::value_parser!(u32).range(1..=1 << 24))]
    lights: u32,
    /// Samples, and pmfs, of one run, 1 to 10^8.
    #[arg(long, default_value_t = 200_000, value_parser = clap::value_parser!(u32).range(1..=100_000_000))]
    queries: u32,
    /// Measure frames of moving lights instead: time, variance relative to a fresh build, bytes.
    #[arg(long, conflicts_with = "device")]
    dynamic: bool,
    /// Count nodes and time of single samples and pmfs in adversarial scenes instead.
    #[arg(long, conflicts_with_all = ["dynamic", "device"])]
    worst: bool,
}

/// A measurement.
#[derive(Clone, Debug, Serialize)]
struct Case {
    what: &'static str,
    /// `levels` of a refit.
    passes: Option<&'static str>,
    /// `one` sample at a time, or a `batch`.
    variant: Option<&'static str>,
    /// `balanced` of a build.
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
        return dynamic::run(context);
    }
    let opened = devices::open(context)?;
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
        let words: &[u32] = bytemuck::cast_slice(bvh.view().nodes());
        let mut target = words.to_vec();
        let copy = spread_ms(&measure(|| target.copy_from_slice(black_box(words)))).median;
        let copy = copy * bvh.view().bytes() as f64 / size_of_val(words) as f64;

        let mut push = |(what, [passes, variant, preset]): What,
                        backend: &str,
                        threads,
                        times: &[Duration],
                        items: u32| {
            let [least, median, most] = quantiles(times.iter().copied().map(ms), [0.0, 0.5, 1.0]);
            let ns = |ms: f64| 1e6 * ms / f64::from(items);
            cases.push(Case {
                what,
                passes,
                variant,
                preset,
                structure: structure.name(),
                lights: args.lights,
                backend: backend.to_owned(),
                threads,
                ns_per_item: ns(median),
                ns_least: ns(least),
                ns_most: ns(most),
                bytes_per_light: bvh.view().bytes() as f64 / f64::from(args.lights),
                copies: median / copy,
            });
        };
        let measured = || {
            let built = measure(|| {
                black_box::<LightBvh>(build(&lights, structure, &BuildParams::BALANCED));
            });
            let mut cpu: CpuBackend = CpuBackend::new(bvh.clone());
            let refit = |cpu: &mut CpuBackend| {
                let start = Instant::now();
                follow(cpu.bvh_mut(), &lights)?;
                Ok(start.elapsed())
            };
            let times = passes(&mut cpu, refit, &queries)?;
            Ok::<_, HostError>((built, times, batches(&bvh, &queries)))
        };
        let mut results = vec![(1, one.install(measured)?)];
        if all > 1 {
            results.push((all, measured()?));
        }
        for (threads, (built, [refit, sample, pmf], batch)) in &results {
            push(BUILD, "cpu", *threads, built, args.lights);
            push(REFIT, "cpu", *threads, refit, args.lights);
            push(SAMPLE, "cpu", *threads, sample, args.queries);
            push(BATCH, "cpu", *threads, batch, args.queries);
            push(PMF, "cpu", *threads, pmf, args.queries);
        }
        for o in &opened {
            let mut device: DeviceBackend<'_> = DeviceBackend::new(&o.device, &bvh)?;
            let mut own = bvh.clone();
            let refit = |device: &mut DeviceBackend<'_>| {
                follow(&mut own, &lights)?;
                Ok(device.follow(&own)?.time)
            };
            let [refit, sample, pmf] = passes(&mut device, refit, &queries)?;
            push(REFIT, o.device.name(), 0, &refit, args.lights);
            push(SAMPLE, o.device.name(), 0, &sample, args.queries);
            push(PMF, o.device.name(), 0, &pmf, args.queries);
        }
    }
    devices::close(opened)?;
    print(context, &cases)?;
    Ok(Outcome::Good)
}

/// A measurement: the pass, and which of its passes, variants or presets.
type What = (&'static str, [Option<&'static str>; 3]);
const BUILD: What = ("build", [None, None, Some("balanced")]);
const REFIT: What = ("refit", [Some("levels"), None, None]);
const SAMPLE: What = ("sample", [None, Some("one"), None]);
const BATCH: What = ("sample", [None, Some("batch"), None]);
const PMF: What = ("pmf", [None; 3]);

fn print(context: &Context, cases: &[Case]) -> Result<(), HostError> {
    if context.json {
        table::print_json(&json!({ "cases": cases }))?;
        return Ok(());
    }
    table::print(
        cases,
        &[
            ("what", |c| c.what.to_owned()),
            ("kind", |c| {
                c.passes.or(c.variant).or(c.preset).unwrap_or("-").to_owned()
            }),
            ("structure", |c| c.structure.to_owned()),
            ("lights", |c| c.lights.to_string()),
            ("backend", |c| c.backend.clone()),
            ("threads", |c| c.threads.to_string()),
            ("ns/item", |c| format!("{:.1}", c.ns_per_item)),
            ("least", |c| format!("{:.1}", c.ns_least)),
            ("most", |c| format!("{:.1}", c.ns_most)),
            ("bytes/light", |c| format!("{:.1}", c.bytes_per_light)),
            ("copies", |c| format!("{:.1}", c.copies)),
        ],
    )?;
    Ok(())
}

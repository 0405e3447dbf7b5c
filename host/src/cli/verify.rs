//! `lightbvh verify`: refit, sample, pmf, images by every integrator on every device against the CPU, word for word.

mod restir;

use bytemuck::cast_slice;
use indicatif::{ProgressBar, ProgressStyle};
use lightbvh::BuildParams;
use lightbvh::exact::hash;
use lightbvh_kernels::query::{Query, Sampled};
use serde::Serialize;

use super::devices::{self, Opened};
use super::{Context, Outcome, table};
use crate::backend::{
    Backend, Bvh, CpuBackend, DeviceBackend, NODE_RECORD, PIXEL_RECORD, PMF_RECORD, SAMPLED_RECORD, Sampler,
    SceneArrays,
};
use crate::compare::{Record, compare_words};
use crate::error::HostError;
use crate::scene::{BUILT_IN, Scene};
use crate::workload::{Shot, arrays_at, build, lights_at, queries};

/// Queries answered at a time.
const BATCH: u32 = 1 << 19;
/// Frame at which the trees are built, and the frames that they are refitted to.
const BUILD_FRAME: u32 = 0;
const REFIT_FRAMES: [u32; 2] = [40, 110];
/// Most reflections of the paths that are compared: enough for some to end by chance.
const BOUNCES: u32 = 5;

#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// How many lights to sample and how many pmfs to evaluate, over all scenes and both structures together.
    #[arg(long, default_value_t = 1_000_000)]
    queries: u64,
    /// Seed of the queries.
    #[arg(long, default_value_t = 1)]
    seed: u32,
    /// Scenes, built-in or files; all built-in ones by default. May be repeated.
    #[arg(long)]
    scene: Vec<String>,
}

/// What was compared with one device.
#[derive(Clone, Debug, Default, Serialize)]
struct Tally {
    compared: u64,
    different: u64,
    nodes: u64,
    samples: u64,
    pmfs: u64,
    pixels: u64,
    first_difference: Option<String>,
}

impl Tally {
    fn take(&mut self, what: &str, record: &Record, cpu: &[u32], device: &[u32]) -> Result<(), HostError> {
        let comparison = compare_words(record, cpu, device)?;
        self.compared += comparison.compared;
        self.different += comparison.different;
        if let (None, Some(first)) = (&self.first_difference, comparison.first) {
            self.first_difference = Some(format!("{what}: {first}"));
        }
        Ok(())
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
    /// Words that the CPU came by in two ways (sampled pmfs evaluated again, nodes refitted in one go), and those that came
    /// out otherwise.
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
    let opened = devices::open(context)?;
    let mut run = Run {
        tallies: vec![Tally::default(); opened.len()],
        cpu: Tally::default(),
        progress: progress(args.queries, context.json),
    };
    let shares = scenes.len() as u64 * 2;
    for scene in &scenes {
        for sampler in [Sampler::SingleLevel, Sampler::TwoLevel] {
            run.structure(scene, sampler, &opened, args.queries.div_ceil(shares), args.seed)?;
        }
    }
    run.progress.finish_and_clear();
    let Run { tallies, cpu, .. } = run;

    let report = Report {
        compared: tallies.iter().map(|tally| tally.compared).sum(),
        different: tallies.iter().map(|tally| tally.different).sum::<u64>() + cpu.different,
        queries: args.queries,
        seed: args.seed,
        scenes: names,
        cpu_compared: cpu.compared,
        cpu_different: cpu.different,
        devices: opened
            .iter()
            .zip(&tallies)
            .map(|(o, tally)| DeviceReport {
                name: o.device.name().to_owned(),
                driver: format!(
                    "{} {}",
                    o.device.probe().driver.name,
                    o.device.probe().driver.info
                ),
                exact: o.exactness.exact && tally.different == 0,
                tally: tally.clone(),
            })
            .collect(),
    };
    devices::close(opened)?;
    print(context, &report, cpu.first_difference.as_deref())?;
    Ok(if report.different == 0 {
        Outcome::Good
    } else {
        Outcome::Bad
    })
}

struct Run {
    tallies: Vec<Tally>,
    cpu: Tally,
    progress: ProgressBar,
}

impl Run {
    /// Everything about one structure over one scene.
    fn structure(
        &mut self,
        scene: &Scene,
        sampler: Sampler,
        opened: &[Opened],
        count: u64,
        seed: u32,
    ) -> Result<(), HostError> {
        let what = |kernel: &str| format!("{} {} {kernel}", scene.name(), sampler.name());
        let lights = lights_at(scene, BUILD_FRAME)?;
        let bvh: Bvh = build(&lights, sampler, &BuildParams::default());
        let mut cpu = CpuBackend::new(bvh.clone(), lights.clone());
        let mut devices = opened
            .iter()
            .map(|o| DeviceBackend::new(&o.device, &bvh, &lights))
            .collect::<Result<Vec<_>, _>>()?;

        for frame in REFIT_FRAMES {
            let lights = lights_at(scene, frame)?;
            let expected = cpu.refit(&lights)?.value;
            for (device, tally) in devices.iter_mut().zip(&mut self.tallies) {
                let found = device.refit(&lights)?.value;
                tally.nodes += expected.len() as u64;
                tally.take(
                    &what("refit"),
                    &NODE_RECORD,
                    cast_slice(&expected),
                    cast_slice(&found),
                )?;
            }
        }
        self.single_dispatch(scene, &what("refit with one dispatch"), &mut cpu, &mut devices)?;

        let shot = Shot {
            frame: REFIT_FRAMES[REFIT_FRAMES.len() - 1],
            width: 96,
            height: 54,
            samples: 2,
            seed,
        };
        let arrays = arrays_at(scene, shot.frame, shot.width, shot.height)?;
        let mut first = 0;
        while first < count {
            let batch = u64::min(count - first, BATCH.into()) as u32;
            let asked = queries(&arrays, hash(seed), first as u32, batch);
            self.batch(&what, &mut cpu, &mut devices, asked)?;
            first += u64::from(batch);
        }
        self.images(scene, sampler, &arrays, &shot, &mut cpu, &mut devices)?;
        restir::compare(scene, sampler, &shot, opened, &mut self.tallies)
    }

    /// The refits again, each level in one dispatch; to the last frame at the end, as before.
    fn single_dispatch(
        &mut self,
        scene: &Scene,
        what: &str,
        cpu: &mut CpuBackend,
        devices: &mut [DeviceBackend<'_>],
    ) -> Result<(), HostError> {
        for frame in REFIT_FRAMES {
            let lights = lights_at(scene, frame)?;
            // From the nodes of another frame, as on the devices: none is as it should be already.
            let climbed = cpu.refit_once(&lights)?.value;
            let expected = cpu.refit(&lights)?.value;
            self.cpu
                .take(what, &NODE_RECORD, cast_slice(&expected), cast_slice(&climbed))?;
            for (device, tally) in devices.iter_mut().zip(&mut self.tallies) {
                let found = device.refit_once(&lights)?.value;
                tally.nodes += expected.len() as u64;
                tally.take(what, &NODE_RECORD, cast_slice(&expected), cast_slice(&found))?;
            }
        }
        Ok(())
    }

    /// Sample, then pmf: of the light sampled for every query but each eighth, which asks for some light.
    fn batch(
        &mut self,
        what: &impl Fn(&str) -> String,
        cpu: &mut CpuBackend,
        devices: &mut [DeviceBackend<'_>],
        mut asked: Vec<Query>,
    ) -> Result<(), HostError> {
        let sampled: Vec<Sampled> = cpu.sample(&asked)?.value;
        for (device, tally) in devices.iter_mut().zip(&mut self.tallies) {
            let found = device.sample(&asked)?.value;
            tally.samples += found.len() as u64;
            tally.take(
                &what("sample"),
                &SAMPLED_RECORD,
                cast_slice(&sampled),
                cast_slice(&found),
            )?;
        }
        let lights = cpu.lights().triangles().len() as u32;
        for (i, (query, sampled)) in asked.iter_mut().zip(&sampled).enumerate() {
            query.random_or_light = if i % 8 == 7 {
                hash(i as u32) % lights
            } else {
                sampled.light
            };
        }
        let pmfs = cpu.pmf(&asked)?.value;
        let again: (Vec<u32>, Vec<u32>) = asked
            .iter()
            .zip(sampled.iter().zip(&pmfs))
            .filter(|(query, (sampled, _))| query.random_or_light == sampled.light)
            .map(|(_, (sampled, pmf))| (sampled.pmf.to_bits(), pmf.to_bits()))
            .unzip();
        self.cpu
            .take(&what("sample against pmf"), &PMF_RECORD, &again.0, &again.1)?;
        for (device, tally) in devices.iter_mut().zip(&mut self.tallies) {
            let found = device.pmf(&asked)?.value;
            tally.pmfs += found.len() as u64;
            tally.take(&what("pmf"), &PMF_RECORD, cast_slice(&pmfs), cast_slice(&found))?;
        }
        self.progress.inc(asked.len() as u64);
        Ok(())
    }

    /// Small images, of light reflected once and of paths; those of the samplers without a tree once per scene only.
    fn images(
        &mut self,
        scene: &Scene,
        structure: Sampler,
        arrays: &SceneArrays,
        shot: &Shot,
        cpu: &mut CpuBackend,
        devices: &mut [DeviceBackend<'_>],
    ) -> Result<(), HostError> {
        let params = shot.params(scene.frame(shot.frame).background);
        let others = [Sampler::Uniform, Sampler::Power].into_iter().filter(|&s| {
            structure == Sampler::SingleLevel && (s != Sampler::Power || !arrays.thresholds.is_empty())
        });
        for sampler in others.chain([structure]) {
            let expected = cpu.render(arrays, &params, sampler)?.value;
            for (device, tally) in devices.iter_mut().zip(&mut self.tallies) {
                let found = device.render(arrays, &params, sampler)?.value;
                tally.pixels += found.len() as u64;
                let what = format!("{} render {}", scene.name(), sampler.name());
                tally.take(&what, &PIXEL_RECORD, cast_slice(&expected), cast_slice(&found))?;
            }
            let expected = cpu.render_path(arrays, &params, BOUNCES, sampler)?.value;
            for (device, tally) in devices.iter_mut().zip(&mut self.tallies) {
                let found = device.render_path(arrays, &params, BOUNCES, sampler)?.value;
                tally.pixels += found.len() as u64;
                let what = format!("{} path {}", scene.name(), sampler.name());
                tally.take(&what, &PIXEL_RECORD, cast_slice(&expected), cast_slice(&found))?;
            }
        }
        Ok(())
    }
}

fn progress(queries: u64, hidden: bool) -> ProgressBar {
    if hidden {
        return ProgressBar::hidden();
    }
    let style = ProgressStyle::with_template("{bar:40} {pos}/{len} queries, {eta} left");
    ProgressBar::new(queries).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}

fn print(context: &Context, report: &Report, cpu_difference: Option<&str>) -> Result<(), HostError> {
    if context.json {
        table::print_json(report)?;
        return Ok(());
    }
    let header = [
        "device",
        "nodes",
        "samples",
        "pmfs",
        "pixels",
        "words compared",
        "words different",
        "exact",
    ];
    let rows: Vec<Vec<String>> = report
        .devices
        .iter()
        .map(|d| {
            let t = &d.tally;
            let mut row = vec![d.name.clone()];
            row.extend(
                [t.nodes, t.samples, t.pmfs, t.pixels, t.compared, t.different].map(|n| n.to_string()),
            );
            row.push(if d.exact { "yes" } else { "no" }.to_owned());
            row
        })
        .collect();
    if !rows.is_empty() {
        table::print(&header, &rows)?;
    }
    for device in &report.devices {
        if let Some(first) = &device.tally.first_difference {
            println!("{}: first difference: {first}", device.name);
        }
    }
    println!(
        "cpu: {} words come by in two ways, {} different",
        report.cpu_compared, report.cpu_different
    );
    if let Some(first) = cpu_difference {
        println!("cpu: first difference: {first}");
    }
    Ok(())
}

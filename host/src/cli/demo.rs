//! `lightbvh demo`: the main job from end to end on a built-in scene.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use bytemuck::cast_slice;
use lightbvh::BuildParams;
use lightbvh_kernels::render::RenderParams;
use serde::Serialize;
use serde_json::json;

use super::measure::times::{ms, spread_ms};
use super::verify::tally::{Kind, Tally};
use super::{Context, Outcome, devices, table, target};
use crate::backend::{
    Backend, BackendError, Bvh, CpuBackend, DeviceBackend, Follow, Integrator, SAMPLED_RECORD, Sampler,
    SceneArrays, Timed,
};
use crate::cli::table::{news, say};
use crate::error::HostError;
use crate::metrics::mean_squared_error;
use crate::render::Film;
use crate::scene::Scene;
use crate::workload::{arrays_at, build, lights_at, queries, render_params, words_in_use};

const SCENE: &str = "street";
/// Frames shown: those of the paper's Table 1.
const FRAMES: [u32; 4] = [0, 50, 100, 150];
/// Light samples per pixel of the frames, and of the reference that the last one is measured against.
const SAMPLES: u32 = 4;
const REFERENCE_SAMPLES: u32 = 64;
/// Lights sampled per frame, besides those of the image.
const QUERIES: u32 = 100_000;

#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// Folder for the images; made if it is not there.
    #[arg(long, default_value = "out", value_name = "DIR")]
    out: PathBuf,
    /// Columns of the images, 1 to 16384.
    #[arg(long, default_value_t = 384, value_parser = clap::value_parser!(u32).range(1..=16_384))]
    width: u32,
    /// Rows of the images, 1 to 16384.
    #[arg(long, default_value_t = 216, value_parser = clap::value_parser!(u32).range(1..=16_384))]
    height: u32,
}

/// A row of the table.
#[derive(Clone, Debug, Serialize)]
struct Row {
    backend: String,
    scene: &'static str,
    lights: usize,
    triangles: usize,
    nodes: usize,
    depth: u32,
    /// Milliseconds: the build once (on the CPU in either case), the others as the median over the frames.
    build_ms: f64,
    refit_ms: f64,
    sample_ms: f64,
    render_ms: f64,
    compared: u64,
    different: u64,
    /// Mean squared error of the last frame's radiance against the reference.
    mse: f64,
}

/// What one backend did over the frames.
#[derive(Default)]
struct Run {
    refit: Vec<Duration>,
    sample: Vec<Duration>,
    render: Vec<Duration>,
    tally: Tally,
    image: Vec<[f32; 3]>,
}

pub(super) fn run(context: &Context, args: &Args) -> Result<Outcome, HostError> {
    let (width, height) = (args.width, args.height);
    target::folder(&args.out)?;
    let opened = devices::open(context)?;
    let scene = Scene::open(SCENE)?;
    let lights = lights_at(&scene, 0)?;
    let start = Instant::now();
    let bvh: Bvh = build(&lights, Sampler::TwoLevel, &BuildParams::default());
    let build_time = start.elapsed();

    let (nodes, depth) = (bvh.nodes().len() + bvh.top_nodes().len(), bvh.depth());

    let mut cpu: CpuBackend = CpuBackend::new(bvh);
    let mut on_devices = opened
        .iter()
        .map(|o| DeviceBackend::new(&o.device, cpu.bvh()))
        .collect::<Result<Vec<_>, _>>()?;
    let mut records: Vec<Run> = (0..=opened.len()).map(|_| Run::default()).collect();
    let mut written = Vec::new();
    let mut exposure = None;
    for frame in FRAMES {
        news!("frame {frame}");
        let arrays = arrays_at(&scene, frame, width, height)?;
        let params = render_params((width, height), SAMPLES, frame, scene.frame(frame).background);
        frame_on_all(&arrays, &params, &mut cpu, &mut on_devices, &mut records)?;

        let film = Film::new(width, height, records[0].image.clone())?;
        // One exposure for all frames, so that they can be compared.
        let exposure = *exposure.get_or_insert_with(|| film.auto_exposure());
        written.push(write(
            &args.out,
            &format!("{SCENE}-{frame:03}.png"),
            &film,
            exposure,
        )?);
    }

    news!("reference");
    let last = FRAMES[FRAMES.len() - 1];
    let arrays = arrays_at(&scene, last, width, height)?;
    let background = scene.frame(last).background;
    let params = render_params((width, height), REFERENCE_SAMPLES, u32::MAX, background);
    let reference = Film::new(
        width,
        height,
        cpu.render(&arrays, &params, Sampler::TwoLevel, Integrator::Direct)?
            .value,
    )?;
    let name = format!("{SCENE}-{last:03}-reference.png");
    written.push(write(&args.out, &name, &reference, exposure.unwrap_or(1.0))?);

    let names = std::iter::once("cpu".to_owned()).chain(opened.iter().map(|o| o.device.name().to_owned()));
    let rows: Vec<Row> = names
        .zip(&records)
        .map(|(backend, record)| Row {
            backend,
            scene: SCENE,
            lights: lights.triangles().len(),
            triangles: scene.triangle_count(),
            nodes,
            depth,
            build_ms: ms(build_time),
            refit_ms: spread_ms(&record.refit).median,
            sample_ms: spread_ms(&record.sample).median,
            render_ms: spread_ms(&record.render).median,
            compared: record.tally.compared,
            different: record.tally.different,
            mse: mean_squared_error(&record.image, reference.pixels()),
        })
        .collect();
    drop(on_devices);
    devices::close(opened)?;
    print(context, &rows, &records, &written)?;
    Ok(Outcome::good_if(rows.iter().all(|row| row.different == 0)))
}

/// Refits, samples and renders one frame, whose number is the seed, on the CPU, then on each device, and compares.
fn frame_on_all(
    arrays: &SceneArrays,
    params: &RenderParams,
    cpu: &mut CpuBackend,
    devices: &mut [DeviceBackend<'_>],
    records: &mut [Run],
) -> Result<(), HostError> {
    let asked = queries(arrays, params.seed, 0, QUERIES);
    let refitted = Timed::of(|| cpu.bvh_mut().follow(&arrays.lights));
    refitted.value.map_err(BackendError::from)?;
    let mut refits = vec![refitted.time];
    for device in devices.iter_mut() {
        refits.push(device.follow(cpu.bvh())?.time);
    }
    let bvh = cpu.bvh().clone();
    let mut expected = None;
    let backends =
        std::iter::once(cpu as &mut dyn Backend).chain(devices.iter_mut().map(|d| d as &mut dyn Backend));
    for ((backend, record), refit) in backends.zip(records).zip(refits) {
        let nodes = words_in_use(&bvh, &backend.nodes()?);
        let sampled = backend.sample(&asked)?;
        let image = backend.render(arrays, params, Sampler::TwoLevel, Integrator::Direct)?;
        record.refit.push(refit);
        record.sample.push(sampled.time);
        record.render.push(image.time);
        record.image.clone_from(&image.value);
        match &expected {
            None => expected = Some((nodes, sampled.value, image.value)),
            Some((cpu_nodes, cpu_sampled, cpu_image)) => {
                let tally = &mut record.tally;
                let nodes_record = backend.node_record();
                tally.take(Kind::Nodes, "refit", &nodes_record, cpu_nodes, &nodes)?;
                let (expected, found) = (cast_slice(cpu_sampled), cast_slice(&sampled.value));
                tally.take(Kind::Samples, "sample", &SAMPLED_RECORD, expected, found)?;
                tally.take_pixels("render", cpu_image, &image.value)?;
            }
        }
    }
    Ok(())
}

fn write(folder: &Path, name: &str, film: &Film, exposure: f32) -> Result<PathBuf, HostError> {
    let path = folder.join(name);
    film.write(&path, exposure)?;
    Ok(path)
}

fn print(context: &Context, rows: &[Row], records: &[Run], written: &[PathBuf]) -> Result<(), HostError> {
    if context.json {
        table::print_json(&json!({ "rows": rows, "images": written }))?;
        return Ok(());
    }
    table::print(
        rows,
        &[
            ("backend", |r| r.backend.clone()),
            ("scene", |r| r.scene.to_owned()),
            ("lights", |r| r.lights.to_string()),
            ("triangles", |r| r.triangles.to_string()),
            ("nodes", |r| r.nodes.to_string()),
            ("depth", |r| r.depth.to_string()),
            ("build ms", |r| format!("{:.1}", r.build_ms)),
            ("refit ms", |r| format!("{:.2}", r.refit_ms)),
            ("sample ms", |r| format!("{:.1}", r.sample_ms)),
            ("render ms", |r| format!("{:.0}", r.render_ms)),
            ("words compared", |r| r.compared.to_string()),
            ("different", |r| r.different.to_string()),
            ("MSE", |r| format!("{:.3e}", r.mse)),
        ],
    )?;
    for (row, record) in rows.iter().zip(records) {
        if let Some(first) = &record.tally.first_difference {
            say!("{}: first difference: {first}", row.backend)?;
        }
    }
    for path in written {
        say!("{}", path.display())?;
    }
    Ok(())
}

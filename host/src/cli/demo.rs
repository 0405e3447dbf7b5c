//! `lightbvh demo`: the main job from end to end on a built-in scene.

use std::path::PathBuf;
use std::time::Duration;

use bytemuck::cast_slice;
use lightbvh::BuildParams;
use serde::Serialize;
use serde_json::json;

use super::measure::times::{ms, spread_ms};
use super::verify::tally::{Kind, Tally};
use super::{Context, Outcome, devices, table, target};
use crate::backend::{
    Backend, BackendError, Bvh, CpuBackend, DeviceBackend, Follow, Integrator, SAMPLED_RECORD, Sampler, Timed,
};
use crate::cli::table::{news, say};
use crate::error::HostError;
use crate::render::Film;
use crate::scene::Scene;
use crate::workload::{arrays_at, build, lights_at, queries, render_params, words_in_use};

const SCENE: &str = "street";
/// Frames shown: those of the paper's Table 1.
const FRAMES: [u32; 4] = [0, 50, 100, 150];
/// Light samples per pixel.
const SAMPLES: u32 = 4;
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

/// A row of the table: a backend over all frames.
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
    first_difference: Option<String>,
}

pub(super) fn run(context: &Context, args: &Args) -> Result<Outcome, HostError> {
    let size = (args.width, args.height);
    target::folder(&args.out)?;
    let opened = devices::open(context)?;
    let scene = Scene::open(SCENE)?;
    let lights = lights_at(&scene, 0)?;
    let built = Timed::of(|| -> Bvh { build(&lights, Sampler::TwoLevel, &BuildParams::default()) });
    let mut cpu: CpuBackend = CpuBackend::new(built.value);
    let mut on_devices = opened
        .iter()
        .map(|o| DeviceBackend::new(&o.device, cpu.bvh()))
        .collect::<Result<Vec<DeviceBackend<'_>>, _>>()?;
    // Refit, sample and render of each backend, by frame.
    let mut times: Vec<[Vec<Duration>; 3]> = vec![Default::default(); opened.len() + 1];
    let mut tallies = vec![Tally::default(); opened.len() + 1];
    let (mut written, mut exposure) = (Vec::new(), None);
    for frame in FRAMES {
        news!("frame {frame}");
        let arrays = arrays_at(&scene, frame, size.0, size.1)?;
        let params = render_params(size, SAMPLES, frame, scene.frame(frame).background);
        let asked = queries(&arrays, frame, 0, QUERIES);
        let refitted = Timed::of(|| cpu.bvh_mut().follow(&arrays.lights));
        refitted.value.map_err(BackendError::from)?;
        let mut refits = vec![refitted.time];
        for device in &mut on_devices {
            refits.push(device.follow(cpu.bvh())?.time);
        }
        let bvh = cpu.bvh().clone();
        let mut expected = None;
        let others = on_devices.iter_mut().map(|device| device as &mut dyn Backend);
        let backends = std::iter::once(&mut cpu as &mut dyn Backend).chain(others);
        for (at, (backend, refit)) in backends.zip(refits).enumerate() {
            let nodes = words_in_use(&bvh, &backend.nodes()?);
            let sampled = backend.sample(&asked)?;
            let image = backend.render(&arrays, &params, Sampler::TwoLevel, Integrator::Direct)?;
            for (list, time) in times[at].iter_mut().zip([refit, sampled.time, image.time]) {
                list.push(time);
            }
            let found = (nodes, sampled.value, image.value);
            let (nodes, sampled, image) = expected.get_or_insert_with(|| found.clone());
            if at > 0 {
                let tally = &mut tallies[at];
                tally.take(Kind::Nodes, "refit", &backend.node_record(), nodes, &found.0)?;
                let (expected, found_samples) = (cast_slice(sampled), cast_slice(&found.1));
                tally.take(Kind::Samples, "sample", &SAMPLED_RECORD, expected, found_samples)?;
                tally.take_pixels("render", image, &found.2)?;
            }
        }
        let image = expected.map(|(_, _, image)| image).unwrap_or_default();
        let film = Film::new(size.0, size.1, image)?;
        // One exposure for all frames, so that they can be compared.
        let exposure = *exposure.get_or_insert_with(|| film.auto_exposure());
        let path = args.out.join(format!("{SCENE}-{frame:03}.png"));
        film.write(&path, exposure)?;
        written.push(path);
    }
    let names = std::iter::once("cpu").chain(opened.iter().map(|o| o.device.name()));
    let rows = names
        .zip(times.iter().zip(tallies))
        .map(|(backend, (times, tally))| {
            let [refit_ms, sample_ms, render_ms] = times.each_ref().map(|own| spread_ms(own).median);
            Row {
                backend: backend.to_owned(),
                scene: SCENE,
                lights: lights.triangles().len(),
                triangles: scene.triangle_count(),
                nodes: cpu.bvh().nodes().len() + cpu.bvh().top_nodes().len(),
                depth: cpu.bvh().depth(),
                build_ms: ms(built.time),
                refit_ms,
                sample_ms,
                render_ms,
                compared: tally.compared,
                different: tally.different,
                first_difference: tally.first_difference,
            }
        });
    let rows: Vec<Row> = rows.collect();
    drop(on_devices);
    devices::close(opened)?;
    let outcome = Outcome::good_if(rows.iter().all(|row| row.different == 0));
    if context.json {
        table::print_json(&json!({ "rows": rows, "images": written }))?;
        return Ok(outcome);
    }
    table::print(
        &rows,
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
        ],
    )?;
    for row in &rows {
        if let Some(first) = &row.first_difference {
            say!("{}: first difference: {first}", row.backend)?;
        }
    }
    for path in written {
        say!("{}", path.display())?;
    }
    Ok(outcome)
}

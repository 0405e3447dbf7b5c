//! `lightbvh demo`: the main job from end to end on a built-in scene.

use std::path::PathBuf;
use std::time::Duration;

use bytemuck::cast_slice;
use lightbvh::Lights;
use serde::Serialize;
use serde_json::json;

use super::measure::times::{ms, spread_ms};
use super::{Context, Outcome, devices, table, target};
use crate::backend::{PIXEL_RECORD, SAMPLED_RECORD, Timed};
use crate::cli::table::{news, say};
use crate::error::HostError;
use crate::method::{Method, Runner, Step, Target};
use crate::render::Film;
use crate::scene::Scene;
use crate::tally::{Kind, Tally};
use crate::workload::{arrays_at, lights_at, queries, render_params};

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
#[derive(Clone, Debug, Default, Serialize)]
struct Row {
    backend: String,
    lights: usize,
    triangles: usize,
    nodes: usize,
    depth: u32,
    /// Milliseconds: the build once, with the upload, the others as the median over the frames.
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
    let lights: Lights = lights_at(&scene, FRAMES[0])?;
    let recipe = Method::TwoLevelMoments.recipe();
    let on_devices = opened.iter().map(|o| Target::Device(&o.device));
    let targets: Vec<Target<'_>> = std::iter::once(Target::Cpu).chain(on_devices).collect();
    let mut runners: Vec<(Box<dyn Runner>, Row)> = Vec::new();
    for target in &targets {
        let built = Timed::of(|| recipe.runner(&Step::new(&scene, FRAMES[0], &lights), *target));
        let row = Row {
            backend: target.name().to_owned(),
            lights: lights.triangles().len(),
            triangles: scene.triangle_count(),
            build_ms: ms(built.time),
            ..Row::default()
        };
        runners.push((built.value?, row));
    }
    // Refit, sample and render of each backend, by frame.
    let mut times: Vec<[Vec<Duration>; 3]> = vec![Default::default(); targets.len()];
    let mut tallies = vec![Tally::default(); targets.len()];
    let (mut written, mut exposure) = (Vec::new(), None);
    for frame in FRAMES {
        news!("frame {frame}");
        let arrays = arrays_at(&scene, frame, size.0, size.1)?;
        let step = Step::new(&scene, frame, &arrays.lights);
        let params = render_params(size, SAMPLES, frame, scene.frame(frame).background);
        let asked = queries(&arrays, frame, 0, QUERIES);
        let mut expected = None;
        for (at, (runner, row)) in runners.iter_mut().enumerate() {
            let refit = runner.advance(&step)?.refit;
            let tree = runner.tree().expect("a light BVH");
            (row.nodes, row.depth) = (tree.nodes, tree.depth);
            let words = runner.backend().nodes()?;
            let nodes = runner.words_in_use(words);
            let sampled = runner.backend().sample(&asked)?;
            let image = runner.image(&step, &arrays, &params)?;
            for (list, time) in times[at].iter_mut().zip([refit, sampled.time, image.time]) {
                list.push(time);
            }
            let found = (nodes, sampled.value, image.value);
            let (nodes, sampled, image) = expected.get_or_insert_with(|| found.clone());
            if at > 0 {
                let tally = &mut tallies[at];
                let record = runner.backend().node_record();
                tally.take(Kind::Nodes, "refit", &record, nodes, &found.0)?;
                let (expected, found_samples) = (cast_slice(sampled), cast_slice(&found.1));
                tally.take(Kind::Samples, "sample", &SAMPLED_RECORD, expected, found_samples)?;
                let (expected, found) = (cast_slice(image), cast_slice(&found.2));
                tally.take(Kind::Pixels, "render", &PIXEL_RECORD, expected, found)?;
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
    let rows = runners.into_iter().zip(times.iter().zip(tallies));
    let rows: Vec<Row> = rows
        .map(|((_, row), (times, tally))| {
            let [refit_ms, sample_ms, render_ms] = times.each_ref().map(|own| spread_ms(own).median);
            Row {
                refit_ms,
                sample_ms,
                render_ms,
                compared: tally.compared,
                different: tally.different,
                first_difference: tally.first_difference,
                ..row
            }
        })
        .collect();
    drop(targets);
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

//! `lightbvh demo`: the main job from end to end on a built-in scene.

use std::path::PathBuf;
use std::time::Duration;

use bytemuck::cast_slice;
use serde::Serialize;
use serde_json::json;

use super::measure::times::{ms, spread_ms};
use super::{Context, Outcome, devices, table, target};
use crate::backend::{Held, PIXEL_RECORD, SceneArrays, Timed};
use crate::cli::table::{news, say};
use crate::error::HostError;
use crate::method::{Method, Recipe, SampleBudget, Step, Target};
use crate::render::Film;
use crate::scene::Scene;
use crate::tally::{Kind, Tally};
use crate::workload::{arrays_at, render_params};

const SCENE: &str = "street";
/// Frames shown: those of the paper's Table 1.
const FRAMES: [u32; 4] = [0, 50, 100, 150];
/// Light samples per pixel.
const SAMPLES: u32 = 4;

#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// Folder for the images; made if it is not there.
    #[arg(long, default_value = "out", value_name = "DIR")]
    out: PathBuf,
    /// Columns of the images, 1 to 16384.
    #[arg(long, default_value_t = 640, value_parser = clap::value_parser!(u32).range(1..=16_384))]
    width: u32,
    /// Rows of the images, 1 to 16384.
    #[arg(long, default_value_t = 360, value_parser = clap::value_parser!(u32).range(1..=16_384))]
    height: u32,
}

/// A row of the table: a backend over all frames.
#[derive(Clone, Debug, Serialize)]
struct Row {
    backend: String,
    /// Milliseconds: the build once, with the upload, the others as the median over the frames; devices render the first alone.
    build_ms: f64,
    refit_ms: f64,
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
    let arrays = FRAMES
        .iter()
        .map(|&frame| arrays_at(&scene, frame, size.0, size.1));
    let arrays: Vec<SceneArrays> = arrays.collect::<Result<_, _>>()?;
    let on_devices = opened.iter().map(|o| Target::Device(&o.device));
    let recipe = Recipe {
        budget: SampleBudget::CameraRays,
        ..Method::TwoLevelMomentsResampled.recipe()
    };
    // Buffers and image of each frame by the CPU, which comes first.
    let mut expected: Vec<(Vec<Held>, Vec<[f32; 3]>)> = Vec::new();
    let mut rows = Vec::new();
    for target in std::iter::once(Target::Cpu).chain(on_devices) {
        news!("{}", target.name());
        let first = Step::new(&scene, FRAMES[0], &arrays[0].lights);
        let built = Timed::of(|| recipe.runner(&first, target));
        let mut runner = built.value?;
        let (mut tally, mut times): (_, [Vec<Duration>; 2]) = (Tally::default(), Default::default());
        for (k, arrays) in arrays.iter().enumerate() {
            let step = Step::new(&scene, FRAMES[k], &arrays.lights);
            let params = render_params(size, SAMPLES, FRAMES[k], scene.data().background);
            times[0].push(runner.advance(&step)?.refit);
            let held = runner.held()?;
            if let Some((own, _)) = expected.get(k) {
                tally.take_held("refit", own, &held)?;
                // A software device takes long for an image.
                if k > 0 {
                    continue;
                }
            }
            let image = runner.image(&step, arrays, &params)?;
            times[1].push(image.time);
            match expected.get(k) {
                Some((_, pixels)) => {
                    let (pixels, found) = (cast_slice(pixels), cast_slice(&image.value));
                    tally.take(Kind::Pixels, "render", &PIXEL_RECORD, pixels, found)?;
                }
                None => expected.push((held, image.value)),
            }
        }
        let [refit_ms, render_ms] = times.map(|own| spread_ms(&own).median);
        rows.push(Row {
            backend: target.name().to_owned(),
            build_ms: ms(built.time),
            refit_ms,
            render_ms,
            compared: tally.compared,
            different: tally.different,
            first_difference: tally.first_difference,
        });
    }
    let (mut written, mut exposure) = (Vec::new(), None);
    for (frame, (_, image)) in FRAMES.into_iter().zip(expected) {
        let film = Film::new(size.0, size.1, image)?;
        // One exposure for all frames, so that they can be compared.
        let exposure = *exposure.get_or_insert_with(|| film.auto_exposure());
        let path = args.out.join(format!("{SCENE}-{frame:03}.png"));
        film.write(&path, exposure)?;
        written.push(path.display().to_string());
    }
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
            ("build ms", |r| format!("{:.1}", r.build_ms)),
            ("refit ms", |r| format!("{:.2}", r.refit_ms)),
            ("render ms", |r| format!("{:.0}", r.render_ms)),
            // The CPU is what others are compared with.
            ("words compared", |r| match r.compared {
                0 => "-".to_owned(),
                count => count.to_string(),
            }),
            ("different", |r| r.different.to_string()),
        ],
    )?;
    for row in &rows {
        if let Some(first) = &row.first_difference {
            say!("{}: first difference: {first}", row.backend)?;
        }
    }
    for path in written {
        say!("{path}")?;
    }
    Ok(outcome)
}

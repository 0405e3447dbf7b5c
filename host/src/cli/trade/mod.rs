//! `lightbvh trade`: speed against accuracy, measured for what a user can choose: times, bytes, variance, and the error of
//! images at equal samples and at equal time.

mod choices;
mod front;
mod image;
pub(super) mod report;
mod structure;
mod subject;

use std::ffi::{OsStr, OsString};
use std::path::PathBuf;
use std::time::Instant;

use serde_json::json;

use self::choices::all;
use self::front::{Point, front};
use self::image::{Budget, Measured};
use self::report::Report;
use self::structure::structures;
use self::subject::Axis;
use super::measure::points;
use super::reading::{Reading, positive};
use super::{Context, Outcome, table};
use crate::cli::table::{news, say};
use crate::error::HostError;
use crate::method::Step;
use crate::metrics::Judge;
use crate::scene::BUILT_IN;
use crate::workload::{arrays_at, lights_at};

#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// A built-in scene or a .gltf, .glb or .obj file; may be repeated [default: three built-in].
    #[arg(long)]
    scene: Vec<OsString>,
    #[command(flatten)]
    reading: Reading,
    /// Only these axes, and the default; all if none is named.
    #[arg(long, value_enum)]
    axes: Vec<Axis>,
    /// Last frame measured; trees are built at frame 0, images taken at a third and two thirds as well.
    #[arg(long, default_value_t = 50, value_parser = clap::value_parser!(u32).range(..=10_000))]
    frame: u32,
    /// Also write to this folder: trade.html with plots and images, trade.json.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Also name the choice of least error in a frame of this time, ms, at the size of the measured images.
    #[arg(long, value_name = "MS", value_parser = positive::<f64>)]
    time: Option<f64>,
    /// One scene, fewer turns, smaller images: within a minute; everything takes about half an hour.
    #[arg(long)]
    quick: bool,
}

impl Args {
    /// Whether choices of an axis are measured.
    fn measures(&self, axis: Axis) -> bool {
        self.axes.is_empty() || self.axes.contains(&axis)
    }
}

pub(super) fn run(context: &Context, args: &Args) -> Result<Outcome, HostError> {
    let budget = if args.quick { Budget::QUICK } else { Budget::FULL };
    let named = match (&args.scene[..], args.quick) {
        ([], true) => vec![BUILT_IN[0].into()],
        ([], false) => BUILT_IN.map(OsString::from).into(),
        (named, _) => named.to_vec(),
    };
    let mut all_points = Vec::new();
    let mut all_steps = Vec::new();
    let mut report = args
        .out
        .as_ref()
        .map(|folder| Report::begin(folder, named.len()))
        .transpose()?;
    for scene in named {
        let start = Instant::now();
        let (mut points, judge) = scene_points(&scene, args, &budget)?;
        let name = scene.to_string_lossy();
        let sentences = front(&mut points).into_iter();
        all_steps.extend(sentences.map(|sentence| format!("{name}: {sentence}")));
        all_steps.extend(args.time.map(|time| pick(&points, budget.samples, time)));
        if let Some(report) = &mut report {
            report.scene(&name, &points, &judge)?;
        }
        all_points.extend(points);
        news!("{name}: {:.1} s", start.elapsed().as_secs_f64());
    }
    let measured = json!({
        "frame": args.frame, "frames": budget.measured_frames(args.frame), "samples": budget.samples, "width": budget.width, "height": budget.height,
        "turns": budget.turns, "threads": rayon::current_num_threads(), "points": all_points, "steps": all_steps,
    });
    if let (Some(report), Some(folder)) = (&report, &args.out) {
        report.write(folder, &measured)?;
    }
    if context.json {
        table::print_json(&measured)?;
    } else {
        print(&all_points)?;
        for step in all_steps {
            say!("{step}")?;
        }
    }
    Ok(Outcome::Good)
}

/// The choice of least error in a frame of `time` ms: squared errors fall by the inverse of the shadow rays, and as many are
/// traced as fit next to the update.
fn pick(points: &[Point], samples: u32, time: f64) -> String {
    let reached = points.iter().filter_map(|point| {
        let rays = f64::from(samples) * (time - point.structure.update_ms) / point.images.image_ms;
        let error = point.images.error * f64::from(samples) / rays;
        (rays >= 1.0).then_some((error, rays, point))
    });
    match reached.min_by(|a, b| a.0.total_cmp(&b.0)) {
        Some((error, rays, Point { scene, choice, .. })) => format!(
            "{scene}: least error in {time} ms: {choice}, {error:.2} by {rays:.1} shadow rays of a pixel"
        ),
        None => format!(
            "{}: no choice traces a shadow ray of each pixel in {time} ms",
            points[0].scene
        ),
    }
}

/// Builds all configurations at the first frame, brings them to the last, measures images on the way, and trees at its end.
fn scene_points(scene: &OsStr, args: &Args, budget: &Budget) -> Result<(Vec<Point>, Judge), HostError> {
    let name = scene.to_string_lossy();
    let scene = &args.reading.open(scene)?;
    for warning in scene.warnings().iter().chain(&scene.unknown_lights()) {
        news!("{name}: {warning}");
    }
    scene.require_lights()?;
    let first = lights_at(scene, 0)?;
    let mut subjects = all(&Step::new(scene, 0, &first), |axis| args.measures(axis))?;
    let last = args.frame;
    let frames = budget.measured_frames(last);
    news!(
        "{name}: {} choices follow its lights to frame {last}",
        subjects.len()
    );
    let mut measured = Measured::default();
    for frame in 0..=last {
        if frame > 0 {
            let lights = lights_at(scene, frame)?;
            for k in 0..subjects.len() {
                let at = (k + frame as usize) % subjects.len();
                subjects[at].advance(&Step::new(scene, frame, &lights))?;
            }
        }
        if frames.contains(&frame) {
            news!("{name}: frame {frame}, images by {} choices", subjects.len());
            let arrays = arrays_at(scene, frame, budget.width, budget.height)?;
            let updates: Vec<f64> = subjects.iter().map(|own| own.updates().mean_ms()).collect();
            let background = scene.frame(frame).background;
            measured.add(&updates, background, budget, |at, params| {
                subjects[at].render(&arrays, params)
            })?;
        }
    }
    news!("{name}: times and variances of samples");
    let lights = lights_at(scene, last)?;
    let points = points::on_surfaces(scene, last, budget.points);
    let structures = structures(&subjects, &Step::new(scene, last, &lights), &points, budget)?;
    let (images, judge) = measured.finish();
    let all = subjects.iter().zip(structures.into_iter().zip(images));
    let points = all.map(|(subject, (structure, images))| Point {
        scene: name.to_string(),
        choice: subject.config().to_string(),
        config: subject.config(),
        default: subject.config().axis == Axis::Default,
        structure,
        images,
        pareto: false,
    });
    Ok((points.collect(), judge))
}

/// A table for each scene; the JSON has more.
fn print(points: &[Point]) -> Result<(), HostError> {
    for of_scene in points.chunk_by(|a, b| a.scene == b.scene) {
        say!("{}", of_scene[0].scene)?;
        table::print(of_scene, COLUMNS)?;
    }
    say!(
        "errors are ratios to the default's with 95 % intervals, mean squared, by CPU images: `error` by the same rays, `equal \
         time` by as many as\nfit into the default's frame; `ns` and `variance` are of one sample; `update` is what a frame waits \
         for; `front`: nothing else is surely\nbetter in one of them and no worse in others; --json and --out have more"
    )?;
    Ok(())
}

const COLUMNS: &[table::Column<Point>] = &[
    ("choice", |p| p.choice.clone()),
    ("update ms", |p| format!("{:.2}", p.structure.update_ms)),
    ("image ms", |p| format!("{:.1}", p.images.image_ms)),
    ("ns", |p| format!("{:.0}", p.structure.ns_per_sample)),
    ("variance", |p| table::known(p.structure.variances.variance, 3)),
    ("error", |p| p.images.error_ratio.to_string()),
    ("equal time", |p| p.images.equal_time_ratio.to_string()),
    ("front", |p| table::yes(p.pareto)),
];

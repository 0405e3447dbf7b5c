//! `lightbvh trade`: speed against accuracy, measured for what a user can choose: times, bytes, variance, and the error of
//! images at equal samples and at equal time.

mod arithmetic;
mod choices;
mod finals;
mod front;
mod image;
mod light;
mod pick;
mod prepare;
pub(super) mod quantile;
mod reach;
pub(super) mod report;
mod reservoirs;
mod steps;
mod structure;
mod turns;
mod update;
mod widths;

use std::path::PathBuf;
use std::time::Instant;

use serde::Serialize;
use serde_json::json;

use self::choices::{Axis, Config};
use self::front::front;
use self::image::{Budget, Images, Measured};
use self::pick::{Goal, picks};
use self::prepare::{Prepared, prepare};
use self::quantile::Interval;
use self::report::Report;
use self::steps::steps;
use self::structure::{Structure, structures};
use self::update::{Frame, Updates};
use self::widths::OnDevice;
use super::range::{self, given};
use super::{Context, Outcome, devices, table};
use crate::cli::table::{news, say};
use crate::error::HostError;
use crate::metrics::Judge;
use crate::workload::lights_at;

/// All frames up to the measured one are gone through.
const MAX_FRAME: u64 = 10_000;

#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// Scenes: street, square, carousel, or .gltf, .glb, .pbrt, .obj and .ply files; the first three if none is named.
    #[arg(long)]
    scene: Vec<String>,
    /// Only these axes, beside the default; all if none is named.
    #[arg(long, value_enum)]
    axes: Vec<Axis>,
    /// Last frame of the animation that is measured; trees are built at its first one, and follow it. Images are measured at a
    /// third and two thirds of the way too.
    #[arg(long, default_value_t = 50)]
    frame: u32,
    /// Size of the images, in place of 192x108, or 96x54 of --quick.
    #[arg(long, value_name = "WxH", value_parser = size)]
    size: Option<(u32, u32)>,
    /// Also write a page with plots, images and error maps, the JSON, and tables and plots for documents, to this folder:
    /// trade.html, trade.json, trade.md, trade-SCENE.svg.
    #[arg(long, value_name = "DIR", conflicts_with_all = ["time", "error"])]
    out: Option<PathBuf>,
    /// Picks what has the least error in a frame of so many milliseconds, update and image, in place of the table.
    #[arg(long, value_name = "MS", value_parser = positive, conflicts_with = "error", allow_negative_numbers = true)]
    time: Option<f64>,
    /// Picks what takes the least time for a frame of this error, in place of the table: root mean square as displayed, as a
    /// share of white, such as 0.05.
    #[arg(long, value_name = "E", value_parser = positive, allow_negative_numbers = true)]
    error: Option<f64>,
    /// One scene, fewer turns, smaller images: within a minute on two cores, where everything takes about a quarter of an hour.
    #[arg(long)]
    quick: bool,
}

/// A configuration in a scene.
#[derive(Clone, Debug, Serialize)]
struct Point {
    scene: String,
    /// What differs from the default, in words.
    choice: String,
    config: Config,
    default: bool,
    #[serde(flatten)]
    structure: Structure,
    #[serde(flatten)]
    images: Images,
    /// Where devices were asked: the default, and its other widths.
    on_devices: Vec<OnDevice>,
    /// Whether it is on the front: nothing else takes less time for an update, an image of the same rays or a sample on a
    /// device, or has less error in it, at no greater cost of the others, and it is not the same as the default as far as can
    /// be told.
    pareto: bool,
}

pub(super) fn run(context: &Context, args: &Args) -> Result<Outcome, HostError> {
    range::check(&[given("--frame", args.frame, 0..=MAX_FRAME)])?;
    let mut budget = if args.quick { Budget::QUICK } else { Budget::FULL };
    if let Some((width, height)) = args.size {
        (budget.width, budget.height) = (width, height);
    }
    let named: Vec<String> = match (&args.scene[..], args.quick) {
        ([], true) => vec!["street".to_owned()],
        ([], false) => ["street", "square", "carousel"].map(String::from).into(),
        (named, _) => named.to_vec(),
    };
    if let Some(goal) = args.time.map(Goal::Time).or(args.error.map(Goal::Error)) {
        return picks(context, args, &named, &budget, goal);
    }
    // Devices take long: only where the axis is named, or nothing is hurried.
    let on_devices = |axis| args.axes.contains(&axis) || (args.axes.is_empty() && !args.quick);
    let opened = if on_devices(Axis::Arithmetic) || on_devices(Axis::Width) {
        devices::open(context)?
    } else {
        Vec::new()
    };
    let mut by_arithmetic = Vec::new();
    let mut all_points = Vec::new();
    let mut all_steps = Vec::new();
    let mut report = args
        .out
        .as_ref()
        .map(|folder| Report::begin(folder, named.len()))
        .transpose()?;
    for name in named {
        let start = Instant::now();
        let (mut points, judge) = scene_points(&name, args, &budget)?;
        if on_devices(Axis::Width) {
            widths::measure(&mut points, &name, args.frame, &opened, budget.turns)?;
        }
        let pareto = front(&points);
        let pareto = points.into_iter().zip(pareto);
        let points: Vec<Point> = pareto.map(|(point, pareto)| Point { pareto, ..point }).collect();
        let sentences = steps(&points).into_iter();
        all_steps.extend(sentences.map(|sentence| format!("{name}: {sentence}")));
        if let Some(report) = &mut report {
            report.scene(&name, args.frame, &points, &judge)?;
        }
        all_points.extend(points);
        if on_devices(Axis::Arithmetic) {
            by_arithmetic.extend(arithmetic::measure(&name, args.frame, &opened, budget.turns)?);
        }
        news!("{name}: {:.1} s", start.elapsed().as_secs_f64());
    }
    let measured = json!({
        "frame": args.frame, "frames": budget.measured_frames(args.frame), "samples": budget.samples, "width": budget.width, "height": budget.height,
        "turns": budget.turns, "threads": rayon::current_num_threads(), "points": all_points, "steps": all_steps,
        "arithmetic": by_arithmetic,
    });
    if let (Some(report), Some(folder)) = (&report, &args.out) {
        report.write(folder, &measured, args.frame, &all_points, &all_steps)?;
    }
    if context.json {
        table::print_json(&measured)?;
    } else {
        print(&all_points)?;
        for step in all_steps {
            say!("{step}")?;
        }
        widths::print(&all_points)?;
        arithmetic::print(&by_arithmetic)?;
    }
    devices::close(opened)?;
    Ok(Outcome::Good)
}

fn scene_points(name: &str, args: &Args, budget: &Budget) -> Result<(Vec<Point>, Judge), HostError> {
    let mut measured = Measured::default();
    let Prepared {
        scene,
        points,
        mut subjects,
        updates,
        arrays,
        ..
    } = prepare(
        name,
        args,
        budget,
        &budget.measured_frames(args.frame),
        &mut |subjects, updates, arrays, background| {
            let updates_ms: Vec<f64> = updates.iter().map(Updates::mean_ms).collect();
            measured.add(subjects, &updates_ms, arrays, background, budget)
        },
    )?;
    news!("{name}: times and variances of samples");
    let last = lights_at(&scene, args.frame)?;
    let structures = structures(
        &mut subjects,
        &Frame::new(&scene, args.frame, &last),
        &arrays.rays.surfaces(),
        updates,
        &points,
        budget,
    )?;
    let (images, judge) = measured.finish();
    let both = structures.into_iter().zip(images);
    let points = subjects
        .iter()
        .zip(both)
        .map(|(subject, (structure, images))| Point {
            scene: name.to_owned(),
            choice: subject.config().to_string(),
            config: subject.config(),
            default: subject.config().axis == Axis::Default,
            structure,
            images,
            on_devices: Vec::new(),
            pareto: false,
        })
        .collect();
    Ok((points, judge))
}

/// A finite number above zero.
pub(super) fn positive(text: &str) -> Result<f64, String> {
    let number = text.parse().ok();
    number
        .filter(|&number: &f64| number.is_finite() && number > 0.0)
        .ok_or_else(|| format!("{text} is no finite number above 0"))
}

/// `WxH`, pixels.
pub(super) fn size(text: &str) -> Result<(u32, u32), String> {
    let range = 1..=4096;
    let parsed = text
        .split_once('x')
        .and_then(|(width, height)| Some((width.parse().ok()?, height.parse().ok()?)));
    parsed
        .filter(|(width, height)| range.contains(width) && range.contains(height))
        .ok_or_else(|| format!("{text} is no size such as 192x108, of 1 to 4096 pixels each way"))
}

fn ratio(interval: &Interval) -> String {
    format!(
        "{:.2} [{:.2}, {:.2}]",
        interval.median, interval.low, interval.high
    )
}

/// A table for each scene; the JSON has more.
fn print(points: &[Point]) -> Result<(), HostError> {
    for of_scene in points.chunk_by(|a, b| a.scene == b.scene) {
        say!("{}", of_scene[0].scene)?;
        table::print(of_scene, COLUMNS)?;
    }
    say!(
        "ratios to the default's, with 95 % intervals; `update` is what a frame waits for, `beside` what is built beside it; variance of one \
         sample, mean over the points, without and with shadows; `error` by the same rays, `equal time` by as many as fit into the \
         default's frame, mean squared, on the CPU; `front`: nothing else is surely better in one of them and no worse in others"
    )?;
    Ok(())
}

const COLUMNS: &[table::Column<Point>] = &[
    ("choice", |p| p.choice.clone()),
    ("bytes/light", |p| format!("{:.1}", p.structure.bytes_per_light)),
    ("build ms", |p| format!("{:.2}", p.structure.build_ms)),
    ("update ms", |p| format!("{:.2}", p.structure.update_ms)),
    ("beside ms", |p| format!("{:.2}", p.structure.beside_ms)),
    ("image ms", |p| format!("{:.1}", p.images.image_ms)),
    ("sample ns", |p| format!("{:.0}", p.structure.ns_per_sample)),
    ("sample", |p| ratio(&p.structure.sample_ratio)),
    ("variance", |p| format!("{:.3}", p.structure.variances.variance)),
    ("shadowed", |p| {
        format!("{:.2}", p.structure.variances.shadowed_variance)
    }),
    ("frame", |p| ratio(&p.images.frame_ratio)),
    ("error", |p| ratio(&p.images.error_ratio)),
    ("equal time", |p| ratio(&p.images.equal_time_ratio)),
    ("front", |p| table::yes(p.pareto)),
];

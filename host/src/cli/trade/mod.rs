//! `lightbvh trade`: speed against accuracy, measured for what a user can choose: times, bytes, variance, and the error of images at
//! equal samples and at equal time.

mod arithmetic;
mod choices;
mod front;
mod image;
mod light;
pub(super) mod quantile;
mod structure;
mod update;

use std::time::Instant;

use serde::Serialize;
use serde_json::json;

use self::choices::{Axis, Config, Subject, all};
use self::front::{Front, fronts};
use self::image::{Budget, Images, images};
use self::quantile::Interval;
use self::structure::{Structure, structures};
use self::update::{Frame, Updates};
use super::variance::points;
use super::{Context, Outcome, devices, table};
use crate::error::HostError;
use crate::scene::Scene;
use crate::workload::{arrays_at, lights_at};

#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// Scenes: street, square, carousel, or .gltf and .glb files; the first three if none is named.
    #[arg(long)]
    scene: Vec<String>,
    /// Only these axes, beside the default; all if none is named.
    #[arg(long, value_enum)]
    axes: Vec<Axis>,
    /// Frame of the animation; trees are built at its first one, and follow it to this one.
    #[arg(long, default_value_t = 50)]
    frame: u32,
    /// Size of the images, in place of 192x108, or 96x54 of --quick.
    #[arg(long, value_name = "WxH", value_parser = size)]
    size: Option<(u32, u32)>,
    /// One scene, fewer turns, smaller images: within a minute.
    #[arg(long)]
    quick: bool,
}

/// A configuration in a scene.
#[derive(Clone, Debug, Serialize)]
struct Point {
    scene: String,
    config: Config,
    default: bool,
    #[serde(flatten)]
    structure: Structure,
    #[serde(flatten)]
    images: Images,
    /// Whether nothing else surely takes less time for a frame of the same rays, or surely has less error in it, at no surely greater
    /// cost of the other.
    pareto: bool,
}

pub(super) fn run(context: &Context, args: &Args) -> Result<Outcome, HostError> {
    let mut budget = if args.quick { Budget::QUICK } else { Budget::FULL };
    if let Some((width, height)) = args.size {
        (budget.width, budget.height) = (width, height);
    }
    let named: Vec<String> = match (&args.scene[..], args.quick) {
        ([], true) => vec!["street".to_owned()],
        ([], false) => ["street", "square", "carousel"].map(String::from).into(),
        (named, _) => named.to_vec(),
    };
    let opened = if args.axes.is_empty() || args.axes.contains(&Axis::Arithmetic) {
        devices::open(context)?
    } else {
        Vec::new()
    };
    let mut by_arithmetic = Vec::new();
    let mut all_points = Vec::new();
    let mut steps = Vec::new();
    for name in named {
        let start = Instant::now();
        let points = scene_points(&name, args, &budget)?;
        let Front { pareto, sentences } = fronts(&points);
        steps.extend(
            sentences
                .into_iter()
                .map(|sentence| format!("{name}: {sentence}")),
        );
        all_points.extend(
            points
                .into_iter()
                .zip(pareto)
                .map(|(point, pareto)| Point { pareto, ..point }),
        );
        if args.axes.is_empty() || args.axes.contains(&Axis::Arithmetic) {
            by_arithmetic.extend(arithmetic::measure(&name, args.frame, &opened, budget.turns)?);
        }
        eprintln!("{name}: {:.1} s", start.elapsed().as_secs_f64());
    }
    if context.json {
        table::print_json(&json!({
            "frame": args.frame, "samples": budget.samples, "width": budget.width, "height": budget.height,
            "turns": budget.turns, "threads": rayon::current_num_threads(), "points": all_points, "steps": steps,
            "arithmetic": by_arithmetic,
        }))?;
    } else {
        print(&all_points)?;
        for step in steps {
            println!("{step}");
        }
        arithmetic::print(&by_arithmetic)?;
    }
    devices::close(opened)?;
    Ok(Outcome::Good)
}

fn scene_points(name: &str, args: &Args, budget: &Budget) -> Result<Vec<Point>, HostError> {
    let scene = Scene::open(name)?;
    for warning in scene.warnings() {
        eprintln!("{name}: {warning}");
    }
    let (_, points) = points::of(name, 0, args.frame, budget.points)?;
    let arrays = arrays_at(&scene, args.frame, budget.width, budget.height)?;
    let first = lights_at(&scene, 0)?;
    let mut subjects: Vec<Box<dyn Subject>> = all(&Frame::new(&scene, 0, &first))?
        .into_iter()
        .filter(|subject| {
            let axis = subject.config().axis;
            axis == Axis::Default || args.axes.is_empty() || args.axes.contains(&axis)
        })
        .collect();
    let mut updates = vec![Updates::default(); subjects.len()];
    for number in 1..=args.frame {
        let lights = lights_at(&scene, number)?;
        for k in 0..subjects.len() {
            let at = (k + number as usize) % subjects.len();
            updates[at].push(subjects[at].advance(&Frame::new(&scene, number, &lights))?);
        }
    }
    let last = lights_at(&scene, args.frame)?;
    let structures = structures(
        &mut subjects,
        &Frame::new(&scene, args.frame, &last),
        &arrays.rays.surfaces(),
        updates,
        &points,
        budget,
    )?;
    let updates_ms: Vec<f64> = structures.iter().map(|structure| structure.update_ms).collect();
    let background = scene.frame(args.frame).background;
    let images = images(&mut subjects, &updates_ms, &arrays, background, budget)?;
    let both = structures.into_iter().zip(images);
    Ok(subjects
        .iter()
        .zip(both)
        .map(|(subject, (structure, images))| Point {
            scene: name.to_owned(),
            config: subject.config(),
            default: subject.config().axis == Axis::Default,
            structure,
            images,
            pareto: false,
        })
        .collect())
}

/// `WxH`, pixels.
fn size(text: &str) -> Result<(u32, u32), String> {
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

fn print(points: &[Point]) -> Result<(), HostError> {
    Ok(table::print(
        points,
        &[
            ("scene", |p| p.scene.clone()),
            ("choice", |p| p.config.to_string()),
            ("bytes/light", |p| format!("{:.1}", p.structure.bytes_per_light)),
            ("build ms", |p| format!("{:.2}", p.structure.build_ms)),
            ("refit ms", |p| format!("{:.2}", p.structure.refit_ms)),
            ("update ms", |p| format!("{:.2}", p.structure.update_ms)),
            ("image ms", |p| format!("{:.1}", p.images.image_ms)),
            ("sample ns", |p| format!("{:.0}", p.structure.ns_per_sample)),
            ("to default", |p| ratio(&p.structure.sample_ratio)),
            ("variance", |p| format!("{:.3}", p.structure.variances.variance)),
            ("median", |p| {
                format!("{:.3}", p.structure.variances.variance_median)
            }),
            ("shadowed", |p| {
                format!("{:.2}", p.structure.variances.shadowed_variance)
            }),
            ("median", |p| {
                format!("{:.2}", p.structure.variances.shadowed_variance_median)
            }),
            ("frame time", |p| ratio(&p.images.frame_ratio)),
            ("error", |p| format!("{:.0}", p.images.error)),
            ("to default", |p| ratio(&p.images.error_ratio)),
            ("at equal time", |p| format!("{:.0}", p.images.error_equal_time)),
            ("to default", |p| ratio(&p.images.equal_time_ratio)),
            ("front", |p| table::yes(p.pareto)),
        ],
    )?)
}

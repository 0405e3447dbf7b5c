//! `lightbvh inspect`: what a scene requires, the smallest model that is sufficient, and whether it is.

mod compare;
mod keys;
mod kinds;
mod light_kinds;
mod motion;
mod options;
mod ratio;
mod report;
mod said;
mod steps;
mod subject;
mod surfaces;

use lightbvh::BuildParams;
use lightbvh::importance::DefaultImportance;
use lightbvh::light::AnyLight;
use lightbvh::requirements::{Declared, Model, Requirements, Updates};
use lightbvh_gpu::KernelSet;
use lightbvh_kernels::bvh::{Node, Standard, WIDTH};
use serde_json::{Value, json};

use self::light_kinds::LightKinds;
use self::motion::Motion;
use self::options::Change;
use self::report::Report;
use self::steps::check;
use self::subject::Source;
use self::surfaces::Surfaces;
use super::reading::BackendName;
use super::{Context, Outcome, table};
use crate::cli::measure::points;
use crate::cli::table::news;
use crate::error::HostError;
use crate::scene::{Instances, Scene};
use crate::workload::{lights_at, lights_of};

pub(super) use self::options::Args;

/// Probabilities that are compared at once: a scene of more lights is looked at from fewer points.
const MOST_PROBABILITIES: usize = 1 << 25;

pub(super) fn run(context: &Context, args: &Args) -> Result<Outcome, HostError> {
    let scene = args.reading.open(&args.scene)?;
    for warning in scene.warnings() {
        news!("{}: {warning}", scene.name());
    }
    scene.require_any_light()?;
    if scene.emissive_count() == 0 {
        return kinds::run(context, args, &scene);
    }
    if let Some(left_out) = scene.unknown_in_figures() {
        news!("{}: {left_out}", scene.name());
    }
    let motion = Motion::of::<Standard>(&scene)?;
    let surfaces = Surfaces::of(&scene);
    let (bvh, _) =
        Instances::new::<Node, DefaultImportance, WIDTH>(&scene, args.frame, BuildParams::default())
            .map_err(|error| HostError::in_frame(scene.name(), args.frame, error))?;
    let requirements = Requirements::of(&bvh, declared(args, &motion));
    let chosen = requirements.model();
    let model = args.overrides(chosen);
    sufficient(&model, &chosen)?;
    // What is refitted is looked at after a refit.
    let moved = args.frame + u32::from(requirements.declared.transforms);
    let lights = lights_at(&scene, moved)?;
    let most = MOST_PROBABILITIES / lights.triangles().len().max(1);
    let count = args.points.min((most as u32).max(1));
    let points = points::on_surfaces(&scene, moved, count);
    let source = Source {
        scene: &scene,
        frame: args.frame,
        moved,
        lights: &lights,
    };
    let checked = check(&model, args, &requirements, &source, &points)?;
    let kernels = KernelSet::of(&checked.model);
    if args.backend == BackendName::Vulkan {
        kernels?;
    }
    let report = Report {
        args,
        scene: scene.name(),
        points: count,
        moved,
        motion,
        animations: animations(&scene),
        surfaces,
        kinds: all_kinds(&scene, args.frame)?,
        requirements,
        chosen,
        asked_for: model != chosen,
        kernels: kernels.err().map(|missing| missing.command()),
        checked,
    };
    if context.json {
        table::print_json(&report.json())?;
    } else {
        report.print()?;
    }
    Ok(Outcome::good_if(report.holds()))
}

/// Whether a model has what the smallest that is sufficient has.
fn sufficient(model: &Model, least: &Model) -> Result<(), HostError> {
    let (option, needs) = if model.updates < least.updates && least.updates == Updates::Meshes {
        (
            "--updates",
            "meshes that stay as they are; keep updates of meshes",
        )
    } else if model.updates < least.updates {
        (
            "--updates nothing",
            "instances that stay as they are; keep updates of instances",
        )
    } else if model.single_level && !least.single_level {
        (
            "--levels one",
            "instances that stay as they are, each with a mesh of its own; take two levels",
        )
    } else {
        return Ok(());
    };
    Err(HostError::Usage { option, needs })
}

/// The kinds of light of a scene, where there are others than triangles.
fn all_kinds(scene: &Scene, frame: u32) -> Result<Option<LightKinds>, HostError> {
    if scene.analytic_count() == 0 {
        return Ok(None);
    }
    let lights = lights_of::<AnyLight>(scene, frame)?;
    Ok(Some(LightKinds::of(lights.triangles())))
}

/// All animations of the file, by their numbers.
fn animations(scene: &Scene) -> Value {
    let data = scene.data();
    let shown = data
        .animations
        .iter()
        .map(|own| (own.place, &own.name, true, true));
    let clips = data.clips.iter().map(|own| (own.place, &own.name, false, true));
    let idle = data.idle.iter().map(|(place, name)| (*place, name, false, false));
    let mut all: Vec<_> = shown.chain(clips).chain(idle).collect();
    all.sort_by_key(|&(place, ..)| place);
    all.into_iter()
        .map(|(place, name, is_shown, moves)| json!({ "number": place, "name": name, "shown": is_shown, "moves": moves }))
        .collect()
}

fn declared(args: &Args, motion: &Motion) -> Declared {
    let has = |change| !args.still && args.changes.contains(&change);
    Declared {
        transforms: has(Change::Transforms) || !args.still && motion.moving > 0,
        radiance: has(Change::Radiance),
        triangles: has(Change::Triangles) || !args.still && motion.bending > 0,
        instances: has(Change::Instances),
        meshes: has(Change::Meshes),
        pmf: !args.no_mis,
    }
}

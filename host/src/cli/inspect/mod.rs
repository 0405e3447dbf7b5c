//! `lightbvh inspect`: what a scene requires, the smallest model that is sufficient, and whether it is.

mod compare;
mod keys;
mod kinds;
mod motion;
mod options;
mod ratio;
mod report;
mod steps;
mod subject;
mod surfaces;

use lightbvh::BuildParams;
use lightbvh::light::AnyLight;
use lightbvh::requirements::{Changes, Declared, LightKinds, Requirements};
use lightbvh_gpu::KernelSet;
use lightbvh_kernels::bvh::{Node, WIDTH};
use serde_json::{Value, json};

use self::motion::Motion;
use self::options::{BackendName, Change};
use self::report::Report;
use self::steps::check;
use self::subject::{Source, is_known};
use self::surfaces::Surfaces;
use super::variance::points;
use super::{Context, Outcome, table};
use crate::cli::table::news;
use crate::error::HostError;
use crate::scene::{Instances, Scene};
use crate::workload::{lights_at, lights_of};

pub(super) use self::options::Args;

/// Probabilities that are compared at once: a scene of more lights is looked at from fewer points.
const MOST_PROBABILITIES: usize = 1 << 25;

pub(super) fn run(context: &Context, args: &Args) -> Result<Outcome, HostError> {
    let scene = Scene::open(&args.scene)?;
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
    let motion = Motion::of::<Node>(&scene)?;
    let surfaces = Surfaces::of(&scene);
    let (bvh, _) = Instances::new::<Node, (), WIDTH>(&scene, args.frame, BuildParams::default())
        .map_err(|error| HostError::in_frame(scene.name(), args.frame, error))?;
    let requirements = Requirements::of(&bvh, declared(args, &motion, &surfaces));
    let chosen = requirements.model();
    let model = args.overrides(chosen);
    model.check(&requirements)?;
    if !is_known(&model) {
        return Err(HostError::Usage {
            option: "--width 4 or 16",
            needs: "--layout moments or two-sided",
        });
    }
    // What is refitted is looked at after a refit.
    let moved = args.frame + u32::from(requirements.declared.changes.transforms);
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

fn declared(args: &Args, motion: &Motion, surfaces: &Surfaces) -> Declared {
    let has = |change| args.changes.contains(&change);
    let changes = Changes {
        transforms: has(Change::Transforms) || motion.moving > 0,
        radiance: has(Change::Radiance),
        triangles: has(Change::Triangles) || motion.bending > 0,
        instances: has(Change::Instances),
        meshes: has(Change::Meshes),
    };
    Declared {
        changes: if args.still { Changes::NONE } else { changes },
        glossy: surfaces.glossy > 0,
        pmf: !args.no_mis,
    }
}

//! `lightbvh validate`: every invariant of the light BVHs of a scene, as built and as refitted.

use lightbvh_kernels::bvh::{Choice, Kinds, Paper, Standard, WIDTH};
use serde::Serialize;
use serde_json::json;

use super::{Context, Outcome, table};
use crate::backend::{BackendError, Bvh, Sampler};
use crate::cli::table::news;
use crate::error::HostError;
use crate::method::{Builder, Importance};
use crate::scene::{Scene, SceneLight};
use crate::workload::{build, lights_of};

/// Frames that the trees are refitted to and checked at.
const FRAMES: [u32; 4] = [0, 50, 100, 150];

#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// A built-in scene (street, square, carousel, stage) or a .gltf, .glb, .pbrt, .obj or .ply file.
    scene: String,
    /// What lights are chosen by: moments, or the paper's Eq. 4.
    #[arg(long, value_enum, default_value_t = Importance::Moments)]
    importance: Importance,
    /// How the light BVHs are built [default: ward; with --importance eq4, saoh as in the paper].
    #[arg(long, value_enum)]
    heuristic: Option<Builder>,
}

/// A structure over the lights as they stand in the world: two levels have a tree for each instance, which `inspect` and
/// `trade` share.
#[derive(Serialize)]
struct Row {
    structure: Sampler,
    frame: u32,
    valid: bool,
    said: String,
    lights: usize,
    mesh_lights: usize,
    nodes: usize,
    depth: u32,
    bytes_per_light: f64,
}

pub(super) fn run(context: &Context, args: &Args) -> Result<Outcome, HostError> {
    let scene = Scene::open(&args.scene)?;
    for warning in scene.warnings() {
        news!("{}: {warning}", scene.name());
    }
    scene.require_any_light()?;
    let rows = match args.importance {
        Importance::Moments if scene.needs_any_light() => rows::<Kinds, WIDTH>(&scene, args)?,
        Importance::Moments => rows::<Standard, WIDTH>(&scene, args)?,
        Importance::Eq4 if scene.analytic_count() > 0 => {
            return Err(HostError::Usage {
                option: "--importance eq4",
                needs: "a scene of emissive triangles alone; this one has lights of other kinds, which trees by moments hold",
            });
        }
        Importance::Eq4 => rows::<Paper, 4>(&scene, args)?,
    };
    let all_valid = rows.iter().all(|row| row.valid);
    if context.json {
        table::print_json(
            &json!({ "scene": scene.name(), "importance": args.importance, "valid": all_valid, "rows": rows }),
        )?;
    } else {
        table::print(
            &rows,
            &[
                ("structure", |r| r.structure.name().to_owned()),
                ("frame", |r| r.frame.to_string()),
                ("lights", |r| r.lights.to_string()),
                ("mesh_lights", |r| r.mesh_lights.to_string()),
                ("nodes", |r| r.nodes.to_string()),
                ("depth", |r| r.depth.to_string()),
                ("bytes_per_light", |r| format!("{:.1}", r.bytes_per_light)),
                ("said", |r| r.said.clone()),
            ],
        )?;
    }
    Ok(Outcome::good_if(all_valid))
}

/// Every structure at every frame. The lights of a frame are made once, for both structures, and where nothing moves for all
/// frames: of large scenes that takes as long as a refit.
fn rows<C: Choice<W, Light: SceneLight>, const W: usize>(
    scene: &Scene,
    args: &Args,
) -> Result<Vec<Row>, HostError> {
    let params = args.heuristic.unwrap_or(args.importance.builder()).params();
    let mut lights = lights_of(scene, FRAMES[0])?;
    let structures = [Sampler::SingleLevel, Sampler::TwoLevel];
    let mut bvhs: [Bvh<C, W>; 2] = structures.map(|structure| build(&lights, structure, &params));
    let is_still = scene.data().animations.is_empty();
    let mut rows = Vec::new();
    for frame in FRAMES {
        if frame != FRAMES[0] && !is_still {
            lights = lights_of(scene, frame)?;
        }
        for (structure, bvh) in structures.into_iter().zip(&mut bvhs) {
            bvh.follow(&lights).map_err(BackendError::Lights)?;
            let (valid, said) = match bvh.validate() {
                Ok(_) => (true, "valid".to_owned()),
                Err(violation) => (false, violation.to_string()),
            };
            rows.push(Row {
                structure,
                frame,
                valid,
                said,
                lights: lights.triangles().len(),
                mesh_lights: lights.mesh_count(),
                nodes: bvh.nodes().len(),
                depth: bvh.depth(),
                bytes_per_light: bvh.bytes() as f64 / lights.triangles().len().max(1) as f64,
            });
        }
    }
    // By structure, as they are read.
    let (one, two): (Vec<Row>, Vec<Row>) = rows
        .into_iter()
        .partition(|row| row.structure == Sampler::SingleLevel);
    Ok(one.into_iter().chain(two).collect())
}

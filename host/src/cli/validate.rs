//! `lightbvh validate`: every invariant of the light BVHs of a scene, as built and as refitted.

use lightbvh_kernels::bvh::{Choice, Paper, Standard, WIDTH};
use serde_json::{Value, json};

use super::render::{HeuristicName, ImportanceName};
use super::{Context, Outcome, table};
use crate::backend::{Bvh, Sampler};
use crate::error::HostError;
use crate::scene::Scene;
use crate::workload::{build, lights_at};

/// Frames that the trees are refitted to and checked at.
const FRAMES: [u32; 4] = [0, 50, 100, 150];

#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// A built-in scene (street, square, carousel) or a .gltf or .glb file.
    scene: String,
    /// What lights are chosen by: moments, or the paper's Eq. 4.
    #[arg(long, value_enum, default_value_t = ImportanceName::Moments)]
    importance: ImportanceName,
    /// How the light BVHs are built [default: ward; with --importance eq4, saoh as in the paper].
    #[arg(long, value_enum)]
    heuristic: Option<HeuristicName>,
}

pub(super) fn run(context: &Context, args: &Args) -> Result<Outcome, HostError> {
    let scene = Scene::open(&args.scene)?;
    let rows = match args.importance {
        ImportanceName::Moments => rows::<Standard, WIDTH>(&scene, args)?,
        ImportanceName::Eq4 => rows::<Paper, 4>(&scene, args)?,
    };
    let all_valid = rows.iter().all(|row| row["valid"] == true);
    let outcome = if all_valid { Outcome::Good } else { Outcome::Bad };
    if context.json {
        table::print_json(
            &json!({ "scene": scene.name(), "importance": args.importance, "valid": all_valid, "rows": rows }),
        )?;
    } else {
        let header = [
            "structure",
            "frame",
            "lights",
            "mesh_lights",
            "nodes",
            "depth",
            "bytes_per_light",
            "said",
        ];
        let cells: Vec<Vec<String>> = rows
            .iter()
            .map(|row| {
                let cell = |key: &&str| match &row[*key] {
                    serde_json::Value::String(text) => text.clone(),
                    serde_json::Value::Number(n) if n.is_f64() => format!("{:.1}", n.as_f64().unwrap_or(0.0)),
                    other => other.to_string(),
                };
                header.iter().map(cell).collect()
            })
            .collect();
        table::print(&header, &cells)?;
    }
    Ok(outcome)
}

/// Every structure at every frame.
fn rows<C: Choice<W>, const W: usize>(scene: &Scene, args: &Args) -> Result<Vec<Value>, HostError> {
    let params = HeuristicName::params(args.heuristic, args.importance);
    let mut rows = Vec::new();
    for sampler in [Sampler::SingleLevel, Sampler::TwoLevel] {
        let mut bvh: Bvh<C, W> = build(&lights_at(scene, 0)?, sampler, &params);
        for frame in FRAMES {
            let lights = lights_at(scene, frame)?;
            bvh.follow(&lights)
                .map_err(crate::backend::BackendError::Lights)?;
            let (valid, said) = match bvh.validate() {
                Ok(_) => (true, "valid".to_owned()),
                Err(violation) => (false, violation.to_string()),
            };
            rows.push(json!({
                "structure": sampler, "frame": frame, "valid": valid, "said": said,
                "lights": lights.triangles().len(), "mesh_lights": lights.mesh_count(),
                "nodes": bvh.nodes().len(), "depth": bvh.depth(),
                "bytes_per_light": bvh.bytes() as f64 / lights.triangles().len() as f64,
            }));
        }
    }
    Ok(rows)
}

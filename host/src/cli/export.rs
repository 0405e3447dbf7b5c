//! `lightbvh export`: a scene as a `.glb` file.

use std::path::PathBuf;

use super::{Context, Outcome, target};
use crate::cli::table::news;
use crate::error::HostError;
use crate::scene::{AnalyticKind, Scene, SceneError};

#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// A built-in scene (street, square, carousel, stage) or a .gltf, .glb, .pbrt, .obj or .ply file.
    scene: String,
    /// The .glb file to write.
    #[arg(short, long, value_name = "FILE.glb")]
    output: PathBuf,
}

pub(super) fn run(_: &Context, args: &Args) -> Result<Outcome, HostError> {
    if !target::ends_in(&args.output, &["glb"]) {
        return Err(HostError::Refused {
            option: "--output",
            value: args.output.display().to_string(),
            problem: String::from("is not what is written: expected a file that ends in .glb, binary glTF"),
        });
    }
    target::check(&args.output).map_err(|source| SceneError::Write {
        path: args.output.clone(),
        source,
    })?;
    let scene = Scene::open(&args.scene)?;
    for warning in scene.warnings() {
        news!("{}: {warning}", scene.name());
    }
    if let Some(idle) = scene.idle_clips() {
        news!("{}: {idle}", scene.name());
    }
    let known = |kind| {
        matches!(
            kind,
            AnalyticKind::Directional
                | AnalyticKind::Point
                | AnalyticKind::Spot { .. }
                | AnalyticKind::Profile { .. }
        )
    };
    let lost = scene
        .data()
        .analytic
        .iter()
        .filter(|light| !known(light.kind))
        .count();
    if lost > 0 {
        news!(
            "{}: glTF has no word for spheres, rectangles, discs and boxes that shine: {lost} left out",
            scene.name()
        );
    }
    if scene.data().environment.is_some() {
        news!(
            "{}: glTF has no word for environment maps: the sky is left out",
            scene.name()
        );
    }
    scene.write_glb(&args.output)?;
    Ok(Outcome::Good)
}

//! `lightbvh export`: a scene as a `.glb` file.

use std::path::PathBuf;

use super::{Context, Outcome};
use crate::error::HostError;
use crate::scene::Scene;

#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// A built-in scene (street, square, carousel) or a .gltf or .glb file.
    scene: String,
    /// The .glb file to write.
    #[arg(short, long, value_name = "FILE.glb")]
    output: PathBuf,
}

pub(super) fn run(_: &Context, args: &Args) -> Result<Outcome, HostError> {
    Scene::open(&args.scene)?.write_glb(&args.output)?;
    Ok(Outcome::Good)
}

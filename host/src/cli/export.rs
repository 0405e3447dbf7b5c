//! `lightbvh export`: a scene as a `.glb` file.

use std::ffi::OsString;
use std::io::{Error, ErrorKind};
use std::path::PathBuf;

use super::reading::Reading;
use super::{Outcome, target};
use crate::cli::table::news;
use crate::error::HostError;
use crate::render::write_whole;
use crate::scene::{AnalyticKind, SceneError};

#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// A built-in scene (street, square, carousel, stage) or a .gltf, .glb or .obj file.
    scene: OsString,
    #[command(flatten)]
    reading: Reading,
    /// The .glb file to write.
    #[arg(short, long, value_name = "FILE.glb")]
    output: PathBuf,
}

pub(super) fn run(args: &Args) -> Result<Outcome, HostError> {
    let unwritten = |source| SceneError::Write(args.output.clone(), source);
    if !target::ends_in(&args.output, &["glb"]) {
        let problem = "expected a file that ends in .glb, binary glTF";
        return Err(unwritten(Error::new(ErrorKind::InvalidInput, problem)).into());
    }
    target::check(&args.output).map_err(unwritten)?;
    let scene = args.reading.open(&args.scene)?;
    for warning in scene.warnings() {
        news!("{}: {warning}", scene.name());
    }
    let is_lost = |kind| !matches!(kind, AnalyticKind::Point | AnalyticKind::Spot { .. });
    let lights = scene.data().analytic.iter();
    let lost = lights.filter(|light| is_lost(light.kind)).count();
    if lost > 0 {
        news!(
            "{}: glTF has no word for spheres, rectangles and discs that shine: {lost} left out",
            scene.name()
        );
    }
    write_whole(&args.output, &scene.to_glb()?).map_err(unwritten)?;
    Ok(Outcome::Good)
}

//! Options of `lightbvh render`.

use std::ffi::OsString;
use std::ops::Range;
use std::path::PathBuf;

use lightbvh_kernels::shading::path::MAX_BOUNCES;

use crate::backend::Integrator;
use crate::cli::frames;
use crate::cli::reading::Reading;
use crate::cli::reading::{BackendName, positive};
use crate::error::HostError;
use crate::method::{Method, Recipe, SampleBudget};

/// Most reflections of a path.
const DEFAULT_BOUNCES: u32 = 8;

#[derive(Debug, clap::Args)]
pub struct Args {
    /// A built-in scene (street, square, carousel, stage) or a .gltf, .glb, .obj or .ply file.
    pub(super) scene: OsString,
    #[command(flatten)]
    pub(super) reading: Reading,
    /// Frame of the animation, 25 per second.
    #[arg(long, default_value_t = 0)]
    pub(super) frame: u32,
    /// Render frames A to B (B left out) into files numbered by frame: FILE-0000.png and so on.
    #[arg(long, value_name = "A..B", value_parser = frames::parse, conflicts_with = "frame")]
    pub(super) animate: Option<Range<u32>>,
    /// Columns, 1 to 16384.
    #[arg(long, default_value_t = 640, value_parser = clap::value_parser!(u32).range(1..=16_384))]
    pub(super) width: u32,
    /// Rows, 1 to 16384.
    #[arg(long, default_value_t = 360, value_parser = clap::value_parser!(u32).range(1..=16_384))]
    pub(super) height: u32,
    /// Light samples per pixel, 1 to 65536.
    #[arg(long, default_value_t = 16, value_parser = clap::value_parser!(u32).range(1..=65_536))]
    pub(super) spp: u32,
    /// Number of the scene's camera, from 0; in a scene without one it is chosen by what is lit.
    #[arg(long, default_value_t = 0)]
    pub(super) camera: usize,
    /// Look from this place, metres, in place of any camera of the scene.
    #[arg(long, value_name = "X,Y,Z", value_parser = place, allow_hyphen_values = true, requires = "look_at", conflicts_with = "camera")]
    pub(super) look_from: Option<[f32; 3]>,
    /// Look at this place, which is in the middle of the image then; +Y is up.
    #[arg(long, value_name = "X,Y,Z", value_parser = place, allow_hyphen_values = true, requires = "look_from")]
    pub(super) look_at: Option<[f32; 3]>,
    /// Vertical field of view with --look-from, degrees, 1 to 170.
    #[arg(long, default_value_t = 50, value_parser = clap::value_parser!(u32).range(1..=170), requires = "look_from")]
    pub(super) fov: u32,
    /// Show the mean of each texture, and no cut-outs.
    #[arg(long)]
    pub(super) no_textures: bool,
    /// How lights are chosen.
    #[arg(long, value_enum, default_value_t = Method::TwoLevelMoments)]
    pub(super) sampler: Method,
    /// Light reflected once, or along whole paths.
    #[arg(long, value_enum, default_value_t = IntegratorName::Direct)]
    pub(super) integrator: IntegratorName,
    /// Most reflections of a path, 1 to 64, with --integrator path; 1 is direct lighting [default: 8].
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=i64::from(MAX_BOUNCES)))]
    pub(super) bounces: Option<u32>,
    /// What renders.
    #[arg(long, value_enum, default_value_t = BackendName::Cpu)]
    pub(super) backend: BackendName,
    /// Seed of the random numbers.
    #[arg(long, default_value_t = 0)]
    pub(super) seed: u32,
    /// Factor on radiance [default: chosen by the image, up to 1000]; EXR files are linear.
    #[arg(long, value_parser = positive::<f32>)]
    pub(super) exposure: Option<f32>,
    /// The file to write: .png (tone-mapped) or .exr (linear).
    #[arg(short, long, value_name = "FILE.png|FILE.exr")]
    pub(super) output: PathBuf,
}

/// Three coordinates.
fn place(text: &str) -> Result<[f32; 3], String> {
    let numbers: Vec<f32> = text
        .split(',')
        .filter_map(|part| part.trim().parse().ok())
        .collect();
    let count = text.split(',').count();
    match numbers[..] {
        [x, y, z] if count == 3 && [x, y, z].iter().all(|x| x.is_finite()) => Ok([x, y, z]),
        _ => Err(format!("{text} is no place; write three numbers, as 1,2.5,-3")),
    }
}

/// The light that is followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum IntegratorName {
    /// Light reflected once.
    Direct,
    /// Light along whole paths.
    Path,
}

/// The method by its name, changed as the options say.
pub(super) fn recipe(args: &Args) -> Result<Recipe, HostError> {
    let mut recipe = Recipe {
        budget: SampleBudget::CameraRays,
        ..args.sampler.recipe()
    };
    let usage = |option, needs| Err(HostError::Usage { option, needs });
    if args.integrator == IntegratorName::Path {
        if recipe.candidates > 1 {
            return usage("--integrator path", "a --sampler without candidates");
        }
        recipe.integrator = Integrator::Path {
            bounces: args.bounces.unwrap_or(DEFAULT_BOUNCES),
        };
    } else if args.bounces.is_some() {
        return usage("--bounces", "--integrator path");
    }
    Ok(recipe)
}

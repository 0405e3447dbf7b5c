//! `lightbvh render`: one frame of a scene, on the CPU or a device.

use std::ffi::OsString;
use std::path::PathBuf;

use lightbvh::EmissiveTriangle;
use lightbvh::light::AnyLight;
use serde_json::json;

use super::reading::{BackendName, Reading, positive};
use super::{Context, Outcome, devices, table, target};
use crate::backend::Integrator;
use crate::cli::table::{news, say};
use crate::error::HostError;
use crate::method::{Method, MethodLight, Recipe, SampleBudget, Step, Target};
use crate::render::Film;
use crate::scene::Scene;
use crate::vulkan::VulkanError;
use crate::workload::{arrays_lit_by, render_params};

/// Most reflections of a path.
const BOUNCES: u32 = 8;

#[derive(Debug, clap::Args)]
pub struct Args {
    /// A built-in scene (street, square, carousel, stage) or a .gltf, .glb or .obj file.
    scene: OsString,
    #[command(flatten)]
    reading: Reading,
    /// Frame of the animation, 25 per second.
    #[arg(long, default_value_t = 0)]
    frame: u32,
    /// Columns, 1 to 16384.
    #[arg(long, default_value_t = 640, value_parser = clap::value_parser!(u32).range(1..=16_384))]
    width: u32,
    /// Rows, 1 to 16384.
    #[arg(long, default_value_t = 360, value_parser = clap::value_parser!(u32).range(1..=16_384))]
    height: u32,
    /// Light samples per pixel, 1 to 65536.
    #[arg(long, default_value_t = 16, value_parser = clap::value_parser!(u32).range(1..=65_536))]
    spp: u32,
    /// Look from this place, metres, in place of the scene's camera.
    #[arg(long, value_name = "X,Y,Z", value_parser = place, allow_hyphen_values = true, requires = "look_at")]
    look_from: Option<[f32; 3]>,
    /// Look at this place, which is in the middle of the image then; +Y is up.
    #[arg(long, value_name = "X,Y,Z", value_parser = place, allow_hyphen_values = true, requires = "look_from")]
    look_at: Option<[f32; 3]>,
    /// Vertical field of view with --look-from, degrees, 1 to 170.
    #[arg(long, default_value_t = 50, value_parser = clap::value_parser!(u32).range(1..=170), requires = "look_from")]
    fov: u32,
    /// Show the mean of each texture, and no cut-outs.
    #[arg(long)]
    no_textures: bool,
    /// How lights are chosen.
    #[arg(long, value_enum, default_value_t = Method::TwoLevelMoments)]
    sampler: Method,
    /// Light reflected once, or along paths of up to 8 reflections.
    #[arg(long, value_enum, default_value_t = IntegratorName::Direct)]
    integrator: IntegratorName,
    /// What renders.
    #[arg(long, value_enum, default_value_t = BackendName::Cpu)]
    backend: BackendName,
    /// Seed of the random numbers.
    #[arg(long, default_value_t = 0)]
    seed: u32,
    /// Factor on radiance [default: chosen by the image, up to 1000]; EXR files are linear.
    #[arg(long, value_parser = positive::<f32>)]
    exposure: Option<f32>,
    /// The file to write: .png (tone-mapped) or .exr (linear).
    #[arg(short, long, value_name = "FILE.png|FILE.exr")]
    output: PathBuf,
}

/// The light that is followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum IntegratorName {
    /// Light reflected once.
    Direct,
    /// Light along whole paths.
    Path,
}

/// Three coordinates.
fn place(text: &str) -> Result<[f32; 3], String> {
    let numbers: Option<Vec<f32>> = text.split(',').map(|part| part.trim().parse().ok()).collect();
    match numbers.as_deref() {
        Some(&[x, y, z]) if [x, y, z].iter().all(|x| x.is_finite()) => Ok([x, y, z]),
        _ => Err(format!("{text} is no place; write three numbers, as 1,2.5,-3")),
    }
}

pub(super) fn run(context: &Context, args: &Args) -> Result<Outcome, HostError> {
    let usage = |option, needs| Err(HostError::Usage { option, needs });
    let mut recipe = Recipe {
        budget: SampleBudget::CameraRays,
        ..args.sampler.recipe()
    };
    if args.integrator == IntegratorName::Path {
        if recipe.candidates > 1 {
            return usage("--integrator path", "a --sampler without candidates");
        }
        recipe.integrator = Integrator::Path { bounces: BOUNCES };
    }
    if context.device.is_some() && args.backend == BackendName::Cpu {
        return usage("--device", "--backend vulkan");
    }
    target::picture(&args.output)?;
    let scene = scene(args, &recipe)?;
    let render = match scene.has_kinds() {
        true => render::<AnyLight>,
        false => render::<EmissiveTriangle>,
    };
    let (on, render_ms, exposure) = match args.backend {
        BackendName::Cpu => render(args, &recipe, &scene, Target::Cpu)?,
        BackendName::Vulkan => {
            let opened = devices::open(context)?;
            let Some(first) = opened.first() else {
                return Err(VulkanError::NoDevice {
                    notes: "--backend vulkan needs one".to_owned(),
                }
                .into());
            };
            let report = render(args, &recipe, &scene, Target::Device(&first.device))?;
            devices::close(opened)?;
            report
        }
    };
    let output = args.output.display().to_string();
    if context.json {
        table::print_json(&json!({
            "scene": scene.name(), "backend": on, "frame": args.frame, "output": output,
            "render_ms": render_ms, "exposure": exposure,
        }))?;
        return Ok(Outcome::Good);
    }
    // All digits of the exposure: given back as an option, it makes the same picture.
    say!("{output}: {render_ms:.1} ms on {on}, exposure {exposure}")?;
    Ok(Outcome::Good)
}

/// The scene as the options show it.
fn scene(args: &Args, recipe: &Recipe) -> Result<Scene, HostError> {
    let mut scene = args.reading.open(&args.scene)?;
    if let (Some(from), Some(at)) = (args.look_from, args.look_at) {
        if from == at {
            return Err(HostError::Usage {
                option: "--look-at",
                needs: "another place than --look-from",
            });
        }
        scene = scene.seen_from(from, at, (args.fov as f32).to_radians())?;
    }
    for warning in scene.warnings() {
        news!("{}: {warning}", scene.name());
    }
    let is_known = AnyLight::IMPORTANCES.contains(&recipe.importance);
    let has_textures = scene.data().has_textures();
    if has_textures && !is_known && !scene.has_other_lights() {
        news!(
            "{}: textures are shown by their means: the paper's importance knows triangles alone",
            scene.name()
        );
    }
    Ok(match has_textures && (args.no_textures || !is_known) {
        true => scene.without_textures(),
        false => scene,
    })
}

/// Renders and writes the image; returns what rendered, the milliseconds and the exposure.
fn render<L: MethodLight>(
    args: &Args,
    recipe: &Recipe,
    scene: &Scene,
    target: Target<'_>,
) -> Result<(String, f64, f32), HostError> {
    let arrays = arrays_lit_by::<L>(scene, args.frame, args.width, args.height)?;
    let step = Step::new(scene, args.frame, &arrays.lights);
    let size = (args.width, args.height);
    let params = render_params(size, args.spp, args.seed, scene.data().background);
    let image = recipe.runner(&step, target)?.image(&step, &arrays, &params)?;
    let film = Film::new(args.width, args.height, image.value)?;
    if let (None, Some(words)) = (args.exposure, film.darkness()) {
        news!("{}: {words}", scene.name());
    }
    let exposure = args.exposure.unwrap_or_else(|| film.auto_exposure());
    film.write(&args.output, exposure)?;
    Ok((target.name().to_owned(), image.time.as_secs_f64() * 1e3, exposure))
}

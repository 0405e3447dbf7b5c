//! `lightbvh render`: one frame of a scene, on the CPU or a device.

use std::path::PathBuf;

use lightbvh::exact::hash;
use lightbvh::{BuildParams, Heuristic};
use lightbvh_kernels::shading::path::MAX_BOUNCES;
use serde_json::json;

use super::{Context, Outcome, devices, table};
use crate::backend::{Backend, CpuBackend, DeviceBackend, Sampler};
use crate::error::HostError;
use crate::render::Film;
use crate::scene::Scene;
use crate::vulkan::VulkanError;
use crate::workload::{Shot, arrays_at, build};

/// Greatest number of camera rays per pixel; the light samples of a pixel are shared out among them.
const MAX_CAMERA_RAYS: u32 = 8;
/// Greatest number of paths that begin with the same camera ray, and are followed by one invocation: llvmpipe leaves all
/// loops of an invocation after some 65,000 iterations, silently, which four paths of eight reflections reach.
const MAX_PATHS_PER_RAY: u32 = 1;

#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// A built-in scene (street, square, carousel) or a .gltf or .glb file.
    scene: String,
    /// Frame of the animation, 25 per second.
    #[arg(long, default_value_t = 0)]
    frame: u32,
    /// Columns, 1 to 16384.
    #[arg(long, default_value_t = 640)]
    width: u32,
    /// Rows, 1 to 16384.
    #[arg(long, default_value_t = 360)]
    height: u32,
    /// Light samples, or paths, per pixel, 1 to 65536.
    #[arg(long, default_value_t = 16)]
    spp: u32,
    /// How lights are chosen.
    #[arg(long, value_enum, default_value_t = Sampler::TwoLevel)]
    sampler: Sampler,
    /// Light reflected once, or along whole paths.
    #[arg(long, value_enum, default_value_t = Integrator::Direct)]
    integrator: Integrator,
    /// Most reflections of a path, 1 to 64 (only with --integrator path; 1 is direct lighting).
    #[arg(long, default_value_t = 8)]
    bounces: u32,
    /// Cost of splits when the light BVH is built.
    #[arg(long, value_enum, default_value_t = HeuristicName::Saoh)]
    heuristic: HeuristicName,
    /// What renders.
    #[arg(long, value_enum, default_value_t = BackendName::Cpu)]
    backend: BackendName,
    /// Seed of the random numbers.
    #[arg(long, default_value_t = 0)]
    seed: u32,
    /// Exposure as a factor on radiance; by default chosen from the image. EXR files are linear and take none.
    #[arg(long)]
    exposure: Option<f32>,
    /// The file to write: .png (tone-mapped) or .exr (linear).
    #[arg(short, long, value_name = "FILE.png|FILE.exr")]
    output: PathBuf,
}

#[derive(Clone, Copy, Debug, clap::ValueEnum)]
pub(super) enum HeuristicName {
    Sah,
    Saoh,
}

impl HeuristicName {
    pub fn params(self) -> BuildParams {
        let heuristic = match self {
            Self::Sah => Heuristic::Sah,
            Self::Saoh => Heuristic::Saoh,
        };
        BuildParams {
            heuristic,
            ..BuildParams::default()
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
enum Integrator {
    Direct,
    Path,
}

#[derive(Clone, Copy, Debug, clap::ValueEnum)]
enum BackendName {
    Cpu,
    Vulkan,
}

/// Number of camera rays per pixel, each for as many samples as the others: of light samples, as few as make edges
/// smooth; of paths, as many as do not make a pass too small.
fn camera_rays(integrator: Integrator, samples: u32) -> u32 {
    let divisor = |most: u32| (1..=most).rev().find(|&n| samples.is_multiple_of(n)).unwrap_or(1);
    match integrator {
        Integrator::Direct => divisor(MAX_CAMERA_RAYS),
        Integrator::Path => samples / divisor(MAX_PATHS_PER_RAY),
    }
}

pub(super) fn run(context: &Context, args: &Args) -> Result<Outcome, HostError> {
    for (option, value, most, expected) in [
        ("--width", args.width, 16_384, "1 to 16384"),
        ("--height", args.height, 16_384, "1 to 16384"),
        ("--spp", args.spp, 65_536, "1 to 65536"),
        ("--bounces", args.bounces, MAX_BOUNCES, "1 to 64"),
    ] {
        if value == 0 || value > most {
            return Err(HostError::Range {
                option,
                value: value.into(),
                expected,
            });
        }
    }
    let scene = Scene::open(&args.scene)?;
    for warning in scene.warnings() {
        eprintln!("{}: {warning}", scene.name());
    }
    let arrays = arrays_at(&scene, args.frame, args.width, args.height)?;
    if args.sampler == Sampler::Power && arrays.thresholds.is_empty() {
        return Err(HostError::Sampler {
            scene: scene.name().to_owned(),
            sampler: args.sampler.name(),
            lights: arrays.lights.triangles().len(),
        });
    }
    let bvh = build(&arrays.lights, args.sampler, &args.heuristic.params());
    let background = scene.frame(args.frame).background;
    let Args {
        frame,
        width,
        height,
        spp: samples,
        seed,
        ..
    } = *args;
    let shot = Shot {
        frame,
        width,
        height,
        samples,
        seed,
    };

    let film = |backend: &mut dyn Backend| -> Result<(Film, f64), VulkanError> {
        let rays = camera_rays(args.integrator, samples);
        let mut sum = vec![[0.0f32; 3]; width as usize * height as usize];
        let mut seconds = 0.0;
        for ray in 0..rays {
            let mut params = shot.params(background);
            params.samples = samples / rays;
            params.jitter = ray;
            let part = match args.integrator {
                Integrator::Direct => {
                    params.seed = seed.wrapping_mul(MAX_CAMERA_RAYS).wrapping_add(ray);
                    backend.render(&arrays, &params, args.sampler)?
                }
                Integrator::Path => {
                    params.seed = hash(seed).wrapping_add(ray);
                    backend.render_path(&arrays, &params, args.bounces, args.sampler)?
                }
            };
            seconds += part.time.as_secs_f64();
            for (sum, part) in sum.iter_mut().zip(&part.value) {
                for k in 0..3 {
                    sum[k] += part[k] / rays as f32;
                }
            }
        }
        Ok((
            Film::new(width, height, sum).expect("as many pixels as the image has"),
            seconds,
        ))
    };
    let (film, seconds, name) = match args.backend {
        BackendName::Cpu => {
            let mut cpu = CpuBackend::new(bvh, arrays.lights.clone());
            let (film, seconds) = film(&mut cpu)?;
            (film, seconds, "cpu".to_owned())
        }
        BackendName::Vulkan => {
            let opened = devices::open(context)?;
            let Some(first) = opened.first() else {
                return Err(VulkanError::NoDevice {
                    notes: "--backend vulkan needs one".to_owned(),
                }
                .into());
            };
            let mut device = DeviceBackend::new(&first.device, &bvh, &arrays.lights)?;
            let (film, seconds) = film(&mut device)?;
            drop(device);
            let name = first.device.name().to_owned();
            devices::close(opened)?;
            (film, seconds, name)
        }
    };
    // Direct lighting is reflected once.
    let bounces = if args.integrator == Integrator::Path {
        args.bounces
    } else {
        1
    };
    let exposure = args.exposure.unwrap_or_else(|| film.auto_exposure());
    film.write(&args.output, exposure)?;
    if context.json {
        table::print_json(&json!({
            "scene": scene.name(), "frame": frame, "width": width, "height": height, "spp": samples,
            "sampler": args.sampler, "integrator": args.integrator, "bounces": bounces, "backend": name, "render_ms": seconds * 1e3, "exposure": exposure,
            "output": args.output,
        }))?;
    } else {
        println!(
            "{}: {:.1} ms on {name}, exposure {exposure:.3}",
            args.output.display(),
            seconds * 1e3
        );
    }
    Ok(Outcome::Good)
}

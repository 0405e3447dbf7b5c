//! `lightbvh render`: one frame of a scene or a sequence, on the CPU or a device.

mod images;
mod options;

use std::ops::Range;
use std::path::PathBuf;
use std::sync::Arc;

use lightbvh::{BuildParams, Heuristic};
use lightbvh_kernels::bvh::{Choice, Paper, Standard, WIDTH};
use lightbvh_kernels::shading::path::MAX_BOUNCES;
use serde_json::{Value, json};

use super::range::{self, Given, MAX_SIDE, given};
use super::{Context, Outcome, devices, frames, table};
use crate::backend::{Combination, SceneArrays};
use crate::error::HostError;
use crate::method::{Step, Target};
use crate::scene::Scene;
use crate::vulkan::{Device, VulkanError};
use crate::workload::{Shot, arrays_at};
use images::{Images, Integrator, Method};
use options::{IntegratorName, SamplerName, numbered};

/// Frames that ReSTIR runs through before the first one shown, where there are as many before it.
const WARM_UP: u32 = 8;
/// Most final samples of ReSTIR per pixel: each keeps a history of its own, about 80 bytes per pixel.
const MAX_HISTORIES: u32 = 64;

#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// A built-in scene (street, square, carousel) or a .gltf or .glb file.
    scene: String,
    /// Frame of the animation, 25 per second.
    #[arg(long, default_value_t = 0)]
    frame: u32,
    /// Render frames A to B (B left out) into files numbered by frame: FILE-0000.png and so on. A light BVH is built for
    /// the first frame and follows the lights from there on: a single level is refitted, of two levels the upper one is
    /// also rebuilt beside each frame and swapped in at the next.
    #[arg(long, value_name = "A..B", value_parser = frames::parse, conflicts_with = "frame")]
    animate: Option<Range<u32>>,
    /// Columns, 1 to 16384.
    #[arg(long, default_value_t = 640)]
    width: u32,
    /// Rows, 1 to 16384.
    #[arg(long, default_value_t = 360)]
    height: u32,
    /// Light samples per pixel, 1 to 65536; of ReSTIR, final samples with a history each, 1 to 64 [default: 16; of
    /// ReSTIR, 1].
    #[arg(long)]
    spp: Option<u32>,
    /// How lights are chosen. ReSTIR runs through up to 8 earlier frames before the first one shown.
    #[arg(long, value_enum, default_value_t = SamplerName::TwoLevel)]
    sampler: SamplerName,
    /// How ReSTIR combines samples of other pixels and frames: without bias, or biased (darker where pixels do not see the
    /// same lights) with fewer shadow rays [default: unbiased].
    #[arg(long, value_enum)]
    restir_mode: Option<Combination>,
    /// Light reflected once, or along whole paths.
    #[arg(long, value_enum, default_value_t = IntegratorName::Direct)]
    integrator: IntegratorName,
    /// Most reflections of a path, 1 to 64, with --integrator path; 1 is direct lighting.
    #[arg(long, default_value_t = 8)]
    bounces: u32,
    /// What lights of a BVH are chosen by: moments, or the paper's Eq. 4.
    #[arg(long, value_enum, default_value_t = ImportanceName::Moments)]
    importance: ImportanceName,
    /// How the light BVH is built [default: ward; with --importance eq4, saoh as in the paper].
    #[arg(long, value_enum)]
    heuristic: Option<HeuristicName>,
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

/// A [`Choice`] on the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum ImportanceName {
    /// The default: moments of the lights, 8 children to a node.
    Moments,
    /// The paper's Eq. 4 on bounds, 4 children to a node.
    Eq4,
}

impl ImportanceName {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Moments, Self::Eq4];

    /// [`Choice::NAME`].
    pub fn name(self) -> &'static str {
        match self {
            Self::Moments => Standard::NAME,
            Self::Eq4 => Paper::NAME,
        }
    }
}

#[derive(Clone, Copy, Debug, clap::ValueEnum)]
pub(super) enum HeuristicName {
    /// The surface area heuristic.
    Sah,
    /// The surface area orientation heuristic.
    Saoh,
    /// Ward's criterion.
    Ward,
    /// Clusters by Morton code, Ward's criterion above them: the fastest.
    Morton,
}

impl HeuristicName {
    /// The parameters of builds by `heuristic`, or by the usual one of `importance`.
    pub fn params(heuristic: Option<Self>, importance: ImportanceName) -> BuildParams {
        let usual = match importance {
            ImportanceName::Moments => Self::Ward,
            ImportanceName::Eq4 => Self::Saoh,
        };
        match heuristic.unwrap_or(usual) {
            Self::Sah => BuildParams::paper(Heuristic::Sah),
            Self::Saoh => BuildParams::paper(Heuristic::Saoh),
            Self::Ward => BuildParams::BALANCED,
            Self::Morton => BuildParams::FAST,
        }
    }
}

#[derive(Clone, Copy, Debug, clap::ValueEnum)]
enum BackendName {
    Cpu,
    Vulkan,
}

pub(super) fn run(context: &Context, args: &Args) -> Result<Outcome, HostError> {
    let integrator = match args.integrator {
        IntegratorName::Direct => Integrator::Direct,
        IntegratorName::Path => Integrator::Path {
            bounces: args.bounces,
        },
    };
    let method = args.sampler.method(args.restir_mode, integrator)?;
    let (most, of, default) = match method {
        Method::Independent { .. } => (65_536, "", 16),
        Method::Restir(_) => (MAX_HISTORIES, " with ReSTIR", 1),
    };
    let samples = args.spp.unwrap_or(default);
    range::check(&[
        given("--width", args.width, 1..=MAX_SIDE),
        given("--height", args.height, 1..=MAX_SIDE),
        Given {
            of,
            ..given("--spp", samples, 1..=most.into())
        },
        given("--bounces", args.bounces, 1..=MAX_BOUNCES.into()),
    ])?;
    let scene = Scene::open(&args.scene)?;
    for warning in scene.warnings() {
        eprintln!("{}: {warning}", scene.name());
    }
    let sequence = Sequence {
        args,
        method,
        samples,
        scene: &scene,
    };
    let (shown, name) = match args.backend {
        BackendName::Cpu => (sequence.render(context, None)?, "cpu".to_owned()),
        BackendName::Vulkan => {
            let opened = devices::open(context)?;
            let Some(first) = opened.first() else {
                return Err(VulkanError::NoDevice {
                    notes: "--backend vulkan needs one".to_owned(),
                }
                .into());
            };
            let shown = sequence.render(context, Some(&first.device))?;
            let name = first.device.name().to_owned();
            devices::close(opened)?;
            (shown, name)
        }
    };
    if context.json {
        let mut report = json!({
            "scene": scene.name(), "width": args.width, "height": args.height, "spp": samples,
            "sampler": args.sampler, "backend": name,
        });
        if args.sampler.needs_bvh() {
            report["importance"] = json!(args.importance);
        }
        // Direct lighting is reflected once.
        report["bounces"] = match integrator {
            Integrator::Direct => 1,
            Integrator::Path { bounces } => bounces,
        }
        .into();
        report["integrator"] = json!(args.integrator);
        if let Some(restir) = method.report() {
            report["restir"] = restir;
        }
        if args.animate.is_some() {
            report["frames"] = shown.into();
        } else {
            for (key, value) in shown.first().and_then(Value::as_object).into_iter().flatten() {
                report[key] = value.clone();
            }
        }
        table::print_json(&report)?;
    }
    Ok(Outcome::Good)
}

/// What is to be rendered.
struct Sequence<'a> {
    args: &'a Args,
    method: Method,
    samples: u32,
    scene: &'a Scene,
}

impl Sequence<'_> {
    /// Renders and writes all frames; returns what the report says of each.
    fn render(&self, context: &Context, device: Option<&Device>) -> Result<Vec<Value>, HostError> {
        let args = self.args;
        let shown = args
            .animate
            .clone()
            .unwrap_or(args.frame..args.frame.saturating_add(1));
        let warm_up = match self.method {
            Method::Independent { .. } => 0,
            Method::Restir(_) => WARM_UP,
        };
        let start = shown.start.saturating_sub(warm_up);
        let first = self.arrays(start)?;
        let step = self.step(start, &first);
        let target = device.map_or(Target::Cpu, Target::Device);
        let params = HeuristicName::params(args.heuristic, args.importance);
        let mut images = match args.importance {
            ImportanceName::Moments => Images::new::<Standard, WIDTH>(self.method, params, target, &step)?,
            ImportanceName::Eq4 => Images::new::<Paper, 4>(self.method, params, target, &step)?,
        };
        let mut exposure = args.exposure;
        let mut reports = Vec::new();
        let mut arrays = Some(first);
        for frame in start..shown.end {
            let arrays = match arrays.take() {
                Some(first) => first,
                None => self.arrays(frame)?,
            };
            let shot = Shot {
                frame,
                width: args.width,
                height: args.height,
                samples: self.samples,
                seed: args.seed,
            };
            let image = images.next(&self.step(frame, &arrays), &arrays, &shot)?;
            if frame < shown.start {
                continue;
            }
            // All frames of a sequence are exposed as its first one.
            let exposure = *exposure.get_or_insert_with(|| image.film.auto_exposure());
            let output = match &args.animate {
                Some(_) => numbered(&args.output, frame),
                None => args.output.clone(),
            };
            image.film.write(&output, exposure)?;
            if !context.json {
                let on = device.map_or("cpu", Device::name);
                let ms = image.seconds * 1e3;
                println!("{}: {ms:.1} ms on {on}, exposure {exposure:.3}", output.display());
            }
            let mut report = json!({
                "frame": frame, "render_ms": image.seconds * 1e3, "exposure": exposure, "output": output,
            });
            if let Some(rays) = image.shadow_rays {
                report["shadow_rays_per_pixel"] = rays.into();
            }
            reports.push(report);
        }
        Ok(reports)
    }

    fn step<'b>(&'b self, frame: u32, arrays: &'b SceneArrays) -> Step<'b> {
        Step {
            scene: self.scene,
            frame,
            lights: &arrays.lights,
        }
    }

    fn arrays(&self, frame: u32) -> Result<Arc<SceneArrays>, HostError> {
        let arrays = arrays_at(self.scene, frame, self.args.width, self.args.height)?;
        if self.method.needs_power_table() && arrays.thresholds.is_empty() {
            return Err(HostError::Sampler {
                scene: self.scene.name().to_owned(),
                sampler: self.args.sampler.name(),
                lights: arrays.lights.triangles().len(),
            });
        }
        Ok(Arc::new(arrays))
    }
}

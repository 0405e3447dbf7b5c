//! `lightbvh render`: one frame of a scene or a sequence, on the CPU or a device.

use std::ops::Range;
use std::path::PathBuf;
use std::sync::Arc;

use lightbvh::EmissiveTriangle;
use lightbvh::light::AnyLight;
use lightbvh_kernels::shading::candidates::MAX_SCATTERED;
use lightbvh_kernels::shading::path::MAX_BOUNCES;
use lightbvh_kernels::shading::pixel::MAX_CANDIDATES;
use serde_json::{Value, json};

use super::range::{self, Given, MAX_SIDE, given};
use super::{Context, Outcome, devices, frames, table};
use crate::backend::{Combination, Integrator, SceneArrays};
use crate::cli::table::{news, say};
use crate::error::HostError;
use crate::method::{
    Builder, Importance, Method, MethodLight, Recipe, SampleBudget, SequenceId, Step, Target,
};
use crate::render::Film;
use crate::scene::{Scene, SceneLight, read_environment};
use crate::vulkan::{Device, VulkanError};
use crate::workload::{RenderSettings, arrays_lit_by};

/// Frames that ReSTIR runs through before the first one shown, where there are as many before it.
const WARM_UP: u32 = 8;
/// All images are of one sequence.
const SEQUENCE: SequenceId = 0;
/// Most final samples of ReSTIR per pixel: each keeps a history of its own, about 80 bytes per pixel.
const MAX_HISTORIES: u32 = 64;
/// Most reflections of a path.
const DEFAULT_BOUNCES: u32 = 8;

#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// A built-in scene (street, square, carousel, stage) or a .gltf, .glb, .pbrt, .obj or .ply file.
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
    /// Which of the scene's cameras looks, counted from 0; `auto`: one chosen by what is lit, as where the scene has none.
    #[arg(long, default_value = "0", value_name = "N|auto", value_parser = camera)]
    camera: CameraName,
    /// Look from this place, metres, in place of any camera of the scene.
    #[arg(long, value_name = "X,Y,Z", value_parser = place, allow_hyphen_values = true, requires = "look_at", conflicts_with = "camera")]
    look_from: Option<[f32; 3]>,
    /// Look at this place, which is in the middle of the image then; +Y is up.
    #[arg(long, value_name = "X,Y,Z", value_parser = place, allow_hyphen_values = true, requires = "look_from")]
    look_at: Option<[f32; 3]>,
    /// Vertical field of view with --look-from, degrees, 1 to 170.
    #[arg(long, default_value_t = 50, value_parser = clap::value_parser!(u32).range(1..=170), requires = "look_from")]
    fov: u32,
    /// Which animation is shown of those that move the same things, by its name, or by its number in the file from 0 [default: the first].
    #[arg(long, value_name = "NAME|NUMBER")]
    animation: Option<String>,
    /// Which axis of a .obj or .ply file points up; those formats do not say. With z, (x, y, z) of the file lies at (x, z, -y), for --look-from too.
    #[arg(long, value_enum, default_value_t = Up::Y)]
    up: Up,
    /// An environment map that lights the scene: a .hdr or .exr picture by longitude and latitude.
    #[arg(long, value_name = "FILE.hdr|FILE.exr")]
    environment: Option<PathBuf>,
    /// Factor on the environment map's radiance.
    #[arg(long, default_value_t = 1.0, value_parser = exposure, requires = "environment")]
    environment_scale: f32,
    /// Show the mean of each texture in its place, and neither glass nor what is cut out: as all commands but this and `verify` do.
    #[arg(long)]
    no_textures: bool,
    /// How lights are chosen. ReSTIR runs through up to 8 earlier frames before the first one shown.
    #[arg(long, value_enum, default_value_t = Method::TwoLevelMoments)]
    sampler: Method,
    /// Candidates that each light sample is one of, 1 to 256, chosen by what they would contribute; one shadow ray as ever
    /// [default: 1; of two-level-moments-resampled, 8].
    #[arg(long)]
    candidates: Option<u32>,
    /// Directions that the surface reflects into, 0 to 16, one ray each: lights that lie there join the candidates of each light sample.
    /// For lights seen in glossy surfaces.
    #[arg(long, default_value_t = 0)]
    scattered: u32,
    /// How ReSTIR combines samples of other pixels and frames: without bias, or biased (darker where pixels do not see the
    /// same lights) with fewer shadow rays [default: unbiased].
    #[arg(long, value_enum)]
    restir_mode: Option<Combination>,
    /// Light reflected once, or along whole paths.
    #[arg(long, value_enum, default_value_t = IntegratorName::Direct)]
    integrator: IntegratorName,
    /// Most reflections of a path, 1 to 64, with --integrator path; 1 is direct lighting [default: 8].
    #[arg(long)]
    bounces: Option<u32>,
    /// What lights of a BVH are chosen by: moments, or the paper's Eq. 4 [default: that of the sampler].
    #[arg(long, value_enum)]
    importance: Option<Importance>,
    /// How the light BVH is built [default: that of the sampler; with --importance, ward or, for eq4, saoh as in the paper].
    #[arg(long, value_enum)]
    heuristic: Option<Builder>,
    /// What renders.
    #[arg(long, value_enum, default_value_t = BackendName::Cpu)]
    backend: BackendName,
    /// Seed of the random numbers.
    #[arg(long, default_value_t = 0)]
    seed: u32,
    /// Exposure as a factor on radiance; by default chosen from the image, up to 1000. EXR files are linear and take none.
    #[arg(long, value_parser = exposure)]
    exposure: Option<f32>,
    /// The file to write: .png (tone-mapped) or .exr (linear).
    #[arg(short, long, value_name = "FILE.png|FILE.exr")]
    output: PathBuf,
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

/// A factor above zero.
fn exposure(text: &str) -> Result<f32, String> {
    let number = text.parse().ok();
    number
        .filter(|&number: &f32| number.is_finite() && number > 0.0)
        .ok_or_else(|| format!("{text} is no finite number above 0"))
}

/// An axis that points up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Up {
    Y,
    Z,
}

impl Up {
    /// The scene of a file whose axis this is.
    fn turn(self, scene: Scene) -> Result<Scene, HostError> {
        let name = scene.name().to_ascii_lowercase();
        let name = name.strip_suffix(".gz").unwrap_or(&name);
        match self {
            Self::Y => Ok(scene),
            Self::Z if name.ends_with(".obj") || name.ends_with(".ply") => Ok(scene.from_z_up()?),
            Self::Z => Err(HostError::Usage {
                option: "--up z",
                needs: "a .obj or .ply file; in others it is known which way is up",
            }),
        }
    }
}

/// What light is followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
enum IntegratorName {
    /// Light reflected once.
    Direct,
    /// Light along whole paths.
    Path,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum BackendName {
    Cpu,
    Vulkan,
}

/// What the options say of the method; the other ones are those of its name.
fn recipe(args: &Args) -> Result<Recipe, HostError> {
    let mut recipe = Recipe {
        budget: SampleBudget::CameraRays,
        ..args.sampler.recipe()
    };
    if let Some(importance) = args.importance {
        (recipe.importance, recipe.builder) = (importance, importance.builder());
    }
    recipe.builder = args.heuristic.unwrap_or(recipe.builder);
    if let Some(combination) = args.restir_mode {
        if recipe.reuse.is_none() {
            return Err(HostError::Usage {
                option: "--restir-mode",
                needs: "--sampler restir, two-level-restir or two-level-moments-restir",
            });
        }
        recipe.reuse = Some(combination);
    }
    let usage = |option, needs| Err(HostError::Usage { option, needs });
    if let Some(candidates) = args.candidates {
        if recipe.reuse.is_some() {
            return usage("--candidates", "a --sampler without ReSTIR");
        }
        recipe.candidates = candidates;
    }
    if args.scattered > 0 {
        if recipe.reuse.is_some() {
            return usage("--scattered", "a --sampler without ReSTIR");
        }
        if args.integrator == IntegratorName::Path {
            return usage(
                "--scattered",
                "--integrator direct: paths find such lights by themselves",
            );
        }
        recipe.scattered = args.scattered;
    }
    if args.integrator == IntegratorName::Path {
        if recipe.reuse.is_some() {
            return usage("--integrator path", "a --sampler without ReSTIR");
        }
        if recipe.candidates > 1 {
            return usage(
                "--integrator path",
                "a --sampler without candidates, and no --candidates",
            );
        }
        recipe.integrator = Integrator::Path {
            bounces: args.bounces.unwrap_or(DEFAULT_BOUNCES),
        };
    } else if args.bounces.is_some() {
        return usage("--bounces", "--integrator path");
    }
    Ok(recipe)
}

pub(super) fn run(context: &Context, args: &Args) -> Result<Outcome, HostError> {
    let recipe = recipe(args)?;
    if context.device.is_some() && args.backend == BackendName::Cpu {
        return Err(HostError::Usage {
            option: "--device",
            needs: "--backend vulkan",
        });
    }
    let (most, of, default) = match recipe.reuse {
        None => (65_536, "", 16),
        Some(_) => (MAX_HISTORIES, " with ReSTIR", 1),
    };
    let samples = args.spp.unwrap_or(default);
    range::check(&[
        given("--width", args.width, 1..=MAX_SIDE),
        given("--height", args.height, 1..=MAX_SIDE),
        Given {
            of,
            ..given("--spp", samples, 1..=most.into())
        },
        given("--bounces", args.bounces.unwrap_or(1), 1..=MAX_BOUNCES.into()),
        given("--candidates", recipe.candidates, 1..=MAX_CANDIDATES.into()),
        given("--scattered", args.scattered, 0..=MAX_SCATTERED.into()),
    ])?;
    let mut scene = args.up.turn(Scene::open(&args.scene)?)?;
    if let Some(word) = &args.animation {
        scene = playing(scene, word)?;
    }
    scene = seen_by(scene, args.camera)?;
    if let (Some(from), Some(at)) = (args.look_from, args.look_at) {
        check_places(from, at)?;
        scene = scene.seen_from(from, at, (args.fov as f32).to_radians())?;
    }
    if let Some(path) = &args.environment {
        let mut data = scene.into_data();
        let map = read_environment(path, args.environment_scale, &mut data.warnings)?;
        data.environment = Some(Arc::new(map));
        scene = Scene::new(data)?;
    }
    for warning in scene.warnings() {
        news!("{}: {warning}", scene.name());
    }
    let is_known = AnyLight::IMPORTANCES.contains(&recipe.importance);
    let is_painted = scene.data().is_painted();
    if is_painted && !is_known && !scene.has_other_lights() {
        news!(
            "{}: textures are shown by their means, and glass is left out: the paper's importance knows triangles alone",
            scene.name()
        );
    }
    if is_painted && (args.no_textures || !is_known) {
        scene = scene.unpainted();
    }
    let first = args.animate.as_ref().map_or(args.frame, |frames| frames.start);
    for note in scene.unseen_glass().iter().chain(&scene.frame(first).far_off()) {
        news!("{}: {note}", scene.name());
    }
    let sequence = Sequence {
        args,
        recipe,
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
            "camera_chosen": camera_words(&scene), "scene": scene.name(), "width": args.width, "height": args.height, "spp": samples,
            "sampler": args.sampler, "backend": name,
        });
        if recipe.lights.needs_bvh() {
            report["importance"] = json!(recipe.importance);
        }
        // Direct lighting is reflected once.
        report["bounces"] = match recipe.integrator {
            Integrator::Direct => 1,
            Integrator::Path { bounces } => bounces,
        }
        .into();
        report["integrator"] = json!(args.integrator);
        if recipe.reuse.is_none() && args.integrator == IntegratorName::Direct {
            report["candidates"] = recipe.candidates.into();
            report["scattered"] = recipe.scattered.into();
        }
        if let Some(options) = recipe.restir() {
            report["restir"] = json!({
                "mode": options.combination.name(),
                "unbiased": options.combination.is_unbiased(),
                "candidates": options.candidates,
                "most_shadow_rays_per_sample": options.most_shadow_rays(),
            });
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

/// The scene with the animation of that name or number.
fn playing(scene: Scene, word: &str) -> Result<Scene, HostError> {
    let mut data = scene.into_data();
    data.play(word).map_err(|expected| HostError::Word {
        option: "--animation",
        word: word.to_owned(),
        expected,
    })?;
    Ok(Scene::new(data)?)
}

/// A camera of a scene.
#[derive(Clone, Copy, Debug)]
enum CameraName {
    /// By its number.
    Own(usize),
    /// Chosen by what there is to see.
    Auto,
}

fn camera(word: &str) -> Result<CameraName, String> {
    match word {
        "auto" => Ok(CameraName::Auto),
        _ => word
            .parse()
            .map(CameraName::Own)
            .map_err(|_| String::from("give a number from 0, or auto")),
    }
}

/// The scene as that camera sees it.
fn seen_by(scene: Scene, camera: CameraName) -> Result<Scene, HostError> {
    let cameras = scene.data().cameras.len();
    let camera = match camera {
        CameraName::Own(0) => return Ok(scene),
        CameraName::Own(number) => number,
        CameraName::Auto => {
            let mut data = scene.into_data();
            data.cameras.clear();
            return Ok(Scene::new(data)?);
        }
    };
    if camera >= cameras {
        return Err(HostError::Range {
            option: "--camera",
            value: camera as u64,
            expected: match cameras {
                0 => String::from(
                    "a scene with cameras, and it has none; leave the option out, or give --look-from and --look-at",
                ),
                _ => format!("0 to {}: the scene has {cameras}", cameras - 1),
            },
        });
    }
    let mut data = scene.into_data();
    data.cameras.swap(0, camera);
    Ok(Scene::new(data)?)
}

/// Refuses a view of the place that the eye is at.
fn check_places(from: [f32; 3], at: [f32; 3]) -> Result<(), HostError> {
    if from == at {
        return Err(HostError::Usage {
            option: "--look-at",
            needs: "another place than --look-from",
        });
    }
    Ok(())
}

/// The options that stand for the camera that was chosen for a scene without one.
fn camera_words(scene: &Scene) -> Option<String> {
    let (from, at, yfov) = scene.chosen_camera()?;
    let place = |p: [f32; 3]| p.map(|x| x.to_string()).join(",");
    let fov = yfov.to_degrees().round();
    Some(format!(
        "--look-from {} --look-at {} --fov {fov}",
        place(from),
        place(at)
    ))
}

/// What is to be rendered.
struct Sequence<'a> {
    args: &'a Args,
    recipe: Recipe,
    samples: u32,
    scene: &'a Scene,
}

impl Sequence<'_> {
    /// Renders and writes all frames, by lights of the type that the scene needs; returns what the report says of each.
    fn render(&self, context: &Context, device: Option<&Device>) -> Result<Vec<Value>, HostError> {
        if self.scene.has_kinds() {
            self.render_by::<AnyLight>(context, device)
        } else {
            self.render_by::<EmissiveTriangle>(context, device)
        }
    }

    fn render_by<L: MethodLight>(
        &self,
        context: &Context,
        device: Option<&Device>,
    ) -> Result<Vec<Value>, HostError> {
        let args = self.args;
        let shown = args
            .animate
            .clone()
            .unwrap_or(args.frame..args.frame.saturating_add(1));
        let warm_up = if self.recipe.reuse.is_some() { WARM_UP } else { 0 };
        let start = shown.start.saturating_sub(warm_up);
        let first = self.arrays::<L>(start)?;
        let target = device.map_or(Target::Cpu, Target::Device);
        let mut runner = self.recipe.runner(&self.step(start, &first), target)?;
        let mut exposure = args.exposure;
        let mut reports = Vec::new();
        let mut arrays = Some(first);
        for frame in start..shown.end {
            let arrays = match arrays.take() {
                Some(first) => first,
                None => self.arrays(frame)?,
            };
            let settings = RenderSettings {
                frame,
                width: args.width,
                height: args.height,
                samples: self.samples,
                seed: args.seed,
            };
            let step = self.step(frame, &arrays);
            if frame > start {
                runner.advance(&step)?;
            }
            let image = runner.image(&step, &arrays, &settings, SEQUENCE)?;
            if frame < shown.start {
                continue;
            }
            // All frames of a sequence are exposed as its first one.
            let film = Film::new(args.width, args.height, image.value)?;
            if exposure.is_none()
                && let Some(words) = film.darkness()
            {
                let has_sky = self.scene.data().environment.is_some();
                let advice = match has_sky {
                    true => "",
                    false => "; --environment FILE.hdr lights it by a sky",
                };
                news!("{}: {words}{advice}", self.scene.name());
            }
            let exposure = *exposure.get_or_insert_with(|| film.auto_exposure());
            let output = match &args.animate {
                Some(_) => frames::numbered(&args.output, frame),
                None => args.output.clone(),
            };
            film.write(&output, exposure)?;
            let ms = image.time.as_secs_f64() * 1e3;
            if !context.json {
                let on = target.name();
                let factor = match exposure {
                    0.001..1000.5 => format!("{exposure:.3}"),
                    _ => format!("{exposure:e}"),
                };
                say!("{}: {ms:.1} ms on {on}, exposure {factor}", output.display())?;
            }
            if reports.is_empty()
                && let Some(words) = camera_words(self.scene)
                && !context.json
            {
                say!("  camera chosen: {words}")?;
            }
            let mut report = json!({
                "frame": frame, "render_ms": ms, "exposure": exposure, "output": output,
            });
            if let Some(rays) = runner.shadow_rays(SEQUENCE) {
                let pixels = f64::from(args.width) * f64::from(args.height);
                report["shadow_rays_per_pixel"] = (rays as f64 / pixels).into();
            }
            reports.push(report);
        }
        Ok(reports)
    }

    fn step<'b, L>(&'b self, frame: u32, arrays: &'b SceneArrays<L>) -> Step<'b, L> {
        Step {
            scene: self.scene,
            frame,
            lights: &arrays.lights,
        }
    }

    fn arrays<L: SceneLight>(&self, frame: u32) -> Result<Arc<SceneArrays<L>>, HostError> {
        let arrays = arrays_lit_by(self.scene, frame, self.args.width, self.args.height)?;
        Ok(Arc::new(arrays))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_files_that_do_not_say_are_turned() {
        let street = || Scene::open("street").expect("built in");
        let error = Up::Z
            .turn(street())
            .expect_err("a built-in scene is upright")
            .to_string();
        assert!(
            error.contains("--up z") && error.contains(".obj or .ply"),
            "{error}"
        );
        let same = Up::Y.turn(street()).expect("as it is");
        assert_eq!(same.data(), street().data());
    }

    #[test]
    fn cameras_that_are_not_there_are_named() {
        let street = || Scene::open("street").expect("built in");
        let of = |scene: Scene, camera| {
            seen_by(scene, CameraName::Own(camera))
                .map(|_| ())
                .map_err(|error| error.to_string())
        };
        let cameras = street().data().cameras.len();
        assert!(cameras > 0 && of(street(), cameras - 1).is_ok());
        let error = of(street(), cameras).expect_err("one too many");
        assert!(error.contains(&format!("the scene has {cameras}")), "{error}");
        let mut data = street().into_data();
        data.cameras.clear();
        let blind = Scene::new(data).expect("a scene");
        assert!(of(blind.clone(), 0).is_ok());
        let error = of(blind, 3).expect_err("there is none");
        assert!(
            error.contains("--camera 3") && error.contains("it has none"),
            "{error}"
        );
    }

    #[test]
    fn a_view_of_the_eye_is_refused() {
        assert!(check_places([1.0; 3], [1.0, 1.0, 1.5]).is_ok());
        let error = check_places([1.0; 3], [1.0; 3])
            .expect_err("no direction")
            .to_string();
        assert!(error.contains("--look-at needs another place"), "{error}");
    }
}

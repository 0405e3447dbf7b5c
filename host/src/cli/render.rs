//! `lightbvh render`: one frame of a scene or a sequence, on the CPU or a device.

mod options;
mod sequence;
mod view;

use lightbvh::EmissiveTriangle;
use lightbvh::light::AnyLight;
use serde_json::json;

use self::options::recipe;
use self::sequence::Sequence;
use self::view::{camera_words, check_places, seen_by};
use super::reading::BackendName;
use super::{Context, Outcome, devices, frames, table, target};
use crate::cli::table::news;
use crate::error::HostError;
use crate::method::MethodLight;
use crate::vulkan::VulkanError;

pub(super) use self::options::Args;

pub(super) fn run(context: &Context, args: &Args) -> Result<Outcome, HostError> {
    let recipe = recipe(args)?;
    if context.device.is_some() && args.backend == BackendName::Cpu {
        return Err(HostError::Usage {
            option: "--device",
            needs: "--backend vulkan",
        });
    }
    // Of a sequence the first: all have one folder and one ending.
    let first = args
        .animate
        .as_ref()
        .map(|shown| frames::numbered(&args.output, shown.start));
    target::picture(first.as_ref().unwrap_or(&args.output))?;
    let mut scene = args.reading.open(&args.scene)?;
    scene = seen_by(scene, args.camera)?;
    if let (Some(from), Some(at)) = (args.look_from, args.look_at) {
        check_places(from, at)?;
        scene = scene.seen_from(from, at, (args.fov as f32).to_radians())?;
    }
    for warning in scene.warnings() {
        news!("{}: {warning}", scene.name());
    }
    let is_known = AnyLight::IMPORTANCES.contains(&recipe.importance);
    let is_painted = scene.data().is_painted();
    if is_painted && !is_known && !scene.has_other_lights() {
        news!(
            "{}: textures are shown by their means: the paper's importance knows triangles alone",
            scene.name()
        );
    }
    if is_painted && (args.no_textures || !is_known) {
        scene = scene.unpainted();
    }
    let sequence = Sequence {
        args,
        recipe,
        scene: &scene,
    };
    let render = match scene.has_kinds() {
        true => Sequence::render::<AnyLight>,
        false => Sequence::render::<EmissiveTriangle>,
    };
    let (shown, name) = match args.backend {
        BackendName::Cpu => (render(&sequence, context, None)?, "cpu".to_owned()),
        BackendName::Vulkan => {
            let opened = devices::open(context)?;
            let Some(first) = opened.first() else {
                return Err(VulkanError::NoDevice {
                    notes: "--backend vulkan needs one".to_owned(),
                }
                .into());
            };
            let shown = render(&sequence, context, Some(&first.device))?;
            let name = first.device.name().to_owned();
            devices::close(opened)?;
            (shown, name)
        }
    };
    if context.json {
        table::print_json(&json!({
            "scene": scene.name(), "backend": name, "camera_chosen": camera_words(&scene), "frames": shown,
        }))?;
    }
    Ok(Outcome::Good)
}

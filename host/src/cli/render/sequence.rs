//! The frames of `lightbvh render`, one after the other.

use serde_json::{Value, json};

use super::options::Args;
use crate::backend::SceneArrays;
use crate::cli::table::{news, say};
use crate::cli::{Context, frames};
use crate::error::HostError;
use crate::method::{MethodLight, Recipe, Step, Target};
use crate::render::Film;
use crate::scene::{Scene, SceneLight};
use crate::vulkan::Device;
use crate::workload::{arrays_lit_by, render_params};

/// A frame or a sequence to render.
pub(super) struct Sequence<'a> {
    pub(super) args: &'a Args,
    pub(super) recipe: Recipe,
    pub(super) scene: &'a Scene,
}

impl Sequence<'_> {
    /// Renders and writes all frames; returns what the report says of each.
    pub(super) fn render<L: MethodLight>(
        &self,
        context: &Context,
        device: Option<&Device>,
    ) -> Result<Vec<Value>, HostError> {
        let args = self.args;
        // With its end: the last frame of all has none after it.
        let (start, last) = match &args.animate {
            Some(frames) => (frames.start, frames.end - 1),
            None => (args.frame, args.frame),
        };
        let first = self.arrays::<L>(start)?;
        let target = device.map_or(Target::Cpu, Target::Device);
        let mut runner = self
            .recipe
            .runner(&Step::new(self.scene, start, &first.lights), target)?;
        let mut exposure = args.exposure;
        let mut is_told = false;
        let mut reports = Vec::new();
        let mut arrays = Some(first);
        for frame in start..=last {
            let arrays = match arrays.take() {
                Some(first) => first,
                None => self.arrays(frame)?,
            };
            let background = self.scene.data().background;
            let params = render_params((args.width, args.height), args.spp, args.seed, background);
            let step = Step::new(self.scene, frame, &arrays.lights);
            if frame > start {
                runner.advance(&step)?;
            }
            let image = runner.image(&step, &arrays, &params)?;
            let film = Film::new(args.width, args.height, image.value)?;
            // All frames of a sequence are exposed as its first one that is not dark.
            let exposure = match (exposure, film.darkness()) {
                (Some(exposure), _) => exposure,
                (None, None) => *exposure.insert(film.auto_exposure()),
                (None, Some(words)) => {
                    if !std::mem::replace(&mut is_told, true) {
                        news!("{}: frame {frame}: {words}", self.scene.name());
                    }
                    film.auto_exposure()
                }
            };
            let output = match &args.animate {
                Some(_) => frames::numbered(&args.output, frame),
                None => args.output.clone(),
            };
            film.write(&output, exposure)?;
            let ms = image.time.as_secs_f64() * 1e3;
            if !context.json {
                let on = target.name();
                // All digits: given back as an option, it makes the same picture.
                let factor = match exposure {
                    0.001..=1000.0 => format!("{exposure}"),
                    _ => format!("{exposure:e}"),
                };
                say!("{}: {ms:.1} ms on {on}, exposure {factor}", output.display())?;
            }
            reports.push(json!({
                "frame": frame, "render_ms": ms, "exposure": exposure, "output": output,
            }));
        }
        Ok(reports)
    }

    fn arrays<L: SceneLight>(&self, frame: u32) -> Result<SceneArrays<L>, HostError> {
        arrays_lit_by(self.scene, frame, self.args.width, self.args.height)
    }
}

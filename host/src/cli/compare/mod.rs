//! `lightbvh compare`: the paper's comparison. Table 1 (errors), Figures 4 and 5 (errors over frames), Figure 6
//! (close-ups) and Table 2 (times), for every method that there is.

mod crops;
mod frames;
mod graphs;
mod measure;
mod plan;
mod reference;
mod report;
mod summary;

use std::path::Path;

use indicatif::ProgressBar;
use serde_json::{Value, json};

use super::{Context, Outcome, devices, progress, table, target};
use crate::cli::table::news;
use crate::error::HostError;
use crate::method::Target;
use crate::scene::Scene;
use crate::vulkan::VulkanError;

use frames::Frames;
use measure::{Job, Results};
pub(super) use plan::Args;
use plan::{BLOCK, Backends, Plan, timed_blocks};
use reference::{Noise, references};
use report::{Report, SceneReport};
use summary::summarize;

pub(super) fn run(context: &Context, args: &Args) -> Result<Outcome, HostError> {
    let plan = args.plan();
    let scenes = plan
        .scenes
        .iter()
        .map(|name| args.reading.open(name))
        .collect::<Result<Vec<_>, _>>()?;
    for scene in &scenes {
        scene.require_lights()?;
        for warning in scene.warnings().iter().chain(&scene.unknown_lights()) {
            news!("{}: {warning}", scene.name());
        }
    }
    let opened = match plan.backends {
        Backends::Cpu => Vec::new(),
        Backends::Vulkan | Backends::All => devices::open(context)?,
    };
    let cpu = (plan.backends != Backends::Vulkan).then_some(Target::Cpu);
    let targets: Vec<Target<'_>> = cpu
        .into_iter()
        .chain(opened.iter().map(|o| Target::Device(&o.device)))
        .collect();
    target::folder(&args.out)?;
    let mut run = Run {
        plan: &plan,
        progress: progress::bar(
            0,
            "{bar:30} {percent:>3} % {elapsed} passed, {eta} left  {wide_msg}",
            false,
        ),
        report: Report {
            settings: settings(&plan),
            notes: &report::NOTES,
            scenes: Vec::new(),
            rows: Vec::new(),
            averages: Vec::new(),
            crops: Vec::new(),
            different: 0,
        },
    };
    if targets.is_empty() {
        return Err(VulkanError::NoDevice {
            notes: "--backend vulkan needs one".to_owned(),
        }
        .into());
    }
    run.progress
        .set_length(scenes.len() as u64 * all_work(&plan, &targets));
    let stems = target::stems(plan.scenes.iter().map(String::as_str));
    for (scene, stem) in scenes.iter().zip(stems) {
        run.scene(scene, &stem, &targets, &args.out)?;
    }
    run.progress.finish_and_clear();
    let report = run.report;
    drop(targets);
    devices::close(opened)?;

    let text = report::markdown(&plan, &report);
    let mut json = serde_json::to_vec_pretty(&report).map_err(std::io::Error::from)?;
    json.push(b'\n');
    for (name, bytes) in [("compare.json", json.as_slice()), ("compare.md", text.as_bytes())] {
        target::store(&args.out.join(name), bytes)?;
    }
    if context.json {
        table::print_json(&report)?;
    } else {
        table::print_text(&text)?;
    }
    Ok(Outcome::good_if(report.different == 0))
}

struct Run<'p> {
    plan: &'p Plan,
    progress: ProgressBar,
    report: Report,
}

impl Run<'_> {
    fn scene(
        &mut self,
        scene: &Scene,
        stem: &str,
        targets: &[Target<'_>],
        folder: &Path,
    ) -> Result<(), HostError> {
        let plan = self.plan;
        let mut frames = Frames::new(scene, plan.size());
        let references = references(&mut frames, plan, &self.progress)?;
        let jobs: Vec<Job<'_, '_>> = targets
            .iter()
            .map(|&target| Job {
                plan,
                references: &references,
                target,
                seeds: seeds(plan, &target),
                blocks: blocks(plan, &target),
                progress: &self.progress,
            })
            .collect();
        let all = jobs
            .iter()
            .map(|job| job.run(&mut frames))
            .collect::<Result<Vec<Results>, _>>()?;

        let mut figures = Vec::new();
        for (target, results) in targets.iter().zip(&all) {
            let (rows, averages) = summarize(plan, scene.name(), target.name(), results);
            // All backends show the same images, so one gives the figures.
            if figures.is_empty() {
                figures = graphs::write(folder, plan, stem, &rows)?;
            }
            self.report.rows.extend(rows);
            self.report.averages.extend(averages);
            self.report.different += results.different_from(&all[0]);
        }
        let crops = format!("crops-{stem}.svg");
        let (last, films) = (&references[references.len() - 1], &all[0].films);
        self.report.crops.extend(crops::write(
            &folder.join(&crops),
            plan,
            scene.name(),
            &last.judge,
            films,
        )?);
        figures.push(crops);
        self.report.scenes.push(SceneReport {
            scene: scene.name().to_owned(),
            exposure: last.judge.exposure(),
            references: plan
                .frames
                .iter()
                .zip(&references)
                .map(|(&frame, reference)| Noise {
                    frame,
                    samples: plan.reference_samples,
                    mse: reference.noise,
                    linear_mse: reference.linear_noise,
                })
                .collect(),
            figures,
        });
        Ok(())
    }
}

/// The work of a scene: its references, and every method's images on every backend.
fn all_work(plan: &Plan, targets: &[Target<'_>]) -> u64 {
    let references = plan.work(plan.reference_samples) * plan.frames.len() as u64;
    let images = |target: &Target<'_>| {
        let timed = blocks(plan, target).len() as u64 * u64::from(BLOCK);
        plan.frames.len() as u64 * u64::from(seeds(plan, target)) + timed
    };
    let images: u64 = targets.iter().map(images).sum();
    references + plan.work(plan.samples) * images * plan.methods.len() as u64
}

/// Images of each frame: devices show that they render the same, and how fast.
fn seeds(plan: &Plan, target: &Target<'_>) -> u32 {
    match target {
        Target::Cpu => plan.seeds,
        Target::Device(_) => 1,
    }
}

/// The blocks that are timed.
fn blocks(plan: &Plan, target: &Target<'_>) -> Vec<u32> {
    let timed = match target {
        Target::Cpu => plan.timed_frames,
        Target::Device(_) => plan.timed_on_devices,
    };
    timed_blocks(plan.last(), timed)
}

fn settings(plan: &Plan) -> Value {
    json!({
        "scenes": plan.scenes, "frames": plan.frames, "samples": plan.samples, "seeds": plan.seeds,
        "width": plan.width, "height": plan.height, "reference_samples": plan.reference_samples,
        "timed_frames": plan.timed_frames, "timed_on_devices": plan.timed_on_devices, "methods": plan.methods, "cpu_threads": rayon::current_num_threads(),
    })
}

//! `lightbvh compare`: the paper's comparison. Table 1 (errors over frames) and Table 2 (times), for every method that
//! there is.

mod measure;
mod plan;
mod report;
mod summary;

use indicatif::ProgressBar;
use lightbvh::BuildParams;
use serde_json::json;

use super::measure::reference::Reference;
use super::{Context, Outcome, devices, progress, table};
use crate::backend::{Backend, Bvh, CpuBackend, Integrator, Sampler};
use crate::cli::table::news;
use crate::error::HostError;
use crate::method::Target;
use crate::scene::Scene;
use crate::vulkan::VulkanError;
use crate::workload::{arrays_at, build, render_params};

use measure::Job;
pub(super) use plan::Args;
use plan::{BLOCK, Backends, timed_blocks};
use report::{Noise, Report, SceneReport};
use summary::summarize;

/// Seeds from here on belong to references, so that these share no random numbers with the images measured against them.
const FIRST_SEED: u32 = 1 << 31;

pub(super) fn run(context: &Context, args: &Args) -> Result<Outcome, HostError> {
    let plan = args.ordered();
    let scenes = plan.scene.iter().map(|name| args.reading.open(name));
    let scenes = scenes.collect::<Result<Vec<_>, _>>()?;
    for scene in &scenes {
        scene.require_lights()?;
        for warning in scene.warnings().iter().chain(&scene.unknown_lights()) {
            news!("{}: {warning}", scene.name());
        }
    }
    let opened = match plan.backend {
        Backends::Cpu => Vec::new(),
        Backends::Vulkan | Backends::All => devices::open(context)?,
    };
    let cpu = (plan.backend != Backends::Vulkan).then_some(Target::Cpu);
    let on_devices = opened.iter().map(|o| Target::Device(&o.device));
    let targets: Vec<Target<'_>> = cpu.into_iter().chain(on_devices).collect();
    if targets.is_empty() {
        return Err(VulkanError::NoDevice {
            notes: "--backend vulkan needs one".to_owned(),
        }
        .into());
    }
    let mut report = Report {
        settings: json!({
            "scenes": plan.scene, "frames": plan.frames, "samples": plan.samples, "seeds": plan.seeds,
            "width": plan.width, "height": plan.height, "reference_samples": plan.reference_samples,
            "timed_frames": plan.timed_frames()[0], "timed_on_devices": plan.timed_frames()[1], "methods": plan.method,
            "cpu_threads": rayon::current_num_threads(),
        }),
        notes: &report::NOTES,
        scenes: Vec::new(),
        rows: Vec::new(),
        averages: Vec::new(),
        different: 0,
    };
    let template = "{bar:30} {percent:>3} % {elapsed} passed, {eta} left  {wide_msg}";
    let blocks = (plan.last() / BLOCK + 1) as usize;
    let work = scenes.len() * (plan.frames.len() + targets.len() * plan.method.len() * blocks);
    let progress = progress::bar(work as u64, template, false);
    for scene in &scenes {
        compare(&plan, scene, &targets, &progress, &mut report)?;
    }
    progress.finish_and_clear();
    drop(targets);
    devices::close(opened)?;

    match context.json {
        true => table::print_json(&report)?,
        false => report::print(&report)?,
    }
    Ok(Outcome::good_if(report.different == 0))
}

/// Compares all methods over a scene on all targets.
fn compare(
    plan: &Args,
    scene: &Scene,
    targets: &[Target<'_>],
    progress: &ProgressBar,
    report: &mut Report,
) -> Result<(), HostError> {
    let references = references(plan, scene, progress)?;
    let mut first = None;
    let [on_cpu, on_devices] = plan.timed_frames();
    for &target in targets {
        // Devices show that they render the same, and how fast.
        let (seeds, timed) = match target {
            Target::Cpu => (plan.seeds, on_cpu),
            Target::Device(_) => (1, on_devices),
        };
        let job = Job {
            plan,
            scene,
            references: &references,
            target,
            seeds,
            blocks: timed_blocks(plan.last(), timed),
            progress,
        };
        let results = job.run()?;
        let [rows, averages] = summarize(plan, scene.name(), target.name(), &results);
        report.rows.extend(rows);
        report.averages.extend(averages);
        report.different += results.different_from(first.get_or_insert(results.clone()));
    }
    let noise = plan.frames.iter().zip(&references);
    report.scenes.push(SceneReport {
        scene: scene.name().to_owned(),
        exposure: references[0].judge.exposure(),
        references: noise
            .map(|(&frame, reference)| Noise {
                frame,
                samples: plan.reference_samples,
                mse: reference.noise,
                linear_mse: reference.linear_noise,
            })
            .collect(),
    });
    Ok(())
}

/// The references of all measured frames, displayed at the exposure of the first.
fn references(plan: &Args, scene: &Scene, progress: &ProgressBar) -> Result<Vec<Reference>, HostError> {
    let mut exposure = None;
    let mut references = Vec::new();
    for &frame in &plan.frames {
        progress.set_message(format!("{} frame {frame}: reference", scene.name()));
        let arrays = arrays_at(scene, frame, plan.width, plan.height)?;
        let bvh: Bvh = build(&arrays.lights, Sampler::TwoLevel, &BuildParams::default());
        let mut cpu: CpuBackend = CpuBackend::new(bvh);
        let mut half = |half| {
            let samples = plan.reference_samples / 2;
            let background = scene.data().background;
            let params = render_params(plan.size(), samples, FIRST_SEED + half, background);
            cpu.render(&arrays, &params, Sampler::TwoLevel, Integrator::Direct)
        };
        let halves = [half(0)?.value, half(1)?.value];
        progress.inc(1);
        let reference = Reference::new(plan.size(), halves, exposure)?;
        exposure = Some(reference.judge.exposure());
        references.push(reference);
    }
    Ok(references)
}

//! `lightbvh compare`: the paper's comparison. Table 1 (errors over frames) and Table 2 (times), for every method that
//! there is.

mod measure;
mod plan;
mod report;
mod summary;

use serde_json::json;

use super::{Context, Outcome, devices, table};
use crate::cli::reading::shown;
use crate::cli::table::news;
use crate::error::HostError;
use crate::method::Target;
use crate::scene::Scene;
use crate::vulkan::VulkanError;

use measure::{Job, Results};
pub(super) use plan::Args;
use plan::{Backends, TIMED};
use report::{Noise, Report, SceneReport};
use summary::summarize;

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
            "scenes": shown(&plan.scene), "frames": plan.frames, "samples": plan.samples, "seeds": plan.seeds,
            "width": plan.width, "height": plan.height, "reference_samples": plan.reference_samples,
            "timed_frames": TIMED, "timed_on_devices": TIMED, "methods": plan.method,
            "cpu_threads": rayon::current_num_threads(),
        }),
        notes: &report::NOTES,
        scenes: Vec::new(),
        rows: Vec::new(),
        averages: Vec::new(),
        different: 0,
    };
    for scene in &scenes {
        compare(&plan, scene, &targets, &mut report)?;
    }
    drop(targets);
    devices::close(opened)?;

    match context.json {
        true => table::print_json(&report)?,
        false => report::print(&report)?,
    }
    Ok(Outcome::good_if(report.different == 0))
}

/// Compares all methods over a scene on all targets.
fn compare(plan: &Args, scene: &Scene, targets: &[Target<'_>], report: &mut Report) -> Result<(), HostError> {
    news!("{}: references", scene.name());
    let job = Job::new(plan, scene)?;
    let mut first = None;
    for &target in targets {
        // Devices show that they render the same, and how fast.
        let seeds = match target {
            Target::Cpu => plan.seeds,
            Target::Device(_) => 1,
        };
        let mut results = Results::default();
        for &method in &plan.method {
            news!("{}: {} on {}", scene.name(), method.name(), target.name());
            job.run(method, target, seeds, &mut results)?;
        }
        let [rows, averages] = summarize(plan, scene.name(), target.name(), &results);
        report.rows.extend(rows);
        report.averages.extend(averages);
        report.different += results.different_from(first.get_or_insert(results.clone()));
    }
    let noise = job.references.iter().map(|(&frame, reference)| Noise {
        frame,
        samples: plan.reference_samples,
        mse: reference.noise,
        linear_mse: reference.linear_noise,
    });
    report.scenes.push(SceneReport {
        scene: scene.name().to_owned(),
        exposure: job.references[&plan.frames[0]].judge.exposure(),
        references: noise.collect(),
    });
    Ok(())
}

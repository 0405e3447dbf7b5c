//! Everything that came out, and its tables as Markdown: the same text on standard output and in the folder.

use std::fmt::Write;

use serde::Serialize;
use serde_json::Value;

use super::plan::Args;
use super::summary::{Errors, Row};
use crate::method::Method;

/// Everything that came out.
#[derive(Serialize)]
pub(super) struct Report {
    pub settings: Value,
    pub notes: &'static [&'static str],
    pub scenes: Vec<SceneReport>,
    pub rows: Vec<Row>,
    pub averages: Vec<Row>,
    /// Images of devices with other words than the CPU's.
    pub different: u64,
}

/// Figures of a scene as a whole.
#[derive(Serialize)]
pub(super) struct SceneReport {
    pub scene: String,
    pub exposure: f32,
    pub references: Vec<Noise>,
}

/// The noise of a reference.
#[derive(Serialize)]
pub(super) struct Noise {
    pub frame: u32,
    pub samples: u32,
    /// Of the displayed bytes.
    pub mse: f64,
    pub linear_mse: f64,
}

/// Notes of the tables.
pub(super) const NOTES: [&str; 7] = [
    "All methods trace the same number of shadow rays per pixel, through the same camera rays: what differs is the light that \
     each ray goes to.",
    "Methods with moments in their names choose lights by the default importance, over trees of 8 children to a node built \
     by Ward's criterion; the other light BVHs by the paper's Eq. 4, over trees of 4 children to a node built by SAH or SAOH.",
    "MSE, SSIM, PSNR and FLIP are of tone-mapped 8-bit sRGB at one exposure per scene (MSE in steps squared, 0 to 255²), as \
     in the paper; linear MSE is of radiance.",
    "± is half the 95 % confidence interval of the mean over the seeds (Student's t); one seed gives none. Of an average, \
     each seed's mean over the frames is one measurement.",
    "References come from the two-level light BVH with many samples and random numbers of their own. Their own noise, \
     estimated from two halves, is in every MSE; compare it with the differences you look at.",
    "Refit and waiting and image times add up to the frame; a rebuild beside the frame counts only as far as the frame \
     waits for it. Image times of devices are the kernels' own where the device has a clock; transfers are left out.",
    "Rebuild times are of the CPU on every backend.",
];

/// A mean and half its confidence interval.
fn measured(mean: f64, ci95: Option<f64>, decimals: usize) -> String {
    match ci95 {
        Some(ci95) => format!("{mean:.decimals$} ± {ci95:.decimals$}"),
        None => format!("{mean:.decimals$}"),
    }
}

/// The measures of Table 1, their names in JSON, and their decimals: none for powers.
const MEASURES: [(&str, &str, Option<usize>); 5] = [
    ("MSE", "mse", Some(1)),
    ("SSIM", "ssim", Some(4)),
    ("PSNR", "psnr", Some(2)),
    ("FLIP", "flip", Some(4)),
    ("linear MSE", "linear_mse", None),
];

fn cell(errors: &Errors, name: &str, decimals: Option<usize>) -> String {
    match (errors.get(name), decimals) {
        ((mean, ci95), Some(decimals)) => measured(mean, ci95, decimals),
        ((mean, Some(ci95)), None) => format!("{mean:.3e} ± {ci95:.1e}"),
        ((mean, None), None) => format!("{mean:.3e}"),
    }
}

/// All tables.
pub(super) fn markdown(plan: &Args, report: &Report) -> String {
    let mut out = String::new();
    // Writing to a string does not fail.
    let mut line = |text: String| {
        let _ = writeln!(out, "{text}");
    };
    line(format!(
        "# Light sampling methods compared\n\n{} × {} pixels, {} shadow rays per pixel, {} seeds per frame (devices: one), \
         references of {} shadow rays per pixel.\n",
        plan.width, plan.height, plan.samples, plan.seeds, plan.reference_samples
    ));
    for note in NOTES {
        line(format!("- {note}"));
    }
    for scene in &report.scenes {
        line(format!("\n## {}\n\n### Table 1: errors\n", scene.scene));
        for backend in backends(report, scene) {
            line(errors(plan, report, scene, &backend));
        }
        line(format!(
            "### Own noise of the references, exposure {:.3}\n",
            scene.exposure
        ));
        line("| frame | MSE | linear MSE |\n|---|---|---|".to_owned());
        for noise in &scene.references {
            line(format!(
                "| {} | {:.2} | {:.3e} |",
                noise.frame, noise.mse, noise.linear_mse
            ));
        }
        line("\n### Change of the MSE over the moving frames\n".to_owned());
        line(changes(report, scene));
        line("### Table 2: milliseconds, averaged over the timed frames\n".to_owned());
        line(times(report, scene));
    }
    line(format!(
        "Images of devices with other words than the CPU's: {}.",
        report.different
    ));
    out
}

/// The backends of a scene, in the order of the rows.
fn backends(report: &Report, scene: &SceneReport) -> Vec<String> {
    let mut backends: Vec<String> = Vec::new();
    for row in report.rows.iter().filter(|row| row.scene == scene.scene) {
        if !backends.contains(&row.backend) {
            backends.push(row.backend.clone());
        }
    }
    backends
}

fn errors(plan: &Args, report: &Report, scene: &SceneReport, backend: &str) -> String {
    let frames: Vec<String> = plan.frames.iter().map(u32::to_string).collect();
    let mut out = format!(
        "On {backend}:\n\n| measure | method | {} | average |\n",
        frames.join(" | ")
    );
    out += &format!("|---|---|{}---|\n", "---|".repeat(frames.len()));
    for (title, name, decimals) in MEASURES {
        for &method in &plan.method {
            let all = report.rows.iter().chain(&report.averages);
            let own =
                all.filter(|row| row.scene == scene.scene && row.backend == backend && row.method == method);
            let cells: Vec<String> = own.map(|row| cell(&row.errors, name, decimals)).collect();
            out += &format!("| {title} | {} | {} |\n", method.name(), cells.join(" | "));
        }
    }
    out
}

/// Of methods that can be told apart in percent; those without a tree are too far off, and in the JSON.
fn changes(report: &Report, scene: &SceneReport) -> String {
    let mut out = String::from("| backend | method | from | MSE |\n|---|---|---|---|\n");
    let is_far = |method| matches!(method, Method::Uniform | Method::Power);
    let is_shown = |a: &&Row| a.scene == scene.scene && !is_far(a.method);
    for average in report.averages.iter().filter(is_shown) {
        for change in &average.mse_change {
            out += &format!(
                "| {} | {} | {} | {} % |\n",
                average.backend,
                average.method.name(),
                change.from.name(),
                measured(change.percent, change.percent_ci95, 1),
            );
        }
    }
    out
}

fn times(report: &Report, scene: &SceneReport) -> String {
    let mut out = String::from(
        "| backend | method | refit | rebuild | waiting | image | frame | frames timed |\n|---|---|---|---|---|---|---|---|\n",
    );
    for average in report.averages.iter().filter(|a| a.scene == scene.scene) {
        let times = &average.times;
        let cell = |ms: Option<f64>| ms.map_or(String::from("-"), |ms| format!("{ms:.2}"));
        let frame = times
            .frame_ms
            .map_or(String::from("-"), |ms| measured(ms, times.frame_ms_ci95, 2));
        out += &format!(
            "| {} | {} | {} | {} | {} | {} | {frame} | {} |\n",
            average.backend,
            average.method.name(),
            cell(times.refit_ms),
            cell(times.rebuild_ms),
            cell(times.wait_ms),
            cell(times.image_ms),
            times.timed_frames,
        );
    }
    out
}

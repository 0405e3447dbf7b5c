//! Everything that came out, and its tables.

use serde::Serialize;
use serde_json::Value;

use super::summary::Row;
use crate::cli::table::{self, say};

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
pub(super) const NOTES: [&str; 5] = [
    "All methods trace the same number of shadow rays per pixel, through the same camera rays: what differs is the light that \
     each ray goes to.",
    "MSE, SSIM, PSNR and FLIP are of tone-mapped 8-bit sRGB at one exposure per scene (MSE in steps squared, 0 to 255²), as \
     in the paper; linear MSE is of radiance.",
    "± is half the 95 % confidence interval of the mean over the seeds (Student's t); one seed gives none. Of an average, \
     each seed's mean over the frames is one measurement.",
    "References come from the two-level light BVH with many samples and random numbers of their own. Their own noise, \
     estimated from two halves, is in every MSE; compare it with the differences you look at.",
    "Refit and waiting and image times add up to the frame; a rebuild, always by the CPU, runs beside it. Image times of \
     devices are the kernels' own where the device has a clock; transfers are left out.",
];

/// Tables of each scene; the JSON has more.
pub(super) fn print(report: &Report) -> std::io::Result<()> {
    for SceneReport {
        scene, references, ..
    } in &report.scenes
    {
        for rows in [&report.rows, &report.averages] {
            let own = rows.iter().filter(|row| row.scene == *scene).cloned();
            let own: Vec<Row> = own.collect();
            say!("{scene}: errors")?;
            table::print(&own, ERRORS)?;
            if own.iter().any(|row| row.frame.is_none()) {
                say!("{scene}: milliseconds, averaged over the timed frames")?;
                table::print(&own, TIMES)?;
            }
        }
        for Noise { frame, mse, .. } in references {
            say!("{scene}: the own noise of the reference of frame {frame} is {mse:.2} of each MSE")?;
        }
    }
    for note in report.notes {
        say!("{note}")?;
    }
    say!(
        "Images of devices with other words than the CPU's: {}.",
        report.different
    )
}

const ERRORS: &[table::Column<Row>] = &[
    ("method", |r| r.method.name().to_owned()),
    ("backend", |r| r.backend.clone()),
    ("frame", |r| {
        r.frame
            .map_or_else(|| "all".to_owned(), |frame| frame.to_string())
    }),
    ("MSE", |r| measured(r, "mse", 1)),
    ("SSIM", |r| table::known(r.get("ssim").0, 4)),
    ("PSNR", |r| table::known(r.get("psnr").0, 2)),
    ("FLIP", |r| table::known(r.get("flip").0, 4)),
    ("linear MSE", |r| measured(r, "linear_mse", 4)),
];

const TIMES: &[table::Column<Row>] = &[
    ("method", |r| r.method.name().to_owned()),
    ("backend", |r| r.backend.clone()),
    ("refit", |r| table::known(r.get("refit_ms").0, 2)),
    ("rebuild", |r| table::known(r.get("rebuild_ms").0, 2)),
    ("waiting", |r| table::known(r.get("wait_ms").0, 2)),
    ("image", |r| table::known(r.get("image_ms").0, 2)),
    ("frame", |r| measured(r, "frame_ms", 2)),
    ("frames timed", |r| r.timed_frames.to_string()),
];

/// A mean and half its confidence interval.
fn measured(row: &Row, name: &str, decimals: usize) -> String {
    match row.get(name) {
        (Some(mean), Some(ci95)) => format!("{mean:.decimals$} ± {ci95:.decimals$}"),
        (mean, _) => table::known(mean, decimals),
    }
}

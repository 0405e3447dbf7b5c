//! What `bench --dynamic` reports.

use std::io;
use std::time::Duration;

use serde::Serialize;

use crate::cli::table;

/// Least, greatest and median of the frames, milliseconds.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub(in crate::cli::bench) struct Spread {
    pub median: f64,
    pub least: f64,
    pub most: f64,
}

impl Spread {
    pub fn of(mut times: Vec<Duration>) -> Self {
        times.sort_unstable();
        let ms = |time: Option<&Duration>| time.map_or(0.0, |time| time.as_secs_f64() * 1e3);
        Self {
            median: ms(times.get(times.len() / 2)),
            least: ms(times.first()),
            most: ms(times.last()),
        }
    }
}

/// A kind of frame.
#[derive(Clone, Debug, Serialize)]
pub(in crate::cli::bench) struct Row {
    pub change: &'static str,
    pub instances: u32,
    pub triangles: u64,
    /// Instances, or triangles of the deformed mesh, that change in each frame.
    pub changed: u32,
    pub backend: String,
    pub threads: usize,
    pub frames: usize,
    /// [`lightbvh::Bvh::update`]: the edits, checked and done.
    pub update_ms: Spread,
    /// [`lightbvh::Bvh::refit`], or the passes on a device.
    pub refit_ms: Spread,
    /// In frames that swap in a rebuilt top level: its rebuild, beside the frame before; its swap-in; the refit then.
    pub rebuild_ms: Option<Spread>,
    pub swap_ms: Option<Spread>,
    pub refit_after_swap_ms: Option<Spread>,
    /// Nodes and roots that the refit computes.
    pub nodes: usize,
    /// The refit's median over the time of copying the top level's nodes and instances once.
    pub copies: f64,
    /// The refit's median over that of a single-level refit of all triangles by one thread.
    pub of_single_level: f64,
}

/// All measurements.
#[derive(Clone, Debug, Serialize)]
pub(in crate::cli::bench) struct Report {
    /// Copying the top level's nodes and instances.
    pub copy_ms: Spread,
    pub top_level_bytes: usize,
    /// Refit of a single-level tree of all triangles in the world, one thread.
    pub single_level_refit_ms: Spread,
    pub rows: Vec<Row>,
}

/// Prints the table.
pub(in crate::cli::bench) fn print(report: &Report) -> io::Result<()> {
    let header = [
        "change",
        "instances",
        "triangles",
        "changed",
        "backend",
        "threads",
        "update ms",
        "refit ms",
        "least",
        "most",
        "nodes",
        "rebuild ms",
        "swap ms",
        "refit then",
        "copies",
        "of single-level",
    ];
    let median = |spread: &Option<Spread>| spread.map_or("-".to_owned(), |s| format!("{:.3}", s.median));
    let rows: Vec<Vec<String>> = report
        .rows
        .iter()
        .map(|r| {
            vec![
                r.change.to_owned(),
                r.instances.to_string(),
                r.triangles.to_string(),
                r.changed.to_string(),
                r.backend.clone(),
                if r.threads == 0 {
                    "-".to_owned()
                } else {
                    r.threads.to_string()
                },
                format!("{:.3}", r.update_ms.median),
                format!("{:.3}", r.refit_ms.median),
                format!("{:.3}", r.refit_ms.least),
                format!("{:.3}", r.refit_ms.most),
                r.nodes.to_string(),
                median(&r.rebuild_ms),
                median(&r.swap_ms),
                median(&r.refit_after_swap_ms),
                format!("{:.2}", r.copies),
                format!("{:.4}", r.of_single_level),
            ]
        })
        .collect();
    table::print(&header, &rows)?;
    table::print_text(&format!(
        "single-level refit of all triangles, one thread: {:.3} ms; copy of the top level ({} bytes): {:.4} ms\n",
        report.single_level_refit_ms.median, report.top_level_bytes, report.copy_ms.median
    ))
}

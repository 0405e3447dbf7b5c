//! What `bench --dynamic` reports.

use std::io;
use std::time::Duration;

use serde::Serialize;

use crate::cli::table;
use crate::cli::times::ms;

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
        let at = |index: usize| times.get(index).copied().map_or(0.0, ms);
        Self {
            median: at(times.len() / 2),
            least: at(0),
            most: at(times.len().saturating_sub(1)),
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
    fn median(spread: Option<Spread>) -> String {
        spread.map_or("-".to_owned(), |s| format!("{:.3}", s.median))
    }
    table::print(
        &report.rows,
        &[
            ("change", |r| r.change.to_owned()),
            ("instances", |r| r.instances.to_string()),
            ("triangles", |r| r.triangles.to_string()),
            ("changed", |r| r.changed.to_string()),
            ("backend", |r| r.backend.clone()),
            ("threads", |r| table::threads(r.threads)),
            ("update ms", |r| format!("{:.3}", r.update_ms.median)),
            ("refit ms", |r| format!("{:.3}", r.refit_ms.median)),
            ("least", |r| format!("{:.3}", r.refit_ms.least)),
            ("most", |r| format!("{:.3}", r.refit_ms.most)),
            ("nodes", |r| r.nodes.to_string()),
            ("rebuild ms", |r| median(r.rebuild_ms)),
            ("swap ms", |r| median(r.swap_ms)),
            ("refit then", |r| median(r.refit_after_swap_ms)),
            ("copies", |r| format!("{:.2}", r.copies)),
            ("of single-level", |r| format!("{:.4}", r.of_single_level)),
        ],
    )?;
    table::print_text(&format!(
        "single-level refit of all triangles, one thread: {:.3} ms; copy of the top level ({} bytes): {:.4} ms\n",
        report.single_level_refit_ms.median, report.top_level_bytes, report.copy_ms.median
    ))
}

//! What a soak found.

use serde::Serialize;

use super::Context;
use super::bound::{NODES, Work};
use super::clock::Timed;
use super::flat::Means;
use super::mirrors::Tally;
use super::times::Row;
use crate::cli::table;
use crate::cli::table::say;
use crate::error::HostError;

/// Frames beyond their bound that a report lists; it counts all.
const LISTED: usize = 20;

/// How often what was done.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub(super) struct Counts {
    pub added: u32,
    pub removed: u32,
    pub moved: u32,
    pub dimmed: u32,
    /// Meshes.
    pub deformed: u32,
    /// Meshes removed with their instances, and others added.
    pub exchanged: u32,
    /// Rebuilds swapped in.
    pub adopted: u32,
    /// Frames that waited for one, by the deterministic rule.
    pub waited: u32,
    /// Frames whose own thread built, since no other could be started.
    pub inline: u32,
    /// Most bytes that the start of a frame put into meshes that are built anew, of [`Report::bytes`].
    pub copied: u32,
    /// Frames in which all was checked.
    pub checked: u32,
    /// Instances touched, once for each frame, and nodes of the top level computed.
    pub touched: u64,
    pub nodes: u64,
}

/// A part of a frame that took longer than its bound.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Violation {
    frame: u32,
    what: &'static str,
    thread_ns: u64,
    wall_ns: u64,
    bound_ns: u64,
    changed: Work,
    /// Whether the frame swapped a rebuild in.
    adopted: bool,
}

impl Violation {
    pub fn new(
        frame: u32,
        what: &'static str,
        time: &Timed,
        bound: std::time::Duration,
        work: &Work,
        adopted: bool,
    ) -> Self {
        Self {
            frame,
            what,
            thread_ns: time.thread.as_nanos() as u64,
            wall_ns: time.wall.as_nanos() as u64,
            bound_ns: bound.as_nanos() as u64,
            changed: *work,
            adopted,
        }
    }
}

/// Parts of frames that took longer than their bound: how many, and the first of them.
#[derive(Default)]
pub(super) struct Beyond {
    pub count: usize,
    pub first: Vec<Violation>,
}

impl Beyond {
    pub fn take(&mut self, violation: impl FnOnce() -> Violation) {
        self.count += 1;
        if self.count <= LISTED {
            self.first.push(violation());
        }
    }
}

#[derive(Clone, Debug, Serialize)]
pub(super) struct Report {
    pub frames: u32,
    pub seed: u32,
    /// At the end.
    pub instances: usize,
    pub lights: usize,
    pub edits: Counts,
    /// Most bytes that the start of a frame may put into meshes that are built anew.
    pub bytes: u32,
    pub rows: Vec<Row>,
    /// Parts of frames that took longer than their bound, by the thread's clock.
    pub beyond: usize,
    /// All parts of frames there were, and how many in 1000 may take longer.
    pub parts: usize,
    pub late: u32,
    pub first_beyond: Vec<Violation>,
    /// The invariant that did not hold, which ended the soak.
    pub invalid: Option<String>,
    pub memory: Means,
    pub process: Means,
    pub devices: Vec<Tally>,
}

impl Report {
    /// Nodes of the top level computed for each instance touched.
    fn nodes_each(&self) -> f64 {
        self.edits.nodes as f64 / self.edits.touched.max(1) as f64
    }

    /// Whether what was counted kept its bounds, memory is flat, all is valid, and no word of a device differs.
    fn is_sound(&self) -> bool {
        let equal = self.devices.iter().all(|device| device.different == 0);
        self.invalid.is_none()
            && self.edits.inline == 0
            && self.edits.copied <= self.bytes
            && self.nodes_each() <= NODES
            && self.memory.is_good()
            && self.process.is_good()
            && equal
    }

    /// Whether no more parts of frames took longer than their bound than may.
    fn is_in_time(&self) -> bool {
        self.beyond * 1000 <= self.late as usize * self.parts
    }

    /// Whether every frame kept its bounds, of time and of what was counted.
    pub fn is_good(&self) -> bool {
        self.is_sound() && self.is_in_time()
    }
}

pub(super) fn print(context: &Context, report: &Report) -> Result<(), HostError> {
    if context.json {
        table::print_json(report)?;
        return Ok(());
    }
    table::print(
        &report.rows,
        &[
            ("what", |r| r.what.to_owned()),
            ("clock", |r| r.clock.to_owned()),
            ("median µs", |r| format!("{:.1}", r.median * 1e-3)),
            ("99 %", |r| format!("{:.1}", r.p99 * 1e-3)),
            ("most", |r| format!("{:.1}", r.most * 1e-3)),
        ],
    )?;
    let edits = &report.edits;
    say!(
        "\n{} frames, {} instances and {} lights at the end: {} added, {} removed, {} moved, {} dimmed; meshes: {} deformed, {} \
         exchanged; {} rebuilds swapped in, {} frames waited for one; valid at {} checks",
        report.frames,
        report.instances,
        report.lights,
        edits.added,
        edits.removed,
        edits.moved,
        edits.dimmed,
        edits.deformed,
        edits.exchanged,
        edits.adopted,
        edits.waited,
        edits.checked
    )?;
    say!(
        "nodes of the top level computed for each instance touched: {:.1}, at most {NODES}",
        report.nodes_each()
    )?;
    say!(
        "bytes put into meshes by the start of a frame: {} at most, of {}; frames that built on their own thread: {}",
        edits.copied,
        report.bytes,
        edits.inline
    )?;
    for (what, means) in [("scene", &report.memory), ("process", &report.process)] {
        say!(
            "memory of the {what}: {:.2} MB in the second quarter, {:.2} MB in the last: {}",
            means.second_quarter * 1e-6,
            means.last_quarter * 1e-6,
            means.verdict()
        )?;
    }
    for device in &report.devices {
        say!(
            "{}: {} words compared, {} different{}",
            device.name,
            device.compared,
            device.different,
            if device.different > 0 {
                format!(", {:?}", device.arrays)
            } else {
                String::new()
            }
        )?;
    }
    for one in &report.first_beyond {
        say!(
            "frame {}: {} took {:.1} µs, bound {:.1} µs; {} instances and {} triangles changed, {} triangles added, {} nodes \
             computed{}",
            one.frame,
            one.what,
            one.thread_ns as f64 * 1e-3,
            one.bound_ns as f64 * 1e-3,
            one.changed.instances,
            one.changed.triangles,
            one.changed.built,
            one.changed.nodes,
            if one.adopted {
                ", a rebuild was swapped in"
            } else {
                ""
            }
        )?;
    }
    say!(
        "time, by the thread's clock: {} of {} parts of frames beyond their bound, {:.2} in 1000, of which {} may: {}",
        report.beyond,
        report.parts,
        report.beyond as f64 * 1000.0 / report.parts.max(1) as f64,
        report.late,
        if report.is_in_time() { "good" } else { "LATE" }
    )?;
    if let Some(invalid) = &report.invalid {
        say!("INVALID: {invalid}")?;
    }
    say!(
        "words, invariants, memory and counts of work: {}",
        if report.is_sound() { "good" } else { "WRONG" }
    )?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is late is told apart from what is wrong, and as many parts may be late as was said.
    #[test]
    fn late_is_not_wrong() {
        let flat = Means {
            second_quarter: 1.0,
            last_quarter: 1.0,
            flat: true,
            judged: true,
        };
        let mut report = Report {
            frames: 1000,
            seed: 0,
            instances: 0,
            lights: 0,
            edits: Counts::default(),
            bytes: 0,
            rows: Vec::new(),
            beyond: 8,
            parts: 4000,
            late: 0,
            first_beyond: Vec::new(),
            invalid: None,
            memory: flat,
            process: flat,
            devices: Vec::new(),
        };
        assert!(report.is_sound() && !report.is_in_time() && !report.is_good());
        report.late = 2;
        assert!(report.is_good());
        report.late = 1;
        assert!(!report.is_good());
        (report.beyond, report.invalid) = (0, Some("a node".to_owned()));
        assert!(report.is_in_time() && !report.is_good());
        (report.invalid, report.edits.copied) = (None, 1);
        assert!(!report.is_sound());
    }
}

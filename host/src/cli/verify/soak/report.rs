//! What a soak found.

use lightbvh::bvh::FrameStart;
use serde::Serialize;

use super::flat::Means;
use super::mirrors::Tally;
use crate::cli::measure::times::Spread;
use crate::cli::table::{self, say};
use crate::error::HostError;

/// How often what was done.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub(in crate::cli::verify) struct Counts {
    pub added: u32,
    pub removed: u32,
    pub moved: u32,
    pub dimmed: u32,
    /// Meshes.
    pub deformed: u32,
    /// Meshes removed with their instances, and others added.
    pub exchanged: u32,
    /// Top levels swapped in, and meshes.
    pub swapped: u32,
    pub rebuilt: u32,
    /// Frames that waited for a build, by the deterministic rule.
    pub waited: u32,
    /// Frames whose own thread built, since no other could be started.
    pub inline: u32,
    /// Frames in which all was checked.
    pub checked: u32,
}

impl Counts {
    pub fn take(&mut self, start: &FrameStart) {
        self.swapped += u32::from(start.swapped);
        self.rebuilt += start.meshes;
        self.waited += u32::from(!start.waited.is_zero());
        self.inline += u32::from(start.inline);
    }
}

/// The parts of a frame, in their order.
const PHASES: [&str; 4] = ["begin-frame", "apply", "refit", "end-frame"];

/// Thread time of a part of all frames.
#[derive(Clone, Debug, Serialize)]
pub(in crate::cli::verify) struct Row {
    what: &'static str,
    us: Spread,
}

/// Thread time by phase and frame, µs; written once before the first, so that memory does not grow by it.
pub(super) struct Times([Vec<f32>; 4]);

impl Times {
    pub fn new(frames: u32) -> Self {
        Self(std::array::from_fn(|_| vec![f32::MAX; frames as usize]))
    }

    pub fn take(&mut self, frame: u32, phases: [f64; 4]) {
        for (list, time) in self.0.iter_mut().zip(phases) {
            list[frame as usize] = time as f32;
        }
    }

    pub fn rows(self) -> Vec<Row> {
        let of = |(what, list): (_, Vec<f32>)| Row {
            what,
            us: Spread::of(list.into_iter().map(f64::from)),
        };
        PHASES.into_iter().zip(self.0).map(of).collect()
    }
}

#[derive(Clone, Debug, Serialize)]
pub(in crate::cli::verify) struct Report {
    pub frames: u32,
    pub seed: u32,
    /// At the end.
    pub instances: usize,
    pub lights: usize,
    pub edits: Counts,
    pub rows: Vec<Row>,
    /// The invariant that did not hold, which ended the soak.
    pub invalid: Option<String>,
    pub memory: Means,
    pub process: Means,
    pub devices: Vec<Tally>,
}

impl Report {
    /// Whether memory is flat, all is valid, and no word of a device differs.
    pub fn is_good(&self) -> bool {
        let equal = self.devices.iter().all(|device| device.different == 0);
        self.invalid.is_none() && self.memory.is_good() && self.process.is_good() && equal
    }
}

pub(in crate::cli::verify) fn print(report: &Report) -> Result<(), HostError> {
    table::print(
        &report.rows,
        &[
            ("what", |r| r.what.to_owned()),
            ("median µs", |r| format!("{:.1}", r.us.median)),
            ("99 %", |r| format!("{:.1}", r.us.p99)),
            ("most", |r| format!("{:.1}", r.us.most)),
        ],
    )?;
    let edits = &report.edits;
    say!(
        "\n{} frames, {} instances and {} lights at the end: {} added, {} removed, {} moved, {} dimmed; meshes: {} deformed, {} \
         exchanged, {} rebuilt; {} top levels swapped in; frames that waited for a build: {}, that built: {}; valid at {} checks",
        report.frames,
        report.instances,
        report.lights,
        edits.added,
        edits.removed,
        edits.moved,
        edits.dimmed,
        edits.deformed,
        edits.exchanged,
        edits.rebuilt,
        edits.swapped,
        edits.waited,
        edits.inline,
        edits.checked
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
    if let Some(invalid) = &report.invalid {
        say!("INVALID: {invalid}")?;
    }
    say!(
        "words, invariants and memory: {}",
        if report.is_good() { "good" } else { "WRONG" }
    )?;
    Ok(())
}

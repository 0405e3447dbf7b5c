//! Times of all frames, by phase.

use std::time::Duration;

use serde::Serialize;

use super::clock::Timed;

/// The parts of a frame, in their order.
pub(super) const PHASES: [&str; 4] = ["begin-frame", "edit", "refit", "end-frame"];

/// A phase of all frames by one clock.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Row {
    pub what: &'static str,
    /// `thread`: processor time; `wall`.
    pub clock: &'static str,
    pub unit: &'static str,
    pub median: f64,
    pub p99: f64,
    pub most: f64,
}

/// Nanoseconds by phase and clock, frame by frame; written once before the first, so that memory does not grow by them.
pub(super) struct Times {
    thread: [Vec<u32>; 4],
    wall: [Vec<u32>; 4],
}

impl Times {
    pub fn new(frames: u32) -> Self {
        let list = || vec![u32::MAX; frames as usize];
        Self {
            thread: std::array::from_fn(|_| list()),
            wall: std::array::from_fn(|_| list()),
        }
    }

    pub fn take(&mut self, frame: u32, phases: &[Timed; 4]) {
        let ns = |time: Duration| u32::try_from(time.as_nanos()).unwrap_or(u32::MAX);
        for (phase, time) in phases.iter().enumerate() {
            self.thread[phase][frame as usize] = ns(time.thread);
            self.wall[phase][frame as usize] = ns(time.wall);
        }
    }

    pub fn rows(&self) -> Vec<Row> {
        let clocks = [("thread", &self.thread), ("wall", &self.wall)];
        let rows = clocks.into_iter().flat_map(|(clock, lists)| {
            PHASES
                .into_iter()
                .zip(lists)
                .map(move |(what, list)| row(what, clock, list))
        });
        rows.collect()
    }
}

fn row(what: &'static str, clock: &'static str, list: &[u32]) -> Row {
    let mut sorted = list.to_vec();
    sorted.sort_unstable();
    let last = sorted.len().saturating_sub(1) as f64;
    let part = |share: f64| f64::from(sorted[(last * share).ceil() as usize]);
    Row {
        what,
        clock,
        unit: "ns",
        median: part(0.5),
        p99: part(0.99),
        most: part(1.0),
    }
}

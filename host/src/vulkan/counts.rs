//! What a device was asked to do, counted.

use serde::Serialize;
use std::ops::Sub;
use std::sync::atomic::{AtomicU64, Ordering};

/// Work that a device was given since it was opened; the difference of two says what lay between.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Counts {
    /// Command buffers submitted.
    pub submissions: u64,
    /// Times that the host stood still until submitted work had ended.
    pub waits: u64,
    /// Regions of copies, from the host or between buffers of the device.
    pub regions: u64,
    /// Short runs of words that a dispatch put in their places.
    pub runs: u64,
    /// Bytes that the host wrote for the device.
    pub bytes: u64,
    /// Buffers made, those for staging too.
    pub buffers: u64,
}

impl Sub for Counts {
    type Output = Self;

    fn sub(self, before: Self) -> Self {
        Self {
            submissions: self.submissions - before.submissions,
            waits: self.waits - before.waits,
            regions: self.regions - before.regions,
            runs: self.runs - before.runs,
            bytes: self.bytes - before.bytes,
            buffers: self.buffers - before.buffers,
        }
    }
}

/// [`Counts`] that count on.
#[derive(Debug, Default)]
pub(super) struct Counters {
    pub submissions: AtomicU64,
    pub waits: AtomicU64,
    pub regions: AtomicU64,
    pub runs: AtomicU64,
    pub bytes: AtomicU64,
    pub buffers: AtomicU64,
}

impl Counters {
    pub fn now(&self) -> Counts {
        let read = |counter: &AtomicU64| counter.load(Ordering::Relaxed);
        Counts {
            submissions: read(&self.submissions),
            waits: read(&self.waits),
            regions: read(&self.regions),
            runs: read(&self.runs),
            bytes: read(&self.bytes),
            buffers: read(&self.buffers),
        }
    }
}

/// Counts `more`.
pub(super) fn count(counter: &AtomicU64, more: u64) {
    counter.fetch_add(more, Ordering::Relaxed);
}

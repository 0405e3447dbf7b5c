//! Records that the passes write, for comparison.

use crate::words::Record;

/// A node of `N`.
pub const fn node_record<N>() -> Record {
    record("node", size_of::<N>() / size_of::<u32>())
}

/// A sampled light.
pub const SAMPLED_RECORD: Record = record("sampled light", 3);

/// A pmf.
pub const PMF_RECORD: Record = record("pmf", 1);

/// A pixel.
pub const PIXEL_RECORD: Record = record("pixel", 3);

const fn record(name: &'static str, words: usize) -> Record {
    Record { name, words }
}

//! Times of several runs.

use std::time::{Duration, Instant};

/// Milliseconds.
pub(super) fn ms(time: Duration) -> f64 {
    time.as_secs_f64() * 1e3
}

/// The time that half of the runs take at most.
pub(super) fn median(times: &[Duration]) -> Duration {
    let mut sorted = times.to_vec();
    sorted.sort_unstable();
    sorted.get(sorted.len() / 2).copied().unwrap_or_default()
}

/// [`median`], in milliseconds.
pub(super) fn median_ms(times: &[Duration]) -> f64 {
    ms(median(times))
}

/// Time of `work`.
pub(super) fn timed(work: impl FnOnce()) -> Duration {
    let start = Instant::now();
    work();
    start.elapsed()
}

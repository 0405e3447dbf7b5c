//! Times of several runs.

use std::time::{Duration, Instant};

use serde::Serialize;

use crate::error::HostError;

/// Milliseconds.
pub(in crate::cli) fn ms(time: Duration) -> f64 {
    time.as_secs_f64() * 1e3
}

/// Processor time that `work` takes on this thread, µs: waits and other programs are not in it. If the system has no such
/// clock, elapsed time.
pub(in crate::cli) fn thread_us<T>(work: impl FnOnce() -> T) -> (f64, T) {
    let (wall, start) = (Instant::now(), thread_time());
    let result = work();
    let end = thread_time();
    let time = end.zip(start).map(|(end, start)| end.saturating_sub(start));
    (time.unwrap_or_else(|| wall.elapsed()).as_secs_f64() * 1e6, result)
}

/// Processor time of this thread so far.
#[cfg(unix)]
fn thread_time() -> Option<Duration> {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
    Duration::try_from(time).ok()
}

#[cfg(not(unix))]
fn thread_time() -> Option<Duration> {
    None
}

/// Times of each of `sides`, ns per item of `items`, turn by turn: what else the machine does meets all alike. `time` gets a side
/// and the turn, and each turn begins with another side, so that none always follows the same one.
pub(in crate::cli) fn in_turns(
    sides: usize,
    turns: u32,
    items: u32,
    mut time: impl FnMut(usize, u32) -> Result<Duration, HostError>,
) -> Result<Vec<Vec<f64>>, HostError> {
    let mut times = vec![Vec::new(); sides];
    for turn in 0..turns {
        for k in 0..sides {
            let at = (k + turn as usize) % sides;
            times[at].push(1e6 * ms(time(at, turn)?) / f64::from(items));
        }
    }
    Ok(times)
}

/// Median, 99 % quantile and maximum of some values.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub(in crate::cli) struct Spread {
    pub median: f64,
    pub p99: f64,
    pub most: f64,
}

impl Spread {
    /// Zeros if there are no values.
    pub fn of(values: impl IntoIterator<Item = f64>) -> Self {
        let [median, p99, most] = quantiles(values, [0.5, 0.99, 1.0]);
        Self { median, p99, most }
    }
}

/// [`Spread`] of durations, ms.
pub(in crate::cli) fn spread_ms(times: &[Duration]) -> Spread {
    Spread::of(times.iter().copied().map(ms))
}

/// The least values that at least these shares of the others do not exceed; zeros if there are no values.
pub(in crate::cli) fn quantiles<const N: usize>(
    values: impl IntoIterator<Item = f64>,
    shares: [f64; N],
) -> [f64; N] {
    let mut sorted: Vec<f64> = values.into_iter().collect();
    sorted.sort_by(f64::total_cmp);
    let last = sorted.len().saturating_sub(1) as f64;
    shares.map(|share| sorted.get((last * share).ceil() as usize).copied().unwrap_or(0.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sleep_takes_no_thread_time() {
        let (time, ()) = thread_us(|| std::thread::sleep(Duration::from_millis(30)));
        assert!(cfg!(not(unix)) || time < 10_000.0, "{time}");
    }

    #[test]
    fn each_side_begins_as_often() {
        let mut order = Vec::new();
        let times = in_turns(3, 2, 4, |at, _| {
            order.push(at);
            Ok(Duration::from_nanos(8 * (at as u64 + 1)))
        });
        assert_eq!(order, [0, 1, 2, 1, 2, 0]);
        let times = times.expect("no side fails");
        for (at, of) in times.iter().enumerate() {
            let expected = 2.0 * (at as f64 + 1.0);
            assert!(
                of.len() == 2 && of.iter().all(|ns| (ns - expected).abs() < 1e-9),
                "{times:?}"
            );
        }
    }
}

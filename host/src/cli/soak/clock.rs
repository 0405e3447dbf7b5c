//! What a piece of work took, by the wall's clock and by the thread's.

use std::time::{Duration, Instant};

/// Time of a piece of work.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Timed {
    /// By the clock on the wall: what the frame stands still, whatever else the machine does meanwhile.
    pub wall: Duration,
    /// Processor time of this thread alone: what the work takes. Time that the thread waits in, for another thread or for a
    /// core, is not of it. Where the system has no such clock, the same as the wall's.
    pub thread: Duration,
}

impl Timed {
    pub fn of<T>(work: impl FnOnce() -> T) -> (Self, T) {
        let (wall, thread) = (Instant::now(), now());
        let result = work();
        let thread = now().zip(thread).map(|(end, start)| end.saturating_sub(start));
        let wall = wall.elapsed();
        let time = Self {
            wall,
            thread: thread.unwrap_or(wall),
        };
        (time, result)
    }

    /// Of both pieces of work.
    pub fn and(self, other: Self) -> Self {
        Self {
            wall: self.wall + other.wall,
            thread: self.thread + other.thread,
        }
    }
}

/// Processor time of this thread so far.
#[cfg(unix)]
fn now() -> Option<Duration> {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
    Duration::try_from(time).ok()
}

#[cfg(not(unix))]
fn now() -> Option<Duration> {
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_thread_that_sleeps_takes_no_time_of_its_own() {
        let (time, ()) = Timed::of(|| std::thread::sleep(Duration::from_millis(30)));
        assert!(time.wall >= Duration::from_millis(30));
        assert!(
            cfg!(not(unix)) || time.thread < Duration::from_millis(10),
            "{time:?}"
        );
    }
}

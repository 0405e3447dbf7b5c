//! Whether memory stays as it is: the last quarter of the frames against the second.

use serde::Serialize;

/// The last quarter may have as much more than the second as chance brings: what is live changes all the time.
const GROWTH: f64 = 1.2;
/// The process has room besides the scene, bytes: lists that keep their capacity, and the allocator's own.
const ROOM: f64 = 16e6;
/// Frames in which trees are swapped in by each rule once.
const ROUND: u32 = 2 * super::RULED;

/// Sums of a quantity over the second and the last quarter.
#[derive(Clone, Copy, Debug, Default)]
struct Quarters {
    sums: [f64; 2],
    counts: [u32; 2],
}

impl Quarters {
    fn take(&mut self, quarter: u32, value: f64) {
        let at = match quarter {
            1 => 0,
            3 => 1,
            _ => return,
        };
        self.sums[at] += value;
        self.counts[at] += 1;
    }

    fn means(&self, room: f64, judged: bool) -> Means {
        let mean = |at: usize| self.sums[at] / f64::from(self.counts[at].max(1));
        let (second_quarter, last_quarter) = (mean(0), mean(1));
        Means {
            second_quarter,
            last_quarter,
            flat: last_quarter <= second_quarter * GROWTH + room,
            judged,
        }
    }
}

/// Bytes in the mean over a quarter of the frames.
#[derive(Clone, Copy, Debug, Serialize)]
pub(in crate::cli::verify) struct Means {
    pub second_quarter: f64,
    pub last_quarter: f64,
    pub flat: bool,
    /// Whether each quarter saw a round of all rules: else they differ by those.
    pub judged: bool,
}

impl Means {
    /// Whether nothing speaks against it.
    pub fn is_good(&self) -> bool {
        self.flat || !self.judged
    }

    pub fn verdict(&self) -> &'static str {
        match (self.flat, self.judged) {
            (true, _) => "flat",
            (false, true) => "GROWS",
            (false, false) => "not judged over fewer than 4,000 frames",
        }
    }
}

/// What the scene and the process hold.
pub(super) struct Memory {
    frames: u32,
    scene: Quarters,
    process: Quarters,
}

impl Memory {
    pub fn new(frames: u32) -> Self {
        Self {
            frames,
            scene: Quarters::default(),
            process: Quarters::default(),
        }
    }

    /// After a frame in which the scene held so many bytes.
    pub fn take(&mut self, frame: u32, bytes: usize) {
        let quarter = (u64::from(frame) * 4 / u64::from(self.frames)) as u32;
        self.scene.take(quarter, bytes as f64);
        // The system is asked seldom: that takes as long as a frame.
        if frame.is_multiple_of(16)
            && let Some(usage) = memory_stats::memory_stats()
        {
            self.process.take(quarter, usage.physical_mem as f64);
        }
    }

    fn is_judged(&self) -> bool {
        self.frames >= 4 * ROUND
    }

    /// Of [`lightbvh::Bvh::memory`].
    pub fn scene(&self) -> Means {
        self.scene.means(0.0, self.is_judged())
    }

    /// Of all that the process has in memory.
    pub fn process(&self) -> Means {
        self.process.means(ROOM, self.is_judged())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn growing_memory_is_not_flat() {
        let (mut flat, mut grows) = (Quarters::default(), Quarters::default());
        for frame in 0..400_u32 {
            flat.take(frame / 100, 1e6 + f64::from(frame % 7));
            grows.take(frame / 100, 1e6 + 1e4 * f64::from(frame));
        }
        assert!(flat.means(0.0, true).is_good() && !grows.means(0.0, true).is_good());
        assert!(grows.means(0.0, false).is_good() && !grows.means(0.0, false).flat);
        let [short, long] = [3_999, 4_000].map(|frames| Memory::new(frames).scene().judged);
        assert!(!short && long);
    }
}

//! The options of the comparison.

use std::path::PathBuf;

use crate::cli::reading::Reading;
use crate::method::Method;
use crate::scene::BUILT_IN;

/// Frames that are brought up together: within a block a method runs frame after frame by itself, so that what it does
/// beside a frame (a rebuild) has the time it would have in an application. The first frame of a block follows other
/// methods' work and is not timed.
pub(super) const BLOCK: u32 = 8;

#[derive(Debug, clap::Args)]
pub(in crate::cli) struct Args {
    /// A built-in scene or a .gltf, .glb, .obj or .ply file; may be repeated [default: all built-in ones].
    #[arg(long)]
    scene: Vec<String>,
    #[command(flatten)]
    pub(super) reading: Reading,
    /// Frames to measure; the animation runs from 0 to the last of them [default: 0,50,100,150].
    #[arg(long, value_delimiter = ',', value_name = "N,N,...", value_parser = clap::value_parser!(u32).range(..=100_000))]
    frames: Vec<u32>,
    /// Shadow rays per pixel [default: 6].
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=65_536))]
    samples: Option<u32>,
    /// Images of each frame, each with its own random numbers [default: 8].
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=4096))]
    seeds: Option<u32>,
    /// Columns [default: 320].
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=4096))]
    width: Option<u32>,
    /// Rows [default: 180].
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=4096))]
    height: Option<u32>,
    /// Shadow rays per pixel of the reference [default: 1024].
    #[arg(long, value_parser = clap::value_parser!(u32).range(2..=1 << 20))]
    reference_samples: Option<u32>,
    /// Frames that times are averaged over, in runs of seven [default: 35, on devices 7].
    #[arg(long, value_parser = clap::value_parser!(u32).range(..=100_000))]
    timed_frames: Option<u32>,
    /// Methods to compare; may be repeated [default: all].
    #[arg(long, value_enum)]
    method: Vec<Method>,
    /// What renders; devices render one image of each frame [default: all, with --quick: cpu].
    #[arg(long, value_enum)]
    backend: Option<Backends>,
    /// Folder for the tables; made if it is not there.
    #[arg(long, default_value = "compare", value_name = "DIR")]
    pub(super) out: PathBuf,
    /// Small images and few frames: a look within a minute. Other options still count.
    #[arg(long)]
    quick: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum Backends {
    /// The CPU.
    Cpu,
    /// Every Vulkan device, or the one of --device.
    Vulkan,
    /// Both.
    All,
}

/// The comparison as the options give it.
#[derive(Clone, Debug)]
pub(super) struct Plan {
    pub scenes: Vec<String>,
    /// Ascending, each once, at least one.
    pub frames: Vec<u32>,
    pub samples: u32,
    pub seeds: u32,
    pub width: u32,
    pub height: u32,
    /// Even.
    pub reference_samples: u32,
    pub timed_frames: u32,
    pub timed_on_devices: u32,
    pub methods: Vec<Method>,
    pub backends: Backends,
}

impl Args {
    /// The comparison as the options give it.
    pub(super) fn plan(&self) -> Plan {
        let choose = |given: Option<u32>, usual: u32, quick: u32| {
            given.unwrap_or(if self.quick { quick } else { usual })
        };
        let mut frames = self.frames.clone();
        if frames.is_empty() {
            frames = if self.quick {
                vec![0, 25, 50]
            } else {
                vec![0, 50, 100, 150]
            };
        }
        frames.sort_unstable();
        frames.dedup();
        let mut methods = self.method.clone();
        if methods.is_empty() {
            methods = Method::ALL.to_vec();
        }
        methods.sort_unstable();
        methods.dedup();
        let mut scenes = Vec::new();
        for scene in &self.scene {
            if !scenes.contains(scene) {
                scenes.push(scene.clone());
            }
        }
        if scenes.is_empty() {
            scenes = BUILT_IN.iter().map(|&name| name.to_owned()).collect();
        }
        Plan {
            scenes,
            samples: choose(self.samples, 6, 6),
            seeds: choose(self.seeds, 8, 3),
            width: choose(self.width, 320, 96),
            height: choose(self.height, 180, 54),
            reference_samples: choose(self.reference_samples, 1024, 128).next_multiple_of(2),
            timed_frames: choose(self.timed_frames, 35, 7),
            timed_on_devices: choose(self.timed_frames, 7, 7),
            frames,
            methods,
            // A software device takes longer for its small images than the CPU for everything.
            backends: self
                .backend
                .unwrap_or(if self.quick { Backends::Cpu } else { Backends::All }),
        }
    }
}

impl Plan {
    /// The last frame.
    pub fn last(&self) -> u32 {
        self.frames.last().copied().unwrap_or(0)
    }

    /// Columns and rows.
    pub fn size(&self) -> (u32, u32) {
        (self.width, self.height)
    }

    /// Shadow rays in thousands, what the progress bar counts, of an image with `samples` per pixel.
    pub fn work(&self, samples: u32) -> u64 {
        (u64::from(self.width) * u64::from(self.height) * u64::from(samples)).div_ceil(1000)
    }
}

/// The blocks up to the `last` frame that have so many timed frames between them, as far as there are as many, spread evenly.
pub(super) fn timed_blocks(last: u32, timed_frames: u32) -> Vec<u32> {
    // A last block of one frame, which follows no other of its block, does not count.
    let blocks = u64::from(last.div_ceil(BLOCK));
    let wanted = u64::from(timed_frames.div_ceil(BLOCK - 1)).min(blocks);
    (0..wanted)
        .map(|i| ((2 * i + 1) * blocks / (2 * wanted)) as u32)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::timed_blocks;

    #[test]
    fn timed_blocks_are_spread_over_the_animation() {
        assert_eq!(timed_blocks(150, 35), [1, 5, 9, 13, 17]);
        assert_eq!(timed_blocks(150, 1), [9]);
        assert_eq!(timed_blocks(150, 1000), (0..19).collect::<Vec<u32>>());
        assert_eq!(timed_blocks(16, 1000), [0, 1]);
        assert_eq!(timed_blocks(17, 1000), [0, 1, 2]);
        assert!(timed_blocks(0, 10).is_empty());
        assert!(timed_blocks(150, 0).is_empty());
    }
}

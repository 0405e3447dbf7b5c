//! The options of the comparison.

use std::ffi::OsString;

use crate::cli::reading::Reading;
use crate::method::Method;
use crate::scene::BUILT_IN;

/// Frames that times are averaged over: the last ones.
pub(super) const TIMED: u32 = 8;

/// The comparison as the options give it.
#[derive(Clone, Debug, clap::Args)]
pub(in crate::cli) struct Args {
    /// A built-in scene or a .gltf, .glb or .obj file; may be repeated.
    #[arg(long, default_values = BUILT_IN)]
    pub(super) scene: Vec<OsString>,
    #[command(flatten)]
    pub(super) reading: Reading,
    /// Frames to measure; the animation runs from 0 to the last of them.
    #[arg(long, value_delimiter = ',', value_name = "N,N,...", value_parser = clap::value_parser!(u32).range(..=100_000))]
    #[arg(default_value = "0,50,100,150", default_value_if("quick", "true", "0,25,50"))]
    pub(super) frames: Vec<u32>,
    /// Shadow rays per pixel.
    #[arg(long, default_value_t = 6, value_parser = clap::value_parser!(u32).range(1..=65_536))]
    pub(super) samples: u32,
    /// Images of each frame, each with its own random numbers [with --quick: 3].
    #[arg(long, default_value_t = 8, default_value_if("quick", "true", "3"), value_parser = clap::value_parser!(u32).range(1..=4096))]
    pub(super) seeds: u32,
    /// Columns [with --quick: 96].
    #[arg(long, default_value_t = 320, default_value_if("quick", "true", "96"), value_parser = clap::value_parser!(u32).range(1..=4096))]
    pub(super) width: u32,
    /// Rows [with --quick: 54].
    #[arg(long, default_value_t = 180, default_value_if("quick", "true", "54"), value_parser = clap::value_parser!(u32).range(1..=4096))]
    pub(super) height: u32,
    /// Shadow rays per pixel of the reference, an even number [with --quick: 128].
    #[arg(long, default_value_t = 1024, default_value_if("quick", "true", "128"), value_parser = clap::value_parser!(u32).range(2..=1 << 20))]
    pub(super) reference_samples: u32,
    /// Methods to compare; may be repeated [default: all].
    #[arg(long, value_enum, default_values_t = Method::ALL.iter().copied(), hide_default_value = true)]
    pub(super) method: Vec<Method>,
    /// What renders; devices render one image of each frame [with --quick: cpu].
    #[arg(long, value_enum, default_value_t = Backends::All, default_value_if("quick", "true", "cpu"))]
    pub(super) backend: Backends,
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

impl Args {
    /// The same with scenes, frames and methods in order, each once.
    pub fn ordered(&self) -> Self {
        let mut plan = self.clone();
        plan.frames.sort_unstable();
        plan.frames.dedup();
        plan.method.sort_unstable();
        plan.method.dedup();
        plan.scene.dedup();
        plan.reference_samples = plan.reference_samples.next_multiple_of(2);
        plan
    }

    /// Whether images of a frame are rendered, for their errors or their time.
    pub fn is_rendered(&self, frame: u32) -> bool {
        frame + TIMED >= self.last() || self.frames.contains(&frame)
    }

    /// The last frame.
    pub fn last(&self) -> u32 {
        self.frames.last().copied().unwrap_or(0)
    }

    /// Columns and rows.
    pub fn size(&self) -> (u32, u32) {
        (self.width, self.height)
    }
}

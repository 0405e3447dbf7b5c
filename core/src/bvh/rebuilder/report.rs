//! The reports of a rebuilder.

use alloc::string::String;
use core::fmt;
use core::time::Duration;

/// Report of the start of a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct FrameStart {
    /// Whether a new top level was swapped in.
    pub swapped: bool,
    /// Number of meshes that got new trees.
    pub meshes: u32,
    /// How long this call waited for the thread, under [`Swap::Deterministic`](super::Swap::Deterministic) alone; zero without a
    /// clock.
    pub waited: Duration,
    /// How long the build took that was swapped in; zero if none was, or without a clock.
    pub built: Duration,
    /// Whether it was built at the end of its frame on the frame's own thread, since no other could be started.
    pub inline: bool,
}

/// A build panicked. The scene keeps its trees.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RebuildError {
    /// The message of the panic.
    pub message: String,
}

impl fmt::Display for RebuildError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let message = &self.message;
        write!(
            f,
            "the build panicked: {message}; the scene keeps its trees and the next build is tried again"
        )
    }
}

impl core::error::Error for RebuildError {}

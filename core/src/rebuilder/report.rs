//! What a rebuilder tells of a frame.

use alloc::string::String;
use core::fmt;
use core::time::Duration;

/// What the start of a frame did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct FrameStart {
    /// Whether parts of the top level, or small meshes, that were built came back; those that gain nothing, or whose place is
    /// gone, change nothing. Large meshes are counted by `adopted` and `parts`.
    pub swapped: bool,
    /// How long this call waited for threads, under [`Swap::Deterministic`](super::Swap::Deterministic) alone; zero where there
    /// is no clock.
    pub waited: Duration,
    /// How long the worker took for what was swapped in; zero if nothing was, and where there is no clock.
    pub built: Duration,
    /// Number of large meshes whose new trees took their places since the last frame began.
    pub adopted: u32,
    /// Number of parts of large meshes that were built anew, the rest of their trees being as good as it was, and put in place
    /// since then.
    pub parts: u32,
    /// Number of large meshes, and of parts of them, whose new trees came to nothing since then: the mesh is gone or was built
    /// by other means, building failed, or a part found no tree of as many nodes. Deformation drops none: what changes
    /// meanwhile is computed in the new tree. Each is told as its thread is done.
    pub dropped: u32,
    /// Whether large meshes wait because another [`Rebuilder`](crate::Rebuilder) has some of the same light BVH under way. One
    /// for each light BVH is enough: a second one begins no large mesh as long as the first has one under way.
    pub is_second: bool,
    /// Number of trees of large meshes, and of parts of them, that are under way, wait for it, or have instances that are still
    /// to follow: one mesh may have two.
    pub under_way: u32,
    /// What of [`RebuilderParams::bytes`](super::RebuilderParams::bytes) went into them in this call: bytes copied, written for
    /// the first time, and nodes computed at bytes that take as long. What changes meanwhile is computed in the new trees
    /// beside that.
    pub copied: u32,
    /// Whether it was built at the end of its frame on the frame's own thread, since no other could be started.
    pub inline: bool,
}

/// Why a rebuild came to nothing. The scene goes on with the tree that it has.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum RebuildError {
    /// Building panicked.
    Panicked {
        /// What the panic said.
        message: String,
    },
    /// It was taken from another light BVH than the one that it came back to.
    Foreign,
}

impl fmt::Display for RebuildError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Panicked { message } => write!(
                f,
                "the rebuild panicked: {message}; the scene keeps its refitted tree and the next rebuild is tried anew"
            ),
            Self::Foreign => write!(f, "{}", crate::bvh::Foreign),
        }
    }
}

impl core::error::Error for RebuildError {}

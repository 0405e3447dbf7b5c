//! How a rebuilder works.

use crate::bvh::RebuildParams;

/// When results are swapped in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Swap {
    /// In the frame that is due or the first one after it that finds the worker done; never waits.
    #[default]
    WhenReady,
    /// In the very frame that is due, waiting for the worker if it is not done: trees depend on the edits alone, never on
    /// how fast the worker was, so that runs and devices can be compared word for word.
    Deterministic,
}

/// How a [`Rebuilder`](crate::Rebuilder) works. By default due after 1 frame, [`Swap::WhenReady`], [`RebuildParams`]'s defaults.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RebuilderParams {
    /// Frames from the end of the one that starts a rebuild to the start of the one in which it is due, at least 1; 0 is
    /// taken as 1.
    pub after: u32,
    /// What happens when it is due and not done.
    pub swap: Swap,
    /// What is built anew.
    pub rebuild: RebuildParams,
    /// Bytes that the start of a frame copies of meshes that are built anew, at least 16 KiB; 256 KiB, the default, take 0.1 ms
    /// as a rule. In frames in which a part of the top level may come in, a quarter of them. A mesh of less than a 256th as
    /// many triangles is put in place at once, as is a single level, whose lights are its triangles; a larger one over the
    /// frames that it takes, 112 bytes for a triangle before it is built, and its nodes and trails after it; memory that is new
    /// counts three times. Then instances follow the new tree, 256 in a frame, all at once where the mesh itself changes. A
    /// subtree that lost its shape while the mesh as a whole has not, of a node for each 128 bytes at most, is built anew
    /// alone.
    pub bytes: u32,
    /// Large meshes that are under way at a time, each with a thread of its own; at least 1. By default 2.
    pub meshes: u32,
    /// Most instances of the parts of the top level that a frame hands to the worker; at least 1024, the default, with which
    /// start and end of a frame take 0.1 to 0.2 ms, and more than 0.3 ms once in some hundreds to ten thousand, by the machine
    /// and how busy it is (`docs/dynamics.md`). Each further 1000 take about 0.1 ms more of each. Where all of many instances
    /// move their own ways, what is built in a frame decides how good the tree is: with *N* of them every part has its turn in
    /// *N* over this many frames.
    pub leaves: u32,
}

impl Default for RebuilderParams {
    /// Due at the start of the next frame; no frame waits.
    fn default() -> Self {
        Self {
            after: 1,
            swap: Swap::WhenReady,
            rebuild: RebuildParams::default(),
            bytes: 1 << 18,
            meshes: 2,
            leaves: 1024,
        }
    }
}

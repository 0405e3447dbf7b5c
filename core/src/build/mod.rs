//! Builders, for either level and any width: wide nodes by Ward's criterion; and for comparison binned top-down splitting by
//! SAH (paper Eq. 2) or SAOH (Eq. 3), whose binary tree is collapsed into a wide one.
//!
//! A builder decides the topology only; bounds come from [refit](crate::refit), so that a built tree and a refitted one
//! are the same to the bit. Builders run on the CPU alone, but keep to the same exact arithmetic: every platform builds
//! the same tree.

mod binary;
mod collapse;
mod cost;
mod primitive;
mod split;
mod topology;
mod ward;

pub use cost::Heuristic;
pub(crate) use topology::{build_each, build_over, build_top};

use alloc::vec::Vec;

use crate::trail::BitTrail;

/// A tree without bounds.
#[derive(Debug)]
pub(crate) struct Topology<N> {
    /// Nodes in depth-first order, the root first; links count from it.
    pub nodes: Vec<N>,
    /// (index of primitive, its trail), in depth-first order.
    pub trails: Vec<(u32, BitTrail)>,
    /// Number of levels.
    pub depth: u32,
}

/// Build options.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BuildParams {
    /// How a tree is built.
    pub heuristic: Heuristic,
    /// Buckets per axis, 2 to 32; others are brought into that range. More find better splits and take longer.
    /// [`Heuristic::Ward`] takes half as many for ranges of fewer than 256 lights.
    pub buckets: u32,
    /// Whether the top level may hold up to `W` parts of a mesh in place of the whole, each of which takes a leaf and its edits: less variance
    /// where meshes lie among each other, and where spots share a mesh with other lights. Other meshes stay as they are.
    pub opens: bool,
}

/// Most buckets per axis.
pub(crate) const MAX_BUCKETS: u32 = 32;

impl BuildParams {
    /// Ward's criterion, 16 buckets: the default.
    pub const BALANCED: Self = Self {
        heuristic: Heuristic::Ward,
        buckets: 16,
        opens: true,
    };
    /// As the paper builds, by its `heuristic`: 16 buckets, meshes left whole.
    #[must_use]
    pub const fn paper(heuristic: Heuristic) -> Self {
        Self {
            heuristic,
            opens: false,
            ..Self::BALANCED
        }
    }
}

impl Default for BuildParams {
    /// [`BALANCED`](Self::BALANCED).
    fn default() -> Self {
        Self::BALANCED
    }
}

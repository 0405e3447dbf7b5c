//! The arrays of a light BVH on a device.

use lightbvh::Instance;
use lightbvh::node::Holds;
use lightbvh::refit::BlasRoot;

/// An array of a light BVH that a device holds in a storage buffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Buffer {
    /// The nodes of bottom levels, and behind them those of the top level. A refit writes them.
    Nodes,
    /// The triangles of bottom levels, or their lights of another kind, in the spaces of their meshes, for a refit.
    Triangles,
    /// The instances.
    Instances,
    /// The roots of bottom levels. A refit writes them.
    Roots,
    /// The bit trails of triangles, `LightTree::trail_words` words each, and the links of the top level, for pmfs.
    Trails,
}

impl Buffer {
    /// All of them.
    pub const ALL: [Self; 5] = [
        Self::Nodes,
        Self::Triangles,
        Self::Instances,
        Self::Roots,
        Self::Trails,
    ];

    /// Name of the bindings that take it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Nodes => "nodes",
            Self::Triangles => "triangles",
            Self::Instances => "instances",
            Self::Roots => "roots",
            Self::Trails => "trails",
        }
    }

    /// The buffer of that name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|buffer| buffer.name() == name)
    }

    /// Bytes from one element to the next, in a tree with nodes of layout `N`.
    #[must_use]
    pub fn stride<N: Holds>(self) -> u32 {
        let bytes = match self {
            Self::Nodes => size_of::<N>(),
            Self::Triangles => size_of::<N::Light>(),
            Self::Instances => size_of::<Instance>(),
            Self::Roots => size_of::<BlasRoot>(),
            Self::Trails => size_of::<u32>(),
        };
        bytes as u32
    }
}

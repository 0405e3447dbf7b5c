//! The arrays of a light BVH on a device.

use bytemuck::cast_slice;
use lightbvh::node::{Holds, Node};
use lightbvh::refit::BlasRoot;
use lightbvh::{Bvh, Instance};

/// An array of a light BVH that a device holds in a storage buffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Buffer {
    /// The nodes of both levels. A refit writes them.
    Nodes,
    /// The triangles of bottom levels, or their lights of another kind, in the spaces of their meshes, for a refit.
    Triangles,
    /// The instances.
    Instances,
    /// The roots of bottom levels. A refit writes them.
    Roots,
    /// The bit trails of triangles, `LightTree::trail_words` words each, for pmfs.
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

    /// What the buffer holds for `bvh`, before a refit that is still to come. May be empty, which a buffer of Vulkan may not
    /// be: make it one element then.
    #[must_use]
    pub fn bytes<N: Node<W>, I, const W: usize>(self, bvh: &Bvh<N, I, W>) -> &[u8] {
        let tree = bvh.tree();
        match self {
            Self::Nodes => cast_slice(tree.nodes),
            Self::Triangles => cast_slice(bvh.triangles()),
            Self::Instances => cast_slice(tree.instances),
            Self::Roots => cast_slice(bvh.roots()),
            Self::Trails => cast_slice(tree.trails),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn buffers_are_found_by_name() {
        for buffer in Buffer::ALL {
            assert_eq!(Buffer::named(buffer.name()), Some(buffer));
        }
        assert_eq!(Buffer::named("results"), None);
    }
}

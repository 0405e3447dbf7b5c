//! The light BVH that the kernels are compiled for, and its picker for the renderer.

use bytemuck::{Pod, Zeroable};
use lightbvh::{CompactNode, Eq4, INVALID, Instance, LightTree, ShadingPoint, traverse};

use crate::shading::pick::{PickLight, Picked};

/// Children per node.
pub const WIDTH: usize = 4;
/// Node layout.
pub type Node = CompactNode<WIDTH>;
/// Importance.
pub type Importance = Eq4;
/// The tree that kernels walk: leaves of a top level are instances.
pub type Tree<'a> = LightTree<'a, Node, Instance>;

/// What a [`LightTree`] holds besides its arrays; part of the push constants.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct TreePush {
    /// Index of the node that a walk starts at.
    pub root: u32,
    /// Words per bit trail, 1 or 2.
    pub trail_words: u32,
    /// 1 when the tree has mesh lights, else 0: an empty buffer cannot be bound, so its length does not tell.
    pub two_level: u32,
}

impl TreePush {
    /// The tree over the given arrays.
    #[inline]
    #[must_use]
    pub fn tree<'a>(&self, nodes: &'a [Node], meshes: &'a [Instance], trails: &'a [u32]) -> Tree<'a> {
        LightTree {
            nodes,
            root: self.root,
            meshes,
            trails,
            trail_words: self.trail_words,
        }
    }

    /// The picker over that tree.
    #[inline]
    #[must_use]
    pub fn picker<'a>(&self, nodes: &'a [Node], meshes: &'a [Instance], trails: &'a [u32]) -> BvhPicker<'a> {
        BvhPicker {
            tree: self.tree(nodes, meshes, trails),
            two_level: self.two_level != 0,
        }
    }
}

/// Picks lights by sampling a light BVH.
#[derive(Clone, Copy)]
pub struct BvhPicker<'a> {
    /// The light BVH.
    pub tree: Tree<'a>,
    /// Whether it has mesh lights; as [`TreePush::two_level`].
    pub two_level: bool,
}

impl PickLight for BvhPicker<'_> {
    #[inline]
    fn pick(&self, point: &ShadingPoint, random: u32) -> Picked {
        let sampled = traverse::sample::<Node, Importance, Instance, WIDTH>(&self.tree, point, random);
        Picked {
            light: sampled.light,
            pmf: sampled.pmf,
        }
    }

    #[inline]
    fn pmf(&self, point: &ShadingPoint, light: u32, mesh: u32) -> f32 {
        let mesh = if self.two_level { mesh } else { INVALID };
        traverse::pmf::<Node, Importance, Instance, WIDTH>(&self.tree, point, light, mesh)
    }
}

//! From ranges to nodes: which node, which slot, which trail.

use alloc::vec::Vec;

use super::grow::{Children, Growth};
use super::range::Range;
use crate::build::topology::Topology;
use crate::node::{Node, kind};
use crate::trail::{BitTrail, max_levels};

/// What primitives stand for.
pub(crate) trait Leaves: Sync {
    /// Levels of nodes that a primitive takes at most.
    const LEVELS: u32;
    /// Number of lights of primitive `index`.
    fn count(&self, index: u32) -> usize;
    /// Light `k` of primitive `index`.
    fn light(&self, index: u32, k: usize) -> u32;
}

/// Every primitive is a light.
pub(super) struct Single;

impl Leaves for Single {
    const LEVELS: u32 = 0;

    fn count(&self, _: u32) -> usize {
        1
    }

    fn light(&self, index: u32, _: usize) -> u32 {
        index
    }
}

/// Emits nodes, whose children are found by `growth`.
pub(super) struct Emitter<'a, L, const W: usize> {
    pub leaves: &'a L,
    pub leaf_kind: u32,
    pub growth: Growth<'a>,
}

impl<L: Leaves, const W: usize> Emitter<'_, L, W> {
    /// Emits the node over `range` at `level`; recursion is as deep as the tree, at most 64.
    pub fn node<N: Node<W>>(&self, range: Range<'_>, level: u32, trail: BitTrail, out: &mut Topology<N>) {
        match &*range.here {
            [group] if L::LEVELS > 0 => {
                let node = out.node(level);
                return self.lights(group.index, node, &mut 0, level, trail, out);
            }
            _ => {}
        }
        let children = self.children(range, level);
        let node = out.node(level);
        let mut slot = 0;
        for (range, opened) in children.into_iter() {
            if let Some(index) = self.leaf(&range, opened) {
                self.lights(index, node, &mut slot, level, trail, out);
            } else {
                out.link(node, slot);
                self.node(range, level + 1, trail.with::<W>(level, slot as u32), out);
                slot += 1;
            }
        }
    }

    /// The children of the node over `range` at `level`.
    pub fn children<'r>(&self, range: Range<'r>, level: u32) -> Children<'r, W> {
        let below = max_levels(W) - L::LEVELS - level - 1;
        let growth = Growth {
            capacity: W.checked_pow(below).unwrap_or(usize::MAX),
            ..self.growth
        };
        growth.children(range, self.leaves)
    }

    /// No nodes yet, and room for the tree over `count` primitives: nodes are seldom filled by less than five eighths.
    pub fn room_for<N: Node<W>>(&self, count: usize) -> Topology<N> {
        let groups = L::LEVELS as usize * count;
        let lights = if groups > 0 { count * W } else { count };
        let nodes = groups + 2 * count / W + 1;
        Topology {
            nodes: Vec::with_capacity(nodes),
            trails: Vec::with_capacity(lights),
            depth: 0,
        }
    }

    /// The primitive of `range`, if its lights are children of the same node.
    pub fn leaf(&self, range: &Range<'_>, opened: bool) -> Option<u32> {
        match &*range.here {
            [only] if opened || self.leaves.count(only.index) == 1 => Some(only.index),
            _ => None,
        }
    }

    /// Puts the lights of primitive `index` into `node`, from `slot` on.
    pub fn lights<N: Node<W>>(
        &self,
        index: u32,
        node: usize,
        slot: &mut usize,
        level: u32,
        trail: BitTrail,
        out: &mut Topology<N>,
    ) {
        for k in 0..self.leaves.count(index) {
            let light = self.leaves.light(index, k);
            out.nodes[node].set_child(*slot, self.leaf_kind, light);
            out.trails.push((light, trail.with::<W>(level, *slot as u32)));
            *slot += 1;
        }
    }
}

impl<N> Topology<N> {
    /// A new node without children; returns its index.
    pub(super) fn node<const W: usize>(&mut self, level: u32) -> usize
    where
        N: Node<W>,
    {
        self.nodes.push(N::EMPTY);
        self.depth = self.depth.max(level + 1);
        self.nodes.len() - 1
    }

    /// Links `slot` of `node` to the node that is emitted next.
    fn link<const W: usize>(&mut self, node: usize, slot: usize)
    where
        N: Node<W>,
    {
        let next = self.nodes.len() as u32;
        self.nodes[node].set_child(slot, kind::INNER, next);
    }
}

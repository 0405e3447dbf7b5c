//! From ranges to nodes: which node, which slot, which trail.

use super::grow::Growth;
use super::range::Range;
use crate::build::Topology;
use crate::node::{Node, kind};
use crate::trail::{BitTrail, max_levels};

/// Emits nodes, whose children are found by `growth`.
pub(super) struct Emitter<'a> {
    pub leaf_kind: u32,
    pub growth: Growth<'a>,
}

impl Emitter<'_> {
    /// Emits the node over `range` at `level`; recursion is as deep as the tree, at most 64.
    pub fn node<N: Node<W>, const W: usize>(
        &self,
        range: Range<'_>,
        level: u32,
        trail: BitTrail,
        out: &mut Topology<N>,
    ) {
        let growth = Growth {
            capacity: W.checked_pow(max_levels(W) - level - 1).unwrap_or(usize::MAX),
            ..self.growth
        };
        let children = growth.children::<W>(range);
        let node = out.nodes.len();
        out.nodes.push(N::EMPTY);
        out.depth = out.depth.max(level + 1);
        for (slot, range) in children.into_iter().enumerate() {
            let own = trail.with::<W>(level, slot as u32);
            if let [only] = &*range.here {
                out.nodes[node].set_child(slot, self.leaf_kind, only.index);
                out.trails.push((only.index, own));
            } else {
                let next = out.nodes.len() as u32;
                out.nodes[node].set_child(slot, kind::INNER, next);
                self.node(range, level + 1, own, out);
            }
        }
    }
}

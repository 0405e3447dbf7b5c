//! What lies beside a way down.

use super::descend::Descent;
use super::neighbor::Neighbor;
use crate::exact;
use crate::node::{LightNode, kind};
use crate::trail::max_levels;
use crate::tree::{INVALID, LightTree, MeshLeaf};

/// A node passed by a way, with importance on one side of the slot taken.
#[derive(Clone, Copy)]
pub(super) struct Beside<const W: usize> {
    pub index: u32,
    pub position: u32,
    pub before: f32,
    pub weights: [f32; W],
    pub sum: f32,
}

impl<const W: usize> Beside<W> {
    pub const NONE: Self = Self {
        index: INVALID,
        position: 0,
        before: 0.0,
        weights: [0.0; W],
        sum: 1.0,
    };

    /// The node that `neighbor` is a child of.
    #[inline(always)]
    pub fn of(neighbor: &Neighbor<W>) -> Self {
        Self {
            index: if neighbor.is_none() {
                INVALID
            } else {
                neighbor.index
            },
            position: neighbor.position,
            before: neighbor.before,
            weights: neighbor.weights,
            sum: neighbor.sum,
        }
    }

    /// Becomes `other` if `open`, the slots with importance on this side of it, is not zero: which side has any is as
    /// random as the choice, so there is no branch.
    #[inline(always)]
    pub fn replace(&mut self, open: u32, other: &Self) {
        let mask = exact::mask(open);
        self.index = exact::masked_u32(mask, other.index, self.index);
        self.position = exact::masked_u32(mask, other.position, self.position);
        self.before = exact::masked(mask, other.before, self.before);
        self.sum = exact::masked(mask, other.sum, self.sum);
        for slot in 0..W {
            self.weights[slot] = exact::masked(mask, other.weights[slot], self.weights[slot]);
        }
    }

    /// The child with importance nearest to the slot that the way of `d` took there.
    #[inline(always)]
    pub fn nearest<N: LightNode<W>, L: MeshLeaf>(
        &self,
        tree: &LightTree<'_, N, L>,
        d: &Descent<W>,
        right: bool,
    ) -> Neighbor<W> {
        let taken = d.path.slot::<W>(self.position);
        let mut nearest = INVALID;
        for i in 0..W {
            // From the far end of the side, so that the nearest comes last.
            let slot = if right { W - 1 - i } else { i };
            let beyond = if right {
                slot as u32 > taken
            } else {
                (slot as u32) < taken
            };
            let better = beyond & (self.weights[slot] > 0.0);
            nearest = if better { slot as u32 } else { nearest };
        }
        let exists = self.index < tree.nodes.len() as u32 && nearest < W as u32;
        let node = &tree.nodes[if exists { self.index as usize } else { 0 }];
        let slot = if exists { nearest as usize } else { 0 };
        Neighbor {
            index: if exists { self.index } else { 0 },
            kind: if exists { node.kind(slot) } else { kind::EMPTY },
            link: node.link(slot),
            mesh: if self.position < max_levels(W) {
                INVALID
            } else {
                d.mesh
            },
            position: self.position,
            slot: nearest,
            before: self.before,
            weights: self.weights,
            sum: self.sum,
        }
    }
}

//! Instances that have moved away from those around them.

use alloc::vec::Vec;

use super::cost::Cluster;
use crate::bvh::{Bvh, Trails};
use crate::node::LightNode;
use crate::tree::INVALID;

/// An instance is put in elsewhere once its node would cost more than this part of what the node above costs as a whole. In a tree as
/// built, a node's share is about 1/32.
const SHARE: f64 = 0.25;

impl<N: LightNode<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// Takes those of `moved` instances, which may repeat, out of the top level that make their nodes wide, and adds them to `out`.
    pub(in crate::bvh) fn take_misplaced(&mut self, mut moved: Vec<u32>, out: &mut Vec<u32>) {
        moved.sort_unstable();
        moved.dedup();
        moved.retain(|&index| self.is_misplaced(index));
        for index in moved {
            self.remove_leaf(index);
            out.push(index);
        }
    }

    /// Whether an instance lies so far from the others of its node, as they were at the last refit, that another place is worth
    /// looking for. Looks at a slot of each of the two nodes above.
    fn is_misplaced(&self, index: u32) -> bool {
        let placed = &self.placed[index as usize];
        if !placed.live || placed.node == INVALID {
            return false;
        }
        let above = self.parents[placed.node as usize];
        if above == INVALID {
            return false;
        }
        let around = Cluster::new(
            &self.nodes[above as usize].summary(self.slot_above(placed.node)),
            0,
        );
        let whole = match self.parents[above as usize] {
            INVALID => Cluster::new(&self.nodes[above as usize].merged(), 0),
            top => Cluster::new(&self.nodes[top as usize].summary(self.slot_above(above)), 0),
        };
        let own = Cluster::new(&self.in_world(index), 1);
        around.cost() + own.merging(&around) > SHARE * whole.cost()
    }
}

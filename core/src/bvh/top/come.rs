//! What came and what went while a part of the top level was built: put into it, and taken out.

use alloc::vec::Vec;

use super::cost::Cluster;
use super::insert::Item;
use crate::bvh::{Bvh, Trails};
use crate::node::{Node, kind};
use crate::tree::INVALID;

/// Most instances and subtrees that a frame puts into parts anew since they came while those were built. Where there are more a
/// part is given up, and tried again: a frame would take longer than it may.
pub(super) const MOST: usize = 40;

/// How many a frame has time for yet.
#[derive(Clone, Copy, Debug)]
pub(in crate::bvh) struct Quota {
    /// Instances and subtrees that are put in.
    pub come: usize,
    /// Those that are taken out since they went, or are in a subtree that was built anew: up to as many as a node has children
    /// go at a time.
    pub gone: usize,
}

impl Default for Quota {
    fn default() -> Self {
        Self {
            come: MOST,
            gone: 4 * MOST,
        }
    }
}

impl<N: Node<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// Fills nodes that miss children, in the order of a tree from its root, and computes each node above them once.
    pub(super) fn fill_all(&mut self, lost: Vec<u32>) {
        let mut changed = Vec::new();
        // From the lowest: what is above may go with them.
        for node in lost.into_iter().rev() {
            if self.top.number(node) == INVALID {
                continue;
            }
            let lowest = self.fill(node);
            changed.push(lowest);
            // What hangs elsewhere now is known where it hangs before the next is filled.
            let mut above = lowest;
            self.refit_node(above);
            while above != node && self.top.number(node) != INVALID && self.parents[above as usize] != INVALID
            {
                above = self.parents[above as usize];
                self.refit_node(above);
            }
        }
        self.update_paths(&changed);
    }

    /// Puts in what has come, and computes each node above it once: until then a node knows of the children that came below its
    /// own as much as before.
    pub(in crate::bvh) fn insert_come(&mut self, instances: &[u32], subtrees: Vec<u32>) {
        self.epoch += u64::from(!instances.is_empty());
        let mut changed = Vec::new();
        for &index in instances {
            self.placed[index as usize].hung = self.epoch;
            self.settle_placed(index);
            self.insert_one(index, &mut changed);
        }
        self.insert_subtrees(subtrees, &mut changed);
        self.top.touched.extend(&changed);
        self.update_paths(&changed);
    }

    fn insert_one(&mut self, index: u32, changed: &mut Vec<u32>) {
        let item = self.item_of(index);
        let node = self.put(item);
        debug_assert!(node.is_some(), "an instance fits into any tree");
        if let Some(node) = node {
            self.know(node);
            changed.push(node);
        }
        self.changes.new.mark_instance(index);
    }

    /// What was put into a node is known in it, and its levels and instances above.
    fn know(&mut self, node: u32) {
        self.refit_node(node);
        let mut node = node;
        while node != INVALID {
            self.measure(node);
            node = self.parents[node as usize];
        }
    }

    /// Puts subtrees that hang nowhere where they cost least; one that would get too deep gives way to its children.
    fn insert_subtrees(&mut self, subtrees: Vec<u32>, changed: &mut Vec<u32>) {
        let mut left = subtrees;
        while let Some(node) = left.pop() {
            let number = self.top.number(node) as usize;
            let item = Item {
                kind: kind::INNER,
                link: node,
                cluster: Cluster::new(&self.nodes[node as usize].merged(), self.top.counts[number]),
                height: self.top.heights[number],
            };
            if let Some(above) = self.put(item) {
                self.know(above);
                changed.push(above);
                continue;
            }
            let own = self.nodes[node as usize];
            self.free_top_node(node);
            for slot in 0..W {
                match own.kind(slot) {
                    kind::INNER => left.push(own.link(slot)),
                    kind::MESH => self.insert_one(own.link(slot), changed),
                    _ => {}
                }
            }
        }
    }
}

//! What there may be to gain below a node of the top level that it has not lost: what changed, and what was built anew, since it was tried.

use super::rebuild::{PART, TopTree};
use crate::bvh::{Bvh, Trails};
use crate::levels::Levels;
use crate::node::Node;
use crate::tree::INVALID;

/// A sum of counts, which stays the greatest number once it is there.
pub(super) fn bounded_sum(a: u32, b: u32) -> u32 {
    (u64::from(a) + u64::from(b)).min(u64::from(u32::MAX)) as u32
}

impl<N: Node<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// Changes of instances below a node of the top level, by number, since it was built or tried.
    pub(in crate::bvh) fn changes_since_tried(&self, number: usize) -> u32 {
        match self.top.moved[number] > self.top.tried[number] {
            true => self.top.changes[number],
            false => 0,
        }
    }

    /// Counts the changes of instances, and children that came and went, at all nodes above them, of which `top` lists each with all above.
    pub(in crate::bvh) fn note_changes(&mut self, instances: &[u32], top: &Levels) {
        let now = self.epoch + 1;
        let mut counted = core::mem::take(&mut self.top.counted);
        for &instance in instances {
            let number = self.top.number(self.placed[instance as usize].node);
            if number != INVALID {
                counted[number as usize] += 1;
            }
        }
        // Each after those below it.
        for &node in top.nodes() {
            let number = self.top.number(node) as usize;
            let count = core::mem::take(&mut counted[number]);
            if count > 0 {
                self.top.changes[number] = bounded_sum(self.changes_since_tried(number), count);
                self.top.moved[number] = now;
                let above = self.top.number(self.parents[node as usize]);
                if above != INVALID {
                    counted[above as usize] += count;
                }
            }
        }
        self.top.counted = counted;
    }

    /// A part has nothing to gain: its nodes are as good as built. Of what was tried above parts that is said of the nodes above parts
    /// alone: those of parts were looked at over subtrees that were kept, and may gain all that these lost.
    pub(super) fn note_tried(&mut self, root: u32, tree: &TopTree<N>, since: u64) {
        let number = self.top.number(root) as usize;
        self.top.stirred[number] = 0;
        for &part in tree.inner.iter().rev() {
            if let Some(node) = self.node_of(part) {
                if tree.kept.is_empty() || self.top.counts[part.number as usize] > PART {
                    self.judge_new(node);
                    self.top.tried[part.number as usize] = since;
                } else {
                    self.judge_list(&[node]);
                }
            }
        }
        let mut node = self.parents[root as usize];
        while node != INVALID {
            self.judge_list(&[node]);
            node = self.parents[node as usize];
        }
    }

    /// So many instances below `node` are in a subtree that was built anew, or as good.
    pub(super) fn stir(&mut self, node: u32, count: u32) {
        let mut node = node;
        while node != INVALID {
            self.stir_one(self.top.number(node) as usize, count);
            node = self.parents[node as usize];
        }
    }

    /// The same of one node, by number.
    pub(in crate::bvh) fn stir_one(&mut self, number: usize, count: u32) {
        self.top.stirred[number] = bounded_sum(self.top.stirred[number], count);
    }
}

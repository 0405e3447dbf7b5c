//! What there may be to gain below a node of the top level that it has not lost: what changed, and what was built anew, since
//! it was tried.

use super::Top;
use super::rebuild::{PART, TopTree};
use crate::bvh::changes::Counted;
use crate::bvh::{Bvh, Trails};
use crate::levels::Levels;
use crate::node::Node;
use crate::tree::INVALID;

/// A frame in which fewer than one in so many instances below a node changed is one in which it rests: a mesh that sways in
/// every frame, or a lamp that flickers, keeps no node from being tried.
const QUIET: u64 = 32;

/// A sum of counts, which stays the greatest number once it is there.
pub(super) fn bounded_sum(a: u32, b: u32) -> u32 {
    (u64::from(a) + u64::from(b)).min(u64::from(u32::MAX)) as u32
}

impl Top {
    /// Bits of a word of the format: much below the node changed in one frame, and anything did since it was tried.
    pub const FLAGS: u32 = Self::MOVED | Self::SEEN;
    const MOVED: u32 = 1 << 31;
    const SEEN: u32 = 1 << 30;

    /// What a rebuilder that begins now has to know of when the node of that number changed: whether it did.
    pub fn what_rests(&self, number: usize) -> u32 {
        let moved = if self.moved[number] > 0 { Self::MOVED } else { 0 };
        let seen = if self.seen[number] > self.tried[number] {
            Self::SEEN
        } else {
            0
        };
        moved | seen
    }

    /// Takes what [`what_rests`](Self::what_rests) told of the next number, as of the epoch 1.
    pub fn set_what_rests(&mut self, flags: u32) {
        self.moved.push(u64::from(flags & Self::MOVED != 0));
        self.seen.push(u64::from(flags & Self::SEEN != 0));
    }

    /// The node of that number was built, or tried to build anew, from what there was at the epoch `since`. What changed after
    /// it is still to be tried.
    pub(super) fn note_tried(&mut self, number: usize, since: u64) {
        self.tried[number] = since;
        if self.moved[number] <= since {
            self.changes[number] = 0;
        }
    }
}

impl<N: Node<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// Counts the changes of instances, and children that came and went, at all nodes above them, of which `top` lists each
    /// with all above. Of refitted instances those count that were edited since the last count, and all of swept bottom levels:
    /// that some of a mesh's triangles changed, or that its tree is another, is nothing to the top level, as long as its flux
    /// is about the same.
    pub(in crate::bvh) fn note_changes(&mut self, counted: &Counted, top: &Levels) {
        let Counted { refitted, swept, all } = counted;
        let now = self.epoch + 1;
        let since = core::mem::replace(&mut self.top.counted_at, self.epoch).max(self.top.built_at);
        let mut counts = core::mem::take(&mut self.top.counted);
        let mut count = |leaf: u32| {
            let number = self.top.number(self.placed[leaf as usize].node);
            if number != INVALID {
                counts[number as usize] += 1;
            }
        };
        for &leaf in refitted {
            let placed = &self.placed[leaf as usize];
            let whole = match placed.part_of {
                INVALID => placed,
                whole => &self.placed[whole as usize],
            };
            if whole.changed > since {
                count(leaf);
            }
        }
        for &blas in swept {
            let users = &self.meshes[self.blases[blas as usize].mesh as usize].users;
            let leaves = users.iter().flat_map(|&user| self.leaves_of(user));
            leaves.for_each(&mut count);
        }
        for &leaf in all {
            let number = self.top.number(self.placed[leaf as usize].node);
            if number != INVALID {
                self.top.seen[number as usize] = now;
            }
        }
        // Each after those below it.
        for &node in top.nodes() {
            let number = self.top.number(node) as usize;
            let count = core::mem::take(&mut counts[number]);
            // A node that was built since the last refit was built of what it finds.
            if count > 0 && self.top.tried[number] < now {
                self.top.changes[number] = bounded_sum(self.top.changes[number], count);
                if u64::from(count) * QUIET >= u64::from(self.top.counts[number]) {
                    self.top.moved[number] = now;
                }
            }
            let above = self.top.number(self.parents[node as usize]);
            if above != INVALID {
                counts[above as usize] += count;
                if self.top.seen[number] == now {
                    self.top.seen[above as usize] = now;
                }
            }
        }
        self.top.counted = counts;
    }

    /// A part has nothing to gain: its nodes are as good as built. Of what was tried above parts that is said of the nodes
    /// above parts alone: those of parts were looked at over subtrees that were kept, and may gain all that these lost.
    pub(super) fn note_tried(&mut self, root: u32, tree: &TopTree<N>, since: u64) {
        let number = self.top.number(root) as usize;
        self.top.stirred[number] = 0;
        for &part in tree.inner.iter().rev() {
            if let Some(node) = self.node_of(part) {
                if tree.kept.is_empty() || self.top.counts[part.number as usize] > PART {
                    self.judge_new(node);
                    self.top.note_tried(part.number as usize, since);
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

    /// So many instances below the node of that number are others than it was built for, as of the present epoch: it is to be
    /// tried, and once more when it rests.
    pub(in crate::bvh) fn unsettle_one(&mut self, number: usize, count: u32) {
        self.stir_one(number, count);
        self.top.changes[number] = bounded_sum(self.top.changes[number], count);
        self.top.moved[number] = self.epoch;
    }
}

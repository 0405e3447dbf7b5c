//! The top level: a tree over instances that edits patch and rebuilds replace.

mod tree;

use alloc::vec::Vec;
use core::ops::Range;

pub(super) use self::tree::TopTree;
use self::tree::{Place, without_children};
use super::{Bvh, Trails};
use crate::build::{Topology, build_top};
use crate::levels::Levels;
use crate::node::{LightNode, kind};
use crate::refit;
use crate::summary::Summary;
use crate::trail::{BitTrail, max_levels};
use crate::tree::INVALID;

/// The top level's place among the nodes.
#[derive(Clone, Debug, Default)]
pub(super) struct Top {
    pub root: u32,
    /// Its nodes: one range after a rebuild, more after instances were added.
    pub ranges: Vec<Range<u32>>,
    /// Its nodes by level.
    pub levels: Levels,
    /// Its nodes with instances.
    pub leaves: Vec<u32>,
    /// Number of levels.
    pub depth: u32,
    /// By node: its level; only those of the top level count.
    pub node_levels: Vec<u32>,
    /// By node: the last search that came by.
    pub marks: Vec<u32>,
    pub mark: u32,
}

impl<N: LightNode<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// A top level without instances: one empty node.
    pub(super) fn empty_top(&mut self) {
        self.replace_top(&[without_children::<N, W>()]);
    }

    /// Puts `nodes`, links counting from the first, which is the root, in place of the top level. Bounds of instances that
    /// changed meanwhile are marked by the caller.
    pub(super) fn replace_top(&mut self, nodes: &[N]) {
        self.place_top(nodes);
        self.index_top();
    }

    /// As [`replace_top`](Self::replace_top), with a tree that knows where everything in it is, but not what became of its
    /// instances since the scene's epoch stood at `since`: those gone leave empty slots.
    pub(super) fn replace_top_by(&mut self, tree: TopTree<N>, since: u64) {
        let range = self.place_top(&tree.nodes);
        if !self.place_instances(&tree.places, range.start, since) {
            for node in range {
                for slot in 0..W {
                    let own = &mut self.nodes[node as usize];
                    if own.kind(slot) == kind::MESH {
                        let placed = self.placed.get(own.link(slot) as usize);
                        if !placed.is_some_and(|placed| placed.live && placed.created <= since) {
                            own.set_child(slot, kind::EMPTY, 0);
                            self.changes.new.top_nodes.push(node);
                        }
                    }
                }
            }
            self.index_top();
            return;
        }
        let first = range.start;
        self.top.node_levels.resize(self.nodes.len(), 0);
        self.top.marks.resize(self.nodes.len(), 0);
        self.top.node_levels[first as usize..range.end as usize].copy_from_slice(&tree.node_levels);
        self.top.depth = tree.depth;
        self.top.levels = tree.levels;
        self.top.leaves = tree.leaves;
        for node in self.top.levels.nodes.iter_mut().chain(&mut self.top.leaves) {
            *node += first;
        }
    }

    /// Notes for every instance where it is a leaf, the nodes of `places` counting from `first`; false where one of them is
    /// no instance, or not the one that was there when the epoch stood at `since`.
    fn place_instances(&mut self, places: &[Place], first: u32, since: u64) -> bool {
        let mut places = places.iter().peekable();
        for (index, (placed, instance)) in (0..).zip(self.placed.iter_mut().zip(&mut self.instances)) {
            let Some(place) = places.next_if(|place| place.instance == index) else {
                placed.node = INVALID;
                continue;
            };
            if !placed.live || placed.created > since {
                return false;
            }
            placed.node = first + place.node;
            placed.slot = place.slot;
            if instance.trail() != place.trail {
                instance.set_trail(place.trail);
                self.changes.new.written_instances.push(index);
            }
        }
        places.peek().is_none()
    }

    /// Puts nodes in place of those of the top level.
    fn place_top(&mut self, nodes: &[N]) -> Range<u32> {
        for range in core::mem::take(&mut self.top.ranges) {
            self.node_ranges.give(range);
        }
        self.changes.forget_top();
        let range = self.place_nodes(nodes);
        self.top.root = range.start;
        self.top.ranges.push(range.clone());
        range
    }

    /// Builds the top level over all instances, here and now.
    pub(super) fn build_top(&mut self) {
        if self.live.is_empty() {
            self.empty_top();
        } else {
            let mut live = self.live.clone();
            live.sort_unstable();
            let topology: Topology<N> =
                build_top::<N, W>(live.into_iter().map(|i| (i, self.in_world(i))), &self.params);
            self.replace_top(&topology.nodes);
        }
        self.changes.new.whole_top = true;
    }

    /// Puts a tree over `added` instances beside the top level, below a new root. Where that would be too deep, everything
    /// is built anew.
    pub(super) fn insert_instances(&mut self, added: &[u32]) {
        if added.is_empty() {
            return;
        }
        let topology: Topology<N> =
            build_top::<N, W>(added.iter().map(|&i| (i, self.in_world(i))), &self.params);
        if self.top.leaves.is_empty() || self.top.depth.max(topology.depth) + 1 > max_levels(W) {
            self.build_top();
            return;
        }
        let new = self.place_nodes(&topology.nodes);
        let mut above = N::EMPTY;
        above.set_child(0, kind::INNER, 0);
        above.set_child(1, kind::INNER, 0);
        let root = self.place_nodes(&[above]);
        for (slot, child) in [(0, self.top.root), (1, new.start)] {
            self.nodes[root.start as usize].relink(slot, child);
            self.parents[child as usize] = root.start;
        }
        // Summaries of what is new, so that as much as possible is right before the next refit.
        for node in new.clone().rev().chain([root.start]) {
            self.nodes[node as usize] = refit::top(&self.nodes, &self.instances, &self.roots, node);
        }
        self.changes.new.instances.extend(added);
        self.top.root = root.start;
        self.top.ranges.extend([new, root]);
        self.index_top();
    }

    /// Takes the leaf of an instance out; its slot stays empty until the next rebuild.
    pub(super) fn remove_leaf(&mut self, index: u32) {
        let (node, slot) = {
            let placed = &self.placed[index as usize];
            (placed.node, placed.slot)
        };
        if node != INVALID {
            self.nodes[node as usize].set_child(slot as usize, kind::EMPTY, 0);
            self.changes.new.top_nodes.push(node);
            self.changes.new.written_nodes.push(node..node + 1);
        }
    }

    /// What is known of an instance in the world.
    fn in_world(&self, index: u32) -> N::Summary {
        let instance = &self.instances[index as usize];
        self.root_of(instance.blas).to_world(instance)
    }

    /// Walks the top level and notes where everything is: parents, levels, lists, and the place and trail of each instance.
    pub(super) fn index_top(&mut self) {
        let count = self.nodes.len();
        self.top.node_levels.resize(count, 0);
        self.top.marks.resize(count, 0);
        for placed in &mut self.placed {
            placed.node = INVALID;
        }
        self.top.leaves.clear();
        self.top.depth = 0;
        let mut pairs = Vec::new();
        let mut stack = alloc::vec![(self.top.root, 0, BitTrail::default())];
        self.parents[self.top.root as usize] = INVALID;
        while let Some((node, level, trail)) = stack.pop() {
            self.top.node_levels[node as usize] = level;
            self.top.depth = self.top.depth.max(level + 1);
            let mut leaf = false;
            for slot in (0..W).rev() {
                let (to, link) = {
                    let own = &self.nodes[node as usize];
                    (own.kind(slot), own.link(slot))
                };
                let own_trail = trail.with::<W>(level, slot as u32);
                if to == kind::INNER {
                    stack.push((link, level + 1, own_trail));
                } else if to == kind::MESH {
                    leaf = true;
                    let instance = &mut self.instances[link as usize];
                    if instance.trail() != own_trail {
                        instance.set_trail(own_trail);
                        self.changes.new.written_instances.push(link);
                    }
                    let placed = &mut self.placed[link as usize];
                    placed.node = node;
                    placed.slot = slot as u32;
                }
            }
            pairs.push((level, node));
            if leaf {
                self.top.leaves.push(node);
            }
        }
        self.top.levels = Levels::gather(pairs);
    }
}

#[cfg(test)]
mod tests;

//! The top level: a tree over instances that edits patch and rebuilds replace.

use alloc::vec::Vec;
use core::ops::Range;

use super::Scene;
use crate::build::{Primitive, Topology, build};
use crate::levels::Levels;
use crate::node::{LightNode, kind};
use crate::trail::{BitTrail, max_levels};
use crate::tree::{INVALID, MeshLeaf};

/// The top level's place among the nodes.
#[derive(Clone, Debug, Default)]
pub(super) struct Top {
    pub root: u32,
    /// Its nodes: one range after a rebuild, more after instances were added.
    pub ranges: Vec<Range<u32>>,
    /// Its nodes with inner children.
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

impl<N: LightNode<W>, const W: usize> Scene<N, W> {
    /// A top level without instances: one empty node.
    pub(super) fn empty_top(&mut self) {
        self.replace_top(&[N::EMPTY]);
    }

    /// Puts `nodes`, links counting from the first, which is the root, in place of the top level. Bounds of instances that
    /// changed meanwhile are marked by the caller.
    pub(super) fn replace_top(&mut self, nodes: &[N]) {
        for range in core::mem::take(&mut self.top.ranges) {
            self.node_ranges.give(range);
        }
        self.pending.top_nodes.clear();
        let range = self.place_nodes(nodes);
        self.top.root = range.start;
        self.top.ranges.push(range);
        self.index_top();
    }

    /// Builds the top level over all instances, here and now.
    pub(super) fn build_top(&mut self) {
        let mut primitives: Vec<Primitive> = (0..self.placed.len() as u32)
            .filter(|&i| self.placed[i as usize].live)
            .map(|i| self.primitive(i))
            .collect();
        if primitives.is_empty() {
            self.empty_top();
        } else {
            let topology: Topology<N> = build::<N, W>(&mut primitives, kind::MESH, &self.params);
            self.replace_top(&topology.nodes);
        }
        self.pending.whole_top = true;
    }

    /// Puts a tree over `added` instances beside the top level, below a new root. Where that would be too deep, everything
    /// is built anew.
    pub(super) fn graft(&mut self, added: &[u32]) {
        if added.is_empty() {
            return;
        }
        let mut primitives: Vec<Primitive> = added.iter().map(|&i| self.primitive(i)).collect();
        let topology: Topology<N> = build::<N, W>(&mut primitives, kind::MESH, &self.params);
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
        // All of the grafted tree and the new root lie above the new leaves, so the next refit gives them bounds.
        self.pending.instances.extend(added);
        self.top.root = root.start;
        self.top.ranges.extend([new, root]);
        self.index_top();
    }

    /// Takes the leaf of an instance out; its slot stays empty until the next rebuild.
    pub(super) fn prune(&mut self, index: u32) {
        let (node, slot) = {
            let placed = &self.placed[index as usize];
            (placed.node, placed.slot)
        };
        if node != INVALID {
            self.nodes[node as usize].set_child(slot as usize, kind::EMPTY, 0);
            self.pending.top_nodes.push(node);
            self.pending.written_nodes.push(node..node + 1);
        }
    }

    fn primitive(&self, index: u32) -> Primitive {
        let instance = &self.instances[index as usize];
        let bounds = self.roots[instance.blas as usize].bounds();
        Primitive::new(index, &instance.to_world(&bounds))
    }

    /// Walks the top level and notes where everything is: parents, levels, lists, and the place and trail of each instance.
    fn index_top(&mut self) {
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
            let (mut inner, mut leaf) = (false, false);
            for slot in (0..W).rev() {
                let (to, link) = {
                    let own = &self.nodes[node as usize];
                    (own.kind(slot), own.link(slot))
                };
                let way = trail.with::<W>(level, slot as u32);
                if to == kind::INNER {
                    inner = true;
                    stack.push((link, level + 1, way));
                } else if to == kind::MESH {
                    leaf = true;
                    let instance = &mut self.instances[link as usize];
                    if instance.trail() != way {
                        instance.set_trail(way);
                        self.pending.written_instances.push(link);
                    }
                    let placed = &mut self.placed[link as usize];
                    placed.node = node;
                    placed.slot = slot as u32;
                }
            }
            if inner {
                pairs.push((level, node));
            }
            if leaf {
                self.top.leaves.push(node);
            }
        }
        self.top.levels = Levels::gather(pairs);
    }
}

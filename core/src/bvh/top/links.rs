//! Links of the top level, down and up, and what is counted along them.

use alloc::vec::Vec;

use crate::bvh::blas::put;
use crate::bvh::{Bvh, Trails};
use crate::node::{Node, kind};
use crate::trail::place;
use crate::tree::INVALID;

impl<N: Node<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// A node of the top level without children, which hangs nowhere yet.
    pub(in crate::bvh) fn new_top_node(&mut self) -> u32 {
        let node = self.node_ranges.take(1).start;
        if self.nodes.len() <= node as usize {
            self.nodes.resize(node as usize + 1, N::EMPTY);
            self.parents.resize(node as usize + 1, INVALID);
        }
        self.nodes[node as usize] = N::EMPTY;
        self.parents[node as usize] = INVALID;
        let number = self.top.numbers.take(1).start;
        self.top.used += 1;
        put(&mut self.top.nodes, number, node, &INVALID);
        self.reserve_numbers();
        self.top.edits[number as usize] = 0;
        self.top.stirred[number as usize] = 0;
        self.top.moved[number as usize] = 0;
        self.top.seen[number as usize] = 0;
        self.top.tried[number as usize] = 0;
        self.top.changes[number as usize] = 0;
        self.top.counted[number as usize] = 0;
        self.top.number_of[node as usize] = number;
        self.note_birth(node);
        node
    }

    /// Tells a node of the top level from those that had its number before.
    pub(super) fn note_birth(&mut self, node: u32) {
        self.top.births += 1;
        let number = self.top.number(node) as usize;
        self.top.born[number] = self.top.births;
    }

    /// Takes a node out of the top level whose children hang elsewhere.
    pub(super) fn free_top_node(&mut self, node: u32) {
        let number = self.top.number(node);
        self.set_above(node, INVALID);
        self.top.number_of[node as usize] = INVALID;
        self.top.nodes[number as usize] = INVALID;
        self.top.numbers.give(number..number + 1);
        self.top.used -= 1;
        self.node_ranges.give(node..node + 1);
        self.top.levels = None;
    }

    /// Room for all numbers there are, and for all nodes.
    pub(super) fn reserve_numbers(&mut self) {
        let numbers = self.top.nodes.len();
        self.top.heights.resize(numbers, 0);
        self.top.counts.resize(numbers, 0);
        self.top.edits.resize(numbers, 0);
        self.top.born.resize(numbers, 0);
        self.top.stirred.resize(numbers, 0);
        self.top.moved.resize(numbers, 0);
        self.top.seen.resize(numbers, 0);
        self.top.tried.resize(numbers, 0);
        self.top.changes.resize(numbers, 0);
        self.top.counted.resize(numbers, 0);
        self.top.marks.resize(numbers, 0);
        self.top.number_of.resize(self.nodes.len(), INVALID);
    }

    /// Puts a child, node or instance, into `slot` of `node`; its summary is still to be computed.
    pub(in crate::bvh) fn hang(&mut self, node: u32, slot: usize, to: u32, link: u32) {
        self.nodes[node as usize].set_child(slot, to, link);
        self.link_up(node, slot);
        if to == kind::MESH {
            let placed = &mut self.placed[link as usize];
            placed.hung_radiance = placed.bright();
        }
        self.changes.new.written_nodes.push(node..node + 1);
        self.top.levels = None;
    }

    /// Empties `slot` of `node`.
    pub(super) fn clear(&mut self, node: u32, slot: usize) {
        self.nodes[node as usize].set_child(slot, kind::EMPTY, 0);
        self.changes.new.written_nodes.push(node..node + 1);
        self.top.levels = None;
    }

    /// Tells the child in `slot` of `node` where it hangs.
    pub(super) fn link_up(&mut self, node: u32, slot: usize) {
        let own = &self.nodes[node as usize];
        let (to, link) = (own.kind(slot), own.link(slot));
        let at = place::<W>(self.top.number(node), slot as u32);
        if to == kind::INNER {
            self.parents[link as usize] = node;
            self.set_above(link, at);
        } else if to == kind::MESH {
            let placed = &mut self.placed[link as usize];
            placed.node = node;
            placed.slot = slot as u32;
            let instance = &mut self.instances[link as usize];
            if instance.place != at {
                instance.place = at;
                self.changes.new.written_instances.push(link);
            }
        }
    }

    /// Makes `node` the root.
    pub(super) fn set_root(&mut self, node: u32) {
        self.top.root = node;
        self.parents[node as usize] = INVALID;
        self.set_above(node, INVALID);
    }

    /// Notes the place in the node above of a node of the top level.
    pub(super) fn set_above(&mut self, node: u32, at: u32) {
        let number = self.top.number(node);
        // There are more records than nodes, unless there are none: then nothing asks.
        debug_assert!(at == INVALID || (number as usize) < self.instances.len());
        let record = self.instances.get_mut(number as usize);
        if let Some(record) = record.filter(|record| record.above != at) {
            record.above = at;
            self.changes.new.written_instances.push(number);
        }
    }

    /// The slot by which a node hangs in the one above it.
    pub(super) fn slot_above(&self, node: u32) -> usize {
        let above = &self.nodes[self.parents[node as usize] as usize];
        let is_own = |&slot: &usize| above.kind(slot) == kind::INNER && above.link(slot) == node;
        (0..W).find(is_own).unwrap_or(0)
    }

    /// Height and number of instances of a child.
    pub(super) fn measured(&self, to: u32, link: u32) -> (u32, u32) {
        if to == kind::INNER {
            let number = self.top.number(link) as usize;
            (self.top.heights[number], self.top.counts[number])
        } else {
            (0, 1)
        }
    }

    /// Height and number of instances of a node, from those of its children.
    pub(super) fn measure(&mut self, node: u32) {
        let own = &self.nodes[node as usize];
        let (mut height, mut count) = (1, 0);
        for slot in 0..W {
            if own.kind(slot) == kind::INNER {
                let child = self.top.number(own.link(slot)) as usize;
                height = height.max(1 + self.top.heights[child]);
                count += self.top.counts[child];
            } else if own.kind(slot) == kind::MESH {
                count += 1;
            }
        }
        let number = self.top.number(node) as usize;
        self.top.heights[number] = height;
        self.top.counts[number] = count;
    }

    /// After children of `node` changed: it and all nodes above are measured and computed, and marked for the next refit.
    pub(in crate::bvh) fn update_path(&mut self, node: u32) {
        self.changes.new.top_nodes.push(node);
        let number = self.top.number(node) as usize;
        self.top.counted[number] += 1;
        let mut node = node;
        while node != INVALID {
            self.update(node);
            self.count_edit(node);
            node = self.parents[node as usize];
        }
    }

    /// The same after children of several nodes changed, of which some may be gone since: each node above is computed once.
    pub(super) fn update_paths(&mut self, nodes: &[u32]) {
        self.top.mark += 1;
        let mark = self.top.mark;
        let mut above = Vec::new();
        for &start in nodes {
            if self.top.number(start) == INVALID {
                continue;
            }
            self.changes.new.top_nodes.push(start);
            let number = self.top.number(start) as usize;
            self.top.counted[number] += 1;
            let mut node = start;
            while node != INVALID {
                let number = self.top.number(node) as usize;
                if core::mem::replace(&mut self.top.marks[number], mark) != mark {
                    above.push((self.level(node), node));
                }
                self.count_edit(node);
                node = self.parents[node as usize];
            }
        }
        above.sort_unstable_by_key(|&(level, node)| (core::cmp::Reverse(level), node));
        for (_, node) in above {
            self.update(node);
        }
    }

    /// One more edit below a node since it was built.
    fn count_edit(&mut self, node: u32) {
        let number = self.top.number(node) as usize;
        self.top.edits[number] = (self.top.edits[number] + 1).min(super::settle::MOST);
    }

    /// A node is measured and computed after its children.
    fn update(&mut self, node: u32) {
        self.measure(node);
        self.refit_node(node);
        self.judge_list(&[node]);
    }
}

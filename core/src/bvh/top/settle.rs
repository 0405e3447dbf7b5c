//! Subtrees that edits have touched, built anew.
//!
//! An insertion looks at one node of each level, so trees get worse by and by. After an edit the nodes above it are looked at:
//! the highest of those that have `n` instances, at most [`MOST`], and `n / OFTEN` edits below them, is built anew. So an edit
//! costs [`OFTEN`] instances' share of a build on each of the levels below [`MOST`], on average, and one build of [`MOST`] at
//! most, whatever the number of instances is, a move one where it was and one where it is. The levels above keep their nodes:
//! insertion alone keeps them as good as new (measured: `docs/dynamics-design.md`). Nodes over a few subtrees taken as they are, in
//! place of instances, were worse than no building at all.

use alloc::vec::Vec;

use crate::build::{BuildParams, Heuristic, Topology, build_top};
use crate::bvh::{Bvh, Trails};
use crate::node::{Node, kind};
use crate::summary::Summary;
use crate::trail::max_levels;
use crate::tree::INVALID;

/// Most instances of a subtree that is built within an edit.
pub(in crate::bvh) const MOST: u32 = 512;
/// A subtree of so many instances is built anew at each edit below it, a larger one after as many times more.
const OFTEN: u32 = 16;

impl<N: Node<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// Builds anew what edits have touched, as often as they were made.
    pub(in crate::bvh) fn settle(&mut self) {
        self.settle_some(u64::MAX);
    }

    /// The same for subtrees of at most `most` instances in all. What is left is built anew by the edits that come next below it.
    pub(in crate::bvh) fn settle_some(&mut self, most: u64) {
        let mut left = most;
        for start in core::mem::take(&mut self.top.touched) {
            if let Some((node, count)) = self.highest_due(start, left) {
                left -= u64::from(count);
                self.build_anew(node);
            }
        }
    }

    /// The highest node from `start` up that is to be built anew, of at most `most` instances, and how many it has: those below
    /// it are built with it, once. None where `start` has gone, for what took its place was built with it.
    fn highest_due(&self, start: u32, most: u64) -> Option<(u32, u32)> {
        let (mut highest, mut built) = (None, 0);
        let mut node = start;
        while self.top.number(node) != INVALID {
            let number = self.top.number(node) as usize;
            let count = self.top.counts[number];
            if count > MOST || u64::from(count) > most {
                break;
            }
            // What is built is one more edit for the nodes above.
            if self.top.heights[number] > 1 && self.top.edits[number] + built >= count.div_ceil(OFTEN) {
                highest = Some((node, count));
                built += 1;
            }
            node = self.parents[node as usize];
        }
        highest
    }

    /// Builds the subtree below `node` anew, by what the nodes know of the instances.
    fn build_anew(&mut self, node: u32) {
        let number = self.top.number(node) as usize;
        self.top.edits[number] = 0;
        let (interior, leaves) = self.below(node);
        // What nodes know of a child without flux is not where it is.
        let shape = |(leaf, own): (u32, N::Summary)| match own.phi() > 0.0 {
            true => (leaf, own),
            false => (leaf, self.in_world(leaf)),
        };
        let leaves: Vec<_> = leaves.into_iter().map(shape).collect();
        // As they are now: nodes may know of a little more or less.
        let nowhere = leaves.iter().map(|&(leaf, _)| leaf);
        let nowhere: Vec<u32> = nowhere.filter(|&leaf| self.is_off(leaf)).collect();
        let params = BuildParams {
            heuristic: match self.params.heuristic {
                // Few instances are sorted by Ward's criterion in no time.
                Heuristic::Morton => Heuristic::Ward,
                other => other,
            },
            ..self.params
        };
        let topology: Topology<N> = build_top::<N, W>(leaves.into_iter(), &params);
        if self.level(node) + topology.depth > max_levels(W) {
            return;
        }
        let above = self.parents[node as usize];
        let mut nodes = alloc::vec![node];
        nodes.extend(self.renewed(interior[1..].to_vec(), topology.nodes.len() - 1));
        for (&own, words) in nodes.iter().zip(&topology.nodes) {
            self.nodes[own as usize] = N::EMPTY;
            for slot in 0..W {
                let link = words.link(slot);
                match words.kind(slot) {
                    kind::INNER => self.hang(own, slot, kind::INNER, nodes[link as usize]),
                    kind::MESH => self.hang(own, slot, kind::MESH, link),
                    _ => {}
                }
            }
            self.changes.new.top_nodes.push(own);
        }
        for &own in nodes.iter().rev() {
            self.measure(own);
            self.refit_node(own);
            self.judge_new(own);
        }
        if above != INVALID {
            self.update_path(above);
        }
        nowhere.into_iter().for_each(|leaf| self.note_nowhere(leaf));
    }

    /// The nodes from `node` down, itself first, and the instances below it with what the nodes know of them.
    pub(in crate::bvh) fn below(&self, node: u32) -> (Vec<u32>, Vec<(u32, N::Summary)>) {
        let (mut nodes, mut leaves) = (alloc::vec![node], Vec::new());
        let mut next = 0;
        while let Some(&node) = nodes.get(next) {
            next += 1;
            let own = &self.nodes[node as usize];
            for slot in 0..W {
                match own.kind(slot) {
                    kind::INNER => nodes.push(own.link(slot)),
                    kind::MESH => leaves.push((own.link(slot), own.summary(slot))),
                    _ => {}
                }
            }
        }
        (nodes, leaves)
    }

    /// Levels above a node of the top level.
    pub(super) fn level(&self, node: u32) -> u32 {
        let mut above = self.parents[node as usize];
        let mut level = 0;
        while above != INVALID {
            above = self.parents[above as usize];
            level += 1;
        }
        level
    }
}

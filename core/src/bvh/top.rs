//! The top level: a tree over instances that edits change leaf by leaf and rebuilds replace.
//!
//! Its nodes lie anywhere among the nodes, and have numbers of their own: links upward, from a leaf to the root, stand in the
//! records of instances by those numbers ([`Instance::place`](crate::Instance), `above`). So a subtree is moved by one link
//! down and one up, whatever is below it. Every node but the root has two children or more, so there are fewer nodes than
//! instances, and enough records.

mod adopt;
mod come;
mod cost;
mod cut;
mod insert;
mod links;
mod misplaced;
mod rebuild;
mod remove;
#[cfg(feature = "std")]
mod search;
mod settle;
mod strayed;
mod tried;

use alloc::collections::BTreeSet;
use alloc::vec::Vec;

pub(super) use self::come::Quota;
pub(crate) use self::rebuild::TopCopy;
pub(super) use self::rebuild::TopTree;
#[cfg(feature = "std")]
pub(crate) use self::search::Search;
pub(super) use self::settle::MOST as MOST_EDITS;
#[cfg(feature = "std")]
pub(crate) use self::strayed::Looked;
use super::ranges::Ranges;
use super::{Bvh, Trails};
use crate::build::{BuildParams, Topology, build_top};
use crate::levels::Levels;
use crate::node::{Node, kind};
use crate::refit;
use crate::summary::Summary;
use crate::tree::INVALID;

/// The top level's place among the nodes.
#[derive(Clone, Debug, Default)]
pub(super) struct Top {
    /// Index of its root.
    pub root: u32,
    /// By number of a node of it: the node's index, [`INVALID`] where the number is free.
    pub nodes: Vec<u32>,
    /// Which numbers are in use, and how many.
    pub numbers: Ranges,
    pub used: usize,
    /// By index of a node: its number, [`INVALID`] where it is no node of the top level. As long as needed.
    pub number_of: Vec<u32>,
    /// By number: levels from this node down, 1 where all children are instances.
    pub heights: Vec<u32>,
    /// By number: instances below.
    pub counts: Vec<u32>,
    /// By number: how many nodes had come when the node did.
    pub born: Vec<u64>,
    /// Nodes that have come so far.
    pub births: u64,
    /// By number: edits below since the node was built.
    pub edits: Vec<u32>,
    /// By number: instances below in subtrees that were built since it was tried to build this one.
    pub stirred: Vec<u32>,
    /// By number: the epoch that the last refit made in which much below changed, 0 before any.
    pub moved: Vec<u64>,
    /// By number: the epoch of the last refit in which anything below changed, 0 before any.
    pub seen: Vec<u64>,
    /// By number: the epoch of what it was built from, or what it was tried to build anew from.
    pub tried: Vec<u64>,
    /// By number: how many changes of instances below refits have seen since.
    pub changes: Vec<u32>,
    /// The epoch as changes were counted last.
    pub counted_at: u64,
    /// The epoch at which all of it was built last.
    pub built_at: u64,
    /// By number: children that came or went since the last refit.
    pub counted: Vec<u32>,
    /// Instances whose meshes went elsewhere, to be looked at.
    pub strayed: BTreeSet<u32>,
    /// Instances that were put anywhere while they had no flux and shine now, to be put in where they are.
    pub lit: BTreeSet<u32>,
    /// Nodes whose children edits have changed; they may be gone.
    pub touched: Vec<u32>,
    /// By number: the last search that came by. Instances have theirs.
    pub marks: Vec<u64>,
    /// Counts searches; it never comes round.
    pub mark: u64,
    /// Its nodes by height, where nothing has changed since they were listed.
    pub levels: Option<Levels>,
}

impl Top {
    /// Number of levels.
    pub fn depth(&self) -> u32 {
        self.heights[self.number(self.root) as usize]
    }

    /// The number of a node of the top level; [`INVALID`] where it is none.
    pub fn number(&self, node: u32) -> u32 {
        self.number_of.get(node as usize).copied().unwrap_or(INVALID)
    }

    /// Number of nodes.
    pub fn len(&self) -> usize {
        self.in_use().count()
    }

    /// Its nodes, in the order of their numbers.
    pub fn in_use(&self) -> impl Iterator<Item = u32> + '_ {
        self.nodes.iter().copied().filter(|&node| node != INVALID)
    }

    /// Its nodes by height, those with instances alone first: an order in which they may be refitted.
    pub fn by_height(&self) -> Levels {
        let depth = self.depth();
        let used = self.heights.iter().zip(&self.nodes);
        let used = used.filter(|&(_, &node)| node != INVALID);
        Levels::gather(used.map(|(&height, &node)| (depth - height, node)).collect())
    }

    /// Bytes of its arrays.
    pub fn memory(&self) -> usize {
        size_of_val(&*self.nodes)
            + (self.strayed.len() + self.lit.len()) * size_of::<u32>()
            + size_of_val(&*self.number_of)
            + size_of_val(&*self.heights)
            + size_of_val(&*self.counts)
            + size_of_val(&*self.edits)
            + size_of_val(&*self.born)
            + size_of_val(&*self.stirred)
            + size_of_val(&*self.moved)
            + size_of_val(&*self.seen)
            + size_of_val(&*self.tried)
            + size_of_val(&*self.changes)
            + size_of_val(&*self.counted)
            + size_of_val(&*self.marks)
            + self
                .levels
                .as_ref()
                .map_or(0, |levels| size_of_val(levels.nodes()))
    }
}

/// How a top level is built as a whole: where meshes may be opened by twice as many buckets. Its leaves are few and large, so a
/// plane that lies a little off costs more than below.
fn in_full(params: &BuildParams) -> BuildParams {
    BuildParams {
        buckets: if params.opens {
            params.buckets.saturating_mul(2)
        } else {
            params.buckets
        },
        ..*params
    }
}

impl<N: Node<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// A top level without instances: one empty node.
    pub(super) fn empty_top(&mut self) {
        let mut node = N::EMPTY;
        node.set_summaries(&[N::Summary::EMPTY; W]);
        self.replace_top(&[node]);
    }

    /// Puts `nodes`, links counting from the first, which is the root, in place of the top level. Bounds of instances that
    /// changed meanwhile are marked by the caller.
    pub(super) fn replace_top(&mut self, nodes: &[N]) {
        self.vacate_top();
        let range = self.place_nodes(nodes);
        self.top.root = range.start;
        self.top.nodes = range.collect();
        self.top.edits.clear();
        self.top.stirred.clear();
        self.top.moved.clear();
        self.top.seen.clear();
        self.top.tried.clear();
        self.top.changes.clear();
        self.top.counted.clear();
        // Records that are not in use are of no account: there may be many more of them.
        for entry in 0..self.live.len() {
            let index = self.live[entry];
            self.settle_placed(index);
            for part in self.placed[index as usize].parts.clone() {
                self.placed[part as usize].settle();
            }
            if self.is_off(index) {
                self.note_nowhere(index);
            }
        }
        self.index_top();
    }

    /// Gives back the nodes of the top level, which is to get others.
    pub(super) fn vacate_top(&mut self) {
        let mut old: Vec<u32> = core::mem::take(&mut self.top.nodes);
        old.retain(|&node| node != INVALID);
        old.sort_unstable();
        for &node in &old {
            self.set_above(node, INVALID);
            self.top.number_of[node as usize] = INVALID;
        }
        for run in old.chunk_by(|a, b| a + 1 == *b) {
            self.node_ranges.give(run[0]..run[0] + run.len() as u32);
        }
        self.changes.forget_top();
    }

    /// Builds the top level over all instances, here and now.
    pub(super) fn build_top(&mut self) {
        if self.live.is_empty() {
            self.empty_top();
        } else {
            let mut live = self.live.clone();
            live.sort_unstable();
            if self.params.opens {
                self.decide(&live, self.cost_of_all());
            }
            let leaves = self.leaves_of_all(&live);
            let leaves = leaves.into_iter().map(|i| (i, self.in_world(i)));
            let topology: Topology<N> = build_top::<N, W>(leaves, &in_full(&self.params));
            self.replace_top(&topology.nodes);
        }
        self.changes.new.whole_top = true;
        // That they are new is no change, nor is what they were built of.
        self.top.tried.fill(self.epoch + 1);
        self.top.built_at = self.epoch;
        // Edits before the next refit go by what nodes know, and what they change is no tree as built.
        let levels = self.top.by_height();
        for range in levels.ranges() {
            for &node in &levels.nodes()[range] {
                self.refit_node(node);
                self.judge_new(node);
            }
        }
    }

    /// What is known of an instance in the world.
    pub(super) fn in_world(&self, index: u32) -> N::Summary {
        let instance = &self.instances[index as usize];
        self.root_of(instance.blas).to_world::<N::Light>(instance)
    }

    /// An instance below a child: where that is which has no flux.
    fn some_leaf(&self, to: u32, link: u32) -> Option<u32> {
        let (mut to, mut link) = (to, link);
        while to == kind::INNER {
            let own = &self.nodes[link as usize];
            let slot = (0..W).find(|&slot| own.kind(slot) != kind::EMPTY)?;
            (to, link) = (own.kind(slot), own.link(slot));
        }
        (to == kind::MESH).then_some(link)
    }

    /// Notes all of the top level's nodes anew, which have the numbers by which `top.nodes` lists them: heights, counts, and
    /// the links upward from each node and instance.
    pub(super) fn index_top(&mut self) {
        let numbers = self.top.nodes.len();
        let used = (0..).zip(&self.top.nodes).filter(|&(_, &node)| node != INVALID);
        let used: Vec<_> = used.map(|(number, _)| number..number + 1).collect();
        self.top.used = used.len();
        self.top.numbers = Ranges::taken(numbers as u32, used).unwrap_or_default();
        self.reserve_numbers();
        for number in 0..numbers {
            let node = self.top.nodes[number];
            if node != INVALID {
                self.top.number_of[node as usize] = number as u32;
            }
        }
        for &index in &self.live {
            self.placed[index as usize].node = INVALID;
            for part in self.placed[index as usize].parts.clone() {
                self.placed[part as usize].node = INVALID;
            }
        }
        self.parents[self.top.root as usize] = INVALID;
        self.set_above(self.top.root, INVALID);
        let mut order = alloc::vec![self.top.root];
        let mut next = 0;
        while let Some(&node) = order.get(next) {
            next += 1;
            for slot in 0..W {
                let own = &self.nodes[node as usize];
                let (to, link) = (own.kind(slot), own.link(slot));
                if to == kind::INNER {
                    order.push(link);
                }
                self.link_up(node, slot);
            }
        }
        for &node in order.iter().rev() {
            self.measure(node);
            self.note_birth(node);
        }
        self.top.touched.clear();
        self.top.levels = None;
    }

    /// The top level's nodes by height, listed once and kept until one comes or goes.
    pub(super) fn top_levels(&mut self) -> &Levels {
        if self.top.levels.is_none() {
            self.top.levels = Some(self.top.by_height());
        }
        self.top.levels.get_or_insert_default()
    }

    /// The summaries of the children of a node of the top level, computed.
    fn refit_node(&mut self, node: u32) {
        self.nodes[node as usize] = refit::top(&self.nodes, &self.instances, &self.roots, node);
    }
}

#[cfg(test)]
mod tests;

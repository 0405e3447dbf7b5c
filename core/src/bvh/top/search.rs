//! Which part of the top level is built anew next.
//!
//! A node is looked at by two measures, each in no time. What it lost against itself when it was built: for more than [`PART`]
//! instances its own loss, that of how well it tells its children apart; for fewer, that of all nodes below. And how many of the
//! instances below it are in subtrees that were built since it was tried last: then there may be something to gain though nothing moved.
//! What is tried and gains nothing is as good as built, so the search ends where nothing moves.

use alloc::vec::Vec;

use super::rebuild::{PART, PAYS, TopCopy};
use crate::bvh::{Bvh, Trails};
use crate::node::{LightNode, kind};
use crate::tree::INVALID;

/// Nodes that one search looks at.
const LOOKED_AT: usize = 2048;
/// The highest nodes, which each search looks at.
const HIGHEST: usize = 256;
/// Room that is not worth looking for a part that fits in.
const SMALL: u32 = 128;
/// Searches that a node above parts waits for at most.
const LONGEST: u32 = 6;
/// What a node above parts must have lost at least, whatever the threshold.
const LEAST: f64 = 0.05;
/// What it must have lost to be built while parts are worn. The subtrees that it keeps overlap until the parts that they then make have
/// had their turn: many frames of a worse tree, which little is not worth.
const HASTE: f64 = 0.12;
/// It comes in then where it costs so much of what it replaces.
const PAYS_AT_ONCE: f64 = 0.8;

/// How far the top level's nodes have been looked at.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Search {
    /// The next number.
    next: u32,
    /// How many are to be looked at before all have been since the last change.
    left: u32,
    /// Searches before a node above parts has its turn, while parts are worn.
    waits: u32,
}

impl Search {
    /// Whether all have been.
    pub fn is_done(&self) -> bool {
        self.left == 0
    }

    /// Notes what nodes cost that were built above parts, over what those cost that they replaced. Where the lights mix faster than they
    /// are put in order that is near 1, and the time belongs to parts.
    pub fn note_gain(&mut self, cost: f64) {
        self.waits = (cost / (1.0 - cost).max(1e-3)).clamp(1.0, f64::from(LONGEST)) as u32;
    }
}

/// What there is to build anew.
#[derive(Clone, Copy, Debug)]
enum Worn {
    /// A part, and whether its tree comes in whatever it costs.
    Part(u32, bool),
    /// Nodes above parts.
    Above(u32),
}

impl<N: LightNode<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// What the next parts are built from that are worse than when they were built by the factor `worse` or more, `most` instances in
    /// all, or [`PART`] where that is more; time in proportion to them.
    pub(crate) fn copy_worn_parts(&self, worse: f64, most: u32, search: &mut Search) -> Vec<TopCopy<N>> {
        let root = self.top.number(self.top.root) as usize;
        if self.top.counts[root] <= PART {
            search.left = 0;
            let is_worn = self.quality(self.top.root).drift() >= worse;
            return Vec::from_iter(is_worn.then(|| self.copy_top()));
        }
        search.waits -= u32::from(search.waits > 0);
        if search.waits == 0 {
            if let Some(node) = self.worn_above(worse, HASTE) {
                self.search_again(search);
                return alloc::vec![self.copy_part(node, PAYS_AT_ONCE)];
            }
        }
        let (mut parts, mut stirred, mut above) = (Vec::new(), Vec::new(), None);
        let most = most.max(PART);
        let mut room = most;
        for _ in 0..LOOKED_AT.min(search.left as usize) {
            let number = search.next as usize % self.top.nodes.len();
            search.left -= 1;
            search.next = number as u32 + 1;
            let count = self.top.counts[number];
            match self.worn_at(number as u32, worse) {
                Some(Worn::Part(found, true)) if count <= room => {
                    room -= count;
                    parts.push((found, f64::INFINITY));
                }
                Some(Worn::Part(found, false)) => stirred.push((found, count)),
                Some(Worn::Above(found)) if above.is_none() => above = Some(found),
                _ => {}
            }
            if room < SMALL {
                break;
            }
        }
        // What is only stirred has time: there are as many such as there are parts after each build above them.
        let is_idle = parts.is_empty() && stirred.is_empty();
        let above = match most - room <= PART / 4 && (search.waits == 0 || is_idle) {
            true => self.worn_above(worse, LEAST).or(above),
            false => None,
        };
        if let Some(node) = above {
            parts = alloc::vec![(node, PAYS)];
            stirred.clear();
        }
        for (found, count) in stirred {
            if count <= room {
                room -= count;
                parts.push((found, PAYS));
            }
        }
        // What is worn and did not fit is still to be found.
        if !parts.is_empty() {
            self.search_again(search);
        }
        let copies = parts.into_iter();
        copies.map(|(node, pays)| self.copy_part(node, pays)).collect()
    }

    /// All nodes are to be looked at again.
    pub(crate) fn search_again(&self, search: &mut Search) {
        search.left = self.top.nodes.len() as u32;
    }

    /// What there is to build anew at a node. Of nodes that could be parts the largest stands for all below it.
    fn worn_at(&self, number: u32, worse: f64) -> Option<Worn> {
        let node = self.top.nodes[number as usize];
        if node == INVALID || self.top.heights[number as usize] < 2 {
            return None;
        }
        if self.top.counts[number as usize] > PART {
            return (self.urgency(node, worse, LEAST) > 0.0).then_some(Worn::Above(node));
        }
        let above = self.top.number(self.parents[node as usize]);
        if self.top.counts[above as usize] <= PART {
            return None;
        }
        let drift = self.quality(node).drift();
        // As built, there is nothing to gain.
        let is_worn = drift > 1.0 && drift >= worse;
        (is_worn || self.is_stirred(node, worse)).then_some(Worn::Part(node, is_worn))
    }

    /// Of the highest nodes that have more than [`PART`] instances below, the one that has most to gain: of which most instances are
    /// told apart least well. What lost less than `least` is not worn.
    fn worn_above(&self, worse: f64, least: f64) -> Option<u32> {
        let mut nodes = alloc::vec![self.top.root];
        let mut best = (0.0, None);
        let mut next = 0;
        while let Some(&node) = nodes.get(next) {
            next += 1;
            let urgency = self.urgency(node, worse, least);
            if urgency > best.0 {
                best = (urgency, Some(node));
            }
            let own = &self.nodes[node as usize];
            for slot in (0..W).filter(|&slot| own.kind(slot) == kind::INNER) {
                let child = own.link(slot);
                let count = self.top.counts[self.top.number(child) as usize];
                if count > PART && nodes.len() < HIGHEST {
                    nodes.push(child);
                }
            }
        }
        best.1
    }

    /// What there may be to gain at a node above parts: its own loss, times the instances that it is about; 0 where it is not worn.
    fn urgency(&self, node: u32, worse: f64, least: f64) -> f64 {
        let number = self.top.number(node) as usize;
        let own = f64::from(self.quality(node).own());
        let is_worn = own >= least.max(1.0 - 1.0 / worse.max(1.0));
        let stirred = if least <= LEAST && self.is_stirred(node, worse) {
            LEAST
        } else {
            0.0
        };
        let own = if is_worn { own } else { 0.0 };
        own.max(stirred) * f64::from(self.top.counts[number])
    }

    /// Whether half of the instances below a node are in subtrees that were built since it was tried.
    fn is_stirred(&self, node: u32, worse: f64) -> bool {
        let number = self.top.number(node) as usize;
        let (stirred, count) = (self.top.stirred[number], self.top.counts[number]);
        worse.is_finite() && stirred > 0 && u64::from(stirred) * 2 >= u64::from(count)
    }
}

//! Which part of the top level is built anew next.
//!
//! A node is looked at by two measures, each in no time. What it lost against itself when it was built: for more than [`PART`]
//! instances its own loss, that of how well it tells its children apart; for fewer, that of all nodes below. And how many of the
//! instances below it are in subtrees that were built since it was tried last: then there may be something to gain though nothing moved.
//! What is tried and gains nothing is as good as built, so the search ends where nothing moves.

use alloc::vec::Vec;

use super::rebuild::{PART, TopCopy};
use crate::bvh::{Bvh, Trails};
use crate::node::LightNode;
use crate::tree::INVALID;

/// Nodes that one search looks at.
const LOOKED_AT: usize = 4096;
/// What a node above parts must have lost at least, whatever the threshold: motion of everything wears it a little in each frame, and
/// parts have to get their turn.
const LEAST: f64 = 0.05;

/// How far the top level's nodes have been looked at.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Search {
    /// The next number.
    next: u32,
    /// How many are to be looked at before all have been since the last change.
    left: u32,
    /// Whether the last that was found was of more than [`PART`] instances.
    was_above: bool,
}

impl Search {
    /// Whether all have been.
    pub fn is_done(&self) -> bool {
        self.left == 0
    }
}

impl<N: LightNode<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// What the next parts are built from that are worse than when they were built by the factor `worse` or more, [`PART`] leaves at
    /// most in all; time in proportion to them.
    pub(crate) fn copy_worn_parts(&self, worse: f64, search: &mut Search) -> Vec<TopCopy<N>> {
        let root = self.top.number(self.top.root) as usize;
        if self.top.counts[root] <= PART {
            search.left = 0;
            let is_worn = self.quality(self.top.root).drift() >= worse;
            return Vec::from_iter(is_worn.then(|| self.copy_top()));
        }
        let mut parts: Vec<(u32, bool)> = Vec::new();
        let (mut room, mut is_above) = (PART, false);
        for _ in 0..LOOKED_AT.min(search.left as usize) {
            let number = search.next as usize % self.top.nodes.len();
            let found = self.worn_at(number as u32, worse, search.was_above);
            if let Some((found, by_itself)) = found.filter(|found| !parts.contains(found)) {
                let count = self.top.counts[self.top.number(found) as usize];
                is_above = count > PART;
                // What does not fit is found again.
                if count > room && !parts.is_empty() {
                    break;
                }
                room = room.saturating_sub(count);
                parts.push((found, by_itself));
            }
            search.left -= 1;
            search.next = number as u32 + 1;
            if room == 0 {
                break;
            }
        }
        search.was_above = is_above && parts.len() == 1 && room == 0;
        parts
            .into_iter()
            .map(|(node, by_itself)| self.copy_part(node, by_itself))
            .collect()
    }

    /// All nodes are to be looked at again.
    pub(crate) fn search_again(&self, search: &mut Search) {
        search.left = self.top.nodes.len() as u32;
    }

    /// The root of the part that is to be built anew for the sake of a node, and whether it comes in whatever it costs; with `is_part`,
    /// of no more than [`PART`] instances. The highest is tried first: what it leaves to do below is less than before.
    fn worn_at(&self, number: u32, worse: f64, is_part: bool) -> Option<(u32, bool)> {
        let node = self.top.nodes[number as usize];
        if node == INVALID || self.top.heights[number as usize] < 2 {
            return None;
        }
        let count = |node: u32| self.top.counts[self.top.number(node) as usize];
        let mut found = None;
        let above = self.parents[node as usize];
        if count(node) <= PART {
            // Of a subtree that may be a part the largest such stands for all.
            if above != INVALID && count(above) <= PART {
                return None;
            }
            let drift = self.quality(node).drift();
            // As built, there is nothing to gain.
            let is_worn = drift > 1.0 && drift >= worse;
            if is_worn || self.is_stirred(node, worse) {
                found = Some((node, is_worn));
            }
        }
        let mut node = node;
        while node != INVALID && !is_part {
            let own = f64::from(self.quality(node).own());
            let is_worn = own >= LEAST.max(1.0 - 1.0 / worse.max(1.0));
            if count(node) > PART && (is_worn || self.is_stirred(node, worse)) {
                found = Some((node, false));
            }
            node = self.parents[node as usize];
        }
        found
    }

    /// Whether half of the instances below a node are in subtrees that were built since it was tried.
    fn is_stirred(&self, node: u32, worse: f64) -> bool {
        let number = self.top.number(node) as usize;
        let (stirred, count) = (self.top.stirred[number], self.top.counts[number]);
        worse.is_finite() && stirred > 0 && u64::from(stirred) * 2 >= u64::from(count)
    }
}

//! Which part of the top level is built anew next.
//!
//! A node is looked at by two measures, each in no time. What it lost against itself when it was built: for more than [`PART`]
//! instances its own loss, that of how well it tells its children apart; for fewer, that of all nodes below. And how many of
//! the instances below it are in subtrees that were built since it was tried last: then there may be something to gain though
//! nothing moved. And each is tried once when what is below it has come to rest. What is tried and gains nothing is as good as
//! built, so the search ends where nothing moves.

use alloc::vec::Vec;

use super::rebuild::{PART, PAYS, TopCopy};
use super::settle::MOST;
use crate::bvh::{Bvh, Taken, Trails};
use crate::node::{Node, kind};
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
/// What it must have lost to be built while parts are worn. The subtrees that it keeps overlap until the parts that they then
/// make have had their turn: many frames of a worse tree, which little is not worth.
const HASTE: f64 = 0.12;
/// It comes in then where it costs so much of what it replaces.
const PAYS_AT_ONCE: f64 = 0.8;
/// One in so many instances must have changed below a node that is tried at rest, each time counting. Of fewer, edits take care.
const SHARE: u64 = 8;
/// Frames after which what has not changed is at rest.
const REST: usize = 16;
/// One instance in so many that is off, and was on a moment ago, keeps a part that is only tried as it is, unless that gains
/// much: a tree is built by flux, puts what is off anywhere, and each would be put in elsewhere when it comes on again.
const BLINKS: usize = 32;
/// It comes in then where it costs so much of what it replaces: lamps that jumped beside others that blink had 1.5 to 3.5 times
/// a new tree's variance for ever where it never did, and have 0.94 to 1.02.
const PAYS_BESIDE: f64 = 0.9;

/// How far the top level's nodes have been looked at.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Search {
    /// The next number.
    next: u32,
    /// How many are to be looked at before all have been since the last change.
    left: u32,
    /// Searches before a node above parts has its turn, while parts are worn; of a small top level, before little counts again.
    waits: u32,
    /// The epochs at which the last frames ended, the oldest at `oldest`.
    ended: [u64; REST],
    oldest: usize,
    /// Whether more is at rest than when the last search began.
    rests: bool,
}

impl Search {
    /// Notes the end of a frame.
    pub fn note_frame(&mut self, now: Taken) {
        let before = self.rests_since();
        self.ended[self.oldest] = now.epoch;
        self.oldest = (self.oldest + 1) % REST;
        self.rests |= self.rests_since() != before;
    }

    /// What has not changed since this epoch is at rest.
    pub fn rests_since(&self) -> u64 {
        self.ended[self.oldest]
    }

    /// Whether all have been.
    pub fn is_done(&self) -> bool {
        self.left == 0 && !self.rests
    }

    /// Notes what nodes cost that were built above parts, over what those cost that they replaced. Where the lights mix faster
    /// than they are put in order that is near 1, and the time belongs to parts.
    pub fn note_gain(&mut self, cost: f64) {
        self.waits = (cost / (1.0 - cost).max(1e-3)).clamp(1.0, f64::from(LONGEST)) as u32;
    }
}

/// What a search asks for.
#[derive(Clone, Copy, Debug)]
struct Asked {
    /// Nodes worse than when they were built by this factor.
    worse: f64,
    /// And those at rest since this epoch, once.
    rests_since: u64,
}

/// What there is to build anew.
#[derive(Clone, Copy, Debug)]
enum Worn {
    /// A part, and whether its tree comes in whatever it costs.
    Part(u32, bool),
    /// Nodes above parts.
    Above(u32),
}

impl<N: Node<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// What the next parts are built from that are worse than when they were built by the factor `worse` or more, `most`
    /// instances in all, or [`PART`] where that is more; time in proportion to them.
    pub(crate) fn copy_worn_parts(&self, worse: f64, most: u32, search: &mut Search) -> Vec<TopCopy<N>> {
        let asked = Asked {
            worse,
            rests_since: search.rests_since(),
        };
        let has_changed = search.left > 0;
        if core::mem::take(&mut search.rests) {
            self.search_again(search);
        }
        let root = self.top.number(self.top.root) as usize;
        if self.top.counts[root] <= PART {
            search.left = 0;
            search.waits -= u32::from(search.waits > 0);
            if has_changed && self.is_worn_whole(worse) {
                return alloc::vec![self.copy_whole_part()];
            }
            if has_changed && search.waits == 0 && self.is_worn_for_few(worse) {
                search.waits = REST as u32;
                let copy = self.copy_whole_part();
                if self.is_on(&copy) {
                    return alloc::vec![copy];
                }
            }
            let pays = match () {
                () if !self.is_untried(self.top.root, asked) => None,
                () if self.is_rested(self.top.root, asked) => Some(1.0),
                () => Some(PAYS),
            };
            return Vec::from_iter(pays.map(|pays| self.copy_asked(self.top.root, pays, asked)));
        }
        search.waits -= u32::from(search.waits > 0);
        if search.waits == 0 {
            if let Some(node) = self.worn_above(asked, HASTE) {
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
            match self.worn_at(number as u32, asked) {
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
            true => self.worn_above(asked, LEAST).or(above),
            false => None,
        };
        if let Some(node) = above {
            self.search_again(search);
            // What is built over subtrees shows what it gains once those have been split.
            let is_once = self.is_rested(node, asked);
            let pays = if is_once { f64::INFINITY } else { PAYS };
            return alloc::vec![self.copy_part(node, pays)];
        }
        for (found, count) in stirred {
            if count <= room {
                room -= count;
                let is_once = self.is_rested(found, asked);
                parts.push((found, if is_once { 1.0 } else { PAYS }));
            }
        }
        // What is worn and did not fit is still to be found.
        if !parts.is_empty() {
            self.search_again(search);
        }
        let copies = parts.into_iter();
        copies
            .map(|(node, pays)| self.copy_asked(node, pays, asked))
            .collect()
    }

    /// A copy of a part. One that is only tried comes in where it gains much while much of it blinks and is off, unless all are
    /// asked for. What lost its order is built whatever blinks.
    fn copy_asked(&self, node: u32, pays: f64, asked: Asked) -> TopCopy<N> {
        let mut copy = self.copy_part(node, pays);
        if pays.is_finite() && asked.worse > 1.0 {
            let blases = copy.blases();
            let off = blases
                .filter(|&blas| self.is_blinking(blas, asked.rests_since))
                .count();
            if off * BLINKS > copy.len() {
                copy.pays = PAYS_BESIDE;
            }
        }
        copy
    }

    /// Whether nearly all of a copy's instances shine.
    fn is_on(&self, copy: &TopCopy<N>) -> bool {
        copy.names().filter(|&name| self.is_off(name)).count() * BLINKS <= copy.len()
    }

    /// All nodes are to be looked at again.
    pub(crate) fn search_again(&self, search: &mut Search) {
        search.left = self.top.nodes.len() as u32;
    }

    /// What there is to build anew at a node. Of nodes that could be parts the largest stands for all below it.
    fn worn_at(&self, number: u32, asked: Asked) -> Option<Worn> {
        let node = self.top.nodes[number as usize];
        if node == INVALID || self.top.heights[number as usize] < 2 {
            return None;
        }
        if self.top.counts[number as usize] > PART {
            return (self.urgency(node, asked, LEAST) > 0.0).then_some(Worn::Above(node));
        }
        let above = self.top.number(self.parents[node as usize]);
        if self.top.counts[above as usize] <= PART {
            return None;
        }
        // As built, there is nothing to gain, and whatever has changed is to be built by those who say so.
        let drift = self.quality(node).drift();
        let is_worn = (drift > 1.0 && drift >= asked.worse)
            || (asked.worse <= 1.0 && self.top.seen[number as usize] > self.top.tried[number as usize]);
        (is_worn || self.is_untried(node, asked)).then_some(Worn::Part(node, is_worn))
    }

    /// Whether a top level of one part has lost its shape: all its nodes together, or its root alone, where that has more
    /// instances below than edits build anew. Edits keep the nodes below as they were built, and in the mean over all levels
    /// what the root lost is little. It counts twice (measured: `tests::motion`).
    fn is_worn_whole(&self, worse: f64) -> bool {
        let quality = self.quality(self.top.root);
        let count = self.top.counts[self.top.number(self.top.root) as usize];
        quality.drift() >= worse || (count > MOST && is_worn_by(2.0 * f64::from(quality.own()), worse, LEAST))
    }

    /// Whether one has lost enough for how few its instances are: the fewer, the less a tree over them takes to build, and the
    /// less it may have lost, in proportion. So little is lost by flux alone as lamps go off and on, so it counts once in
    /// [`REST`] frames, and where nearly all shine.
    fn is_worn_for_few(&self, worse: f64) -> bool {
        let count = self.top.counts[self.top.number(self.top.root) as usize];
        let share = f64::from(count.max(1)) / f64::from(PART);
        self.quality(self.top.root).drift() >= 1.0 + (worse - 1.0) * share
    }

    /// Of the highest nodes that have more than [`PART`] instances below, the one that has most to gain: of which most
    /// instances are told apart least well. What lost less than `least` is not worn.
    fn worn_above(&self, asked: Asked, least: f64) -> Option<u32> {
        let mut nodes = alloc::vec![self.top.root];
        let mut best = (0.0, None);
        let mut next = 0;
        while let Some(&node) = nodes.get(next) {
            next += 1;
            let urgency = self.urgency(node, asked, least);
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
    fn urgency(&self, node: u32, asked: Asked, least: f64) -> f64 {
        let number = self.top.number(node) as usize;
        let own = f64::from(self.quality(node).own());
        let is_worn = is_worn_by(own, asked.worse, least);
        let untried = if least <= LEAST && self.is_untried(node, asked) {
            LEAST
        } else {
            0.0
        };
        let own = if is_worn { own } else { 0.0 };
        own.max(untried) * f64::from(self.top.counts[number])
    }

    /// Whether there may be something to gain that no node has lost.
    fn is_untried(&self, node: u32, asked: Asked) -> bool {
        let has_nodes = self.top.heights[self.top.number(node) as usize] > 1;
        has_nodes && asked.worse.is_finite() && (self.is_stirred(node) || self.is_rested(node, asked))
    }

    /// Whether much below a node changed since it was tried, and no more than little in a frame has for [`REST`] frames. What a
    /// tree lost is measured by flux and node by node, and light reaches a point from dim lamps too: so each node is tried once
    /// when its lights have come to rest.
    fn is_rested(&self, node: u32, asked: Asked) -> bool {
        let number = self.top.number(node) as usize;
        let changes = self.top.changes[number];
        changes > 0
            && self.top.moved[number] <= asked.rests_since
            && u64::from(changes) * SHARE >= u64::from(self.top.counts[number])
    }

    /// Whether enough of the instances below a node are in subtrees that were built since it was tried: half of them above
    /// parts. Of a part an eighth, for those are the subtrees that were kept when the nodes above were built, in which all that
    /// was lost may lie.
    fn is_stirred(&self, node: u32) -> bool {
        let number = self.top.number(node) as usize;
        let (stirred, count) = (self.top.stirred[number], self.top.counts[number]);
        let share = if count <= PART { 8 } else { 2 };
        stirred > 0 && u64::from(stirred) * share >= u64::from(count)
    }
}

/// Whether a node that lost `own` is worse by itself by the factor `worse`, and lost at least `least`.
fn is_worn_by(own: f64, worse: f64, least: f64) -> bool {
    own >= least && 1.0 / (1.0 - own).max(1e-6) >= worse
}

#[cfg(test)]
pub(super) mod tests;

//! Noted instances are looked at, a few in each frame, and put in elsewhere where they are in the wrong place.

use alloc::collections::BTreeSet;
use alloc::vec::Vec;

use super::NOWHERE;
use crate::bvh::top::misplaced::{SWAYS, distance};
use crate::bvh::{Bvh, Trails};
use crate::node::{Node, kind};
use crate::summary::Summary;
use crate::tree::INVALID;

/// A mesh is dim that was brighter by more than this factor, where it blinks.
const DIM: f64 = 2.0;
/// Noted instances that one frame looks at.
const LOOKED_AT: usize = 16;

/// What lies elsewhere is farther from the others than it was, in squared distance, by this while it moves: of those that move
/// together some are ahead of the rest for a while. Once it rests, 1.
pub(super) const FARTHER: f64 = 2.0;
/// Where fewer are noted each that rests is put in anew beside which others stayed: those may be others than they were. Where
/// more are, until none is, parts are built anew.
const ALONE: usize = 256;

/// What is asked of an instance that went far, besides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Guard {
    /// It changed since the last frame: it is far from the others.
    Moves,
    /// It did not: it is farther from the others than it was.
    Rests,
    /// Few are noted besides: or the others did not move.
    RestsAlone,
}

/// Where a rebuilder goes on.
#[derive(Debug, Default)]
pub(crate) struct Looked {
    /// From these indices on, of what strayed and of what came on.
    pub(super) next: [u32; 2],
    /// The epoch when the last frame began.
    pub(super) epoch: Option<u64>,
    /// Whether many were noted since none was: parts are built anew then.
    pub(super) is_crowd: bool,
}

impl<N: Node<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// Puts noted instances in elsewhere, about `most` leaves of them: those that went farther than what lies beside them is
    /// spread, and then at least one of what came on.
    pub(crate) fn put_strayed_elsewhere(&mut self, most: usize, looked: &mut Looked) {
        let mut out = self.take_strayed(most, looked);
        self.take_lit(most.saturating_sub(out.len()).max(1), looked, &mut out);
        looked.epoch = Some(self.epoch);
        if out.is_empty() {
            return;
        }
        self.epoch += 1;
        for &leaf in &out {
            self.remove_leaf(leaf);
        }
        out.sort_unstable();
        self.insert_instances(&out);
        self.settle_some(crate::bvh::rebuild::ADOPTED);
    }

    /// Leaves of what went far, about `most`.
    fn take_strayed(&mut self, most: usize, looked: &mut Looked) -> Vec<u32> {
        let mut out = Vec::new();
        let mut later = Vec::new();
        let noted = self.top.strayed.len();
        looked.is_crowd = noted >= ALONE || looked.is_crowd && noted > 0;
        for _ in 0..LOOKED_AT {
            if out.len() >= most {
                break;
            }
            let Some(index) = take_next(&mut self.top.strayed, &mut looked.next[0]) else {
                break;
            };
            let blas = self.blas_index(&self.placed[index as usize]);
            let rests = self.rests(index, looked);
            // One that blinks is where it is bright, unless it rests where it is dim.
            if self.was_brighter(blas) > DIM && !rests {
                later.push(index);
                continue;
            }
            if self.root_of(blas).phi() <= 0.0 {
                self.lose_center(blas);
                continue;
            }
            let guard = match (rests, !looked.is_crowd) {
                (false, _) => Guard::Moves,
                (true, false) => Guard::Rests,
                (true, true) => Guard::RestsAlone,
            };
            if self.lies_elsewhere(index, guard) {
                self.take_leaves(index, &mut out);
            } else if !rests {
                later.push(index);
            }
        }
        self.top.strayed.extend(later);
        out
    }

    /// Adds leaves of what came on to `out`, about `most`.
    fn take_lit(&mut self, most: usize, looked: &mut Looked, out: &mut Vec<u32>) {
        let mut later = Vec::new();
        let enough = out.len() + most;
        for _ in 0..LOOKED_AT {
            if out.len() >= enough {
                break;
            }
            let Some(index) = take_next(&mut self.top.lit, &mut looked.next[1]) else {
                break;
            };
            let blas = self.blas_index(&self.placed[index as usize]);
            if self.was_brighter(blas) > DIM && !self.rests(index, looked) {
                later.push(index);
            } else if self.is_dark(index) {
                self.lose_center(blas);
            } else if self.is_nowhere(index) && !self.is_off(index) {
                self.take_leaves(index, out);
            }
        }
        self.top.lit.extend(later);
    }

    /// Adds the leaves of an instance that are in the tree to `out`: it is to be put in anew.
    fn take_leaves(&mut self, index: u32, out: &mut Vec<u32>) {
        let leaves = self.leaves_of(index);
        out.extend(leaves.filter(|&leaf| self.placed[leaf as usize].node != INVALID));
        // Where it is opened that is not said of its parts alone.
        self.settle_placed(index);
    }

    /// Whether an instance and its mesh are as they were when the last frame began.
    fn rests(&self, index: u32, looked: &Looked) -> bool {
        let placed = &self.placed[index as usize];
        let changed = self.blases[self.blas_index(placed) as usize]
            .changed
            .max(placed.changed);
        looked.epoch.is_some_and(|since| changed <= since)
    }

    /// Whether an instance is farther from where it was put than its node was wide then, the others in it, and it where it was;
    /// and as `guard` says, so that those that move together stay together. An opened one, of which each part has a node, where
    /// it is out of its own extent.
    pub(super) fn lies_elsewhere(&self, index: u32, guard: Guard) -> bool {
        let placed = &self.placed[index as usize];
        let own = self.in_world(index);
        let (was, is) = (
            placed.hung_center.map(f64::from),
            own.center().to_array().map(f64::from),
        );
        if !placed.parts.is_empty() {
            return distance(is, was) * SWAYS > f64::from(own.spread());
        }
        if placed.node == INVALID
            || self.parents[placed.node as usize] == INVALID
            || placed.hung_center[0].is_nan()
        {
            return false;
        }
        if placed.hung_center[0] == NOWHERE {
            return true;
        }
        // Flux, flux times centre, and flux times squared distance from where it was; the instance itself is at zero.
        let mut phi = f64::from(own.phi());
        let (mut first, mut second) = ([0.0; 3], phi * f64::from(own.spread()));
        for other in self.beside(index) {
            let flux = f64::from(other.phi());
            let center = other.center().to_array().map(f64::from);
            phi += flux;
            (0..3).for_each(|k| first[k] += flux * (center[k] - was[k]));
            second += flux * (f64::from(other.spread()) + distance(center, was));
        }
        // Of all about their mean.
        let spread = second / phi - distance(first.map(|x| x / phi), [0.0; 3]);
        let others = phi - f64::from(own.phi());
        let middle = first.map(|x| if others > 0.0 { x / others } else { 0.0 });
        let moved = [0, 1, 2].map(|k| is[k] - was[k]);
        let is_farther = |by: f64| distance(moved, middle) > by * distance([0.0; 3], middle);
        distance(is, was) > spread
            && match guard {
                Guard::Moves => is_farther(FARTHER),
                Guard::Rests => is_farther(1.0),
                Guard::RestsAlone => is_farther(1.0) || !self.moves_with_others(index, distance(is, was)),
            }
    }

    /// Whether three in four of those beside an instance, and of those beside its node, went about as far since they were put
    /// where they are: then parts are built anew where that is due. A few that travel together among others are a node in the
    /// wrong place.
    pub(super) fn moves_with_others(&self, index: u32, squared: f64) -> bool {
        let placed = &self.placed[index as usize];
        let above = self.parents[placed.node as usize];
        self.move_too(placed.node, placed.slot as usize, squared)
            && self.move_too(above, self.slot_above(placed.node), squared)
    }

    /// Whether three in four of the children of a node but for one, of each an instance, went at least a quarter as far; in
    /// squared distance.
    fn move_too(&self, node: u32, but: usize, squared: f64) -> bool {
        let own = &self.nodes[node as usize];
        let (mut count, mut moved) = (0, 0);
        for slot in (0..W).filter(|&slot| slot != but) {
            let Some(leaf) = self.some_leaf(own.kind(slot), own.link(slot)) else {
                continue;
            };
            let was = self.placed[leaf as usize].hung_center.map(f64::from);
            count += 1;
            // Of one that never moved that is no number.
            moved += u32::from(16.0 * distance(self.center_now(leaf), was) >= squared);
        }
        4 * moved >= 3 * count
    }

    /// What is beside an instance in its node, but for those that are nowhere themselves: they go elsewhere too.
    pub(super) fn beside(&self, index: u32) -> impl Iterator<Item = N::Summary> + '_ {
        let placed = &self.placed[index as usize];
        let node = &self.nodes[placed.node as usize];
        let is_there = |slot: usize| {
            node.kind(slot) != kind::MESH || self.placed[node.link(slot) as usize].hung_center[0] != NOWHERE
        };
        (0..W)
            .filter(move |&slot| {
                slot != placed.slot as usize && node.kind(slot) != kind::EMPTY && is_there(slot)
            })
            .map(move |slot| {
                let known = node.summary(slot);
                let is_dark = known.phi() <= 0.0;
                let leaf = is_dark.then(|| self.some_leaf(node.kind(slot), node.link(slot)));
                leaf.flatten().map_or(known, |leaf| self.in_world(leaf))
            })
    }
}

/// The first of `list` from `next` on, after which the next call goes on: those that are noted in every frame keep nobody waiting.
fn take_next(list: &mut BTreeSet<u32>, next: &mut u32) -> Option<u32> {
    let index = *list.range(*next..).next().or(list.first())?;
    list.remove(&index);
    *next = index + 1;
    Some(index)
}

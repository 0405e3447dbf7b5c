//! How much worse a bottom level is than when it was built: what decides whether it is built anew.
//!
//! A node stands for the lights below each of its children by a few moments. What it cannot tell apart is the share of its
//! lights' variance of position that lies within its inner children, r = Σ Φ_c s²_c / (Φ σ²), from 0 to 1 and without unit or
//! scale. In σ² is each light's own extent, in s² the distance of their centers alone: no tree tells points of one light apart,
//! and lamps that start at one point as r = 0 have all to lose. As refits stretch the nodes, r grows. The mean of its growth
//! over a tree's nodes, by flux, is what of the order of its lights the tree has lost: 0 as built and for any motion of the
//! whole, 0.6 to 0.85 where the triangles change places at random. Each node is compared with itself, so nothing that happens
//! elsewhere hides it.
//!
//! Means of subtrees are kept by node and computed along the paths of a refit. They follow from the words of the nodes and what was
//! noted at the build, however many refits lie between.

use alloc::collections::BTreeSet;
use alloc::vec::Vec;
use core::ops::Range;

use super::{Bvh, Trails};
use crate::exact::max;
use crate::node::{Node, kind};
use crate::summary::Summary;
use crate::widest::widest;

/// What is known of a node's subtree.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Quality {
    /// r as it was built.
    pub built: f32,
    /// What r has grown since.
    own: f32,
    /// Mean over the lights of what the nodes on their paths have lost, the sum over each path.
    lost: f32,
    /// Mean over the lights of the number of those nodes.
    levels: f32,
    /// Variance of the centers of the lights, or instances, by flux: s² above.
    apart: f32,
}

impl Quality {
    /// How many times worse than when it was built, at least 1.
    pub fn drift(&self) -> f64 {
        if self.levels > 0.0 {
            1.0 / (1.0 - f64::from(self.lost) / f64::from(self.levels)).max(1e-6)
        } else {
            1.0
        }
    }

    /// Variance of the centers of the lights, m².
    pub fn apart(&self) -> f32 {
        self.apart
    }

    /// What is lost on the ways down, for a unit of flux.
    pub fn loss(&self) -> f64 {
        f64::from(self.lost)
    }

    /// How much less than when it was built the node itself tells its children apart, 0 to 1.
    #[cfg(feature = "std")]
    pub fn own(&self) -> f32 {
        self.own
    }

    /// Those of the nodes of a tree in depth-first order, links counting from its root.
    pub fn as_built<N: Node<W>, const W: usize>(nodes: &[N]) -> Vec<Self> {
        let mut known = alloc::vec![Self::default(); nodes.len()];
        for index in (0..nodes.len() as u32).rev() {
            known[index as usize] = Self::of(nodes, &known, index, true);
        }
        known
    }

    /// That of node `index`, whose children's stand in `known`; as built with `is_new`.
    #[inline(always)]
    fn of<N: Node<W>, const W: usize>(nodes: &[N], known: &[Self], index: u32, is_new: bool) -> Self {
        let node = &nodes[index as usize];
        // A node of lights alone tells all of them apart.
        if (0..W).all(|slot| node.kind(slot) != kind::INNER) {
            let about = About::of(node);
            return Self {
                apart: about.mean(about.between),
                ..Self::default()
            };
        }
        let spread = Spread::of(node, |slot| known[node.link(slot) as usize].apart);
        let (mut lost, mut levels) = (0.0, 0.0);
        for slot in (0..W).filter(|&slot| node.kind(slot) == kind::INNER) {
            let (below, flux) = (&known[node.link(slot) as usize], spread.about.flux[slot]);
            lost += flux * f64::from(below.lost);
            levels += flux * f64::from(below.levels);
        }
        let per_phi = spread.about.per_phi();
        let total = spread.apart() + spread.extents;
        let share = if total > 0.0 {
            (spread.within / total).min(1.0) as f32
        } else {
            0.0
        };
        let built = if is_new {
            share
        } else {
            known[index as usize].built
        };
        let own = max(share - built, 0.0);
        Self {
            built,
            own,
            lost: own + (lost * per_phi) as f32,
            levels: 1.0 + (levels * per_phi) as f32,
            apart: spread.about.mean(spread.apart()),
        }
    }
}

/// Flux of a node's children, and flux times variance of their centers, W m².
#[derive(Clone, Copy, Debug)]
struct About<const W: usize> {
    flux: [f64; W],
    phi: f64,
    between: f64,
}

impl<const W: usize> About<W> {
    #[inline(always)]
    fn of<N: Node<W>>(node: &N) -> Self {
        // Component by component, each an array over the slots: processors compute several at a time, but for the sums, whose
        // order counts.
        let (mut flux, mut from) = ([0.0; W], [[0.0; W]; 3]);
        // Positions from the first child's, for the differences of `f32` are exact.
        let first = node.summary(0).center().to_array().map(f64::from);
        for slot in 0..W {
            let child = node.summary(slot);
            // Without flux no distance counts.
            let is_there = node.kind(slot) != kind::EMPTY;
            flux[slot] = f64::from(if is_there { child.phi() } else { 0.0 });
            let center = child.center().to_array();
            for axis in 0..3 {
                from[axis][slot] = f64::from(center[axis]) - first[axis];
            }
        }
        let (mut firsts, mut seconds) = ([[0.0; W]; 3], [[0.0; W]; 3]);
        for axis in 0..3 {
            for slot in 0..W {
                firsts[axis][slot] = flux[slot] * from[axis][slot];
                seconds[axis][slot] = firsts[axis][slot] * from[axis][slot];
            }
        }
        let (mut phi, mut moved, mut squares) = (0.0, [0.0; 3], 0.0);
        for slot in 0..W {
            phi += flux[slot];
            for axis in 0..3 {
                moved[axis] += firsts[axis][slot];
                squares += seconds[axis][slot];
            }
        }
        let mut own = Self {
            flux,
            phi,
            between: 0.0,
        };
        let mean = moved.map(|sum| sum * own.per_phi());
        let apart = squares - (moved[0] * mean[0] + moved[1] * mean[1] + moved[2] * mean[2]);
        own.between = apart.max(0.0);
        own
    }

    #[inline(always)]
    fn per_phi(&self) -> f64 {
        if self.phi > 0.0 { 1.0 / self.phi } else { 0.0 }
    }

    /// A mean by flux, given its sum.
    fn mean(&self, sum: f64) -> f32 {
        (sum * self.per_phi()).min(f64::from(f32::MAX)) as f32
    }
}

/// Flux times variance of position of a node's lights, W m², by where it lies.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spread<const W: usize> {
    /// Of the children's means.
    about: About<W>,
    /// Of the centers of the lights of each inner child.
    within: f64,
    /// Of the lights themselves.
    extents: f64,
}

impl<const W: usize> Spread<W> {
    /// That of a node, given the variance of the lights' centers of each slot that holds a node.
    #[inline(always)]
    pub fn of<N: Node<W>>(node: &N, apart_of: impl Fn(usize) -> f32) -> Self {
        let about = About::of(node);
        let mut spreads = [0.0; W];
        for slot in 0..W {
            spreads[slot] = node.summary(slot).spread();
        }
        let (mut within, mut extents) = (0.0, 0.0);
        for slot in (0..W).filter(|&slot| node.kind(slot) != kind::EMPTY) {
            let (flux, spread) = (about.flux[slot], f64::from(spreads[slot]));
            if node.kind(slot) == kind::INNER {
                let apart = f64::from(apart_of(slot));
                within += flux * apart;
                extents += flux * (spread - apart).max(0.0);
            } else {
                extents += flux * spread;
            }
        }
        Self {
            about,
            within,
            extents,
        }
    }

    /// Flux of all lights, W.
    pub fn phi(&self) -> f64 {
        self.about.phi
    }

    /// What a node costs that has these lights below: all but what no tree could help.
    pub fn apart(&self) -> f64 {
        self.within + self.about.between
    }
}

/// Looks at nodes that were refitted, children before parents.
pub(super) fn judge<N: Node<W>, const W: usize>(nodes: &[N], known: &mut [Quality], list: &[u32]) {
    for &index in list {
        known[index as usize] = Quality::of(nodes, known, index, false);
    }
}

/// When bottom levels were refitted last, one entry for each, in the order of time.
#[derive(Clone, Debug, Default)]
pub(super) struct Refitted {
    in_order: BTreeSet<(u64, u32)>,
    /// By index of a bottom level: the epoch of its entry, 0 where it has none.
    last: Vec<u64>,
}

impl Refitted {
    /// In time in proportion to the logarithm of the number of bottom levels.
    fn note(&mut self, blas: u32, epoch: u64) {
        if self.last.len() <= blas as usize {
            self.last.resize(blas as usize + 1, 0);
        }
        let last = core::mem::replace(&mut self.last[blas as usize], epoch);
        if last > 0 {
            self.in_order.remove(&(last, blas));
        }
        self.in_order.insert((epoch, blas));
    }

    /// Has room for so many bottom levels.
    pub fn reserve(&mut self, count: usize) {
        super::room::reserve(&mut self.last, count);
    }

    /// Those after `epoch`.
    fn since(&self, epoch: u64) -> impl Iterator<Item = (u64, u32)> + '_ {
        self.in_order.range((epoch + 1, 0)..).copied()
    }

    /// Bytes, but for what the order takes besides its entries.
    pub fn memory(&self) -> usize {
        size_of_val(&*self.last) + self.in_order.len() * size_of::<(u64, u32)>()
    }

    #[cfg(test)]
    fn len(&self) -> usize {
        self.in_order.len()
    }
}

impl<N: Node<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// Looks at nodes in depth-first order, all below each of them among them; as built with `is_new`.
    pub(super) fn judge_range(&mut self, range: Range<u32>, is_new: bool) {
        if self.quality.len() < self.nodes.len() {
            self.quality.resize(self.nodes.len(), Quality::default());
        }
        let (nodes, quality) = (&self.nodes, &mut self.quality);
        widest(
            #[inline(always)]
            || {
                for index in range.rev() {
                    quality[index as usize] = Quality::of(nodes, quality, index, is_new);
                }
            },
        );
    }

    /// Looks at nodes that were refitted, children before parents.
    pub(super) fn judge_list(&mut self, list: &[u32]) {
        self.quality.resize(self.nodes.len(), Quality::default());
        judge(&self.nodes, &mut self.quality, list);
    }

    /// Looks at a node of the top level that was just built.
    pub(super) fn judge_new(&mut self, node: u32) {
        self.quality.resize(self.nodes.len(), Quality::default());
        self.quality[node as usize] = Quality::of(&self.nodes, &self.quality, node, true);
    }

    /// What is known of the subtree of a node.
    pub(super) fn quality(&self, node: u32) -> Quality {
        self.quality.get(node as usize).copied().unwrap_or_default()
    }

    /// How many times worse a bottom level is than when it was built.
    pub(super) fn drift(&self, blas: u32) -> f64 {
        self.quality[self.roots[blas as usize].node as usize].drift()
    }

    /// Notes that bottom level `blas` was refitted at `epoch`.
    pub(super) fn note_refitted(&mut self, blas: u32, epoch: u64) {
        self.refitted.note(blas, epoch);
    }

    /// Whether an entry of the list is the last of a bottom level that was refitted since it was built.
    fn is_last(&self, (epoch, blas): (u64, u32)) -> bool {
        let own = &self.blases[blas as usize];
        !own.nodes.is_empty() && !own.is_outgoing && own.changed == epoch && own.changed > own.created
    }

    /// The bottom levels refitted after `since`, and since they were built, by index.
    pub(super) fn refitted_since(&self, since: u64) -> Vec<u32> {
        let recent = self.refitted.since(since);
        let mut found: Vec<u32> = recent
            .filter(|&entry| self.is_last(entry))
            .map(|(_, blas)| blas)
            .collect();
        found.sort_unstable();
        found.dedup();
        found
    }
}

#[cfg(test)]
mod tests;

//! Batches of edits: leaves and subtrees stay or are inserted again, leaves are inserted or removed.

use alloc::sync::Arc;
use alloc::vec::Vec;

use super::{Batch, Top};
use crate::build::BuildParams;
use crate::exact;
use crate::node::{Node, kind};
use crate::trail::{leaf, leaf_parts, place_parts};
use crate::tree::INVALID;

/// Half extents of the node above that a subtree may drift from where it was put. Once 20 clusters had passed each other without a
/// build, the tree cost 1.06 of a fresh one at 1/10 and 1/4, 1.29 at 1/2, 2.7 if subtrees stay; 1/10 takes 1.8 times the edits of 1/4.
const DRIFTS: f32 = 0.25;
/// A batch that inserts, removes or moves more than one leaf in `WHOLE` is a whole build, which takes as long as inserting about
/// a sixth one by one.
const WHOLE: usize = 4;

impl<N> Top<N> {
    /// Applies batches of edits as one: sets the words of the leaves that they name, and computes all nodes above. Takes time in
    /// proportion to the leaves times the depth, at most that of a whole build.
    pub fn edit<const W: usize>(&mut self, batches: &[Arc<Batch>], params: &BuildParams)
    where
        N: Node<W>,
    {
        // Set all leaves first: siblings that move together are compared at their new places.
        batches.iter().for_each(|batch| self.set(batch));
        let named = batches.iter().flat_map(|batch| batch.instances.iter().copied());
        let mut instances: Vec<u32> = named.collect();
        if batches.len() > 1 {
            instances.sort_unstable();
            instances.dedup();
        }
        let (mut entering, mut leaving, mut nodes) = (Vec::new(), Vec::new(), Vec::new());
        for instance in instances {
            if self.leaves[instance as usize].is_none() {
                self.take_out::<W>(instance);
                continue;
            }
            for part in self.links_of(instance) {
                let (link, at) = (leaf(instance, part), self.place_of(instance, part));
                if at == INVALID {
                    entering.push(link);
                } else if self.stays::<W>(link, at) {
                    nodes.push(place_parts::<W>(at).0);
                } else {
                    leaving.push(link);
                }
            }
        }
        let all = self.count as usize + self.parts.len();
        if (entering.len() + leaving.len() + self.lost.len()) * WHOLE > all {
            return self.build(params);
        }
        leaving.iter().for_each(|&link| self.detach(link));
        let lost = core::mem::take(&mut self.lost);
        for node in lost {
            if let Some(node) = self.close_gap(node) {
                self.note_change(node);
                nodes.push(node);
            }
        }
        let mut drifted = self.refit_above(nodes);
        drifted.retain(|&node| self.has_drifted(node));
        if drifted.len() * WHOLE > all {
            return self.build(params);
        }
        // The highest first: a subtree moves with those below it.
        for node in drifted.into_iter().rev() {
            if !self.insert_again(node) {
                return self.build(params);
            }
        }
        let mut nodes = Vec::with_capacity(leaving.len() + entering.len());
        for link in leaving.into_iter().chain(entering) {
            match self.insert(kind::MESH, link) {
                Some(node) => nodes.push(node),
                None => return self.build(params),
            }
        }
        self.refit_changed(nodes);
    }

    /// Computes nodes whose children changed, and all above.
    fn refit_changed<const W: usize>(&mut self, nodes: Vec<u32>)
    where
        N: Node<W>,
    {
        nodes.iter().for_each(|&node| self.note_change(node));
        self.refit_above(nodes);
    }

    /// Call it for a node whose children changed: the centres above move then without drift, so places are noted again.
    fn note_change<const W: usize>(&mut self, node: u32)
    where
        N: Node<W>,
    {
        let mut node = node;
        loop {
            let shape = &mut self.shapes[node as usize];
            (shape.is_changed, shape.from) = (true, [f32::NAN; 3]);
            match self.above[node as usize] {
                INVALID => return,
                at => node = place_parts::<W>(at).0,
            }
        }
    }

    /// Takes a subtree out and inserts it again. Returns whether there is a place where the tree stays within its levels.
    fn insert_again<const W: usize>(&mut self, node: u32) -> bool
    where
        N: Node<W>,
    {
        // The root, or a node that gave way meanwhile.
        let at = core::mem::replace(&mut self.above[node as usize], INVALID);
        if at == INVALID {
            return true;
        }
        let (above, slot) = place_parts::<W>(at);
        self.attach(above, slot as usize, kind::EMPTY, 0);
        let gap = self.close_gap(above);
        self.refit_changed(gap.into_iter().collect());
        let new = self.insert(kind::INNER, node);
        self.refit_changed(new.into_iter().collect());
        new.is_some()
    }

    /// Whether a subtree has moved relative to the centre of the node above, on an axis, by more than [`DRIFTS`] of that node's half
    /// extents, since it or what it holds was put in.
    fn has_drifted<const W: usize>(&self, node: u32) -> bool
    where
        N: Node<W>,
    {
        let at = self.above[node as usize];
        if at == INVALID {
            return false;
        }
        let (own, above) = (
            &self.shapes[node as usize],
            &self.shapes[place_parts::<W>(at).0 as usize],
        );
        (0..3).any(|k| exact::abs(own.center[k] - above.center[k] - own.from[k]) > DRIFTS * above.half[k])
    }

    /// Whether the leaf at a place stays: on each axis its distance from the mean of its node's children is at most twice the half
    /// extents that the node had when a child was last added or removed. No two places in a box are farther apart than that, so a
    /// leaf that does not move stays. A leaf without siblings does not: its node is removed.
    fn stays<const W: usize>(&self, link: u32, at: u32) -> bool
    where
        N: Node<W>,
    {
        let (node, slot) = place_parts::<W>(at);
        let own = &self.nodes[node as usize];
        let center = self.center_of(kind::MESH, link);
        // Sum differences: children at one place are then at distance 0, despite rounding.
        let (mut away, mut others) = ([0.0; 3], 0.0);
        for other in (0..W).filter(|&other| other != slot as usize) {
            if own.kind(other) != kind::EMPTY {
                let sibling = self.center_of(own.kind(other), own.link(other));
                (0..3).for_each(|k| away[k] += sibling[k] - center[k]);
                others += 1.0;
            }
        }
        let half = self.shapes[node as usize].half;
        let most = |k: usize| 2.0 * half[k] * (others + 1.0);
        others > 0.0 && (0..3).all(|k| exact::abs(away[k]) <= most(k))
    }

    /// Call it after a node lost children: an empty node is removed, and a single child replaces its node. Returns the node whose
    /// children changed then; `None` if the node was removed already.
    fn close_gap<const W: usize>(&mut self, node: u32) -> Option<u32>
    where
        N: Node<W>,
    {
        let mut node = node;
        loop {
            if self.shapes[node as usize].height == 0 {
                return None;
            }
            let own = self.nodes[node as usize];
            let mut used = (0..W).filter(|&slot| own.kind(slot) != kind::EMPTY);
            let (first, second) = (used.next(), used.next());
            let is_root = node == self.root;
            let (to, link) = match (first, second) {
                (_, Some(_)) => return Some(node),
                (None, _) if is_root => return Some(node),
                (None, _) => (kind::EMPTY, 0),
                (Some(slot), _) => (own.kind(slot), own.link(slot)),
            };
            if is_root && to != kind::INNER {
                return Some(node);
            }
            let at = core::mem::replace(&mut self.above[node as usize], INVALID);
            self.shapes[node as usize].height = 0;
            self.free.push(node);
            if is_root {
                self.root = link;
                self.above[link as usize] = INVALID;
                self.written.links.push(link);
                return Some(link);
            }
            let (above, slot) = place_parts::<W>(at);
            self.attach(above, slot as usize, to, link);
            node = above;
        }
    }

    /// Marks the nodes with too few children; the next edit removes them.
    pub fn note_gaps<const W: usize>(&mut self)
    where
        N: Node<W>,
    {
        for (node, own) in (0u32..).zip(&self.nodes) {
            let children = (0..W).filter(|&slot| own.kind(slot) != kind::EMPTY).count();
            if node != self.root && self.shapes[node as usize].height > 0 && children < 2 {
                self.lost.push(node);
            }
        }
    }

    /// Whether a link is that of an instance that is closed, or of a part of one that is opened.
    pub fn has_leaf(&self, link: u32) -> bool {
        let (instance, part) = leaf_parts(link);
        self.links_of(instance).contains(&part)
    }
}

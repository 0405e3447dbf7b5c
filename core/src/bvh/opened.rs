//! Large meshes opened: the top level holds the subtrees below the root of a bottom level in place of the whole (partial
//! re-braiding, Benthin et al. 2017).
//!
//! A part of an opened instance is a leaf of the top level with a record of its own, which follows that of the instance: the
//! same map, the same lights, another root. Parts of one mesh share what is known of their subtrees, which stands among the
//! roots of bottom levels. Nothing else knows of parts: lights are listed, numbered and named by the instance that they belong
//! to.
//!
//! What an instance costs the top level is what its lights cost by Ward's criterion, flux times variance of position. It is opened
//! where that is more than a part [`OPENS`] of what all lights together cost, and closed again below a part [`CLOSES`].

use alloc::vec::Vec;
use core::ops::Range;

use super::apply::NO_INSTANCE;
use super::blas::{Blas, put};
use super::records::InstanceState;
use super::{Bvh, Trails};
use crate::instance::Instance;
use crate::node::{Node, kind};
use crate::refit::{self, BlasRoot};
use crate::summary::Summary;
use crate::tree::INVALID;

/// An instance that costs more than this part of the whole is opened. There are at most as many as its inverse.
pub(super) const OPENS: f64 = 1.0 / 8192.0;
/// An opened instance that costs less than this part of the whole is closed: less than [`OPENS`], so that what moves does not
/// open and close from frame to frame.
pub(super) const CLOSES: f64 = OPENS / 4.0;

/// Most instances that are opened or closed as a rebuilt top level is put in place.
const MOST: usize = 64;

/// What sets of lights cost together: flux, its first and second moments.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Together {
    phi: f64,
    first: [f64; 3],
    second: f64,
    /// Where positions count from, so that little is lost to rounding.
    origin: Option<[f64; 3]>,
}

impl Together {
    pub fn add<S: Summary>(&mut self, summary: &S) {
        let c = summary.center();
        let c = [c.x, c.y, c.z].map(f64::from);
        let phi = f64::from(summary.phi());
        let origin = *self.origin.get_or_insert(c);
        let mut squared = f64::from(summary.spread());
        for k in 0..3 {
            let x = c[k] - origin[k];
            self.first[k] += phi * x;
            squared += x * x;
        }
        self.phi += phi;
        self.second += phi * squared;
    }

    /// Flux times variance of position, W m².
    pub fn cost(&self) -> f64 {
        if self.phi > 0.0 {
            let of_mean: f64 = self.first.iter().map(|x| x * x / self.phi).sum();
            (self.second - of_mean).max(0.0)
        } else {
            0.0
        }
    }
}

/// What a set of lights costs by itself, W m².
pub(super) fn cost<S: Summary>(summary: &S) -> f64 {
    f64::from(summary.phi()) * f64::from(summary.spread())
}

/// What sets of lights cost together.
pub(super) fn cost_of<S: Summary>(sets: &[S]) -> f64 {
    let mut whole = Together::default();
    sets.iter().for_each(|set| whole.add(set));
    whole.cost()
}

/// Whether an instance that costs `own` of `whole` is to be open, given whether it is.
pub(super) fn is_to_open(own: f64, whole: f64, is_open: bool) -> bool {
    own > whole * if is_open { CLOSES } else { OPENS }
}

/// Number of parts that the bottom level with this root can be opened into: its children, where all are nodes and lie in slots
/// without gaps; else 0. A light has no node that could be a root.
pub(super) fn parts_below<N: Node<W>, const W: usize>(root: &N) -> u32 {
    let count = (0..W).take_while(|&slot| root.kind(slot) == kind::INNER).count();
    let is_all = (count..W).all(|slot| root.kind(slot) == kind::EMPTY);
    if is_all && count > 1 { count as u32 } else { 0 }
}

/// An instance that is opened or could be.
#[derive(Clone, Copy, Debug)]
pub(super) struct Openable {
    pub index: u32,
    instance: Instance,
    root: BlasRoot,
    /// By how much its mesh was brighter, where it blinks.
    was_brighter: f64,
}

/// Of the `openable` instances those that are to be opened, and those that are to be closed,
/// the costliest first; at most [`MOST`] of both, so that no frame has much to do for them. All lights together cost `whole`.
pub(super) fn wanted<N: Node<W>, const W: usize>(whole: f64, openable: &[Openable]) -> [Vec<u32>; 2] {
    let mut changes: Vec<(f64, u32, bool)> = Vec::new();
    for own in openable {
        let (index, instance) = (&own.index, &own.instance);
        let as_is = cost(&own.root.summary::<N::Summary>().to_world::<N::Light>(instance));
        let own = as_is * own.was_brighter;
        let is_open = instance.part != INVALID;
        let wanted = is_to_open(own, whole, is_open);
        if wanted != is_open {
            changes.push((own, *index, wanted));
        }
    }
    changes.sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    changes.truncate(MOST);
    [true, false].map(|wanted| {
        let those = changes.iter().filter(|change| change.2 == wanted);
        those.map(|change| change.1).collect()
    })
}

impl<N: Node<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// Those of some instances that are opened or could be.
    pub(super) fn openable(&self, some: impl Iterator<Item = u32>) -> Vec<Openable> {
        if !self.params.opens {
            return Vec::new();
        }
        let found =
            some.filter(|&index| !self.placed[index as usize].parts.is_empty() || self.can_open(index));
        found
            .map(|index| {
                let instance = self.instances[index as usize];
                Openable {
                    index,
                    instance,
                    root: self.roots[instance.blas as usize],
                    was_brighter: self.was_brighter(instance.blas),
                }
            })
            .collect()
    }

    /// The records by which an instance hangs in the top level: its parts, or its own.
    pub(super) fn leaves_of(&self, index: u32) -> Range<u32> {
        let parts = &self.placed[index as usize].parts;
        if parts.is_empty() {
            index..index + 1
        } else {
            parts.clone()
        }
    }

    /// The same of several.
    pub(super) fn leaves_of_all(&self, instances: &[u32]) -> Vec<u32> {
        instances
            .iter()
            .flat_map(|&index| self.leaves_of(index))
            .collect()
    }

    /// Whether instances are ever opened. One alone needs no top level.
    fn opens(&self) -> bool {
        self.params.opens && self.live.len() > 1
    }

    /// What an instance costs as a whole.
    fn own_cost(&self, index: u32) -> f64 {
        cost(&self.in_world(index)) * self.was_brighter(self.instances[index as usize].blas)
    }

    /// Opens and closes instances that hang nowhere in the top level, by what they cost of `whole`.
    pub(super) fn decide(&mut self, instances: &[u32], whole: f64) {
        for &index in instances {
            let is_open = !self.placed[index as usize].parts.is_empty();
            let wanted = self.opens() && is_to_open(self.own_cost(index), whole, is_open);
            match (is_open, wanted) {
                (false, true) => _ = self.open(index),
                (true, false) => self.close(index),
                _ => {}
            }
        }
    }

    /// Opens those of `added` instances, which hang nowhere yet, that cost much of what there is with them.
    pub(super) fn decide_added(&mut self, added: &[u32]) {
        if !self.opens() {
            return;
        }
        let mut whole = Together::default();
        whole.add(&self.nodes[self.top.root as usize].merged());
        for &index in added {
            whole.add(&self.in_world(index));
        }
        self.decide(added, whole.cost());
    }

    /// What all instances in use cost together.
    pub(super) fn cost_of_all(&self) -> f64 {
        let mut whole = Together::default();
        for &index in &self.live {
            whole.add(&self.in_world(index));
        }
        whole.cost()
    }

    /// Opens those of `open` and closes those of `close`, in the top level too, each in time in proportion to its depth. Those that
    /// are no more, or are so already, stay as they are.
    pub(super) fn reopen(&mut self, open: &[u32], close: &[u32]) {
        let changed = self.reopen_some(open, close, false);
        self.note_reopened(&changed);
    }

    /// The tree was built over what these instances were before they were opened or closed. Among few others it has been
    /// decided anew.
    pub(crate) fn note_reopened(&mut self, instances: &[u32]) {
        // A refit that computes nothing leaves the epoch as it is.
        self.epoch += u64::from(!instances.is_empty());
        for &index in instances {
            if !self.placed.get(index as usize).is_some_and(|placed| placed.live) {
                continue;
            }
            for leaf in self.leaves_of(index) {
                let flux = f64::from(self.in_world(leaf).phi());
                self.unsettle_above(self.placed[leaf as usize].node, flux);
            }
        }
    }

    /// Opens and closes, and returns those that were not so yet, which are still to be noted. Where it is done `beside` the
    /// frames, nodes above are computed once for all parts.
    pub(super) fn reopen_some(&mut self, open: &[u32], close: &[u32], beside: bool) -> Vec<u32> {
        let mut changed = Vec::new();
        for (list, wanted) in [(open, true), (close, false)] {
            for &index in list {
                let Some(placed) = self.placed.get(index as usize).filter(|placed| placed.live) else {
                    continue;
                };
                if placed.parts.is_empty() != wanted || (wanted && !self.can_open(index)) {
                    continue;
                }
                self.leaves_of(index).for_each(|leaf| self.remove_leaf(leaf));
                if wanted {
                    self.open(index);
                } else {
                    self.close(index);
                }
                let leaves: Vec<u32> = self.leaves_of(index).collect();
                if beside {
                    self.insert_come(&leaves, Vec::new());
                } else {
                    self.insert_instances(&leaves);
                }
                changed.push(index);
            }
        }
        changed
    }

    fn can_open(&self, index: u32) -> bool {
        let blas = self.blas_index(&self.placed[index as usize]);
        self.opens()
            && !self.stays_closed(blas)
            && parts_below::<N, W>(&self.nodes[self.roots[blas as usize].node as usize]) > 0
    }

    /// Gives an instance that hangs nowhere parts; false where its mesh has none.
    pub(super) fn open(&mut self, index: u32) -> bool {
        self.hand_over(index);
        let blas = self.blas_index(&self.placed[index as usize]);
        let root = self.roots[blas as usize].node;
        let count = parts_below::<N, W>(&self.nodes[root as usize]);
        if count == 0 || self.stays_closed(blas) {
            return false;
        }
        self.take_parts(blas, count);
        let parts = self.placed_ranges.take(count);
        // Until it is hung it is as one that was hung now: its record may have been another's.
        let mut hung = self.placed[index as usize].clone();
        (hung.flickers, hung.hung_radiance, hung.hung_center) = (false, hung.radiance, [f32::NAN; 3]);
        for part in parts.clone() {
            self.put_part(part, index, hung.hung_words());
        }
        let placed = &mut self.placed[index as usize];
        placed.parts = parts.clone();
        placed.node = INVALID;
        let record = &mut self.instances[index as usize];
        record.place = INVALID;
        record.part = parts.start;
        self.place(index);
        // Its leaves are others, whatever its words are.
        self.placed[index as usize].changed = self.epoch;
        true
    }

    /// A record for a part of `instance` that was hung as `hung` tells, its words still to be written.
    pub(super) fn put_part(&mut self, part: u32, instance: u32, hung: [u32; 4]) {
        let old = self.placed.get(part as usize);
        let mut placed = InstanceState {
            live: false,
            generation: old.map_or(0, |old| old.generation + 1),
            user: 0,
            listed: 0,
            lights: 0..0,
            node: INVALID,
            slot: 0,
            hung: 0,
            mark: 0,
            changed: self.epoch,
            parts: 0..0,
            part_of: instance,
            ..self.placed[instance as usize].clone()
        };
        placed.set_hung_words(hung);
        put(&mut self.placed, part, placed.clone(), &placed);
        let old = self.instances.get(part as usize).copied().unwrap_or(NO_INSTANCE);
        let record = Instance {
            listed: old.listed,
            above: old.above,
            ..NO_INSTANCE
        };
        put(&mut self.instances, part, record, &NO_INSTANCE);
    }

    /// Takes the parts of an instance away, which hang nowhere.
    pub(super) fn close(&mut self, index: u32) {
        let parts = core::mem::take(&mut self.placed[index as usize].parts);
        let blas = self.instances[index as usize].blas;
        for part in parts.clone() {
            let old = self.instances[part as usize];
            self.instances[part as usize] = Instance {
                listed: old.listed,
                above: old.above,
                ..NO_INSTANCE
            };
            self.placed[part as usize].part_of = INVALID;
            self.placed[part as usize].node = INVALID;
            self.placed[part as usize].flickers = false;
            self.changes.new.written_instances.push(part);
        }
        self.placed_ranges.give(parts);
        self.instances[index as usize].part = INVALID;
        self.give_parts(blas);
        self.place(index);
        // Its leaves are others, whatever its words are.
        self.placed[index as usize].changed = self.epoch;
    }

    /// One more instance is opened into the parts of a bottom level, `count` of them.
    pub(super) fn take_parts(&mut self, blas: u32, count: u32) {
        if self.blases[blas as usize].opened == 0 {
            self.blases[blas as usize].parts = self.blas_ranges.take(count);
            self.place_parts(blas);
            self.changes.new.roots.insert(blas);
        }
        self.blases[blas as usize].opened += 1;
    }

    /// One less is.
    pub(super) fn give_parts(&mut self, blas: u32) {
        let own = &mut self.blases[blas as usize];
        own.opened -= 1;
        if own.opened == 0 {
            let roots = core::mem::take(&mut own.parts);
            for root in roots.clone() {
                self.roots[root as usize] = BlasRoot::new(INVALID, &N::Summary::EMPTY);
            }
            self.blas_ranges.give(roots);
        }
    }

    /// After a bottom level got other nodes: its instances' parts follow, in the same places where there are as many.
    pub(super) fn update_parts(&mut self, blas: u32) {
        let own = &self.blases[blas as usize];
        if own.opened == 0 {
            return;
        }
        let count = parts_below::<N, W>(&self.nodes[self.roots[blas as usize].node as usize]);
        let as_many = count == own.parts.len() as u32;
        let users = self.meshes[own.mesh as usize].users.iter().copied();
        let opened = users.filter(|&user| !self.placed[user as usize].parts.is_empty());
        let opened: Vec<u32> = opened.collect();
        if as_many {
            self.place_parts(blas);
            self.changes.new.roots.insert(blas);
            opened.into_iter().for_each(|index| self.write_parts(index));
            return;
        }
        for &index in &opened {
            self.leaves_of(index).for_each(|leaf| self.remove_leaf(leaf));
            self.close(index);
        }
        for &index in &opened {
            self.open(index);
        }
        let leaves = self.leaves_of_all(&opened);
        self.insert_instances(&leaves);
    }

    /// Roots of the parts of a bottom level, below its own root.
    pub(super) fn place_parts(&mut self, blas: u32) {
        let (parts, mesh) = {
            let own = &self.blases[blas as usize];
            (own.parts.clone(), own.mesh)
        };
        if parts.is_empty() {
            return;
        }
        let root = self.nodes[self.roots[blas as usize].node as usize];
        let part = Blas::none::<N::Light>(mesh);
        let nothing = BlasRoot::new(INVALID, &N::Summary::EMPTY);
        for (index, slot) in parts.zip(0..) {
            put(
                &mut self.blases,
                index,
                part.clone(),
                &Blas::none::<N::Light>(INVALID),
            );
            put(&mut self.roots, index, nothing, &nothing);
            self.roots[index as usize] = refit::root(&self.nodes, root.link(slot));
        }
    }

    /// Brings the words of an instance's parts in line with its own.
    pub(super) fn write_parts(&mut self, index: u32) {
        let parts = self.placed[index as usize].parts.clone();
        if parts.is_empty() {
            return;
        }
        let own = self.instances[index as usize];
        let roots = self.blases[own.blas as usize].parts.clone();
        for (part, blas) in parts.zip(roots) {
            let old = self.instances[part as usize];
            self.instances[part as usize] = Instance {
                root: self.roots[blas as usize].node,
                blas,
                count: 0,
                part: index,
                listed: old.listed,
                place: old.place,
                above: old.above,
                ..own
            };
            let InstanceState {
                radiance, transform, ..
            } = self.placed[index as usize];
            let placed = &mut self.placed[part as usize];
            placed.changed = self.epoch;
            placed.radiance = radiance;
            placed.transform = transform;
            self.changes.new.mark_instance(part);
        }
    }
}

#[cfg(test)]
mod tests;

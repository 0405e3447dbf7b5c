//! Parts of opened instances: their records, which follow those of the instances, and the roots of bottom levels that parts of
//! one mesh share.

use alloc::vec::Vec;
use core::ops::Range;

use crate::bvh::apply::NO_INSTANCE;
use crate::bvh::blas::{Blas, put};
use crate::bvh::records::InstanceState;
use crate::bvh::{Bvh, Trails};
use crate::instance::Instance;
use crate::node::{Node, kind};
use crate::refit::{self, BlasRoot};
use crate::summary::Summary;
use crate::tree::INVALID;

/// Number of parts that the bottom level with this root can be opened into: its children, where all are nodes and lie in slots
/// without gaps; else 0. A light has no node that could be a root.
pub(in crate::bvh) fn parts_below<N: Node<W>, const W: usize>(root: &N) -> u32 {
    let count = (0..W).take_while(|&slot| root.kind(slot) == kind::INNER).count();
    let is_all = (count..W).all(|slot| root.kind(slot) == kind::EMPTY);
    if is_all && count > 1 { count as u32 } else { 0 }
}

impl<N: Node<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// The records by which an instance hangs in the top level: its parts, or its own.
    pub(in crate::bvh) fn leaves_of(&self, index: u32) -> Range<u32> {
        let parts = &self.placed[index as usize].parts;
        if parts.is_empty() {
            index..index + 1
        } else {
            parts.clone()
        }
    }

    /// The same of several.
    pub(in crate::bvh) fn leaves_of_all(&self, instances: &[u32]) -> Vec<u32> {
        instances
            .iter()
            .flat_map(|&index| self.leaves_of(index))
            .collect()
    }

    /// Gives an instance that hangs nowhere parts; false where its mesh has none.
    pub(in crate::bvh) fn open(&mut self, index: u32) -> bool {
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
    pub(in crate::bvh) fn put_part(&mut self, part: u32, instance: u32, hung: [u32; 4]) {
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
    pub(in crate::bvh) fn close(&mut self, index: u32) {
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
    pub(in crate::bvh) fn take_parts(&mut self, blas: u32, count: u32) {
        if self.blases[blas as usize].opened == 0 {
            self.blases[blas as usize].parts = self.blas_ranges.take(count);
            self.place_parts(blas);
            self.changes.new.roots.insert(blas);
        }
        self.blases[blas as usize].opened += 1;
    }

    /// One less is.
    pub(in crate::bvh) fn give_parts(&mut self, blas: u32) {
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
    pub(in crate::bvh) fn update_parts(&mut self, blas: u32) {
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
    pub(in crate::bvh) fn place_parts(&mut self, blas: u32) {
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
    pub(in crate::bvh) fn write_parts(&mut self, index: u32) {
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

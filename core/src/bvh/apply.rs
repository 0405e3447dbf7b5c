//! Edits done, once they are known to be sound.

use alloc::vec::Vec;

use super::edit::{InstanceId, MeshId};
use super::log::Entry;
use super::records::put;
use super::{Bvh, InstanceState};
use crate::instance::Instance;
use crate::model::Model;
use crate::transform::Transform;

/// Ids that a batch of edits made.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Added {
    /// The id of each mesh added, in the order of the edits that add one.
    pub meshes: Vec<MeshId>,
    /// The id of each instance and light by itself added, in the order of the edits that add one.
    pub instances: Vec<InstanceId>,
}

impl<M: Model<W>, const W: usize> Bvh<M, W> {
    pub(super) fn set_place(&mut self, index: u32, transform: Transform) {
        let own = &mut self.placed[index as usize].transform;
        let bits = |column: &[f32; 3]| column.map(f32::to_bits);
        let is_turned = own.columns.each_ref().map(bits) != transform.columns.each_ref().map(bits);
        let is_moved = bits(&own.translation) != bits(&transform.translation);
        *own = transform;
        if is_turned {
            self.place(index);
        } else if is_moved {
            // No other word depends on it.
            self.instances[index as usize].translation = transform.origin();
            self.log.push(Entry::Instance(index));
            self.mark_stale(index);
        }
    }

    pub(super) fn insert_instance(
        &mut self,
        mesh: MeshId,
        transform: Transform,
        radiance: [f32; 3],
        mask: u32,
    ) -> InstanceId {
        let index = self.placed_ranges.take(1).start;
        let old = self.placed.get(index as usize);
        let (generation, is_stale) = old.map_or((0, false), |old| (old.generation + 1, old.is_stale));
        let own = &mut self.meshes[mesh.index as usize];
        let (user, count) = (own.users.len() as u32, own.lights.len());
        own.users.push(index);
        self.light_count += count;
        let placed = InstanceState {
            live: true,
            generation,
            mesh: mesh.index,
            user,
            transform,
            radiance,
            mask,
            listed: self.live.len() as u32,
            numbers: self.numbers.take(count as u32),
            is_stale,
        };
        put(&mut self.placed, index, placed);
        if self.instances.len() <= index as usize {
            self.instances.resize(index as usize + 1, NO_INSTANCE);
        }
        self.live.push(index);
        self.list(self.live.len() as u32 - 1);
        self.place(index);
        self.id_of_instance(index)
    }

    pub(super) fn take_instance(&mut self, index: u32) {
        self.mark_stale(index);
        if (index as usize) < self.top.places.len() {
            self.top.take_out::<W>(index);
        }
        let placed = &mut self.placed[index as usize];
        placed.live = false;
        let (mesh, user, listed, lights) = (placed.mesh, placed.user, placed.listed, placed.numbers.clone());
        let own = &mut self.meshes[mesh as usize];
        own.users.swap_remove(user as usize);
        if let Some(&moved) = own.users.get(user as usize) {
            self.placed[moved as usize].user = user;
        }
        let goes_too = own.is_light && own.users.is_empty();
        // The last of the list takes its entry.
        self.live.swap_remove(listed as usize);
        if let Some(&moved) = self.live.get(listed as usize) {
            self.placed[moved as usize].listed = listed;
            self.list(listed);
        }
        let end = self.live.len() as u32;
        self.instances[end as usize].listed = NO_INSTANCE.listed;
        self.log.push(Entry::Instance(end));
        self.instances[index as usize] = Instance {
            listed: self.instances[index as usize].listed,
            ..NO_INSTANCE
        };
        self.log.push(Entry::Instance(index));
        self.retire_lights(lights);
        self.placed_ranges.give(index..index + 1);
        if goes_too {
            self.take_mesh(mesh);
        }
    }

    /// Writes entry `entry` of the list of instances in use into the record that holds it.
    fn list(&mut self, entry: u32) {
        self.instances[entry as usize].listed = self.live[entry as usize];
        self.log.push(Entry::Instance(entry));
    }

    /// The words of an instance by its mesh, transform and radiance.
    pub(super) fn record_of(&self, index: u32) -> Instance {
        let placed = &self.placed[index as usize];
        let mesh = &self.meshes[placed.mesh as usize];
        Instance {
            root: mesh.root(),
            blas: placed.mesh,
            first: placed.numbers.start,
            first_light: mesh.lights.start,
            count: placed.numbers.len() as u32,
            listed: self.instances[index as usize].listed,
            mask: placed.mask,
            ..placed.transform.instance_by(placed.radiance, mesh.is_by_area)
        }
    }

    /// Brings the words of an instance in line with its mesh, transform and radiance.
    pub(super) fn place(&mut self, index: u32) {
        self.instances[index as usize] = self.record_of(index);
        self.log.push(Entry::Instance(index));
        self.mark_stale(index);
    }
}

/// The words of an instance that is not in use.
pub(super) const NO_INSTANCE: Instance = Instance {
    flux: 0.0,
    radiance: [0.0; 3],
    ..Instance::IDENTITY
};

//! Edits done, once they are known to be sound.

use alloc::vec::Vec;

use super::edit::{Edit, EditError, InstanceId, MeshId};
use super::log::Entry;
use super::records::put;
use super::{Bvh, InstanceState};
use crate::build::{Topology, build_each};
use crate::instance::Instance;
use crate::model::Model;
use crate::transform::Transform;

/// Ids that a batch of edits made.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Added {
    /// Ids of the meshes added, in the order of their edits.
    pub meshes: Vec<MeshId>,
    /// Ids of the instances added, in the order of their edits.
    pub instances: Vec<InstanceId>,
}

impl<M: Model<W>, const W: usize> Bvh<M, W> {
    /// Applies a batch of edits in their order, all or none. The next [`refit`](Self::refit) restores the quality of sampling.
    /// Until then probabilities are exact and no removed light is returned, but a sample may be none if a light was removed,
    /// and added lights have the uniform share alone.
    ///
    /// Time is in proportion to the edits, to the lights in them, and to the instances of each mesh that is deformed as a
    /// whole, reaches farther than before, or gets its first [surface](crate::light::Light::is_surface) or loses its
    /// last, as often as it is. A mesh is built within the call that adds it: 0.2 to 0.4 µs for each light. The top level
    /// is edited by the next refit (measured: `docs/dynamics.md`).
    ///
    /// # Errors
    /// [`EditError`] naming the first edit that cannot be done; the scene is as before then.
    pub fn apply(&mut self, mut edits: Vec<Edit<M::Light>>) -> Result<Added, EditError> {
        for (mesh, reach) in self.check(&mut edits)? {
            self.meshes[mesh.index as usize].reach = reach;
        }
        let new_meshes = edits.iter().filter_map(|edit| match edit {
            Edit::AddMesh { lights } => Some(&**lights),
            _ => None,
        });
        let mut topologies = build_each(&new_meshes.collect::<Vec<_>>(), &self.params).into_iter();
        let mut updated = Added::default();
        for edit in edits {
            match edit {
                Edit::AddMesh { lights } => {
                    let mesh = topologies
                        .next()
                        .map(|topology| self.insert_mesh(&lights, &topology));
                    updated.meshes.extend(mesh);
                }
                Edit::AddInstance {
                    mesh,
                    transform,
                    radiance,
                    mask,
                } => {
                    updated
                        .instances
                        .push(self.insert_instance(mesh, transform, radiance, mask));
                }
                Edit::AddLight { light, mask } => {
                    // A mesh of one light has no tree.
                    let (nodes, trails, depth) = (Vec::new(), Vec::new(), 0);
                    let none = Topology { nodes, trails, depth };
                    let mesh = self.insert_mesh(&[light], &none);
                    self.meshes[mesh.index as usize].is_light = true;
                    updated
                        .instances
                        .push(self.insert_instance(mesh, Transform::IDENTITY, [1.0; 3], mask));
                }
                Edit::SetLight { instance, light } => {
                    let mesh = self.placed[instance.index as usize].mesh;
                    self.write_lights(mesh, 0, &[light]);
                }
                // Skip edits that change nothing.
                Edit::SetTransform { instance, transform } => self.set_place(instance.index, transform),
                Edit::SetRadiance { instance, radiance } => {
                    let own = &mut self.placed[instance.index as usize].radiance;
                    if core::mem::replace(own, radiance).map(f32::to_bits) != radiance.map(f32::to_bits) {
                        self.place(instance.index);
                    }
                }
                Edit::SetMask { instance, mask } => {
                    let own = &mut self.placed[instance.index as usize].mask;
                    if core::mem::replace(own, mask) != mask {
                        self.place(instance.index);
                    }
                }
                Edit::SetLights { mesh, lights } => self.write_lights(mesh.index, 0, &lights),
                Edit::SetLightRange { mesh, first, lights } => self.write_lights(mesh.index, first, &lights),
                Edit::RemoveInstance(id) => self.take_instance(id.index),
                Edit::RemoveMesh(id) => self.take_mesh(id.index),
            }
        }
        self.bound_log();
        Ok(updated)
    }

    /// Applies each edit of a batch that is sound, in order. Returns the ids that were added, and the errors of the others.
    /// [`apply`](Self::apply) is all or none, and builds several meshes at a time.
    pub fn apply_each(&mut self, edits: Vec<Edit<M::Light>>) -> (Added, Vec<EditError>) {
        let (mut added, mut refused) = (Added::default(), Vec::new());
        for (index, edit) in edits.into_iter().enumerate() {
            match self.apply(alloc::vec![edit]) {
                Ok(own) => {
                    added.meshes.extend(own.meshes);
                    added.instances.extend(own.instances);
                }
                Err(error) => refused.push(EditError { edit: index, ..error }),
            }
        }
        (added, refused)
    }

    fn set_place(&mut self, index: u32, transform: Transform) {
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

    fn take_instance(&mut self, index: u32) {
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

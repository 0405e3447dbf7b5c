//! Edits done, once they are known to be sound.

use alloc::vec::Vec;

use super::blas::put;
use super::edit::{Edit, EditError, InstanceId, MeshId};
use super::{Bvh, InstanceState, Mesh, Trails};
use crate::build::{Topology, build_each};
use crate::instance::Instance;
use crate::node::Node;
use crate::transform::Transform;
use crate::tree::INVALID;

/// What a batch of edits made.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Added {
    /// Ids of the meshes added, in the order of their edits.
    pub meshes: Vec<MeshId>,
    /// Ids of the instances added, in the order of their edits.
    pub instances: Vec<InstanceId>,
}

impl<N: Node<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// Does a batch of edits in their order, all or none. Sampling is as good as before after the next [`refit`](Self::refit);
    /// until then probabilities are exact and no light that is gone is returned, but there may be none where one was removed,
    /// and lights that were added may have the uniform share alone.
    ///
    /// Time is in proportion to the edits, to the triangles in them, and to the instances of each mesh that is deformed as a
    /// whole, reaches farther than before, or has lights of another [`flux_power`](crate::light::Light::flux_power) than
    /// before, as often as it is. An instance that is added, removed, or put in elsewhere since it moved far or changed its
    /// radiance by more than a factor of 2, takes one node of each level, and on average a share of 16 instances in building
    /// subtrees of at most 512 anew; a mirror copies what that writes (measured: `docs/dynamics.md`). One call puts in
    /// elsewhere 64 instances at most, and one more for each 64 that there are; the others keep their places until they move
    /// again, or a rebuild. Where at least as many instances are added as there are, the top level is built anew within the
    /// call. A mesh is built within the call that adds it: 0.2 to 0.4 µs for each triangle.
    ///
    /// # Errors
    /// [`EditError`] naming the first edit that cannot be done; the scene is as before then.
    pub fn apply(&mut self, mut edits: Vec<Edit<N::Light>>) -> Result<Added, EditError> {
        for (mesh, extent) in self.check(&mut edits)? {
            let blas = self.meshes[mesh.index as usize].blas;
            self.blases[blas as usize].extent = extent;
        }
        let new_meshes = edits.iter().filter_map(|edit| match edit {
            Edit::AddMesh { triangles } => Some(&**triangles),
            _ => None,
        });
        let mut topologies = build_each(&new_meshes.collect::<Vec<_>>(), &self.params).into_iter();
        let mut updated = Added::default();
        let (mut added, mut moved) = (Vec::new(), Vec::new());
        let (mut brightened, mut reshaped) = (Vec::new(), Vec::new());
        for edit in edits {
            match edit {
                Edit::AddMesh { triangles } => {
                    let mesh = topologies
                        .next()
                        .map(|topology| self.insert_mesh(&triangles, topology));
                    updated.meshes.extend(mesh);
                }
                Edit::AddInstance {
                    mesh,
                    transform,
                    radiance,
                } => {
                    let mesh = mesh.place_in_batch().map_or(mesh, |place| updated.meshes[place]);
                    let id = self.insert_instance(mesh, transform, radiance);
                    added.push(id.index);
                    updated.instances.push(id);
                }
                // Engines send all their transforms in every frame: what is set as it was is no change.
                Edit::SetTransform { instance, transform } if self.stands_so(instance.index, &transform) => {}
                Edit::SetTransform { instance, transform } => {
                    self.note_dark(instance.index);
                    self.placed[instance.index as usize].transform = transform;
                    if self.place(instance.index) {
                        moved.push(instance.index);
                    }
                }
                Edit::SetRadiance { instance, radiance } if self.shines_so(instance.index, radiance) => {}
                Edit::SetRadiance { instance, radiance } => {
                    let was_off = self.is_off(instance.index);
                    self.placed[instance.index as usize].radiance = radiance;
                    self.place(instance.index);
                    let has_come = was_off && !self.is_off(instance.index);
                    let has_moved_dark = has_come && self.has_moved(instance.index);
                    let is_looked_at_now = has_moved_dark && !self.note_lit(instance.index);
                    let (is_otherwise, is_brighter) = self.shines_otherwise(instance.index);
                    if is_looked_at_now || is_otherwise {
                        moved.push(instance.index);
                        if is_brighter {
                            brightened.push(instance.index);
                        }
                    }
                }
                Edit::SetTriangles { mesh, triangles } => {
                    let blas = self.meshes[mesh.index as usize].blas;
                    self.write_triangles(blas, &triangles);
                    reshaped.push(blas);
                }
                Edit::SetTriangleRange {
                    mesh,
                    first,
                    triangles,
                } => {
                    let blas = self.meshes[mesh.index as usize].blas;
                    self.write_triangle_range(blas, first, &triangles);
                    if triangles.len() == self.blas_len(blas) {
                        reshaped.push(blas);
                    }
                }
                Edit::RemoveInstance(id) => self.take_instance(id.index),
                Edit::RemoveMesh(id) => self.take_mesh(id.index),
            }
        }
        if !added.is_empty() && 2 * added.len() >= self.live.len() {
            self.freshen(&added);
            self.build_top();
        } else {
            let has_new = !added.is_empty() || !brightened.is_empty();
            let usual = if has_new { self.usual_flux() } else { 0.0 };
            let jumped = self.take_jumped(reshaped);
            self.freshen(&added);
            moved.extend(&jumped);
            self.decide_added(&added);
            brightened.extend(&added);
            added = self.leaves_of_all(&added);
            let new = self.leaves_of_all(&brightened);
            self.take_misplaced(moved, &jumped, &mut added);
            added.sort_unstable();
            self.insert_instances(&added);
            self.unsettle_bright(&new, usual);
        }
        self.settle();
        if !updated.meshes.is_empty() || !updated.instances.is_empty() {
            self.reserve_room();
        }
        self.bound_changes();
        Ok(updated)
    }

    /// Whether an instance has this transform, to the bit.
    fn stands_so(&self, index: u32, transform: &Transform) -> bool {
        let words = |own: &Transform| {
            let [a, b, c] = own.columns;
            bytemuck::cast([a, b, c, own.translation])
        };
        is_same::<12>(words(&self.placed[index as usize].transform), words(transform))
    }

    /// Whether an instance has this radiance, and nothing is to be done for it: where many come on at once, some are not where
    /// their light belongs yet.
    fn shines_so(&self, index: u32, radiance: f32) -> bool {
        let is_same = self.placed[index as usize].radiance.to_bits() == radiance.to_bits();
        is_same && !self.shines_otherwise(index).0
    }

    pub(super) fn insert_mesh(&mut self, triangles: &[N::Light], topology: Topology<N>) -> MeshId {
        let index = self.mesh_ranges.take(1).start;
        let blas = self.add_blas(index, triangles, topology);
        let generation = match self.meshes.get(index as usize) {
            Some(old) => old.generation + 1,
            None => 0,
        };
        let mesh = Mesh {
            live: true,
            generation,
            blas,
            users: Vec::new(),
        };
        put(&mut self.meshes, index, mesh.clone(), &mesh);
        MeshId {
            tree: self.id.0,
            index,
            generation,
        }
    }

    fn take_mesh(&mut self, index: u32) {
        self.meshes[index as usize].live = false;
        self.remove_blas(self.meshes[index as usize].blas);
        self.mesh_ranges.give(index..index + 1);
    }

    pub(super) fn insert_instance(
        &mut self,
        mesh: MeshId,
        transform: Transform,
        radiance: f32,
    ) -> InstanceId {
        let index = self.placed_ranges.take(1).start;
        let generation = match self.placed.get(index as usize) {
            Some(old) => old.generation + 1,
            None => 0,
        };
        self.epoch += 1;
        let users = &mut self.meshes[mesh.index as usize].users;
        let user = users.len() as u32;
        users.push(index);
        let blas = self.meshes[mesh.index as usize].blas;
        let lights = self.blases[blas as usize].triangles.len();
        self.light_count += lights;
        let placed = InstanceState {
            live: true,
            generation,
            mesh: mesh.index,
            user,
            transform,
            radiance,
            listed: self.live.len() as u32,
            lights: self.lights.take(lights as u32),
            node: INVALID,
            slot: 0,
            hung: self.epoch,
            hung_radiance: radiance,
            flickers: false,
            hung_center: [f32::NAN; 3],
            mark: 0,
            changed: self.epoch,
            parts: 0..0,
            part_of: INVALID,
        };
        put(&mut self.placed, index, placed.clone(), &placed);
        // The record may hold an entry of the list and a link of the top level, which are not this instance's to take.
        let old = self.instances.get(index as usize);
        let record = old.map_or(NO_INSTANCE, |old| Instance {
            listed: old.listed,
            above: old.above,
            ..NO_INSTANCE
        });
        put(&mut self.instances, index, record, &NO_INSTANCE);
        self.live.push(index);
        self.list(self.live.len() as u32 - 1);
        self.place(index);
        InstanceId {
            tree: self.id.0,
            index,
            generation,
        }
    }

    fn take_instance(&mut self, index: u32) {
        self.hand_over(index);
        self.epoch += 1;
        for leaf in self.leaves_of(index) {
            self.remove_leaf(leaf);
        }
        if !self.placed[index as usize].parts.is_empty() {
            self.close(index);
        }
        self.top.strayed.remove(&index);
        self.top.lit.remove(&index);
        let placed = &mut self.placed[index as usize];
        placed.live = false;
        placed.node = INVALID;
        placed.flickers = false;
        let (mesh, user, listed, lights) = (placed.mesh, placed.user, placed.listed, placed.lights.clone());
        let users = &mut self.meshes[mesh as usize].users;
        users.swap_remove(user as usize);
        if let Some(&moved) = users.get(user as usize) {
            self.placed[moved as usize].user = user;
        }
        // The last of the list takes its entry.
        self.live.swap_remove(listed as usize);
        if let Some(&moved) = self.live.get(listed as usize) {
            self.placed[moved as usize].listed = listed;
            self.list(listed);
        }
        let end = self.live.len() as u32;
        self.instances[end as usize].listed = NO_INSTANCE.listed;
        self.changes.new.written_instances.push(end);
        let old = self.instances[index as usize];
        self.instances[index as usize] = Instance {
            listed: old.listed,
            above: old.above,
            ..NO_INSTANCE
        };
        self.changes.new.written_instances.push(index);
        self.retire_lights(lights);
        self.placed_ranges.give(index..index + 1);
    }

    /// Writes entry `entry` of the list of instances in use into the record that holds it.
    fn list(&mut self, entry: u32) {
        self.instances[entry as usize].listed = self.live[entry as usize];
        self.changes.new.written_instances.push(entry);
    }

    /// Brings the words of an instance in line with its transform and radiance, and says whether that changed any.
    pub(super) fn place(&mut self, index: u32) -> bool {
        self.hand_over(index);
        self.put_words(index)
    }

    /// The same, whichever tree it followed.
    pub(super) fn put_words(&mut self, index: u32) -> bool {
        self.epoch += 1;
        let placed = &self.placed[index as usize];
        let blas = self.meshes[placed.mesh as usize].blas;
        let old = self.instances[index as usize];
        let new = Instance {
            root: self.roots[blas as usize].node,
            blas,
            first: placed.lights.start,
            first_triangle: self.blases[blas as usize].triangles.start,
            count: placed.lights.len() as u32,
            listed: old.listed,
            place: old.place,
            above: old.above,
            part: old.part,
            ..self.in_place(blas, placed.transform, placed.radiance)
        };
        // What is set as it was rests: engines send all their transforms in every frame.
        let is_other = !is_same::<{ size_of::<Instance>() / 4 }>(bytemuck::cast(new), bytemuck::cast(old));
        if is_other {
            self.placed[index as usize].changed = self.epoch;
        }
        self.instances[index as usize] = new;
        self.changes.new.mark_instance(index);
        self.write_parts(index);
        is_other
    }

    /// After a bottom level got other nodes: its instances must know the root.
    pub(super) fn update_root(&mut self, blas: u32) {
        let mesh = self.blases[blas as usize].mesh;
        let users = self.meshes[mesh as usize].users.clone();
        let root = self.roots[blas as usize].node;
        for user in users {
            let instance = &mut self.instances[user as usize];
            if instance.root != root {
                instance.root = root;
                self.changes.new.mark_instance(user);
            }
        }
        self.update_parts(blas);
    }
}

/// Whether all words are the same, without a branch for each: they are few, and compared several at a time.
#[inline(always)]
fn is_same<const COUNT: usize>(a: [u32; COUNT], b: [u32; COUNT]) -> bool {
    a.iter().zip(&b).fold(0, |all, (a, b)| all | (a ^ b)) == 0
}

/// The words of an instance that is not in use.
pub(super) const NO_INSTANCE: Instance = Instance {
    flux: 0.0,
    radiance: 0.0,
    ..Instance::IDENTITY
};

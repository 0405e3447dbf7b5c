//! Edits done, once they are known to be sound.

use alloc::vec::Vec;

use super::blas::{Owner, no_instance, put};
use super::edit::{Edit, EditError, InstanceId, MeshId};
use super::{Mesh, Placed, Scene, blas};
use crate::exact;
use crate::instance::Instance;
use crate::light::EmissiveTriangle;
use crate::node::LightNode;
use crate::transform::{Extent, Transform};
use crate::tree::{INVALID, MeshLeaf};

/// What a batch of edits made.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Updated {
    /// Ids of the meshes added, in the order of their edits.
    pub meshes: Vec<MeshId>,
    /// Ids of the instances added, in the order of their edits.
    pub instances: Vec<InstanceId>,
}

impl<N: LightNode<W>, const W: usize> Scene<N, W> {
    /// Does a batch of edits, all or none. Sampling sees them after the next [`refit`](Self::refit).
    ///
    /// # Errors
    /// [`EditError`] naming the first edit that cannot be done; the scene is as before then.
    pub fn update(&mut self, mut edits: Vec<Edit>) -> Result<Updated, EditError> {
        let mut deformed = self.check(&mut edits)?.into_iter();
        self.removed_lights.clear();
        let mut updated = Updated::default();
        let mut added = Vec::new();
        for edit in edits {
            match edit {
                Edit::AddMesh { triangles } => updated.meshes.push(self.add_mesh(&triangles)),
                Edit::AddInstance {
                    mesh,
                    transform,
                    radiance,
                } => {
                    let id = self.add_instance(mesh, transform, radiance);
                    added.push(id.index);
                    updated.instances.push(id);
                }
                Edit::Move { instance, transform } => {
                    self.placed[instance.index as usize].transform = transform;
                    self.place(instance.index);
                }
                Edit::Shine { instance, radiance } => {
                    self.placed[instance.index as usize].radiance = radiance;
                    self.place(instance.index);
                }
                Edit::Deform { mesh, triangles } => {
                    let extent = deformed.next().unwrap_or_else(|| Extent::of(&triangles));
                    self.deform(mesh, &triangles, extent);
                }
                Edit::RemoveInstance(id) => self.remove_instance(id.index),
                Edit::RemoveMesh(id) => self.remove_mesh(id.index),
            }
        }
        // One may be gone again, and its index taken by another.
        added.retain(|&index| self.placed[index as usize].live);
        added.sort_unstable();
        added.dedup();
        self.graft(&added);
        Ok(updated)
    }

    fn add_mesh(&mut self, triangles: &[EmissiveTriangle]) -> MeshId {
        let index = self.mesh_ranges.take(1).start;
        let blas = self.add_blas(Owner::Mesh(index), triangles);
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
        MeshId { index, generation }
    }

    fn remove_mesh(&mut self, index: u32) {
        self.meshes[index as usize].live = false;
        self.remove_blas(self.meshes[index as usize].blas);
        self.mesh_ranges.give(index..index + 1);
    }

    fn add_instance(&mut self, mesh: MeshId, transform: Transform, radiance: f32) -> InstanceId {
        let index = self.placed_ranges.take(1).start;
        let generation = match self.placed.get(index as usize) {
            Some(old) => old.generation + 1,
            None => 0,
        };
        self.clock += 1;
        let users = &mut self.meshes[mesh.index as usize].users;
        let user = users.len() as u32;
        users.push(index);
        let blas = self.meshes[mesh.index as usize].blas;
        let placed = Placed {
            live: true,
            generation,
            mesh: mesh.index,
            user,
            transform,
            radiance,
            own: None,
            lights: self
                .lights
                .take(self.blases[blas as usize].triangles.len() as u32),
            node: INVALID,
            slot: 0,
            born: self.clock,
        };
        put(&mut self.placed, index, placed.clone(), &placed);
        put(&mut self.instances, index, no_instance(), &no_instance());
        self.place(index);
        InstanceId { index, generation }
    }

    fn remove_instance(&mut self, index: u32) {
        self.clock += 1;
        self.prune(index);
        let placed = &mut self.placed[index as usize];
        placed.live = false;
        placed.node = INVALID;
        let (mesh, user, own, lights) = (placed.mesh, placed.user, placed.own.take(), placed.lights.clone());
        let users = &mut self.meshes[mesh as usize].users;
        users.swap_remove(user as usize);
        if let Some(&moved) = users.get(user as usize) {
            self.placed[moved as usize].user = user;
        }
        if let Some((blas, _)) = own {
            self.remove_blas(blas);
        }
        self.instances[index as usize] = no_instance();
        self.pending.written_instances.push(index);
        self.lights.give(lights.clone());
        self.removed_lights.push(lights);
        self.placed_ranges.give(index..index + 1);
    }

    fn deform(&mut self, id: MeshId, triangles: &[EmissiveTriangle], extent: Extent) {
        let blas = self.meshes[id.index as usize].blas;
        self.blases[blas as usize].extent = extent;
        self.write_triangles(blas, triangles);
        // Instances with triangles of their own need them anew; the others may need some now, or no more.
        for k in 0..self.meshes[id.index as usize].users.len() {
            let user = self.meshes[id.index as usize].users[k];
            if let Some((own, baked)) = self.placed[user as usize].own {
                self.bake(own, id.index, &baked);
            }
            self.place(user);
        }
    }

    /// Writes a mesh's triangles, brought through `transform`, into a bottom level of an instance's own.
    fn bake(&mut self, own: u32, mesh: u32, transform: &Transform) {
        let baked = self.baked(mesh, transform);
        self.blases[own as usize].extent = Extent::of(&baked);
        self.write_triangles(own, &baked);
    }

    fn baked(&self, mesh: u32, transform: &Transform) -> Vec<EmissiveTriangle> {
        let shared = &self.blases[self.meshes[mesh as usize].blas as usize].triangles;
        self.triangles[shared.start as usize..shared.end as usize]
            .iter()
            .map(|triangle| transform.bake(triangle))
            .collect()
    }

    /// Brings the words of an instance in line with its transform and radiance: by the shared bottom level where that can
    /// serve, or by one of its own, as it is or written anew.
    fn place(&mut self, index: u32) {
        let (mesh, transform, radiance, own) = {
            let placed = &self.placed[index as usize];
            (placed.mesh, placed.transform, placed.radiance, placed.own)
        };
        let shared = self.meshes[mesh as usize].blas;
        let by_shared = transform.similarity(&self.blases[shared as usize].extent, radiance);
        let (instance, blas) = match (by_shared, own) {
            (Some(instance), _) => {
                if let Some((own, _)) = own {
                    self.placed[index as usize].own = None;
                    self.remove_blas(own);
                }
                (instance, shared)
            }
            (None, Some((own, baked))) => (self.place_own(index, own, &baked), own),
            (None, None) => {
                let triangles = self.baked(mesh, &transform);
                let own = self.add_blas(Owner::Instance(index), &triangles);
                self.placed[index as usize].own = Some((own, transform));
                (in_world(radiance), own)
            }
        };
        let old = self.instances[index as usize];
        self.instances[index as usize] = Instance {
            root: self.roots[blas as usize].node,
            blas,
            first: self.placed[index as usize].lights.start,
            first_triangle: self.blases[blas as usize].triangles.start,
            trail: old.trail,
            ..instance
        };
        self.pending.mark_instance(index);
    }

    /// The instance of its own bottom level `own`, whose triangles were brought through `baked`: moved since then, or
    /// brought through the transform of now.
    fn place_own(&mut self, index: u32, own: u32, baked: &Transform) -> Instance {
        let (mesh, transform, radiance) = {
            let placed = &self.placed[index as usize];
            (placed.mesh, placed.transform, placed.radiance)
        };
        let extent = self.blases[own as usize].extent;
        let since = transform.since(baked);
        if transform == *baked {
            in_world(radiance)
        } else if let Some(moved) = since.and_then(|since| since.similarity(&extent, radiance)) {
            moved
        } else {
            self.bake(own, mesh, &transform);
            self.placed[index as usize].own = Some((own, transform));
            in_world(radiance)
        }
    }

    /// After a bottom level got other nodes: its instances must know the root.
    pub(super) fn reroot(&mut self, blas: u32) {
        let users: Vec<u32> = match self.blases[blas as usize].owner {
            blas::Owner::Instance(index) => alloc::vec![index],
            blas::Owner::Mesh(mesh) => self.meshes[mesh as usize].users.clone(),
        };
        let root = self.roots[blas as usize].node;
        for user in users {
            let instance = &mut self.instances[user as usize];
            if instance.blas() == blas && instance.root != root {
                instance.root = root;
                self.pending.mark_instance(user);
            }
        }
    }
}

/// An instance of a bottom level in world space.
fn in_world(radiance: f32) -> Instance {
    Instance {
        flux: exact::max(radiance, 0.0),
        radiance,
        ..Instance::world(INVALID, INVALID)
    }
}

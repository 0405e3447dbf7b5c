//! All that can be read of a light BVH.

use alloc::vec::Vec;
use core::ops::Range;

use super::Bvh;
use super::edit::{InstanceId, MeshId};
use crate::instance::Instance;
use crate::light::Light;
use crate::model::{Model, SummaryOf};
use crate::node::Node;
use crate::refit::BlasRoot;

/// All that can be read of a [`Bvh`]: its arrays, what they take, its ids, and its lights by number.
#[derive(Debug)]
pub struct View<'a, M: Model<W>, const W: usize>(pub(super) &'a Bvh<M, W>);

impl<'a, M: Model<W>, const W: usize> View<'a, M, W> {
    /// The nodes of the bottom levels, those not in use included.
    #[must_use]
    pub fn nodes(&self) -> &'a [M::Node] {
        &self.0.nodes
    }

    /// The nodes of the top level, those not in use included.
    #[must_use]
    pub fn top_nodes(&self) -> &'a [M::Node] {
        &self.0.top.nodes
    }

    /// Root and summary of each mesh's bottom level.
    #[must_use]
    pub fn roots(&self) -> &'a [BlasRoot] {
        &self.0.roots
    }

    /// The instances by index; those not in use are in no leaf.
    #[must_use]
    pub fn instances(&self) -> &'a [Instance] {
        &self.0.instances
    }

    /// The lights of all meshes, in their own spaces; the instances of a mesh say where its own begin.
    #[must_use]
    pub fn lights(&self) -> &'a [M::Light] {
        &self.0.lights
    }

    /// Bytes that sampling and pmf read, unused parts included.
    #[must_use]
    pub fn bytes(&self) -> usize {
        let (bvh, top) = (self.0, &self.0.top);
        size_of_val(&*bvh.nodes)
            + size_of_val(&*bvh.instances)
            + size_of_val(&*bvh.trails)
            + size_of_val(&*top.nodes)
            + size_of_val(&*top.above)
            + size_of_val(&*top.places)
            + size_of_val(&*top.parts)
    }

    /// Bytes of all its arrays: what sampling reads, the lights, and what edits and refits need. Lists of changes are not
    /// counted, nor the copy that a rebuilder has: as much as the top level again.
    #[must_use]
    pub fn memory(&self) -> usize {
        let bvh = self.0;
        let users = bvh.meshes.iter().map(|mesh| size_of_val(&*mesh.users));
        size_of_val(&*bvh.nodes)
            + size_of_val(&*bvh.instances)
            + size_of_val(&*bvh.trails)
            + size_of_val(&*bvh.lights)
            + size_of_val(&*bvh.roots)
            + size_of_val(&*bvh.meshes)
            + users.sum::<usize>()
            + size_of_val(&*bvh.placed)
            + size_of_val(&*bvh.live)
            + bvh.top.memory()
    }

    /// Greatest number of nodes on a path from the root to a light.
    #[must_use]
    pub fn depth(&self) -> u32 {
        let bvh = self.0;
        if bvh.single && !bvh.meshes.is_empty() {
            bvh.bottom_depth
        } else {
            bvh.top.depth() + bvh.bottom_depth
        }
    }

    /// Whether it has no top level: see [`single_level`](Bvh::single_level).
    #[must_use]
    pub fn is_single_level(&self) -> bool {
        self.0.single
    }

    /// The merged summary of all lights, as of the last refit.
    #[must_use]
    pub fn summary(&self) -> SummaryOf<M, W> {
        let tree = self.0.tree();
        Node::<W>::merged(&tree.top[tree.root as usize])
    }

    /// Number of lights in the world.
    #[must_use]
    pub fn light_count(&self) -> usize {
        self.0.light_count
    }

    /// One more than the greatest number of a light that is in use, or among the [removed](Self::removed_lights).
    #[must_use]
    pub fn light_end(&self) -> u32 {
        let forgotten = self.removed_lights().first().filter(|_| self.0.forgotten);
        self.0.numbers.used_end().max(forgotten.map_or(0, |all| all.end))
    }

    /// The ids of all instances, lights by themselves among them, in the order of their indices.
    pub fn instance_ids(&self) -> impl Iterator<Item = InstanceId> + Clone + use<'a, M, W> {
        let bvh = self.0;
        let live = (0..).zip(&bvh.placed).filter(|(_, placed)| placed.live);
        live.map(|(index, _)| bvh.id_of_instance(index))
    }

    /// The ids of all meshes, those of lights by themselves among them, in the order of their indices.
    pub fn mesh_ids(&self) -> impl Iterator<Item = MeshId> + Clone + use<'a, M, W> {
        let bvh = self.0;
        let live = (0..).zip(&bvh.meshes).filter(|(_, mesh)| mesh.live);
        live.map(|(index, _)| bvh.id_of_mesh(index))
    }

    /// The id of the instance of index `instance`, as a [`SampledLight`](crate::SampledLight) names it; `None` where there is
    /// no such.
    #[must_use]
    pub fn instance_id(&self, instance: u32) -> Option<InstanceId> {
        self.0
            .placed
            .get(instance as usize)
            .filter(|placed| placed.live)?;
        Some(self.0.id_of_instance(instance))
    }

    /// The id of the mesh of index `mesh`, which is that of [`MeshId::index`]; `None` where there is no such.
    #[must_use]
    pub fn mesh_id(&self, mesh: u32) -> Option<MeshId> {
        self.0.meshes.get(mesh as usize).filter(|own| own.live)?;
        Some(self.0.id_of_mesh(mesh))
    }

    /// The mesh of an instance; `None` where there is no such instance.
    #[must_use]
    pub fn mesh_of(&self, instance: InstanceId) -> Option<MeshId> {
        self.mesh_id(self.0.live(instance)?.mesh)
    }

    /// The lights of an instance: numbered without gaps, the same as long as the instance lives; that of part
    /// `k`, as the mesh was given, is `start + k`.
    #[must_use]
    pub fn lights_of(&self, instance: InstanceId) -> Option<Range<u32>> {
        self.0.live(instance).map(|placed| placed.numbers.clone())
    }

    /// The lights of a mesh, in its own space and in the order in which it was given; `None` where there is no such mesh.
    #[must_use]
    pub fn mesh_lights(&self, mesh: MeshId) -> Option<&'a [M::Light]> {
        let own = self.mesh_id(mesh.index).filter(|&own| own == mesh)?;
        let range = &self.0.meshes[own.index as usize].lights;
        Some(&self.0.lights[range.start as usize..range.end as usize])
    }

    /// Light `light` of the instance of index `instance` in the world, as a [`SampledLight`](crate::SampledLight) names them;
    /// `None` if there is none. A single-level BVH ignores `instance`.
    #[must_use]
    pub fn light(&self, light: u32, instance: u32) -> Option<M::Light> {
        let bvh = self.0;
        let index = if bvh.single { 0 } else { instance };
        let placed = bvh
            .placed
            .get(index as usize)
            .filter(|placed| placed.live && placed.numbers.contains(&light))?;
        let own = &bvh.instances[index as usize];
        let place = bvh.meshes[placed.mesh as usize].lights.start + (light - placed.numbers.start);
        Some(bvh.lights[place as usize].in_world(own, index))
    }

    /// All lights in the world by number, up to the greatest in use. Their `mesh` is the index of the instance; numbers not in
    /// use get lights without radiance of mesh `u32::MAX`.
    #[must_use]
    pub fn world_lights(&self) -> Vec<M::Light> {
        let bvh = self.0;
        let dark = M::Light::DARK;
        let mut out = alloc::vec![dark; bvh.numbers.used_end() as usize];
        for (index, placed) in bvh.placed.iter().enumerate().filter(|(_, placed)| placed.live) {
            let own = &bvh.instances[index];
            let range = bvh.meshes[placed.mesh as usize].lights.clone();
            let local = &bvh.lights[range.start as usize..range.end as usize];
            let lights = placed.numbers.start as usize..placed.numbers.end as usize;
            for (light, own_light) in out[lights].iter_mut().zip(local) {
                *light = own_light.in_world(own, index as u32);
            }
        }
        out
    }

    /// Numbers of removed lights since the last [`take_removed_lights`](Bvh::take_removed_lights), oldest first. Other lights keep their
    /// numbers. Engines that keep an [`InstanceId`] and a light's place in its mesh need none of this: an id is never reused.
    ///
    /// - In a frame: [`apply`](Bvh::apply), take the removed lights, replace everything kept of them, then resample.
    /// - A reservoir of a removed light keeps its count and gets weight 0. Its sample still names the light: do not look it up. An empty
    ///   reservoir is biased if the balance heuristic merges it.
    /// - Old surfaces need old lights: keep copies of the last frame's [`lights`](Self::lights) and [`instances`](Self::instances) for
    ///   [`world_light`](crate::refit::world_light).
    /// - A number is not reused before it is taken, unless too many wait: more than 65,536, and more than there are lights or half of the
    ///   free numbers below 2^30, whichever is less. Then all numbers that wait are freed.
    /// - That is reported by a first range that begins at 0 and covers every number, of present lights too: empty every reservoir.
    ///   The edit that causes it takes time in proportion to the numbers that waited.
    /// - Ranges do not overlap, except that first one.
    #[must_use]
    pub fn removed_lights(&self) -> &'a [Range<u32>] {
        &self.0.removed_lights
    }

    /// Whether an instance is a light by itself.
    #[cfg(test)]
    pub(crate) fn is_light(&self, instance: InstanceId) -> bool {
        let placed = self.0.live(instance);
        placed.is_some_and(|placed| self.0.meshes[placed.mesh as usize].is_light)
    }
}

//! Lights by number: which there are, where they are, and which are no more.

use alloc::vec::Vec;
use core::ops::Range;

use super::Bvh;
use super::edit::{InstanceId, MeshId};
use crate::light::Light;
use crate::lights::MAX_LIGHTS;
use crate::model::Model;

/// Least number of removed lights that may wait to be taken.
const LEAST_WAITING: usize = 1 << 16;

impl<M: Model<W>, const W: usize> Bvh<M, W> {
    /// The lights of an instance: numbered without gaps, the same as long as the instance lives; that of light
    /// `k`, as the mesh was given, is `start + k`.
    #[must_use]
    pub fn lights_of(&self, instance: InstanceId) -> Option<Range<u32>> {
        self.live(instance).map(|placed| placed.numbers.clone())
    }

    /// One more than the greatest number of a light that is in use, or among the [removed](Self::removed_lights).
    #[must_use]
    pub fn light_end(&self) -> u32 {
        let forgotten = self.removed_lights.first().filter(|_| self.forgotten);
        self.numbers.used_end().max(forgotten.map_or(0, |all| all.end))
    }

    /// Light `light` of the instance of index `instance` in the world, as a [`SampledLight`](crate::SampledLight) names them;
    /// `None` if there is none. A single-level BVH ignores `instance`.
    #[must_use]
    pub fn light(&self, light: u32, instance: u32) -> Option<M::Light> {
        let index = if self.single { 0 } else { instance };
        let placed = self
            .placed
            .get(index as usize)
            .filter(|placed| placed.live && placed.numbers.contains(&light))?;
        let own = &self.instances[index as usize];
        let place = self.meshes[placed.mesh as usize].lights.start + (light - placed.numbers.start);
        Some(self.lights[place as usize].in_world(own, index))
    }

    /// The id of the instance of index `instance`, as a [`SampledLight`](crate::SampledLight) names it; `None` where there is
    /// no such.
    #[must_use]
    pub fn instance_id(&self, instance: u32) -> Option<InstanceId> {
        self.placed.get(instance as usize).filter(|placed| placed.live)?;
        Some(self.id_of_instance(instance))
    }

    /// The mesh of an instance; `None` where there is no such instance.
    #[must_use]
    pub fn mesh_of(&self, instance: InstanceId) -> Option<MeshId> {
        self.live(instance).and_then(|placed| self.mesh_id(placed.mesh))
    }

    /// The lights of a mesh, in its own space and in the order in which it was given; `None` where there is no such mesh.
    #[must_use]
    pub fn mesh_lights(&self, mesh: MeshId) -> Option<&[M::Light]> {
        let own = self.mesh_id(mesh.index).filter(|&own| own == mesh)?;
        let range = &self.meshes[own.index as usize].lights;
        Some(&self.lights[range.start as usize..range.end as usize])
    }

    /// The id of the mesh of index `mesh`, which is that of [`MeshId::index`]; `None` where there is no such.
    #[must_use]
    pub fn mesh_id(&self, mesh: u32) -> Option<MeshId> {
        self.meshes.get(mesh as usize).filter(|own| own.live)?;
        Some(self.id_of_mesh(mesh))
    }

    /// Whether an instance is a light by itself.
    #[cfg(test)]
    pub(crate) fn is_light(&self, instance: InstanceId) -> bool {
        let placed = self.live(instance);
        placed.is_some_and(|placed| self.meshes[placed.mesh as usize].is_light)
    }

    pub(super) fn id_of_mesh(&self, index: u32) -> MeshId {
        let generation = self.meshes[index as usize].generation;
        MeshId::from_bits([self.id.0, index, generation])
    }

    pub(super) fn id_of_instance(&self, index: u32) -> InstanceId {
        let generation = self.placed[index as usize].generation;
        InstanceId::from_bits([self.id.0, index, generation])
    }

    /// All lights in the world by number, up to the greatest in use. Their `mesh` is the index of the instance; numbers not in
    /// use get lights without radiance of mesh `u32::MAX`.
    #[must_use]
    pub fn world_lights(&self) -> Vec<M::Light> {
        let dark = M::Light::DARK;
        let mut out = alloc::vec![dark; self.numbers.used_end() as usize];
        for (index, placed) in self.placed.iter().enumerate().filter(|(_, placed)| placed.live) {
            let own = &self.instances[index];
            let range = self.meshes[placed.mesh as usize].lights.clone();
            let local = &self.lights[range.start as usize..range.end as usize];
            let lights = placed.numbers.start as usize..placed.numbers.end as usize;
            for (light, own_light) in out[lights].iter_mut().zip(local) {
                *light = own_light.in_world(own, index as u32);
            }
        }
        out
    }

    /// Number of lights in the world.
    #[must_use]
    pub fn light_count(&self) -> usize {
        self.light_count
    }

    /// Numbers of removed lights since the last [`take_removed_lights`](Self::take_removed_lights), oldest first. Other lights keep their
    /// numbers. Engines that keep an [`InstanceId`] and a light's place in its mesh need none of this: an id is never reused.
    ///
    /// - In a frame: [`apply`](Self::apply), take the removed lights, replace everything kept of them, then resample.
    /// - A reservoir of a removed light keeps its count and gets weight 0. Its sample still names the light: do not look it up. An empty
    ///   reservoir is biased if the balance heuristic merges it.
    /// - Old surfaces need old lights: keep copies of the last frame's [`lights`](Self::lights) and [`instances`](Self::instances) for
    ///   [`world_light`](crate::refit::world_light).
    /// - No new light gets such a number before it is taken, with one exception: if more than 65,536 wait and more than there are lights
    ///   (or than half of what is left of 2^30, if that is less), all become free. The first range is then that of all numbers from 0 on,
    ///   of present lights too: empty every reservoir. That edit takes time in proportion to the numbers that waited.
    /// - Ranges do not overlap, except that first one.
    #[must_use]
    pub fn removed_lights(&self) -> &[Range<u32>] {
        &self.removed_lights
    }

    /// Takes the [numbers of lights that are no more](Self::removed_lights) since they were taken last. From now on new lights
    /// may get them. An engine that keeps no numbers over frames calls this too, for what it leaves waits in memory and in
    /// files: 16 bytes for each removed instance, up to the limit above.
    pub fn take_removed_lights(&mut self) -> Vec<Range<u32>> {
        let removed = core::mem::take(&mut self.removed_lights);
        let given_back = usize::from(core::mem::take(&mut self.forgotten));
        for range in &removed[given_back..] {
            self.numbers.give(range.clone());
        }
        self.waiting_lights = 0;
        removed
    }

    /// Lights that are no more.
    pub(super) fn retire_lights(&mut self, lights: Range<u32>) {
        self.light_count -= lights.len();
        self.waiting_lights += lights.len();
        self.removed_lights.push(lights);
        // As many as there are lights, but not so many that numbers run out.
        let most = self
            .light_count
            .min(MAX_LIGHTS.saturating_sub(self.light_count) / 2);
        if self.waiting_lights > LEAST_WAITING.max(most) {
            // Waiting numbers count as used; earlier forgotten ones were not reported yet.
            let end = self.light_end();
            self.take_removed_lights();
            self.removed_lights.push(0..end);
            self.forgotten = true;
        }
    }
}

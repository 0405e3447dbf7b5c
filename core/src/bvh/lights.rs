//! Ids, and numbers of lights that are no more.

use core::ops::Range;

use super::Bvh;
use super::edit::{InstanceId, MeshId};
use crate::lights::MAX_LIGHTS;
use crate::model::Model;

/// Least number of removed lights that may wait to be taken.
const LEAST_WAITING: usize = 1 << 16;

impl<M: Model<W>, const W: usize> Bvh<M, W> {
    pub(super) fn id_of_mesh(&self, index: u32) -> MeshId {
        let generation = self.meshes[index as usize].generation;
        MeshId::from_bits([self.id.0, index, generation])
    }

    pub(super) fn id_of_instance(&self, index: u32) -> InstanceId {
        let generation = self.placed[index as usize].generation;
        InstanceId::from_bits([self.id.0, index, generation])
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
            let end = self.view().light_end();
            self.take_removed_lights();
            self.removed_lights.push(0..end);
            self.forgotten = true;
        }
    }
}

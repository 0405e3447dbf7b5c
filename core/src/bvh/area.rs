//! Whether the flux of a mesh grows with the scale of its instances.

use super::Bvh;
use crate::light::Light;
use crate::model::Model;

/// Whether flux goes by area, as that of surfaces does. Other lights of the mesh get a wrong, but positive, weight.
pub(super) fn is_by_area<L: Light>(lights: &[L]) -> bool {
    lights.is_empty() || lights.iter().any(Light::is_surface)
}

impl<M: Model<W>, const W: usize> Bvh<M, W> {
    /// Whether the flux of a mesh goes by area.
    pub(super) fn goes_by_area(&self, mesh: u32) -> bool {
        let own = &self.meshes[mesh as usize].lights;
        is_by_area(&self.lights[own.start as usize..own.end as usize])
    }
}

#[cfg(test)]
mod tests;

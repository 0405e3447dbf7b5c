//! How the flux of a mesh grows with the scale of its instances.

use super::Bvh;
use crate::instance::Instance;
use crate::light::Light;
use crate::node::Node;
use crate::transform::Transform;

/// The [`flux_power`](Light::flux_power) that all lights have. If they differ it is that of surfaces: weights then are as far
/// off as their own powers are from it, and positive all the same.
pub(super) fn common_power<L: Light>(lights: &[L]) -> u32 {
    if !L::HAS_FLUX_POWERS {
        return L::FLUX_POWER;
    }
    let mut powers = lights.iter().map(Light::flux_power);
    match powers.next() {
        Some(first @ (0 | 3)) if powers.all(|power| power == first) => first,
        _ => 2,
    }
}

impl<N: Node<W>, I, const W: usize> Bvh<N, I, W> {
    /// The words of an instance of `mesh` that depend on its map, its radiance and the kind of the mesh's lights.
    pub(super) fn in_place(&self, mesh: u32, transform: Transform, radiance: [f32; 3]) -> Instance {
        let power = self.meshes[mesh as usize].power;
        let own = transform.instance_by(radiance, power);
        let is_told = N::Light::HAS_FLUX_POWERS && power != 2;
        Instance {
            mirrored: own.mirrored | if is_told { Instance::IS_NOT_BY_AREA } else { 0 },
            ..own
        }
    }

    /// The power of a mesh's lights.
    pub(super) fn power_of(&self, mesh: u32) -> u32 {
        let own = &self.meshes[mesh as usize].triangles;
        common_power(&self.triangles[own.start as usize..own.end as usize])
    }
}

#[cfg(test)]
mod tests;

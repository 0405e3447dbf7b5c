//! How the flux of a mesh grows with the scale of its instances.

use core::ops::Range;

use super::{Bvh, Trails};
use crate::instance::Instance;
use crate::light::Light;
use crate::node::Node;
use crate::transform::Transform;
use crate::validate::{Violation, equal};

/// Numbers of a mesh's lights by [`flux_power`](Light::flux_power), where its type of lights has several.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Powers {
    lights: u32,
    /// Those of power 0.
    points: u32,
    /// Those of power 3.
    volumes: u32,
}

impl Powers {
    /// Of these lights; nothing where their type has one power.
    pub fn of<L: Light>(lights: &[L]) -> Self {
        let mut powers = Self::default();
        if L::HAS_FLUX_POWERS {
            powers.lights = lights.len() as u32;
            for light in lights {
                powers.points += u32::from(light.flux_power() == 0);
                powers.volumes += u32::from(light.flux_power() == 3);
            }
        }
        powers
    }

    /// Once lights of powers `new` are in place of some of powers `old`.
    fn with(self, old: Self, new: Self) -> Self {
        Self {
            lights: self.lights - old.lights + new.lights,
            points: self.points - old.points + new.points,
            volumes: self.volumes - old.volumes + new.volumes,
        }
    }

    /// The power that all lights have. Where they differ it is that of surfaces: weights then are as far off as their own
    /// powers are from it, and positive all the same.
    fn common<L: Light>(self) -> u32 {
        if !L::HAS_FLUX_POWERS {
            L::FLUX_POWER
        } else if self.lights > 0 && self.points == self.lights {
            0
        } else if self.lights > 0 && self.volumes == self.lights {
            3
        } else {
            2
        }
    }
}

impl<N: Node<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// The words of an instance of `mesh` that depend on its map, its radiance and the kind of the mesh's lights.
    pub(super) fn in_place(&self, mesh: u32, transform: Transform, radiance: f32) -> Instance {
        let power = self.meshes[mesh as usize].powers.common::<N::Light>();
        let own = transform.instance_by(radiance, power);
        let is_told = N::Light::HAS_FLUX_POWERS && power != 2;
        Instance {
            mirrored: own.mirrored | if is_told { Instance::IS_NOT_BY_AREA } else { 0 },
            ..own
        }
    }

    /// The powers of a mesh after `lights` replace those in `range`; takes time in proportion to `lights`.
    pub(super) fn powers_with(&self, mesh: u32, range: Range<u32>, lights: &[N::Light]) -> Powers {
        let own = &self.meshes[mesh as usize];
        if !N::Light::HAS_FLUX_POWERS || range == own.triangles {
            return Powers::of(lights);
        }
        let old = Powers::of(&self.triangles[range.start as usize..range.end as usize]);
        own.powers.with(old, Powers::of(lights))
    }

    /// Sets the powers of a mesh; if the common power changes, the words of its instances do too.
    pub(super) fn set_powers(&mut self, mesh: u32, powers: Powers) {
        let own = &mut self.meshes[mesh as usize];
        let old = core::mem::replace(&mut own.powers, powers);
        if old.common::<N::Light>() != powers.common::<N::Light>() {
            for user in own.users.clone() {
                self.place(user);
            }
        }
    }

    /// Whether the powers of a mesh are those of its lights.
    pub(super) fn check_powers(&self, mesh: u32) -> Result<(), Violation> {
        let own = &self.meshes[mesh as usize];
        let lights = &self.triangles[own.triangles.start as usize..own.triangles.end as usize];
        let found = own.powers.common::<N::Light>();
        let expected = Powers::of(lights).common::<N::Light>();
        equal(crate::tree::INVALID, mesh, "flux power", expected, found)
    }
}

#[cfg(test)]
mod tests;

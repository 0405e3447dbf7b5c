//! The lights of a scene, read through their instances: where an instance moves, its record is all that changes.

use lightbvh::light::Light;
use lightbvh::refit::world_light;
use lightbvh::{EmissiveTriangle, INVALID, Instance};

/// What emits. Lights in world space are those of one instance, [`listed`].
#[derive(Clone, Copy)]
pub struct Emitters<'a, L = EmissiveTriangle> {
    /// The lights of all meshes, in the spaces of their meshes.
    pub lights: &'a [L],
    /// Where the meshes stand.
    pub instances: &'a [Instance],
}

/// The one instance of `count` lights that are listed in world space.
#[must_use]
pub const fn listed(count: u32) -> [Instance; 1] {
    [Instance {
        count,
        ..Instance::IDENTITY
    }]
}

impl<L: Light> Emitters<'_, L> {
    /// Light `light` of `instance` in the world, without radiance where there is no such light. Where there is one instance, it is
    /// meant: surfaces name the mesh lights of a scene whether or not the tree over it has two levels.
    #[inline]
    #[must_use]
    pub fn light(&self, light: u32, instance: u32) -> L {
        let instance = if self.instances.len() < 2 {
            INVALID
        } else {
            instance
        };
        world_light(self.lights, self.instances, light, instance)
    }
}

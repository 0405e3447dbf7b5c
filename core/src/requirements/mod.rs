//! What a scene requires of a light BVH, and the smallest model that is sufficient.
//!
//! ```
//! use lightbvh::requirements::{Declared, Requirements};
//! # let bvh = lightbvh::LightBvh::default();
//! let requirements = Requirements::of(&bvh, Declared::default());
//! println!("{}", requirements.model()); // a type to write down, and how to build it
//! ```
//!
//! Facts are counted in the words of the current lights; the caller [declares](Declared) the changes of later frames. An engine
//! asks during development, or when a level is baked, and names the returned type; other models are then not compiled.

mod choice;
#[cfg(test)]
mod tests;

use crate::bvh::Bvh;
use crate::instance::Instance;
use crate::light::EmissiveTriangle;
use crate::model::Model;

pub use choice::{Choice, Layout};

/// Edits that the caller will make. A scene does not show them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Declared {
    /// Instances move ([`Edit::SetTransform`](crate::Edit::SetTransform)).
    pub transforms: bool,
    /// Instances become brighter or dimmer, as a whole ([`Edit::SetRadiance`](crate::Edit::SetRadiance)).
    pub radiance: bool,
    /// Meshes deform, or the emission of their triangles varies ([`Edit::SetLights`](crate::Edit::SetLights)); none turns
    /// from one that shines from both sides into one that shines from one.
    pub triangles: bool,
    /// Instances of the same meshes are inserted and removed.
    pub instances: bool,
    /// Meshes are inserted of which nothing is known yet.
    pub meshes: bool,
}

/// Counts of a scene's lights, and the declared changes. [`model`](Self::model) draws the conclusion.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Requirements {
    /// What the caller says.
    pub declared: Declared,
    /// Number of meshes.
    pub meshes: usize,
    /// Number of instances.
    pub instances: usize,
    /// Most instances that one mesh has.
    pub most_instances: usize,
    /// Number of triangles of all meshes.
    pub triangles: usize,
    /// Number of lights: triangles of all instances.
    pub lights: usize,
    /// Triangles of all meshes that shine from one side, so that they have a normal or may get one.
    pub one_sided: usize,
    /// Instances that stand elsewhere than at the identity, or whose factor on radiance is not 1.
    pub placed: usize,
}

impl Requirements {
    /// Counts the lights of a light BVH's scene. Takes time in proportion to its triangles.
    #[must_use]
    pub fn of<M: Model<W, Light = EmissiveTriangle>, const W: usize>(
        bvh: &Bvh<M, W>,
        declared: Declared,
    ) -> Self {
        let view = bvh.view();
        let meshes = view.mesh_ids().filter_map(|mesh| view.mesh_lights(mesh));
        let one_sided = meshes.clone().flatten().filter(|own| !own.is_two_sided());
        let mut found = Self {
            declared,
            meshes: meshes.clone().count(),
            triangles: meshes.clone().map(<[_]>::len).sum(),
            one_sided: one_sided.count(),
            ..Self::default()
        };
        let mut users = alloc::vec![0_usize; view.roots().len()];
        for own in view.instances().iter().filter(|own| own.count > 0) {
            found.instances += 1;
            found.lights += own.count as usize;
            users[own.blas as usize] += 1;
            let stays = own.columns == Instance::IDENTITY.columns && own.translation == [0.0; 3];
            found.placed += usize::from(!stays || own.radiance != [1.0; 3]);
        }
        found.most_instances = users.into_iter().max().unwrap_or(0);
        found
    }

    /// Whether there is one mesh, in one place.
    #[must_use]
    pub fn is_one_mesh(&self) -> bool {
        self.meshes == 1 && self.instances == 1
    }
}

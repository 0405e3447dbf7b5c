//! What a scene requires of a light BVH, and the smallest model that is sufficient.
//!
//! ```
//! use lightbvh::requirements::{Declared, Requirements};
//! # let bvh = lightbvh::LightBvh::default();
//! let requirements = Requirements::of(&bvh, Declared::STATIC); // or of `Lights`
//! println!("{}", requirements.model()); // a type to write down, and how to build it
//! ```
//!
//! Facts are counted in the words of the lights as they stand, exactly but for [`TOLERANCE`]; what the frames to come bring is what
//! the caller [declares](Declared). An engine asks while it is developed, or when a level is baked, and
//! names the type that it is told: what is not chosen is then not compiled.

mod declared;
mod facts;
mod kinds;
mod model;
mod orientation;
mod scene;
mod smallest;
#[cfg(test)]
mod tests;
mod transforms;

use crate::light::EmissiveTriangle;
use crate::moments::LightMoments;

pub use declared::{Changes, Declared};
pub use facts::Fact;
pub use kinds::LightKinds;
pub use model::{Layout, Model, ModelError, Structure, Updates};
pub use orientation::Orientation;
pub(crate) use scene::Placed;
pub use scene::SceneLights;
pub use transforms::{TOLERANCE, TransformKind};

/// What is known of a scene's lights, and what is declared of their future. A plain structure: [`facts`](Self::facts) gives
/// reasons, [`model`](Self::model) draws the conclusion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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
    /// Most triangles that a mesh has.
    pub most_triangles: usize,
    /// Number of lights: triangles of all instances.
    pub lights: usize,
    /// How many of them have no flux: no area, no radiance, or an instance that is off.
    pub dark: usize,
    /// Triangles with flux in their mesh that shine from one side, with a normal.
    pub one_sided: usize,
    /// Triangles with flux in their mesh that shine from both sides.
    pub two_sided: usize,
    /// Triangles with flux in their mesh that shine from one side, but are so thin that no normal is known of them.
    pub needles: usize,
    /// Triangles without flux in their mesh that would shine from one side.
    pub unlit: usize,
    /// Whether normals tell anything.
    pub orientation: Orientation,
    /// Instances by [`TransformKind`], in its order.
    pub transforms: [usize; 5],
    /// Instances whose map mirrors.
    pub mirrored: usize,
    /// Instances whose factor on radiance is not 1.
    pub dimmed: usize,
}

impl Requirements {
    /// What `scene`, a `&Bvh` or `&Lights`, requires under what is `declared`. Takes time in proportion to its lights, about
    /// that of a refit; triangles are sorted once more where their normals may cancel.
    #[must_use]
    pub fn of<'a>(scene: impl Into<SceneLights<'a>>, declared: Declared) -> Self {
        let scene = scene.into();
        let mut users = alloc::vec![0_usize; scene.meshes.len()];
        let mut found = Self {
            declared,
            meshes: scene.meshes.len(),
            instances: scene.placed.len(),
            most_instances: 0,
            triangles: 0,
            most_triangles: 0,
            lights: 0,
            dark: 0,
            one_sided: 0,
            two_sided: 0,
            needles: 0,
            unlit: 0,
            orientation: Orientation::Absent,
            transforms: [0; 5],
            mirrored: 0,
            dimmed: 0,
        };
        for mesh in &scene.meshes {
            found.triangles += mesh.len();
            found.most_triangles = found.most_triangles.max(mesh.len());
            let normals = orientation::Normals::of(mesh);
            found.one_sided += normals.one_sided;
            found.two_sided += normals.two_sided;
            found.needles += normals.needles;
            found.unlit += normals.unlit;
            found.orientation = found.orientation.max(normals.orientation);
        }
        for placed in &scene.placed {
            users[placed.mesh] += 1;
            found.transforms[TransformKind::of(&placed.transform) as usize] += 1;
            found.mirrored += usize::from(placed.instance.mirrors());
            found.dimmed += usize::from(placed.radiance.to_bits() != 1.0_f32.to_bits());
            for local in scene.meshes[placed.mesh] {
                let light: EmissiveTriangle = placed.instance.triangle(local, 0);
                found.dark += usize::from(LightMoments::of_triangle(&light).phi <= 0.0);
            }
            found.lights += scene.meshes[placed.mesh].len();
        }
        found.most_instances = users.into_iter().max().unwrap_or(0);
        found
    }

    /// The simplest kind that the maps of all instances are of; the identity where there is none.
    #[must_use]
    pub fn transform(&self) -> TransformKind {
        use TransformKind as K;
        let kinds = [K::Identity, K::Translation, K::Rigid, K::Uniform, K::NonUniform];
        let of = kinds.into_iter().zip(self.transforms);
        of.filter(|&(_, count)| count > 0)
            .map(|(kind, _)| kind)
            .max()
            .unwrap_or(K::Identity)
    }

    /// Whether there is one mesh, in one place.
    #[must_use]
    pub fn is_one_mesh(&self) -> bool {
        self.meshes == 1 && self.instances == 1
    }
}

//! What a scene requires of a light BVH, and the smallest model that is sufficient.
//!
//! ```
//! use lightbvh::requirements::{Declared, Requirements};
//! # let bvh = lightbvh::LightBvh::default();
//! let requirements = Requirements::of(&bvh, Declared::STATIC);
//! println!("{}", requirements.model()); // a type to write down, and how to build it
//! ```
//!
//! Facts are counted in the words of the current lights; the caller [declares](Declared) the changes of later frames. An engine
//! asks during development, or when a level is baked, and names the returned type; other models are then not compiled.

mod model;
#[cfg(test)]
mod tests;

use crate::bvh::Bvh;
use crate::light::EmissiveTriangle;
use crate::moments::LightMoments;
use crate::node::LightNode;
use crate::transform::Transform;

pub use model::{Layout, Model, Updates};

/// What the caller says of the frames to come, edit by edit. Nothing of it can be seen in a scene as it stands.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Declared {
    /// Instances move ([`Edit::SetTransform`](crate::Edit::SetTransform)).
    pub transforms: bool,
    /// Instances become brighter or dimmer, as a whole ([`Edit::SetRadiance`](crate::Edit::SetRadiance)).
    pub radiance: bool,
    /// Meshes deform, or the emission of their triangles varies ([`Edit::SetTriangles`](crate::Edit::SetTriangles)); none turns
    /// from one that shines from both sides into one that shines from one.
    pub triangles: bool,
    /// Instances of the same meshes are inserted and removed.
    pub instances: bool,
    /// Meshes are inserted of which nothing is known yet.
    pub meshes: bool,
}

impl Declared {
    /// Nothing changes.
    pub const STATIC: Self = Self {
        transforms: false,
        radiance: false,
        triangles: false,
        instances: false,
        meshes: false,
    };
}

/// The simplest kind that a map is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum TransformKind {
    /// Every entry is that of the identity.
    Identity,
    /// The linear part A is that of the identity.
    Translation,
    /// AᵀA is the identity, up to 2^-20: lengths stay.
    Rigid,
    /// AᵀA is a multiple of the identity, up to 2^-20 of it: all lengths grow alike.
    Uniform,
    /// Lengths grow unlike in different directions.
    NonUniform,
}

impl TransformKind {
    /// Of `transform`. A mirroring map is of the kind that its lengths say.
    #[must_use]
    pub fn of(transform: &Transform) -> Self {
        if transform.columns == Transform::IDENTITY.columns {
            let stays = transform.translation == [0.0; 3];
            return [Self::Translation, Self::Identity][usize::from(stays)];
        }
        // Rotations rounded to `f32` are within 2^-22.
        let near = |found: f64, expected: f64, unit: f64| (found - expected).abs() <= unit / 1_048_576.0;
        let columns = transform.columns.map(|column| column.map(f64::from));
        let gram = |i: usize, j: usize| -> f64 { (0..3).map(|k| columns[i][k] * columns[j][k]).sum() };
        let squared = (gram(0, 0) + gram(1, 1) + gram(2, 2)) / 3.0;
        let of_scale = |k: usize| if k % 4 == 0 { squared } else { 0.0 };
        let alike = (0..9).all(|k| near(gram(k / 3, k % 3), of_scale(k), squared));
        // A map onto one point has no scale.
        if !alike || squared <= 0.0 {
            Self::NonUniform
        } else if near(squared, 1.0, 1.0) {
            Self::Rigid
        } else {
            Self::Uniform
        }
    }
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
    /// How many of them have no flux: no area, no radiance, or an instance that is off.
    pub dark: usize,
    /// Triangles of all meshes that shine from one side, so that they have a normal or may get one.
    pub one_sided: usize,
    /// Instances by [`TransformKind`], in its order.
    pub transforms: [usize; 5],
    /// Instances whose factor on radiance is not 1.
    pub dimmed: usize,
}

impl Requirements {
    /// Counts the lights of a light BVH's scene. Takes time in proportion to its lights, about that of a
    /// refit.
    #[must_use]
    pub fn of<N: LightNode<W>, I, const W: usize>(bvh: &Bvh<N, I, W>, declared: Declared) -> Self {
        let (meshes, placed) = bvh.meshes_and_places();
        let mut users = alloc::vec![0_usize; meshes.len()];
        let mut found = Self {
            declared,
            meshes: meshes.len(),
            instances: placed.len(),
            triangles: meshes.iter().map(|mesh| mesh.len()).sum(),
            ..Self::default()
        };
        let all = meshes.iter().copied().flatten();
        found.one_sided = all.filter(|triangle| !triangle.is_two_sided()).count();
        for (mesh, transform, radiance, instance) in placed {
            users[mesh] += 1;
            found.transforms[TransformKind::of(&transform) as usize] += 1;
            found.dimmed += usize::from(radiance.to_bits() != 1.0_f32.to_bits());
            for local in meshes[mesh] {
                let light: EmissiveTriangle = instance.triangle(local, 0);
                found.dark += usize::from(LightMoments::of_triangle(&light).phi <= 0.0);
            }
            found.lights += meshes[mesh].len();
        }
        found.most_instances = users.into_iter().max().unwrap_or(0);
        found
    }

    /// The simplest kind that the maps of all instances are of; the identity where there is none.
    #[must_use]
    pub fn transform(&self) -> TransformKind {
        use TransformKind as K;
        let kinds = [K::Identity, K::Translation, K::Rigid, K::Uniform, K::NonUniform];
        let last = self.transforms.iter().rposition(|&count| count > 0);
        kinds[last.unwrap_or(0)]
    }

    /// Whether there is one mesh, in one place.
    #[must_use]
    pub fn is_one_mesh(&self) -> bool {
        self.meshes == 1 && self.instances == 1
    }
}

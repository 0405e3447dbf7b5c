//! One frame of a scene.

use std::sync::Arc;

use lightbvh::light::{AnyLight, EmissiveTriangle};
use lightbvh_kernels::shading::material::Material as SurfaceMaterial;
use lightbvh_kernels::shading::textures::Corner;
use lightbvh_kernels::shading::trace::{NONE, SurfaceTriangle};

use super::camera::View;
use super::ray_bvh::RayBvh;
use super::scene_light::SceneLight;
use super::texture_words::TextureArrays;

/// The paper animates its scenes at a simulated 25 frames per second (section 4.1).
pub const FRAMES_PER_SECOND: u32 = 25;

/// A mesh light: one instance of one emissive primitive, its triangles contiguous.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MeshRange {
    /// Index of the first triangle in [`Frame::emissive`].
    pub first: u32,
    /// Number of triangles, above zero.
    pub count: u32,
    /// Node and mesh, for messages.
    pub name: String,
}

/// A scene at one time. Lengths and order are the same in every frame of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Every triangle, emissive or not.
    pub triangles: Vec<SurfaceTriangle>,
    /// Triangles with radiance above zero, those of zero area included.
    pub emissive: Vec<EmissiveTriangle>,
    /// Ranges of `emissive`, in order, without gaps.
    pub mesh_lights: Vec<MeshRange>,
    /// Lights by formula, numbered after those, and each a mesh light of its own after [`mesh_lights`](Self::mesh_lights).
    pub others: Vec<AnyLight>,
    /// Where `triangles`, then `emissive` lie on textures; empty without textures.
    pub corners: [Vec<Corner>; 2],
    /// [`TextureArrays::words`](super::TextureArrays); empty without textures.
    pub textures: Arc<Vec<u32>>,
    /// By [`SurfaceTriangle::material`]; the last one of lights by formula, where there are any.
    pub materials: Vec<SurfaceMaterial>,
    /// Where the frame is seen from.
    pub camera: View,
    /// Radiance of rays that leave the scene, W/(m² sr).
    pub background: [f32; 3],
}

impl Frame {
    /// Textures of the triangles that `rays` are of.
    pub fn textures(&self, rays: &RayBvh) -> TextureArrays {
        if self.textures.is_empty() {
            return TextureArrays::default();
        }
        let [surfaces, lights] = &self.corners;
        let of = |&source: &u32| surfaces.get(source as usize).copied().unwrap_or(NO_CORNER);
        let surfaces = rays.sources().iter().map(of);
        TextureArrays {
            corners: surfaces.chain(lights.iter().copied()).collect(),
            words: Arc::clone(&self.textures),
        }
    }

    /// All lights that the type holds, in the order in which they are numbered.
    pub fn lights<L: SceneLight>(&self) -> Vec<L> {
        let triangles = self.emissive.iter().map(|&triangle| L::from(triangle));
        triangles
            .chain(self.others.iter().filter_map(|&light| L::of_kind(light)))
            .collect()
    }
}

/// Of a triangle without textures.
pub(super) const NO_CORNER: Corner = Corner {
    uv: [[0.0; 2]; 3],
    material: NONE,
};

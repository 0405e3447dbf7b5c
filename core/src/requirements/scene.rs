//! Lights as requirements see them: meshes, and where they stand.

use alloc::vec::Vec;

use crate::bvh::{Bvh, Trails};
use crate::instance::Instance;
use crate::light::EmissiveTriangle;
use crate::lights::Lights;
use crate::node::LightNode;
use crate::transform::Transform;

/// Validated lights: from a [`Bvh`], whose meshes are shared by instances, or from [`Lights`], each of whose mesh lights is a
/// mesh that stands in the world.
#[derive(Clone, Debug)]
pub struct SceneLights<'a> {
    pub(super) meshes: Vec<&'a [EmissiveTriangle]>,
    pub(super) placed: Vec<Placed>,
}

/// A mesh in the world.
#[derive(Clone, Debug)]
pub(crate) struct Placed {
    /// Index into the meshes.
    pub mesh: usize,
    pub transform: Transform,
    /// Factor on the mesh's radiance.
    pub radiance: f32,
    /// Its words.
    pub instance: Instance,
}

impl<'a, N, I, const W: usize, T: Trails> From<&'a Bvh<N, I, W, T>> for SceneLights<'a>
where
    N: LightNode<W>,
{
    fn from(bvh: &'a Bvh<N, I, W, T>) -> Self {
        let (meshes, placed) = bvh.meshes_and_places();
        Self { meshes, placed }
    }
}

impl<'a> From<&'a Lights> for SceneLights<'a> {
    fn from(lights: &'a Lights) -> Self {
        let meshes = (0..lights.mesh_count()).map(|mesh| &lights.triangles()[lights.mesh(mesh)]);
        let placed = (0..lights.mesh_count()).map(|mesh| Placed {
            mesh,
            transform: Transform::IDENTITY,
            radiance: 1.0,
            instance: Transform::IDENTITY.instance_by(1.0, 2),
        });
        Self {
            meshes: meshes.collect(),
            placed: placed.collect(),
        }
    }
}

//! Edits one at a time.

use alloc::vec::Vec;

use super::edit::{Edit, EditError, InstanceId, MeshId};
use super::{Added, Bvh};
use crate::light::EmissiveTriangle;
use crate::node::LightNode;
use crate::transform::Transform;

impl<N: LightNode<W>, I, const W: usize> Bvh<N, I, W> {
    /// Adds a mesh of at least one triangle, in its own space; it lights nothing before an instance puts it into the world.
    ///
    /// # Errors
    /// [`EditError`], as of [`apply`](Self::apply).
    pub fn add_mesh(&mut self, triangles: Vec<EmissiveTriangle>) -> Result<MeshId, EditError> {
        let Added { meshes, .. } = self.apply(alloc::vec![Edit::AddMesh { triangles }])?;
        Ok(meshes[0])
    }

    /// Puts a mesh into the world.
    ///
    /// # Errors
    /// [`EditError`], as of [`apply`](Self::apply).
    pub fn add_instance(&mut self, mesh: MeshId, transform: Transform) -> Result<InstanceId, EditError> {
        let added = self.apply(alloc::vec![Edit::AddInstance {
            mesh,
            transform,
            radiance: 1.0,
        }])?;
        Ok(added.instances[0])
    }

    /// Moves an instance.
    ///
    /// # Errors
    /// [`EditError`], as of [`apply`](Self::apply).
    pub fn set_transform(&mut self, instance: InstanceId, transform: Transform) -> Result<(), EditError> {
        self.one(Edit::SetTransform { instance, transform })
    }

    /// Makes an instance brighter or dimmer: `radiance` is a factor on its mesh's, 0 or from 2^-60 to 2^60.
    ///
    /// # Errors
    /// [`EditError`], as of [`apply`](Self::apply).
    pub fn set_radiance(&mut self, instance: InstanceId, radiance: f32) -> Result<(), EditError> {
        self.one(Edit::SetRadiance { instance, radiance })
    }

    /// Gives a mesh as many other triangles.
    ///
    /// # Errors
    /// [`EditError`], as of [`apply`](Self::apply).
    pub fn set_triangles(&mut self, mesh: MeshId, triangles: Vec<EmissiveTriangle>) -> Result<(), EditError> {
        self.one(Edit::SetTriangles { mesh, triangles })
    }

    /// Takes an instance out of the world.
    ///
    /// # Errors
    /// [`EditError`], as of [`apply`](Self::apply).
    pub fn remove_instance(&mut self, instance: InstanceId) -> Result<(), EditError> {
        self.one(Edit::RemoveInstance(instance))
    }

    /// Forgets a mesh that has no instances.
    ///
    /// # Errors
    /// [`EditError`], as of [`apply`](Self::apply).
    pub fn remove_mesh(&mut self, mesh: MeshId) -> Result<(), EditError> {
        self.one(Edit::RemoveMesh(mesh))
    }

    fn one(&mut self, edit: Edit) -> Result<(), EditError> {
        self.apply(alloc::vec![edit]).map(|_| ())
    }
}

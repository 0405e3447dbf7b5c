//! Single edits; the error is the reason alone.

use alloc::vec::Vec;

use super::edit::{Edit, EditReason, InstanceId, MeshId};
use super::{Added, Bvh};
use crate::model::Model;
use crate::transform::Transform;

impl<M: Model<W>, const W: usize> Bvh<M, W> {
    /// Adds a mesh of at least one light, in its own space; it lights nothing before an instance puts it into the world.
    ///
    /// # Errors
    /// [`EditReason`]; nothing is changed then.
    pub fn add_mesh(&mut self, lights: Vec<M::Light>) -> Result<MeshId, EditReason> {
        Ok(self.one(Edit::AddMesh { lights })?.meshes[0])
    }

    /// Puts a mesh into the world.
    ///
    /// # Errors
    /// [`EditReason`]; nothing is changed then.
    pub fn add_instance(&mut self, mesh: MeshId, transform: Transform) -> Result<InstanceId, EditReason> {
        let added = self.one(Edit::AddInstance {
            mesh,
            transform,
            radiance: [1.0; 3],
            mask: u32::MAX,
        })?;
        Ok(added.instances[0])
    }

    /// Puts a light by itself into the world: an instance, with a transform, a colour and a mask.
    /// [`remove_instance`](Self::remove_instance) takes it out.
    ///
    /// # Errors
    /// [`EditReason`]; nothing is changed then.
    pub fn add_light(&mut self, light: impl Into<M::Light>) -> Result<InstanceId, EditReason> {
        let light = light.into();
        let mask = u32::MAX;
        Ok(self.one(Edit::AddLight { light, mask })?.instances[0])
    }

    /// Makes a light by itself another one, of any kind and in any place.
    ///
    /// # Errors
    /// [`EditReason`], [`EditReason::NoLight`] for an instance of a mesh; nothing is changed then.
    pub fn set_light(&mut self, instance: InstanceId, light: impl Into<M::Light>) -> Result<(), EditReason> {
        let light = light.into();
        self.one(Edit::SetLight { instance, light }).map(|_| ())
    }

    /// Moves an instance, anywhere: it keeps its id and its lights' numbers. One that goes away from those around it is put in
    /// elsewhere in the top level.
    ///
    /// # Errors
    /// [`EditReason`]; nothing is changed then.
    pub fn set_transform(&mut self, instance: InstanceId, transform: Transform) -> Result<(), EditReason> {
        self.one(Edit::SetTransform { instance, transform }).map(|_| ())
    }

    /// Makes an instance brighter, dimmer, or of another colour: `radiance` is a factor on its mesh's, linear RGB, each 0 or from 2^-60 to
    /// 2^60. Zeros turn it off; uniform choice may still return its lights, which then have no radiance. Weights go by its luminance, as if the
    /// mesh were white.
    ///
    /// # Errors
    /// [`EditReason`]; nothing is changed then.
    pub fn set_radiance(&mut self, instance: InstanceId, radiance: [f32; 3]) -> Result<(), EditReason> {
        self.one(Edit::SetRadiance { instance, radiance }).map(|_| ())
    }

    /// Makes an instance light the receivers whose mask has a bit of `mask`, and no others, where nodes store masks: see
    /// [`Linked`](crate::importance::Linked); from the next [`refit`](Self::refit) on. Costs what moving it costs.
    ///
    /// # Errors
    /// [`EditReason`]; nothing is changed then.
    pub fn set_mask(&mut self, instance: InstanceId, mask: u32) -> Result<(), EditReason> {
        self.one(Edit::SetMask { instance, mask }).map(|_| ())
    }

    /// Gives a mesh as many other lights.
    ///
    /// # Errors
    /// [`EditReason`]; nothing is changed then.
    pub fn set_lights(&mut self, mesh: MeshId, lights: Vec<M::Light>) -> Result<(), EditReason> {
        self.one(Edit::SetLights { mesh, lights }).map(|_| ())
    }

    /// Changes the lights of a mesh from index `first` on, as many as are given. Takes time in proportion to them and to the
    /// depth of the mesh's tree, of which a [`refit`](Self::refit) then computes the paths to them; all of it where they are
    /// more than a sixteenth of the mesh. If they reach farther from
    /// the mesh's origin than any light did since the mesh was set as a whole, each instance of the mesh is looked at.
    /// A mesh of points and spots alone is looked at as a whole.
    ///
    /// # Errors
    /// [`EditReason`], [`EditReason::Range`] where they are not all in the mesh; nothing is changed then.
    pub fn set_light_range(
        &mut self,
        mesh: MeshId,
        first: u32,
        lights: Vec<M::Light>,
    ) -> Result<(), EditReason> {
        let edit = Edit::SetLightRange { mesh, first, lights };
        self.one(edit).map(|_| ())
    }

    /// Takes an instance out of the world.
    ///
    /// # Errors
    /// [`EditReason`]; nothing is changed then.
    pub fn remove_instance(&mut self, instance: InstanceId) -> Result<(), EditReason> {
        self.one(Edit::RemoveInstance(instance)).map(|_| ())
    }

    /// Forgets a mesh that has no instances.
    ///
    /// # Errors
    /// [`EditReason`]; nothing is changed then.
    pub fn remove_mesh(&mut self, mesh: MeshId) -> Result<(), EditReason> {
        self.one(Edit::RemoveMesh(mesh)).map(|_| ())
    }

    fn one(&mut self, edit: Edit<M::Light>) -> Result<Added, EditReason> {
        self.apply(alloc::vec![edit]).map_err(|error| error.reason)
    }
}

//! Validation of a batch of edits, as a whole, before any of it is done.

use alloc::collections::{BTreeMap, BTreeSet};
use alloc::vec::Vec;

use super::Bvh;
use super::edit::{Edit, EditError, EditReason, InstanceId, MeshId, RADIANCE_FACTORS};
use crate::exact;
use crate::light::Light;
use crate::lights::MAX_LIGHTS;
use crate::model::Model;
use crate::trail::MAX_PLACES;
use crate::transform::{Transform, reach_of};

/// How far the lights of deformed meshes reach.
type Reaches = BTreeMap<MeshId, f32>;

/// The effects of the earlier edits of the batch.
#[derive(Default)]
struct Batch {
    removed_instances: BTreeSet<InstanceId>,
    removed_meshes: BTreeSet<MeshId>,
    /// Change of a mesh's number of instances.
    uses: BTreeMap<MeshId, i64>,
    reaches: Reaches,
    /// Transforms of moved instances, and of added ones, which have no id yet.
    transforms: BTreeMap<InstanceId, Transform>,
    added: BTreeMap<MeshId, Vec<Transform>>,
    /// Whether a later edit may ask for those.
    deforms: bool,
    /// Ends of the numbers of instances, of lights in the world and of lights of meshes.
    instances: usize,
    numbers: usize,
    lights: usize,
}

impl<M: Model<W>, const W: usize> Bvh<M, W> {
    /// Brings all lights of the batch into the domain, or says which edit cannot be done. Returns how far meshes
    /// reach that are deformed.
    pub(super) fn check(&self, edits: &mut [Edit<M::Light>]) -> Result<Reaches, EditError> {
        let deforms = |edit: &Edit<M::Light>| {
            matches!(
                edit,
                Edit::SetLights { .. } | Edit::SetLightRange { .. } | Edit::SetLight { .. }
            )
        };
        let mut batch = Batch {
            instances: self.placed_ranges.end() as usize,
            numbers: self.numbers.end() as usize,
            lights: self.light_ranges.end() as usize,
            deforms: edits.iter().any(deforms),
            ..Batch::default()
        };
        for (index, edit) in edits.iter_mut().enumerate() {
            self.check_one(&mut batch, edit)
                .map_err(|reason| EditError { edit: index, reason })?;
        }
        Ok(batch.reaches)
    }

    fn check_one(&self, batch: &mut Batch, edit: &mut Edit<M::Light>) -> Result<(), EditReason> {
        if self.single && !matches!(edit, Edit::SetLights { .. } | Edit::SetLightRange { .. }) {
            return Err(EditReason::SingleLevel);
        }
        match edit {
            Edit::AddMesh { lights } => {
                if lights.is_empty() {
                    return Err(EditReason::EmptyMesh);
                }
                checked(lights)?;
                batch.lights += lights.len();
            }
            &mut Edit::AddInstance {
                mesh,
                transform,
                radiance,
                mask: _,
            } => {
                let count = self.known_mesh(batch, mesh)?;
                transform
                    .check(self.reach(batch, mesh))
                    .map_err(EditReason::Transform)?;
                factor(radiance)?;
                *batch.uses.entry(mesh).or_default() += 1;
                if batch.deforms {
                    batch.added.entry(mesh).or_default().push(transform);
                }
                batch.instances += 1;
                batch.numbers += count;
            }
            Edit::AddLight { light, mask: _ } => {
                *light = light.checked().map_err(EditReason::Alone)?;
                batch.instances += 1;
                batch.numbers += 1;
                batch.lights += 1;
            }
            Edit::SetLight { instance, light } => {
                let mesh = self.known_instance(batch, *instance)?;
                if !self.meshes[mesh.index as usize].is_light {
                    return Err(EditReason::NoLight(*instance));
                }
                *light = light.checked().map_err(EditReason::Alone)?;
                self.check_lights(batch, mesh, core::slice::from_mut(light))?;
            }
            &mut Edit::SetTransform { instance, transform } => {
                let mesh = self.known_instance(batch, instance)?;
                transform
                    .check(self.reach(batch, mesh))
                    .map_err(EditReason::Transform)?;
                if batch.deforms {
                    batch.transforms.insert(instance, transform);
                }
            }
            &mut Edit::SetRadiance { instance, radiance } => {
                self.known_instance(batch, instance)?;
                factor(radiance)?;
            }
            &mut Edit::SetMask { instance, mask: _ } => {
                self.known_instance(batch, instance)?;
            }
            Edit::SetLights { mesh, lights } => {
                let expected = self.known_mesh(batch, *mesh)?;
                if lights.len() != expected {
                    let found = lights.len();
                    return Err(EditReason::Count { expected, found });
                }
                self.check_lights(batch, *mesh, lights)?;
            }
            Edit::SetLightRange { mesh, first, lights } => {
                let all = self.known_mesh(batch, *mesh)?;
                let end = (*first as usize).checked_add(lights.len());
                if end.is_none_or(|end| end > all) {
                    return Err(EditReason::Range {
                        first: *first,
                        count: lights.len(),
                        lights: all,
                    });
                }
                self.check_lights(batch, *mesh, lights)?;
            }
            &mut Edit::RemoveInstance(id) => {
                let mesh = self.known_instance(batch, id)?;
                batch.removed_instances.insert(id);
                *batch.uses.entry(mesh).or_default() -= 1;
                if self.meshes[mesh.index as usize].is_light && self.instances_of(batch, mesh) == 0 {
                    batch.removed_meshes.insert(mesh);
                }
            }
            &mut Edit::RemoveMesh(id) => {
                self.known_mesh(batch, id)?;
                let instances = self.instances_of(batch, id);
                if instances != 0 {
                    return Err(EditReason::InUse { instances });
                }
                batch.removed_meshes.insert(id);
            }
        }
        let is_full = batch.instances > MAX_PLACES as usize;
        if is_full || batch.numbers > MAX_LIGHTS || batch.lights > MAX_LIGHTS {
            return Err(EditReason::TooMany);
        }
        Ok(())
    }

    /// Number of lights of a mesh that is there.
    fn known_mesh(&self, batch: &Batch, id: MeshId) -> Result<usize, EditReason> {
        let known = self.view().mesh_lights(id);
        let known = known.filter(|_| !batch.removed_meshes.contains(&id));
        known.map(<[_]>::len).ok_or(EditReason::UnknownMesh(id))
    }

    /// The mesh of an instance that is there.
    fn known_instance(&self, batch: &Batch, id: InstanceId) -> Result<MeshId, EditReason> {
        match self.live(id) {
            Some(placed) if !batch.removed_instances.contains(&id) => Ok(self.id_of_mesh(placed.mesh)),
            _ => Err(EditReason::UnknownInstance(id)),
        }
    }

    /// How many instances a mesh has.
    fn instances_of(&self, batch: &Batch, id: MeshId) -> usize {
        let now = self.meshes[id.index as usize].users.len() as i64;
        (now + batch.uses.get(&id).copied().unwrap_or(0)) as usize
    }

    /// The farthest that a mesh has reached since it was set as a whole.
    fn reach(&self, batch: &Batch, id: MeshId) -> f32 {
        let known = batch.reaches.get(&id).copied();
        known.unwrap_or(self.meshes[id.index as usize].reach)
    }

    /// Whether lights of a mesh may become these: all its instances, those of the batch included, stay within the domain.
    fn check_lights(
        &self,
        batch: &mut Batch,
        mesh: MeshId,
        lights: &mut [M::Light],
    ) -> Result<(), EditReason> {
        checked(lights)?;
        let (known, mut reach) = (self.reach(batch, mesh), reach_of(lights));
        if lights.len() < self.meshes[mesh.index as usize].lights.len() {
            reach = exact::max(reach, known);
        }
        if reach > known {
            for &index in &self.meshes[mesh.index as usize].users {
                let placed = &self.placed[index as usize];
                let id = self.id_of_instance(index);
                if !batch.removed_instances.contains(&id) {
                    let transform = batch.transforms.get(&id).unwrap_or(&placed.transform);
                    transform.check(reach).map_err(EditReason::Transform)?;
                }
            }
            for transform in batch.added.get(&mesh).into_iter().flatten() {
                transform.check(reach).map_err(EditReason::Transform)?;
            }
        }
        batch.reaches.insert(mesh, reach);
        Ok(())
    }
}

/// Brings lights into the domain up to the first that cannot be.
fn checked<L: Light>(lights: &mut [L]) -> Result<(), EditReason> {
    for (index, light) in lights.iter_mut().enumerate() {
        let checked = light.checked();
        *light = checked.map_err(|error| EditReason::Light { index, error })?;
    }
    Ok(())
}

/// `Ok` for a factor on radiance that may be.
pub(super) fn factor(radiance: [f32; 3]) -> Result<(), EditReason> {
    let [least, most] = RADIANCE_FACTORS;
    let is_one = |value: f32| value == 0.0 || (least..=most).contains(&value);
    match radiance.into_iter().find(|&value| !is_one(value)) {
        Some(value) => Err(EditReason::Radiance { value }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests;

//! A batch of edits, and what the model expects of it.

use arbitrary::{Result, Unstructured};
use lightbvh::bvh::{Added, EditReason};
use lightbvh::{Bvh, Edit, EmissiveTriangle, InstanceId, LightNode, MeshId, Transform};

use super::model::{Mesh, Model, Placed, within};
use super::placing::{factor, transform};
use crate::input::{self, Coordinates};

/// What may be wrong with an edit, as bits.
mod wrong {
    pub const MESH: u8 = 1;
    pub const INSTANCE: u8 = 2;
    pub const EMPTY: u8 = 4;
    pub const LIGHT: u8 = 8;
    pub const TRANSFORM: u8 = 16;
    pub const RADIANCE: u8 = 32;
    pub const COUNT: u8 = 64;
    pub const IN_USE: u8 = 128;
}

/// What is expected of an edit: the reasons for which it may be refused, and whether it may be done.
#[derive(Clone, Copy)]
struct Verdict {
    reasons: u8,
    done: bool,
}

const SOUND: Verdict = Verdict {
    reasons: 0,
    done: true,
};

/// The reasons of the first condition that does not hold; `None` is one that rounding decides.
fn first_wrong(conditions: &[(Option<bool>, u8)]) -> Verdict {
    let mut verdict = SOUND;
    for &(holds, reason) in conditions {
        if holds != Some(true) {
            verdict.reasons |= reason;
        }
        if holds == Some(false) {
            verdict.done = false;
            break;
        }
    }
    verdict
}

/// The model as the edits so far leave it; what they add has no id yet.
struct Staged {
    model: Model,
    meshes: Vec<Vec<EmissiveTriangle>>,
    added: Vec<(MeshId, Transform, f32)>,
}

/// Does a batch to the scene, and to the model if it is not refused.
pub fn edit<N: LightNode<W> + std::fmt::Debug, const W: usize>(
    u: &mut Unstructured<'_>,
    model: &mut Model,
    scene: &mut Bvh<N, (), W>,
    first: bool,
    thorough: bool,
) -> Result<()> {
    let mut staged = Staged {
        model: model.clone(),
        meshes: Vec::new(),
        added: Vec::new(),
    };
    let (mut edits, mut verdicts) = (Vec::new(), Vec::new());
    for _ in 0..1 + u.arbitrary::<u8>()? % 5 {
        let (edit, verdict) = one(u, &mut staged, first)?;
        edits.push(edit);
        verdicts.push(verdict);
        if !verdict.done {
            break;
        }
    }
    let before = verdicts
        .iter()
        .any(|verdict| verdict.reasons != 0)
        .then(|| scene.clone());
    let removed: Vec<_> = model
        .instances
        .iter()
        .filter(|placed| staged.model.gone_instances.contains(&placed.id))
        .map(|placed| placed.lights.clone())
        .collect();
    match scene.apply(edits) {
        Ok(updated) => {
            assert!(
                verdicts.iter().all(|verdict| verdict.done),
                "a wrong edit was done"
            );
            let mut told = scene.take_removed_lights();
            told.sort_unstable_by_key(|range| range.start);
            let mut removed = removed;
            removed.sort_unstable_by_key(|range| range.start);
            assert_eq!(told, removed);
            *model = staged.done(&updated, scene);
        }
        Err(error) => {
            let verdict = verdicts[error.edit];
            assert!(verdict.reasons & bit(&error.reason) != 0, "{error}");
            assert!(!error.to_string().is_empty());
            let before = before.expect("refused, so not all were sound");
            assert_same(&before, scene, thorough);
        }
    }
    Ok(())
}

/// A refused batch changes nothing.
fn assert_same<N: LightNode<W> + std::fmt::Debug, const W: usize>(
    before: &Bvh<N, (), W>,
    after: &Bvh<N, (), W>,
    thorough: bool,
) {
    fn words<T: bytemuck::NoUninit>(list: &[T]) -> &[u8] {
        bytemuck::cast_slice(list)
    }
    assert_eq!(words(before.nodes()), words(after.nodes()));
    assert_eq!(words(before.instances()), words(after.instances()));
    assert_eq!(words(before.triangles()), words(after.triangles()));
    assert_eq!(words(before.roots()), words(after.roots()));
    assert_eq!(before.removed_lights(), after.removed_lights());
    if thorough {
        assert_eq!(format!("{before:?}"), format!("{after:?}"));
    }
}

fn bit(reason: &EditReason) -> u8 {
    match reason {
        EditReason::UnknownMesh(_) => wrong::MESH,
        EditReason::UnknownInstance(_) => wrong::INSTANCE,
        EditReason::EmptyMesh => wrong::EMPTY,
        EditReason::Light { .. } => wrong::LIGHT,
        EditReason::Transform(_) => wrong::TRANSFORM,
        EditReason::Radiance { .. } => wrong::RADIANCE,
        EditReason::Count { .. } => wrong::COUNT,
        EditReason::InUse { .. } => wrong::IN_USE,
        _ => 0,
    }
}

/// Triangles of a mesh: few, within the domain but for one list in sixteen.
fn mesh(u: &mut Unstructured<'_>, count: Option<usize>) -> Result<Vec<EmissiveTriangle>> {
    let byte: u8 = u.arbitrary()?;
    if byte & 15 == 15 {
        return input::any_triangles(u);
    }
    let usual = if byte >= 240 { byte & 15 } else { 1 + byte % 4 };
    let count = count.map_or(usual, |count| count.min(255) as u8);
    let coordinates = if byte & 16 == 0 {
        Coordinates::Grid(0.5)
    } else {
        Coordinates::choose(u)?
    };
    input::triangles_within(u, coordinates, count)
}

/// One of the living, or of the dead.
fn pick<T: Copy>(byte: u8, living: &[T], gone: &[T]) -> Option<T> {
    let list = if byte >= 232 || living.is_empty() {
        gone
    } else {
        living
    };
    (!list.is_empty()).then(|| list[usize::from(byte) % list.len()])
}

fn known(condition: bool) -> Option<bool> {
    Some(condition)
}

/// Whether all triangles are in the domain; those that are, brought into it.
fn accepted(triangles: &[EmissiveTriangle]) -> (Option<bool>, Vec<EmissiveTriangle>) {
    let all: Vec<_> = triangles
        .iter()
        .filter_map(|triangle| triangle.checked().ok())
        .collect();
    (Some(all.len() == triangles.len()), all)
}

/// Whether a radiance factor is accepted.
fn shines(radiance: f32) -> Option<bool> {
    Some(radiance == 0.0 || (2f32.powi(-60)..=2f32.powi(60)).contains(&radiance))
}

/// An edit, done to the staged model where it may be done.
fn one(u: &mut Unstructured<'_>, staged: &mut Staged, first: bool) -> Result<(Edit, Verdict)> {
    let (kind, which): (u8, u8) = u.arbitrary()?;
    let meshes: Vec<MeshId> = staged.model.meshes.iter().map(|mesh| mesh.id).collect();
    let instances: Vec<InstanceId> = staged.model.instances.iter().map(|placed| placed.id).collect();
    let mesh_id = pick(which, &meshes, &staged.model.gone_meshes);
    let instance = pick(which, &instances, &staged.model.gone_instances);
    Ok(match (kind % 12, mesh_id, instance) {
        (1..=3, Some(id), _) if !first => staged.add_instance(id, transform(u)?, factor(u)?),
        (4..=6, _, Some(id)) => staged.move_to(id, transform(u)?),
        (7, _, Some(id)) => staged.shine(id, factor(u)?),
        (8 | 9, Some(id), _) => {
            let found = staged.model.meshes.iter().find(|mesh| mesh.id == id);
            let count = found.map(|mesh| mesh.triangles.len()).filter(|_| kind < 240);
            let triangles = mesh(u, count)?;
            staged.deform(id, triangles)
        }
        (10, _, Some(id)) => staged.remove_instance(id),
        (11, Some(id), _) => staged.remove_mesh(id),
        _ => staged.add_mesh(mesh(u, None)?),
    })
}

impl Staged {
    fn lives(&self, id: MeshId) -> bool {
        self.model.meshes.iter().any(|mesh| mesh.id == id)
    }

    fn placed(&mut self, id: InstanceId) -> Option<&mut Placed> {
        self.model.instances.iter_mut().find(|placed| placed.id == id)
    }

    fn add_mesh(&mut self, triangles: Vec<EmissiveTriangle>) -> (Edit, Verdict) {
        let (sound, all) = accepted(&triangles);
        let verdict = first_wrong(&[
            (known(!triangles.is_empty()), wrong::EMPTY),
            (sound, wrong::LIGHT),
        ]);
        self.meshes.push(all);
        (Edit::AddMesh { triangles }, verdict)
    }

    fn add_instance(&mut self, mesh: MeshId, transform: Transform, radiance: f32) -> (Edit, Verdict) {
        let lives = self.lives(mesh);
        let inside = if lives {
            within(&transform, self.model.triangles(mesh))
        } else {
            None
        };
        let verdict = first_wrong(&[
            (known(lives), wrong::MESH),
            (inside, wrong::TRANSFORM),
            (shines(radiance), wrong::RADIANCE),
        ]);
        self.added.push((mesh, transform, radiance));
        let edit = Edit::AddInstance {
            mesh,
            transform,
            radiance,
        };
        (edit, verdict)
    }

    fn move_to(&mut self, instance: InstanceId, transform: Transform) -> (Edit, Verdict) {
        let mesh = self.placed(instance).map(|placed| placed.mesh);
        let inside = mesh.and_then(|mesh| within(&transform, self.model.triangles(mesh)));
        let verdict = first_wrong(&[
            (known(mesh.is_some()), wrong::INSTANCE),
            (inside, wrong::TRANSFORM),
        ]);
        if let Some(placed) = self.placed(instance) {
            placed.transform = transform;
        }
        (Edit::SetTransform { instance, transform }, verdict)
    }

    fn shine(&mut self, instance: InstanceId, radiance: f32) -> (Edit, Verdict) {
        let placed = self.placed(instance);
        let verdict = first_wrong(&[
            (known(placed.is_some()), wrong::INSTANCE),
            (shines(radiance), wrong::RADIANCE),
        ]);
        if let Some(placed) = placed {
            placed.radiance = radiance;
        }
        (Edit::SetRadiance { instance, radiance }, verdict)
    }

    fn deform(&mut self, id: MeshId, triangles: Vec<EmissiveTriangle>) -> (Edit, Verdict) {
        let (sound, all) = accepted(&triangles);
        let old = self.model.meshes.iter().find(|mesh| mesh.id == id);
        let same = old.is_some_and(|mesh| mesh.triangles.len() == triangles.len());
        let mut conditions = vec![
            (known(old.is_some()), wrong::MESH),
            (known(same), wrong::COUNT),
            (sound, wrong::LIGHT),
        ];
        // Those of this very batch too.
        let placed = self
            .model
            .instances
            .iter()
            .map(|placed| (placed.mesh, placed.transform));
        let added = self.added.iter().map(|&(mesh, transform, _)| (mesh, transform));
        for (_, transform) in placed.chain(added).filter(|&(mesh, _)| mesh == id) {
            conditions.push((within(&transform, &all), wrong::TRANSFORM));
        }
        if let Some(mesh) = self.model.meshes.iter_mut().find(|mesh| mesh.id == id) {
            mesh.triangles = all;
        }
        (
            Edit::SetTriangles { mesh: id, triangles },
            first_wrong(&conditions),
        )
    }

    fn remove_instance(&mut self, id: InstanceId) -> (Edit, Verdict) {
        let lives = self.placed(id).is_some();
        self.model.instances.retain(|placed| placed.id != id);
        if lives {
            self.model.gone_instances.push(id);
        }
        (
            Edit::RemoveInstance(id),
            first_wrong(&[(known(lives), wrong::INSTANCE)]),
        )
    }

    fn remove_mesh(&mut self, id: MeshId) -> (Edit, Verdict) {
        let lives = self.lives(id);
        let used = self.model.instances.iter().any(|placed| placed.mesh == id)
            || self.added.iter().any(|&(mesh, ..)| mesh == id);
        let verdict = first_wrong(&[(known(lives), wrong::MESH), (known(!used), wrong::IN_USE)]);
        if lives && !used {
            self.model.meshes.retain(|mesh| mesh.id != id);
            self.model.gone_meshes.push(id);
        }
        (Edit::RemoveMesh(id), verdict)
    }

    /// The model, once the scene has given the new ones their ids.
    fn done<N: LightNode<W>, const W: usize>(self, updated: &Added, scene: &Bvh<N, (), W>) -> Model {
        let mut model = self.model;
        assert_eq!(updated.meshes.len(), self.meshes.len());
        assert_eq!(updated.instances.len(), self.added.len());
        for (&id, triangles) in updated.meshes.iter().zip(self.meshes) {
            let new = model.meshes.iter().all(|mesh| mesh.id != id) && !model.gone_meshes.contains(&id);
            assert!(new, "an id never means another one");
            model.meshes.push(Mesh { id, triangles });
        }
        for (&id, (mesh, transform, radiance)) in updated.instances.iter().zip(self.added) {
            let new =
                model.instances.iter().all(|placed| placed.id != id) && !model.gone_instances.contains(&id);
            assert!(new, "an id never means another one");
            model.instances.push(Placed {
                id,
                mesh,
                transform,
                radiance,
                lights: scene.lights_of(id).expect("just added"),
            });
        }
        model
    }
}

//! A batch of edits, and what the model expects of it.

mod staged;

use arbitrary::{Result, Unstructured};
use lightbvh::bvh::Added;
use lightbvh::exact::hash;
use lightbvh::light::Light;
use lightbvh::{Bvh, Edit, EmissiveTriangle, InstanceId, LightNode, MeshId, Transform};

use super::model::{Mesh, Model, Placed, reach, within};
use super::placing::{color, transform};
use crate::input::{self, Coordinates};

/// What is expected of an edit: the reasons for which it may be refused, by their names, and whether it may be done.
struct Verdict {
    reasons: Vec<&'static str>,
    done: bool,
}

/// The reasons of the first condition that does not hold; `None` is one that rounding decides.
fn first_wrong(conditions: &[(Option<bool>, &'static str)]) -> Verdict {
    let mut verdict = Verdict {
        reasons: Vec::new(),
        done: true,
    };
    for &(holds, reason) in conditions {
        if holds != Some(true) {
            verdict.reasons.push(reason);
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
    added: Vec<(MeshId, Transform, [f32; 3])>,
}

/// Applies a batch to the scene, and to the model if it is not refused; returns whether it was applied.
pub fn edit<N: LightNode<W> + std::fmt::Debug, const W: usize>(
    u: &mut Unstructured<'_>,
    model: &mut Model,
    scene: &mut Bvh<(N, ()), W>,
    first: bool,
    thorough: bool,
) -> Result<bool> {
    let mut staged = Staged {
        model: model.clone(),
        meshes: Vec::new(),
        added: Vec::new(),
    };
    let (mut edits, mut verdicts) = (Vec::new(), Vec::new());
    let bits: u8 = u.arbitrary()?;
    if let Some(mesh) = staged
        .model
        .meshes
        .get(usize::from(bits >> 3 & 3))
        .filter(|_| bits & 0x80 != 0)
    {
        // Enough instances that a single one is less than a quarter.
        let (mesh, seed) = (mesh.id, u.arbitrary::<u8>()?);
        for k in 0..4 + seed % 32 {
            let axis = |axis: u32| f32::from(hash(u32::from(seed) << 16 | u32::from(k) << 8 | axis) as i8);
            let (edit, verdict) = staged.add_instance(mesh, Transform::at([0, 1, 2].map(axis)), [1.0; 3]);
            edits.push(edit);
            verdicts.push(verdict);
        }
    }
    for _ in 0..1 + bits % 5 {
        let (edit, verdict) = one(u, &mut staged, first)?;
        edits.push(edit);
        let done = verdict.done;
        verdicts.push(verdict);
        if !done {
            break;
        }
    }
    let before = verdicts
        .iter()
        .any(|verdict| !verdict.reasons.is_empty())
        .then(|| scene.clone());
    let removed: Vec<_> = model
        .instances
        .iter()
        .filter(|placed| staged.model.gone_instances.contains(&placed.id))
        .map(|placed| placed.lights.clone())
        .collect();
    let done = scene.apply(edits);
    let told = scene.take_removed_lights();
    match done {
        Ok(updated) => {
            assert!(
                verdicts.iter().all(|verdict| verdict.done),
                "a wrong edit was done"
            );
            let (mut told, mut removed) = (told, removed);
            told.sort_unstable_by_key(|range| range.start);
            removed.sort_unstable_by_key(|range| range.start);
            assert_eq!(told, removed);
            *model = staged.done(&updated, scene);
            Ok(true)
        }
        Err(error) => {
            let name = format!("{:?}", error.reason);
            let expected = &verdicts[error.edit].reasons;
            assert!(expected.iter().any(|reason| name.starts_with(reason)), "{error}");
            assert!(!error.to_string().is_empty());
            let before = before.expect("refused, so not all were sound");
            assert_same(&before, scene, thorough);
            Ok(false)
        }
    }
}

/// A refused batch changes nothing.
fn assert_same<N: LightNode<W> + std::fmt::Debug, const W: usize>(
    before: &Bvh<(N, ()), W>,
    after: &Bvh<(N, ()), W>,
    thorough: bool,
) {
    fn words<T: bytemuck::NoUninit>(list: &[T]) -> &[u8] {
        bytemuck::cast_slice(list)
    }
    assert_eq!(words(before.view().nodes()), words(after.view().nodes()));
    assert_eq!(words(before.view().top_nodes()), words(after.view().top_nodes()));
    assert_eq!(words(before.view().instances()), words(after.view().instances()));
    assert_eq!(words(before.view().lights()), words(after.view().lights()));
    assert_eq!(words(before.view().roots()), words(after.view().roots()));
    assert_eq!(before.view().removed_lights(), after.view().removed_lights());
    if thorough {
        assert_eq!(format!("{before:?}"), format!("{after:?}"));
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

/// Whether all triangles are in the domain; those that are, brought into it.
fn accepted(triangles: &[EmissiveTriangle]) -> (Option<bool>, Vec<EmissiveTriangle>) {
    let all: Vec<_> = triangles
        .iter()
        .filter_map(|triangle| triangle.checked().ok())
        .collect();
    (Some(all.len() == triangles.len()), all)
}

/// Whether a radiance factor is accepted.
fn shines(radiance: [f32; 3]) -> Option<bool> {
    let is_one = |x: f32| x == 0.0 || (2f32.powi(-60)..=2f32.powi(60)).contains(&x);
    Some(radiance.into_iter().all(is_one))
}

/// An edit, done to the staged model where it may be done.
fn one(u: &mut Unstructured<'_>, staged: &mut Staged, first: bool) -> Result<(Edit, Verdict)> {
    let (kind, which): (u8, u8) = u.arbitrary()?;
    let meshes: Vec<MeshId> = staged.model.meshes.iter().map(|mesh| mesh.id).collect();
    let instances: Vec<InstanceId> = staged.model.instances.iter().map(|placed| placed.id).collect();
    let mesh_id = pick(which, &meshes, &staged.model.gone_meshes);
    let instance = pick(which, &instances, &staged.model.gone_instances);
    Ok(match (kind % 13, mesh_id, instance) {
        (1..=3, Some(id), _) if !first => staged.add_instance(id, transform(u)?, color(u)?),
        (4..=6, _, Some(id)) => staged.move_to(id, transform(u)?),
        (7, _, Some(id)) => staged.shine(id, color(u)?),
        (8 | 9, Some(id), _) => {
            let found = staged.model.meshes.iter().find(|mesh| mesh.id == id);
            let count = found.map(|mesh| mesh.triangles.len()).filter(|_| kind < 240);
            let triangles = mesh(u, count)?;
            staged.deform(id, triangles)
        }
        (12, Some(id), _) => {
            let (first, count): (u8, u8) = u.arbitrary()?;
            staged.deform_some(id, u32::from(first % 8), mesh(u, Some(usize::from(count % 4)))?)
        }
        (10, _, Some(id)) => staged.remove_instance(id),
        (11, Some(id), _) => staged.remove_mesh(id),
        _ => staged.add_mesh(mesh(u, None)?),
    })
}

//! What bends meshes: morph targets, the joints of vertices, skins.

use glam::Mat4;
use gltf::json;
use gltf::json::mesh::Semantic;

use super::super::error::SceneError;
use super::super::model::{Influence, SceneData, Skin};
use super::attributes::Attributes;
use super::{DAMAGED, Document};

/// Sets of four joints for a vertex that are read, at most.
const MAX_SETS: u32 = 8;

/// How far each target moves each vertex.
pub(super) fn targets(
    document: &Document<'_>,
    primitive: &json::mesh::Primitive,
    rows: &[u32],
    element: &str,
) -> Result<Vec<Vec<[f32; 3]>>, SceneError> {
    let mut targets = Vec::new();
    for (t, target) in primitive.targets.iter().flatten().enumerate() {
        let element = format!("{element}.targets[{t}]");
        targets.push(match target.positions {
            Some(index) => document.floats(index, &element, Some(rows))?,
            None => Vec::new(),
        });
    }
    // Where no target moves anything there is none.
    if targets.iter().all(Vec::is_empty) {
        targets.clear();
    }
    Ok(targets)
}

/// The joints of each vertex, in sets of four.
pub(super) fn influences(
    document: &Document<'_>,
    attributes: &Attributes<'_, '_>,
    rows: &[u32],
) -> Result<Vec<Vec<Influence>>, SceneError> {
    let element = attributes.element;
    let mut sets = Vec::new();
    for set in 0..MAX_SETS {
        let Some(joints) = attributes.floats::<4>(Semantic::Joints(set), rows)? else {
            break;
        };
        let Some(weights) = attributes.floats::<4>(Semantic::Weights(set), rows)? else {
            let problem = format!("has JOINTS_{set} without WEIGHTS_{set}");
            return Err(document.malformed(element, problem, DAMAGED));
        };
        let whole = |x: &f32| (0.0..=65535.0).contains(x) && x.fract() == 0.0;
        if let Some(joint) = joints.as_flattened().iter().find(|x| !whole(x)) {
            return Err(document.malformed(element, format!("has {joint} as a joint"), DAMAGED));
        }
        let pairs = joints.iter().zip(weights).map(|(joints, weights)| Influence {
            joints: joints.map(|joint| joint as u16),
            weights,
        });
        sets.push(pairs.collect());
    }
    Ok(sets)
}

/// All skins; `place` is where each of the file's nodes went. Nodes whose skin has joints outside of the scene lose it, with a
/// note.
pub(super) fn skins(
    document: &Document<'_>,
    place: &[Option<u32>],
    data: &mut SceneData,
) -> Result<(), SceneError> {
    let mut lost = Vec::new();
    for (s, skin) in document.root.skins.iter().enumerate() {
        let element = format!("skins[{s}]");
        let mut joints = Vec::with_capacity(skin.joints.len());
        for &joint in &skin.joints {
            document.get(&document.root.nodes, joint, "node", &element)?;
            joints.extend(place[joint.value()]);
        }
        let whole = joints.len() == skin.joints.len() && !joints.is_empty();
        let inverse_bind = match skin.inverse_bind_matrices {
            Some(index) => bind_matrices(document, index, skin.joints.len(), &element)?,
            None => vec![columns(&Mat4::IDENTITY.to_cols_array()); joints.len()],
        };
        if whole {
            data.skins.push(Skin { joints, inverse_bind });
        } else {
            document.note(
                "",
                format!("{element} is ignored, as its joints are not all in the scene"),
            );
            lost.push(s as u32);
            data.skins.push(Skin::default());
        }
    }
    for node in &mut data.nodes {
        node.skin = node.skin.filter(|skin| !lost.contains(skin));
    }
    Ok(())
}

fn bind_matrices(
    document: &Document<'_>,
    index: json::Index<json::Accessor>,
    joints: usize,
    element: &str,
) -> Result<Vec<[[f32; 3]; 4]>, SceneError> {
    let matrices = document.floats::<16>(index, element, None)?;
    if matrices.len() < joints {
        let problem = format!("has {} inverse bind matrices for {joints} joints", matrices.len());
        return Err(document.malformed(element, problem, DAMAGED));
    }
    Ok(matrices.iter().take(joints).map(columns).collect())
}

/// The columns of an affine matrix, whose last row is (0, 0, 0, 1) (glTF 2.0, section 3.5.3).
pub(super) fn columns(m: &[f32; 16]) -> [[f32; 3]; 4] {
    [0, 4, 8, 12].map(|column| [m[column], m[column + 1], m[column + 2]])
}

//! `EXT_mesh_gpu_instancing`: the mesh of a node, placed many times.

use std::collections::BTreeMap;

use gltf::json;
use serde::Deserialize;

use super::super::error::SceneError;
use super::super::model::Node;
use super::super::transform::Transform;
use super::Document;

/// Where each instance stands, by the names of its attributes: accessors.
#[derive(Deserialize)]
struct Instancing {
    attributes: BTreeMap<String, u32>,
}

/// Where the instances of a node's mesh stand in the node's space; `None` where it has the mesh once. Attributes of the
/// application are passed.
pub(super) fn places(
    document: &Document<'_>,
    node: &json::Node,
    element: &str,
) -> Result<Option<Vec<Transform>>, SceneError> {
    let others = node.extensions.as_ref().map(|extensions| &extensions.others);
    let Some(others) = others else { return Ok(None) };
    let found: Option<Instancing> = document.extension(others, "EXT_mesh_gpu_instancing", element)?;
    let Some(Instancing { attributes }) = found else {
        return Ok(None);
    };
    let element = format!("{element}.extensions.EXT_mesh_gpu_instancing");
    let index = |name: &str| attributes.get(name).map(|&index| json::Index::new(index));
    let vectors = |name: &str| -> Result<Option<Vec<[f32; 3]>>, SceneError> {
        index(name)
            .map(|index| document.floats::<3>(index, &element, None))
            .transpose()
    };
    let (translations, scales) = (vectors("TRANSLATION")?, vectors("SCALE")?);
    let rotations = index("ROTATION")
        .map(|index| document.floats::<4>(index, &element, None))
        .transpose()?;
    let counts = [
        translations.as_ref().map(Vec::len),
        rotations.as_ref().map(Vec::len),
        scales.as_ref().map(Vec::len),
    ];
    let Some(count) = counts.iter().flatten().copied().next() else {
        return Ok(None);
    };
    if counts.iter().flatten().any(|&other| other != count) {
        let problem = "its attributes have different numbers of instances";
        return Err(document.malformed(element, problem, "give each as many"));
    }
    let bytes = (size_of::<Node>() + element.len()) as u64 * count as u64;
    document.load.take(&element, "the list of instances", bytes)?;
    let place = |i: usize| Transform::Trs {
        translation: translations.as_ref().map_or([0.0; 3], |all| all[i]),
        rotation: rotations.as_ref().map_or([0.0, 0.0, 0.0, 1.0], |all| all[i]),
        scale: scales.as_ref().map_or([1.0; 3], |all| all[i]),
    };
    Ok(Some((0..count).map(place).collect()))
}

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
    let is_lit = ["KHR_lights_punctual", super::IES].map(|name| others.contains_key(name));
    if is_lit.contains(&true) || node.camera.is_some() {
        let what =
            "EXT_mesh_gpu_instancing repeats its mesh alone; its light or camera stands once, at the node";
        document.note(element, what);
    }
    let element = format!("{element}.extensions.EXT_mesh_gpu_instancing");
    let index = |name: &str| attributes.get(name).map(|&index| json::Index::new(index));
    let vectors = |name: &str| -> Result<Option<Vec<[f32; 3]>>, SceneError> {
        index(name)
            .map(|index| document.floats::<3>(index, &element))
            .transpose()
    };
    let (translations, scales) = (vectors("TRANSLATION")?, vectors("SCALE")?);
    let rotations = index("ROTATION")
        .map(|index| document.floats::<4>(index, &element))
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

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};

    use super::super::tests::{data_uri, painted, read, refused};

    /// A lamp at a node that has it three times; `counts` are those of translations and rotations.
    fn lamps(counts: [usize; 2]) -> Value {
        let places = [1.0_f32, 0.0, 0.0, 2.0, 0.0, 0.0, 3.0, 0.0, 0.0];
        let half = std::f32::consts::FRAC_1_SQRT_2;
        let turns = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, half, half, 0.0, 0.0, 1.0, 0.0_f32];
        let bytes: Vec<u8> = [&places[..], &turns]
            .concat()
            .iter()
            .flat_map(|x| x.to_le_bytes())
            .collect();
        let mut root = painted([[0.0; 2]; 3]);
        let mut push = |list: &str, value| root[list].as_array_mut().expect("a list").push(value);
        push("buffers", json!({ "byteLength": 84, "uri": data_uri(&bytes) }));
        push("bufferViews", json!({ "buffer": 1, "byteLength": 84 }));
        let accessor = |offset, count, shape| json!({ "bufferView": 2, "byteOffset": offset, "componentType": 5126, "count": count, "type": shape });
        push("accessors", accessor(0, counts[0], "VEC3"));
        push("accessors", accessor(36, counts[1], "VEC4"));
        root["materials"][0] = json!({ "emissiveFactor": [1, 1, 1] });
        let attributes = json!({ "TRANSLATION": 2, "ROTATION": 3, "_ID": 0 });
        root["nodes"][0] = json!({ "mesh": 0, "translation": [0, 5, 0],
            "extensions": { "EXT_mesh_gpu_instancing": { "attributes": attributes } } });
        root["extensionsRequired"] = json!(["EXT_mesh_gpu_instancing"]);
        root
    }

    /// The extension is of the mesh.
    #[test]
    fn a_light_of_a_node_with_instances_is_named() {
        let mut root = lamps([3, 3]);
        root["extensions"] = json!({ "KHR_lights_punctual": { "lights": [{ "type": "point" }] } });
        root["nodes"][0]["extensions"]["KHR_lights_punctual"] = json!({ "light": 0 });
        let scene = read(&root);
        assert_eq!((scene.data().analytic.len(), scene.emissive_count()), (1, 3));
        let warnings = scene.warnings();
        assert!(
            warnings.len() == 1 && warnings[0].contains("nodes[0]") && warnings[0].contains("stands once"),
            "{warnings:?}"
        );
    }

    #[test]
    fn each_instance_is_a_mesh_light_of_its_own() {
        let scene = read(&lamps([3, 3]));
        assert_eq!(scene.warnings(), &[] as &[String]);
        let frame = scene.frame(0);
        assert_eq!(frame.mesh_lights.len(), 3);
        // The second vertex: one to the right, one up, one to the left of where the instance stands.
        let expected = [[2.0, 5.0, 0.0], [2.0, 6.0, 0.0], [2.0, 5.0, 0.0]];
        for (light, expected) in frame.emissive.iter().zip(expected) {
            let is_there = light.p[1].iter().zip(expected).all(|(x, y)| (x - y).abs() < 1e-6);
            assert!(is_there, "{:?}", light.p);
        }
        let error = refused(&lamps([3, 2]), None);
        assert!(error.contains("different numbers"), "{error}");
    }
}

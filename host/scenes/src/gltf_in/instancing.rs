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
    let stands_once = ["KHR_lights_punctual", super::IES]
        .iter()
        .any(|name| others.contains_key(*name))
        || node.camera.is_some();
    if stands_once {
        document.warn(format!(
            "{element}: EXT_mesh_gpu_instancing repeats its mesh alone; its light or camera stands once, at the node"
        ));
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
        return Err(document.malformed(
            element,
            "its attributes have different numbers of instances",
            "give each as many",
        ));
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
    use crate::{Scene, SceneError};

    fn base64(bytes: &[u8]) -> String {
        const SIGNS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        let mut text = String::new();
        for three in bytes.chunks(3) {
            let word = (0..3).fold(0_u32, |word, k| {
                word << 8 | u32::from(three.get(k).copied().unwrap_or(0))
            });
            for k in 0..4 {
                let sign = SIGNS[(word >> (18 - 6 * k)) as usize & 63];
                text.push(if k > three.len() { '=' } else { char::from(sign) });
            }
        }
        text
    }

    /// A lamp of one triangle, at a node that has it three times; `counts` are those of translations and rotations.
    fn read(counts: [usize; 2]) -> Result<Scene, SceneError> {
        Scene::read_gltf_slice("instances.gltf", text(counts).as_bytes(), None)
    }

    fn text(counts: [usize; 2]) -> String {
        let triangle = [0.0_f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
        let places = [1.0_f32, 0.0, 0.0, 2.0, 0.0, 0.0, 3.0, 0.0, 0.0];
        let half = std::f32::consts::FRAC_1_SQRT_2;
        let turns = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, half, half, 0.0, 0.0, 1.0, 0.0_f32];
        let numbers: Vec<f32> = [&triangle[..], &places, &turns].concat();
        let bytes: Vec<u8> = numbers.iter().flat_map(|x| x.to_le_bytes()).collect();
        format!(
            r#"{{"asset": {{"version": "2.0"}}, "extensionsUsed": ["EXT_mesh_gpu_instancing"],
            "extensionsRequired": ["EXT_mesh_gpu_instancing"],
            "buffers": [{{"byteLength": {}, "uri": "data:application/octet-stream;base64,{}"}}],
            "bufferViews": [{{"buffer": 0, "byteLength": {}}}],
            "accessors": [
                {{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}},
                {{"bufferView": 0, "byteOffset": 36, "componentType": 5126, "count": {}, "type": "VEC3"}},
                {{"bufferView": 0, "byteOffset": 72, "componentType": 5126, "count": {}, "type": "VEC4"}}],
            "materials": [{{"emissiveFactor": [1, 1, 1]}}],
            "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}, "material": 0}}]}}],
            "nodes": [{{"mesh": 0, "translation": [0, 5, 0],
                "extensions": {{"EXT_mesh_gpu_instancing": {{"attributes": {{"TRANSLATION": 1, "ROTATION": 2, "_ID": 0}}}}}}}}],
            "scenes": [{{"nodes": [0]}}]}}"#,
            bytes.len(),
            base64(&bytes),
            bytes.len(),
            counts[0],
            counts[1]
        )
    }

    /// The extension is of the mesh.
    #[test]
    fn a_light_of_a_node_with_instances_is_named() {
        let lit = text([3, 3]).replace(
            r#""_ID": 0}}"#,
            r#""_ID": 0}}, "KHR_lights_punctual": {"light": 0}"#,
        );
        let lit = lit.replace(
            r#""extensionsUsed""#,
            r#""extensions": {"KHR_lights_punctual": {"lights": [{"type": "point"}]}}, "extensionsUsed""#,
        );
        let scene = Scene::read_gltf_slice("instances.gltf", lit.as_bytes(), None).expect("valid");
        assert_eq!((scene.data().analytic.len(), scene.emissive_count()), (1, 3));
        let warnings = scene.warnings();
        assert!(
            warnings.len() == 1 && warnings[0].contains("nodes[0]") && warnings[0].contains("stands once"),
            "{warnings:?}"
        );
    }

    #[test]
    fn each_instance_is_a_mesh_light_of_its_own() {
        let scene = read([3, 3]).expect("valid");
        assert_eq!(scene.warnings(), &[] as &[String]);
        let frame = scene.frame(0);
        assert_eq!(frame.mesh_lights.len(), 3);
        // The second vertex: one to the right, one up, one to the left of where the instance stands.
        let expected = [[2.0, 5.0, 0.0], [2.0, 6.0, 0.0], [2.0, 5.0, 0.0]];
        for (light, expected) in frame.emissive.iter().zip(expected) {
            let is_there = light.p[1].iter().zip(expected).all(|(x, y)| (x - y).abs() < 1e-6);
            assert!(is_there, "{:?}", light.p);
        }
        let error = read([3, 2]).expect_err("two rotations").to_string();
        assert!(error.contains("different numbers"), "{error}");
    }
}

//! Compressed geometry and pictures in glTF files: the same scene as unpacked, or an error.

use lightbvh_host::scene::Scene;
use lightbvh_tests::gltf_files::{embedded, read_json};
use meshoptimizer_rs::Workspace;
use meshoptimizer_rs::codec::{
    ExpMode, IndexEncoding, VertexEncoding, encode_filter_exp, encode_index_buffer, encode_index_sequence,
    encode_vertex_buffer,
};
use serde_json::{Value, json};

/// A grid of 20 by 20 emissive squares, whose positions fill more than one block of the vertex codec.
fn grid() -> (Vec<[f32; 3]>, Vec<u32>) {
    let positions = (0..441_u16)
        .map(|i| [f32::from(i % 21), f32::from(i / 21), f32::from(i % 7) * 0.25])
        .collect();
    let squares = (0..400).map(|i| i / 20 * 21 + i % 20);
    let indices = squares
        .flat_map(|a| [a, a + 1, a + 22, a, a + 22, a + 21])
        .collect();
    (positions, indices)
}

fn bytes(values: &[[f32; 3]]) -> Vec<u8> {
    values
        .as_flattened()
        .iter()
        .flat_map(|x| x.to_le_bytes())
        .collect()
}

/// A view over a fallback buffer, with its compressed bytes behind the others in buffer 0.
fn packed(
    data: &mut Vec<u8>,
    stream: &[u8],
    (count, stride): (usize, usize),
    mode: &str,
    filter: &str,
) -> Value {
    let view = json!({
        "buffer": 1, "byteLength": count * stride, "byteStride": if mode == "ATTRIBUTES" { json!(stride) } else { Value::Null },
        "extensions": { "EXT_meshopt_compression": {
            "buffer": 0, "byteOffset": data.len(), "byteLength": stream.len(), "byteStride": stride,
            "count": count, "mode": mode, "filter": filter,
        } },
    });
    data.extend(stream);
    view
}

/// The grid with its two views and 16-bit indices or 32-bit ones.
fn file(data: &[u8], views: [Value; 2], index_type: u32) -> Value {
    json!({
        "asset": { "version": "2.0" },
        "extensionsUsed": ["EXT_meshopt_compression"],
        "extensionsRequired": ["EXT_meshopt_compression"],
        "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1, "material": 0 }] }],
        "materials": [{ "emissiveFactor": [1.0, 1.0, 1.0] }],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": 441, "type": "VEC3" },
            { "bufferView": 1, "componentType": index_type, "count": 2400, "type": "SCALAR" },
        ],
        "bufferViews": views,
        "buffers": [
            { "byteLength": data.len(), "uri": embedded(data) },
            { "byteLength": 441 * 12 + 2400 * 4, "extensions": { "EXT_meshopt_compression": { "fallback": true } } },
        ],
    })
}

/// What each mode and filter gives.
fn compressed(mode: &str, filter: &str, version: u8) -> Value {
    let (positions, indices) = grid();
    let workspace = &mut Workspace::default();
    let flat = positions.as_flattened();
    let content = match filter {
        "EXPONENTIAL" => {
            encode_filter_exp(441, 12, 24, flat, ExpMode::Separate, workspace).expect("floats in range")
        }
        _ => bytes(&positions),
    };
    let encoding = VertexEncoding::new(version, 2).expect("a version");
    let vertices = encode_vertex_buffer(&content, 441, 12, encoding, workspace).expect("encoded");
    let encoding = IndexEncoding::new(1).expect("a version");
    let (list, stride, kind) = match mode {
        "TRIANGLES" => (encode_index_buffer(&indices, encoding, workspace), 2, 5123),
        _ => (encode_index_sequence(&indices, encoding, workspace), 4, 5125),
    };
    let mut data = Vec::new();
    let first = packed(&mut data, &vertices, (441, 12), "ATTRIBUTES", filter);
    let second = packed(&mut data, &list.expect("encoded"), (2400, stride), mode, "NONE");
    file(&data, [first, second], kind)
}

fn triangles(scene: &Scene) -> Vec<[[f32; 3]; 3]> {
    scene
        .frame(0)
        .triangles
        .iter()
        .map(|triangle| triangle.p)
        .collect()
}

/// The corners of each triangle may be turned, which the triangle codec does.
fn same(a: &[[[f32; 3]; 3]], b: &[[[f32; 3]; 3]]) -> bool {
    let turned =
        |p: &[[f32; 3]; 3], q: &[[f32; 3]; 3]| (0..3).any(|turn| (0..3).all(|i| p[i] == q[(i + turn) % 3]));
    a.len() == b.len() && a.iter().zip(b).all(|(p, q)| turned(p, q))
}

#[test]
fn compressed_views_hold_what_was_compressed() {
    let (positions, indices) = grid();
    let (corners, _) = indices.as_chunks::<3>();
    let expected: Vec<[[f32; 3]; 3]> = corners
        .iter()
        .map(|triangle| triangle.map(|vertex| positions[vertex as usize]))
        .collect();
    for (mode, filter, version) in [
        ("TRIANGLES", "NONE", 0),
        ("INDICES", "NONE", 0),
        ("TRIANGLES", "EXPONENTIAL", 0),
        ("TRIANGLES", "NONE", 1),
    ] {
        let scene = read_json(&compressed(mode, filter, version)).expect("a sound file");
        assert!(same(&triangles(&scene), &expected), "{mode} {filter} {version}");
    }
}

#[test]
fn compressed_views_that_cannot_be_are_named() {
    let extension = "/bufferViews/0/extensions/EXT_meshopt_compression";
    let cases = [
        ("count", json!(400), "cannot be unpacked"),
        ("count", json!(4_000_000_000_u64), "--memory"),
        ("count", json!(u64::MAX), "--memory"),
        ("byteStride", json!(13), "cannot be unpacked"),
        ("byteLength", json!(100), "cannot be unpacked"),
        ("byteOffset", json!(1_u64 << 40), "claims"),
        ("buffer", json!(7), "buffer 7"),
        ("buffer", json!(1), "buffer 1, which has 0"),
        ("mode", json!("OTHER"), "OTHER"),
        ("filter", json!("OCTAHEDRAL"), "cannot be unpacked"),
        ("mode", json!("TRIANGLES"), "cannot be unpacked"),
    ];
    for (key, value, expected) in cases {
        let mut root = compressed("TRIANGLES", "NONE", 0);
        root.pointer_mut(extension).expect("an extension")[key] = value.clone();
        let error = read_json(&root).expect_err("must be refused").to_string();
        assert!(error.contains(expected), "{key} = {value}: {error}");
        assert!(
            error.contains("bufferViews[0]") || error.contains("accessors[0]"),
            "{error}"
        );
    }
    let mut root = compressed("TRIANGLES", "NONE", 0);
    root["bufferViews"][0]["extensions"] = json!({});
    let error = read_json(&root)
        .expect_err("the buffer holds nothing")
        .to_string();
    assert!(error.contains("which has 0"), "{error}");
}

#[test]
fn an_optional_compression_that_is_broken_leaves_the_plain_data() {
    let (positions, _) = grid();
    let mut root = compressed("TRIANGLES", "NONE", 0);
    let mut plain = bytes(&positions);
    plain.resize(441 * 12 + 2400 * 4, 0);
    root["buffers"][1] = json!({ "byteLength": plain.len(), "uri": embedded(&plain) });
    root["bufferViews"][0]["extensions"]["EXT_meshopt_compression"]["byteLength"] = json!(100);
    let scene = read_json(&root).expect("the plain data are there");
    assert!(
        scene
            .warnings()
            .iter()
            .any(|warning| warning.contains("plain data"))
    );
    assert_eq!(scene.triangle_count(), 800);
}

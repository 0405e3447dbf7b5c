//! Compressed geometry in glTF files: the same scene as unpacked, or an error.

use draco_core::{
    DataType, EncoderBuffer, EncoderOptions, FaceIndex, GeometryAttributeType, Mesh, MeshEncoder,
    PointAttribute, PointIndex,
};
use meshoptimizer_rs::Workspace;
use meshoptimizer_rs::codec::{
    ExpMode, IndexEncoding, VertexEncoding, encode_filter_exp, encode_index_buffer, encode_index_sequence,
    encode_vertex_buffer,
};
use serde_json::{Value, json};

use crate::files::{bytes, embedded, png_white_black, read_json, refused};

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

/// The grid by a mode of indices, a filter of positions and a version of the vertex codec.
fn compressed(mode: &str, filter: &str, version: u8) -> Value {
    let (positions, indices) = grid();
    let workspace = &mut Workspace::default();
    let flat = positions.as_flattened();
    let content = match filter {
        "EXPONENTIAL" => {
            encode_filter_exp(441, 12, 24, flat, ExpMode::Separate, workspace).expect("floats in range")
        }
        _ => bytes(flat),
    };
    let encoding = VertexEncoding::new(version, 2).expect("a version");
    let mut data = encode_vertex_buffer(&content, 441, 12, encoding, workspace).expect("encoded");
    let encoding = IndexEncoding::new(1).expect("a version");
    let (list, stride, kind) = match mode {
        "TRIANGLES" => (encode_index_buffer(&indices, encoding, workspace), 2, 5123),
        _ => (encode_index_sequence(&indices, encoding, workspace), 4, 5125),
    };
    let (list, first) = (list.expect("encoded"), data.len());
    data.extend(&list);
    let view = |offset, length, stride: usize, count: usize, mode: &str, filter: &str| {
        json!({ "buffer": 1, "byteLength": count * stride, "extensions": { "EXT_meshopt_compression": {
            "buffer": 0, "byteOffset": offset, "byteLength": length, "byteStride": stride,
            "count": count, "mode": mode, "filter": filter,
        } } })
    };
    json!({
        "asset": { "version": "2.0" },
        "extensionsRequired": ["EXT_meshopt_compression"],
        "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1 }] }],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": 441, "type": "VEC3" },
            { "bufferView": 1, "componentType": kind, "count": 2400, "type": "SCALAR" },
        ],
        "bufferViews": [
            view(0, first, 12, 441, "ATTRIBUTES", filter), view(first, list.len(), stride, 2400, mode, "NONE"),
        ],
        "buffers": [
            { "byteLength": data.len(), "uri": embedded(&data) },
            { "byteLength": 441 * 12 + 2400 * 4, "extensions": { "EXT_meshopt_compression": { "fallback": true } } },
        ],
    })
}

/// The corners of each triangle may be turned, which the triangle codec does.
#[test]
fn compressed_views_hold_what_was_compressed() {
    let (positions, indices) = grid();
    let (corners, _) = indices.as_chunks::<3>();
    for (mode, filter, version) in [
        ("TRIANGLES", "NONE", 0),
        ("INDICES", "NONE", 0),
        ("TRIANGLES", "EXPONENTIAL", 0),
        ("TRIANGLES", "NONE", 1),
    ] {
        let found = read_json(&compressed(mode, filter, version)).frame(0).triangles;
        assert_eq!(found.len(), corners.len());
        for (own, corners) in found.iter().zip(corners) {
            let expected = corners.map(|vertex| positions[vertex as usize]);
            let is_turned = |by: usize| (0..3).all(|i| own.p[i] == expected[(i + by) % 3]);
            assert!((0..3).any(is_turned), "{mode} {filter} {version}");
        }
    }
}

#[test]
fn compressed_views_that_cannot_be_are_named() {
    let extension = "/bufferViews/0/extensions/EXT_meshopt_compression";
    for (key, value, expected) in [
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
    ] {
        let mut root = compressed("TRIANGLES", "NONE", 0);
        root.pointer_mut(extension).expect("an extension")[key] = value.clone();
        let error = refused(&root);
        let is_named = error.contains("bufferViews[0]") || error.contains("accessors[0]");
        assert!(is_named && error.contains(expected), "{key} = {value}: {error}");
    }
    let mut root = compressed("TRIANGLES", "NONE", 0);
    root["bufferViews"][0]["extensions"] = json!({});
    assert!(refused(&root).contains("which has 0"), "the buffer holds nothing");
}

const POSITIONS: [[f32; 3]; 4] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.5]];

/// Two triangles by Draco, with texture coordinates in the white half of the picture as normalized bytes.
fn stream(level: i32) -> Vec<u8> {
    use DataType::{Float32, Uint8};
    use GeometryAttributeType::{Position, TexCoord};
    let mut mesh = Mesh::new();
    let positions = bytes(POSITIONS.as_flattened());
    let coordinates = [0, 0, 100, 0, 0, 100, 100, 100];
    for (kind, numbers, data, bytes) in [
        (Position, 3, Float32, &positions[..]),
        (TexCoord, 2, Uint8, &coordinates),
    ] {
        let mut attribute = PointAttribute::new();
        attribute.init(kind, numbers, data, data == Uint8, 4);
        attribute.buffer_mut().write(0, bytes);
        mesh.add_attribute(attribute);
    }
    mesh.set_num_faces(2);
    mesh.set_face(FaceIndex(0), [0, 1, 2].map(PointIndex));
    mesh.set_face(FaceIndex(1), [1, 3, 2].map(PointIndex));
    let mut options = EncoderOptions::new();
    options.set_compression_level(level);
    let mut encoder = MeshEncoder::new();
    encoder.set_mesh(mesh);
    let mut out = EncoderBuffer::new();
    encoder.encode(&options, &mut out).expect("a sound mesh");
    out.data().to_vec()
}

fn file(stream: &[u8]) -> Value {
    json!({
        "asset": { "version": "2.0" },
        "extensionsRequired": ["KHR_draco_mesh_compression"],
        "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [{
            "attributes": { "POSITION": 0, "TEXCOORD_0": 1 }, "indices": 2, "material": 0,
            "extensions": { "KHR_draco_mesh_compression": {
                "bufferView": 0, "attributes": { "POSITION": 0, "TEXCOORD_0": 1 },
            } },
        }] }],
        "materials": [{ "emissiveFactor": [1.0, 0.5, 0.25], "emissiveTexture": { "index": 0 } }],
        "textures": [{ "source": 0, "sampler": 0 }],
        "samplers": [{ "magFilter": 9728 }],
        "images": [{ "uri": embedded(&png_white_black()) }],
        "accessors": [
            { "componentType": 5126, "count": 4, "type": "VEC3" },
            { "componentType": 5121, "count": 4, "type": "VEC2", "normalized": true },
            { "componentType": 5123, "count": 6, "type": "SCALAR" },
        ],
        "bufferViews": [{ "buffer": 0, "byteLength": stream.len() }],
        "buffers": [{ "byteLength": stream.len(), "uri": embedded(stream) }],
    })
}

#[test]
fn streams_hold_triangles_and_coordinates() {
    for level in [0, 7, 10] {
        let frame = read_json(&file(&stream(level))).frame(0);
        let mut area = 0.0;
        for light in &frame.emissive {
            // White wherever 100 / 255 is left of the picture's middle; else the coordinates were taken as they are.
            assert_eq!(light.radiance, [1.0, 0.5, 0.25], "level {level}");
            for vertex in light.p {
                let near = |p: &[f32; 3]| (0..3).all(|i| (p[i] - vertex[i]).abs() < 1e-3);
                assert!(POSITIONS.iter().any(near), "level {level}: {vertex:?}");
            }
            let [a, b, c] = light.p;
            area += 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
        }
        // Both face forward.
        assert!(
            frame.emissive.len() == 2 && (area - 1.0).abs() < 1e-3,
            "level {level}: {area}"
        );
    }
}

#[test]
fn streams_that_are_not_are_named() {
    let sound = stream(7);
    let error = refused(&file(&sound[..sound.len() / 2]));
    assert!(
        error.contains("meshes[0].primitives[0]") && error.contains("Draco"),
        "{error}"
    );
    let extension = "/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression";
    let names = |number: u32| json!({ "POSITION": number });
    for (key, value, expected) in [
        ("bufferView", json!(9), "bufferView 9"),
        ("bufferView", json!("x"), "invalid type"),
        ("attributes", names(7), "attribute 7 is not in the stream"),
        ("attributes", names(1), "2 numbers for each vertex"),
    ] {
        let mut root = file(&sound);
        root.pointer_mut(extension).expect("an extension")[key] = value;
        let error = refused(&root);
        assert!(error.contains(expected), "{expected}: {error}");
    }
}

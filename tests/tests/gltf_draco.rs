//! Draco streams in glTF files.

use draco_core::{
    DataType, EncoderBuffer, EncoderOptions, FaceIndex, GeometryAttributeType, Mesh, MeshEncoder,
    PointAttribute, PointIndex,
};
use lightbvh_tests::gltf_files::{embedded, png_white_black, push, read_json};
use serde_json::{Value, json};

const POSITIONS: [[f32; 3]; 4] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.5]];

/// In the white half of the picture, and in both, as normalized bytes.
const COORDINATES: [[u8; 2]; 4] = [[0, 0], [100, 0], [0, 100], [100, 100]];

/// Two triangles with texture coordinates.
fn stream(level: i32) -> Vec<u8> {
    let mut mesh = Mesh::new();
    let mut attribute = |kind, numbers, data, normalized, bytes: &[u8]| {
        let mut attribute = PointAttribute::new();
        attribute.init(kind, numbers, data, normalized, 4);
        attribute.buffer_mut().write(0, bytes);
        mesh.add_attribute(attribute);
    };
    let positions: Vec<u8> = POSITIONS
        .as_flattened()
        .iter()
        .flat_map(|x| x.to_le_bytes())
        .collect();
    attribute(
        GeometryAttributeType::Position,
        3,
        DataType::Float32,
        false,
        &positions,
    );
    let coordinates = COORDINATES.as_flattened();
    attribute(
        GeometryAttributeType::TexCoord,
        2,
        DataType::Uint8,
        true,
        coordinates,
    );
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
        "extensionsUsed": ["KHR_draco_mesh_compression"],
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
        let scene = read_json(&file(&stream(level))).expect("a sound file");
        let frame = scene.frame(0);
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
        assert_eq!(frame.emissive.len(), 2, "level {level}");
        assert!(
            (area - 1.0).abs() < 1e-3,
            "level {level}: both face forward, area {area}"
        );
    }
}

#[test]
fn streams_that_are_not_are_named() {
    let sound = stream(7);
    let error = read_json(&file(&sound[..sound.len() / 2]))
        .expect_err("cut")
        .to_string();
    assert!(
        error.contains("meshes[0].primitives[0]") && error.contains("Draco"),
        "{error}"
    );
    let extension = "/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression";
    let cases = [
        ("bufferView", json!(9), "bufferView 9"),
        ("bufferView", json!("x"), "invalid type"),
        (
            "attributes",
            json!({ "POSITION": 7 }),
            "attribute 7 is not in the stream",
        ),
        (
            "attributes",
            json!({ "POSITION": 1 }),
            "2 numbers for each vertex",
        ),
    ];
    for (key, value, expected) in cases {
        let mut root = file(&sound);
        root.pointer_mut(extension).expect("an extension")[key] = value;
        let error = read_json(&root).expect_err("must be refused").to_string();
        assert!(error.contains(expected), "{expected}: {error}");
    }
}

#[test]
fn an_optional_stream_that_is_broken_leaves_the_plain_data() {
    let sound = stream(7);
    let mut root = file(&sound[..8]);
    root["extensionsRequired"] = json!([]);
    let plain: Vec<u8> = POSITIONS
        .as_flattened()
        .iter()
        .flat_map(|x| x.to_le_bytes())
        .collect();
    push(
        &mut root["buffers"],
        json!({ "byteLength": 48, "uri": embedded(&plain) }),
    );
    push(&mut root["bufferViews"], json!({ "buffer": 1, "byteLength": 48 }));
    root["accessors"][0]["bufferView"] = json!(1);
    let primitive = &mut root["meshes"][0]["primitives"][0];
    primitive["mode"] = json!(5);
    primitive.as_object_mut().expect("an object").remove("indices");
    let scene = read_json(&root).expect("the plain data are there");
    // A strip of four vertices, both triangles with their front up.
    let triangles: Vec<_> = scene
        .frame(0)
        .triangles
        .iter()
        .map(|triangle| triangle.p)
        .collect();
    let [a, b, c, d] = POSITIONS;
    assert_eq!(triangles, [[a, b, c], [b, d, c]]);
    assert!(
        scene.warnings().iter().any(|warning| warning.contains("Draco")),
        "{:?}",
        scene.warnings()
    );
}

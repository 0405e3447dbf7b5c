//! What is said of files that can be read but not as they stand.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Value, json};

use super::*;

fn data_uri(bytes: &[u8]) -> String {
    format!("data:application/octet-stream;base64,{}", STANDARD.encode(bytes))
}

/// A triangle with a white picture, which lies by these coordinates.
fn painted(uv: [[f32; 2]; 3]) -> Value {
    let mut bytes = std::io::Cursor::new(Vec::new());
    ::image::RgbaImage::from_pixel(1, 1, ::image::Rgba([255; 4]))
        .write_to(&mut bytes, ::image::ImageFormat::Png)
        .expect("memory");
    let positions = [[0.0_f32, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let numbers = positions.as_flattened().iter().chain(uv.as_flattened());
    let buffer: Vec<u8> = numbers.flat_map(|x| x.to_le_bytes()).collect();
    json!({
        "asset": { "version": "2.0" }, "scene": 0, "scenes": [{ "nodes": [0] }], "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0, "TEXCOORD_0": 1 }, "material": 0 }] }],
        "materials": [{ "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } }],
        "textures": [{ "source": 0 }],
        "images": [{ "uri": format!("data:image/png;base64,{}", STANDARD.encode(bytes.into_inner())) }],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0] },
            { "bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2" }
        ],
        "bufferViews": [
            { "buffer": 0, "byteLength": 36 }, { "buffer": 0, "byteOffset": 36, "byteLength": 24 }
        ],
        "buffers": [{ "byteLength": 60, "uri": data_uri(&buffer) }]
    })
}

fn read(root: &Value) -> Scene {
    let text = root.to_string();
    Scene::read_gltf_slice("x.gltf", text.as_bytes(), None).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn texture_coordinates_that_are_none_are_named() {
    let fine = [[0.0, 0.0], [1.0, 0.0], [-(1 << 20) as f32, 1.0]];
    assert_eq!(read(&painted(fine)).warnings(), &[] as &[String]);
    for (bad, instead) in [
        (f32::INFINITY, (1 << 20) as f32),
        (-1e30, -(1 << 20) as f32),
        (f32::NAN, 0.0),
    ] {
        let scene = read(&painted([[0.0, 0.0], [bad, 0.0], [0.0, 1.0]]));
        let lies = scene.data().meshes[0].primitives[0].coordinates.as_ref();
        assert_eq!(lies.expect("where it lies")[1], [instead, 0.0]);
        let warnings = scene.warnings();
        assert!(
            warnings.len() == 1
                && warnings[0].starts_with("meshes[0].primitives[0]: numbers of TEXCOORD_0 beyond 2^20"),
            "{warnings:?}"
        );
    }
    let mut short = painted(fine);
    short["accessors"][1]["count"] = json!(2);
    let scene = read(&short);
    assert!(scene.warnings()[0].contains("TEXCOORD_0 has fewer entries than POSITION"));
}

/// What exporters write for none is none.
#[test]
fn lights_have_their_ranges() {
    let mut root = painted([[0.0; 2]; 3]);
    let lamp = |range: f64| json!({ "type": "point", "range": range });
    let spot = json!({ "type": "spot", "range": 7.5 });
    let far = lamp(1e40);
    root["extensions"] = json!({ "KHR_lights_punctual": { "lights": [lamp(3.0), spot, far, lamp(1e-9)] } });
    for light in 0..4 {
        let nodes = root["nodes"].as_array_mut().expect("nodes");
        nodes.push(json!({ "extensions": { "KHR_lights_punctual": { "light": light } } }));
        let number = nodes.len() - 1;
        root["scenes"][0]["nodes"]
            .as_array_mut()
            .expect("nodes")
            .push(json!(number));
    }
    let scene = read(&root);
    let found: Vec<Option<f32>> = scene.data().analytic.iter().map(|light| light.range).collect();
    assert_eq!(found, [Some(3.0), Some(7.5), None, Some(2.0_f32.powi(-20))]);
    assert!(scene.warnings().is_empty(), "{:?}", scene.warnings());
}

/// Every extension that is read stands in the documentation.
#[test]
fn the_documentation_names_every_extension_that_is_read() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/scenes.md");
    let text = std::fs::read_to_string(path).expect("docs/scenes.md");
    for name in extensions::READ.iter().chain(&extensions::HARMLESS) {
        assert!(text.contains(&format!("`{name}`")), "{name}");
    }
}

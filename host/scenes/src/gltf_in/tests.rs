//! What is said of files that can be read but not as they stand.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Value, json};

use lightbvh::BuildParams;
use lightbvh::light::{AnyLight, SpotLight};
use lightbvh_kernels::bvh::AnyNode;

use super::*;
use crate::Instances;

pub(super) fn data_uri(bytes: &[u8]) -> String {
    format!("data:application/octet-stream;base64,{}", STANDARD.encode(bytes))
}

/// A triangle with a white picture, which lies by these coordinates.
pub(super) fn painted(uv: [[f32; 2]; 3]) -> Value {
    painted_of(1.0, uv)
}

/// The same with sides of that length, metres.
fn painted_of(side: f32, uv: [[f32; 2]; 3]) -> Value {
    let mut bytes = std::io::Cursor::new(Vec::new());
    ::image::RgbaImage::from_pixel(1, 1, ::image::Rgba([255; 4]))
        .write_to(&mut bytes, ::image::ImageFormat::Png)
        .expect("memory");
    let positions = [[0.0; 3], [side, 0.0, 0.0], [0.0, side, 0.0]];
    let numbers = positions.as_flattened().iter().chain(uv.as_flattened());
    let buffer: Vec<u8> = numbers.flat_map(|x| x.to_le_bytes()).collect();
    json!({
        "asset": { "version": "2.0" }, "scene": 0, "scenes": [{ "nodes": [0] }], "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0, "TEXCOORD_0": 1 }, "material": 0 }] }],
        "materials": [{ "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } }],
        "textures": [{ "source": 0 }],
        "images": [{ "uri": format!("data:image/png;base64,{}", STANDARD.encode(bytes.into_inner())) }],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [side, side, 0] },
            { "bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2" }
        ],
        "bufferViews": [
            { "buffer": 0, "byteLength": 36 }, { "buffer": 0, "byteOffset": 36, "byteLength": 24 }
        ],
        "buffers": [{ "byteLength": 60, "uri": data_uri(&buffer) }]
    })
}

pub(super) fn read(root: &Value) -> Scene {
    let text = root.to_string();
    Scene::read_gltf_slice("x.gltf", text.as_bytes(), None).unwrap_or_else(|error| panic!("{error}"))
}

/// Why a file is refused.
pub(super) fn refused(root: &Value, folder: Option<&Path>) -> String {
    let found = Scene::read_gltf_slice("x.gltf", root.to_string().as_bytes(), folder);
    found.expect_err("refused").to_string()
}

/// Percent signs hide nothing.
#[test]
fn files_outside_of_the_folder_are_refused() {
    let folder = std::env::temp_dir().join(format!("lightbvh-gltf-{}", std::process::id()));
    std::fs::create_dir_all(folder.join("scene")).expect("a folder for files");
    std::fs::write(folder.join("secret"), [0; 60]).expect("a folder for files");
    for uri in ["../secret", "%2e%2e/secret", "%2E%2E%2Fsecret"] {
        let mut root = painted([[0.0; 2]; 3]);
        root["buffers"][0]["uri"] = json!(uri);
        let error = refused(&root, Some(&folder.join("scene")));
        assert!(error.contains("outside the scene's folder"), "{uri}: {error}");
    }
    std::fs::remove_dir_all(folder).expect("removed");
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

#[test]
fn texture_transforms_that_no_scene_takes_are_bounded_and_named() {
    let far = (1 << 20) as f32;
    for (given, expected) in [
        (
            json!({ "scale": [1e30, 1] }),
            [[far, 0.0], [0.0, 1.0], [0.0, 0.0]],
        ),
        (
            json!({ "scale": [1, 1e40] }),
            [[1.0, 0.0], [0.0, far], [0.0, 0.0]],
        ),
        (
            json!({ "offset": [0, -1e30] }),
            [[1.0, 0.0], [0.0, 1.0], [0.0, -far]],
        ),
        (json!({ "rotation": 1e40 }), [[1.0, 0.0], [0.0, 1.0], [0.0, 0.0]]),
    ] {
        let mut root = painted([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]);
        root["extensionsUsed"] = json!(["KHR_texture_transform"]);
        let material = &mut root["materials"][0];
        let texture = json!({ "index": 0, "extensions": { "KHR_texture_transform": given.clone() } });
        material["pbrMetallicRoughness"]["baseColorTexture"] = texture.clone();
        material["emissiveTexture"] = texture;
        material["emissiveFactor"] = json!([1, 1, 1]);
        let scene = read(&root);
        let paint = scene.data().materials[0].paint.expect("a picture");
        for texture in [paint.base_texture, paint.glow_texture] {
            assert_eq!(texture.expect("a picture").transform, expected, "{given}");
        }
        let warnings = scene.warnings();
        assert!(
            warnings.len() == 1 && warnings[0].starts_with("materials[0]: scales and offsets of its"),
            "{given}: {warnings:?}"
        );
        assert_eq!(scene.frame(0).emissive.len(), 1, "{given}");
    }
}

#[test]
fn alpha_modes_that_are_none_are_named() {
    for (mode, is_known) in [("OPAQUE", true), ("MASK", true), ("FOO", false), ("mask", false)] {
        let mut root = painted([[0.0; 2]; 3]);
        root["materials"][0]["alphaMode"] = json!(mode);
        let scene = read(&root);
        let warnings = scene.warnings();
        assert_eq!(warnings.is_empty(), is_known, "{mode}: {warnings:?}");
        assert!(is_known || warnings[0].starts_with("materials[0]: its alphaMode is none of"));
        assert_eq!(scene.data().materials[0].masked, mode == "MASK");
    }
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

/// A spot, a sun and a triangle, the first two under a node that is turned by a right angle about x and has this scale.
fn lit_under(scale: [f32; 3]) -> Value {
    let mut root = painted([[0.0; 2]; 3]);
    let half = std::f32::consts::FRAC_1_SQRT_2;
    root["extensions"] =
        json!({ "KHR_lights_punctual": { "lights": [{ "type": "spot" }, { "type": "directional" }] } });
    let lamp = |light: u32| json!({ "extensions": { "KHR_lights_punctual": { "light": light } } });
    root["nodes"] = json!([
        { "mesh": 0 },
        { "name": "hand", "translation": [1, 2, 3], "rotation": [-half, 0.0, 0.0, half], "scale": scale, "children": [2, 3] },
        lamp(0),
        lamp(1)
    ]);
    root["scenes"][0]["nodes"] = json!([0, 1]);
    root
}

/// A spot below a node of scale 0 shone along its own axis, and a sun from above, whatever their rotation.
#[test]
fn scales_do_not_turn_lights() {
    for scale in [
        [1.0; 3],
        [0.0; 3],
        [1e-30; 3],
        [1e30; 3],
        [0.5, 0.0, 2.0],
        [2.0, 3.0, 0.0],
    ] {
        let scene = read(&lit_under(scale));
        for frame in [0, 30] {
            let lit = scene.frame(frame);
            let spot = SpotLight::try_from(lit.others[0]).expect("a spot");
            let towards = lit.sky.suns()[1].direction;
            for (found, expected) in [
                (spot.axis, [0.0, -1.0, 0.0]),
                (towards, [0.0, 1.0, 0.0]),
                (spot.p, [1.0, 2.0, 3.0]),
            ] {
                let error: f32 = (0..3).map(|i| (found[i] - expected[i]).abs()).sum();
                assert!(error < 1e-5, "{scale:?}: {found:?}, expected {expected:?}");
            }
        }
        let followed = Instances::<AnyLight>::new::<AnyNode, (), 8>(&scene, 0, BuildParams::default());
        let (lights, mut instances) = followed.unwrap_or_else(|error| panic!("{scale:?}: {error}"));
        let spot = SpotLight::try_from(lights.world_lights()[0]).expect("a spot");
        assert!((spot.axis[1] + 1.0).abs() < 1e-5, "{scale:?}: {:?}", spot.axis);
        assert!(instances.edits(&scene, 9).is_empty());
    }
}

/// What would be refused when it is rendered is refused when it is read, by name.
#[test]
fn what_no_tree_takes_is_refused_by_name() {
    let mut dust = painted_of(1e-20, [[0.0; 2]; 3]);
    dust["nodes"][0] = json!({ "mesh": 0, "name": "dust", "scale": [1e20, 1e20, 1.0] });
    let mut bright = lit_under([1.0; 3]);
    bright["extensions"]["KHR_lights_punctual"]["lights"][0]["intensity"] = json!(1e38);
    bright["nodes"][2]["name"] = json!("lamp");
    let mut zeros = painted([[0.0; 2]; 3]);
    zeros["accessors"][0] = json!({ "componentType": 5126, "count": 3_000_000, "type": "VEC3" });
    // What was left out is most likely why.
    let mut points = painted([[0.0; 2]; 3]);
    points["meshes"][0]["primitives"][0]["mode"] = json!(0);
    for (root, parts) in [
        (dust, ["node 0 `dust`", "scale"]),
        (bright, ["`lamp`", "lower it"]),
        (
            zeros,
            ["3000000 zeros without a bufferView", "more than the 60 bytes"],
        ),
        (points, ["no triangles", "\n  - meshes[0].primitives[0]"]),
    ] {
        let error = refused(&root, None);
        assert!(parts.iter().all(|part| error.contains(part)), "{error}");
    }
}

/// Every extension that is read stands in the documentation.
#[test]
fn the_documentation_names_every_extension_that_is_read() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/scenes.md");
    let text = std::fs::read_to_string(path).expect("docs/scenes.md");
    for name in extensions::READ.iter().chain(&extensions::HARMLESS) {
        assert!(text.contains(&format!("`{name}`")), "{name}");
    }
}

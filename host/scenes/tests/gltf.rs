//! What is read of a glTF file, what is left out, and what is written.

use glam::Vec3;
use lightbvh::light::TWO_SIDED;
use lightbvh_scenes::{Frame, Scene};
use serde_json::{Value, json};

use crate::files::{busy, bytes, changed, embedded, push, read, read_json, refused, triangle};

fn frame(root: &Value) -> Frame {
    read_json(root).frame(0)
}

fn normal_z(frame: &Frame) -> f32 {
    let [a, b, c] = frame.emissive[0].p;
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

#[test]
fn a_triangle_in_a_data_uri_emits_by_factor_and_strength() {
    let light = frame(&triangle()).emissive[0];
    assert_eq!(light.p, [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    assert_eq!((light.radiance, light.flags), ([1.0, 0.5, 0.25], 0));
    let mut root = changed("/materials/0/doubleSided", json!(true));
    root["materials"][0]["extensions"] =
        json!({ "KHR_materials_emissive_strength": { "emissiveStrength": 8.0 } });
    root["extensionsRequired"] = json!(["KHR_materials_emissive_strength"]);
    let light = frame(&root).emissive[0];
    assert_eq!((light.radiance, light.flags), ([8.0, 4.0, 2.0], TWO_SIDED));
}

/// Through two negative factors nothing is mirrored; along z alone the front looks along -z then.
#[test]
fn mirrored_instances_keep_their_front() {
    for (scale, front) in [
        ([1.0, 1.0, 1.0], 1.0),
        ([-1.0, 1.0, 1.0], 1.0),
        ([1.0, -2.0, 1.0], 2.0),
        ([-1.0, -1.0, 1.0], 1.0),
        ([1.0, 1.0, -1.0], -1.0),
        // It stays in the list.
        ([1.0, 0.0, 1.0], 0.0),
    ] {
        let frame = frame(&changed("/nodes/0/scale", json!(scale)));
        assert_eq!(normal_z(&frame), front, "{scale:?}");
    }
}

#[test]
fn every_kind_of_element_survives_the_way_through_glb() {
    let scene = Scene::new(busy()).expect("a sound scene");
    let back = read(&scene.to_glb().expect("it can be written")).expect("and read back");
    for frame in 0..80 {
        assert_eq!(scene.frame(frame), back.frame(frame), "frame {frame}");
    }
}

#[test]
fn animations_follow_gltf() {
    let scene = Scene::new(busy()).expect("a sound scene");
    let first = |frame: u32| scene.frame(frame).triangles[0].p[0];
    // Linear from 0 to 3 in the first second, back in the second, then again.
    assert_eq!(first(0), [0.0, 0.0, 0.0]);
    assert_eq!(first(25), [3.0, 1.5, 0.0]);
    assert_eq!(first(75), first(25));
    let near = |a: f32, b: f32| (a - b).abs() < 1e-5;
    assert!(near(first(5)[0], 0.6), "{:?}", first(5));
    // Step: the scale is -2 from 0.7 s on, so the second vertex lies to the left, on the front side still.
    let [a, _, _] = scene.frame(20).triangles[0].p;
    let lefts = scene.frame(20).triangles[1].p.map(|p| p[0] - a[0]);
    assert!(lefts.iter().any(|x| near(*x, -2.0)), "{lefts:?}");
}

/// Elements that the format allows and that are left out: a warning of many is one line.
#[test]
fn what_is_left_out_is_noted_once() {
    let mut root = triangle();
    root["animations"] = json!([{
        "channels": [{ "sampler": 0, "target": { "path": "pointer", "extensions": { "KHR_animation_pointer": {} } } }],
        "samplers": [{ "input": 0, "output": 0 }],
    }]);
    root["extensionsUsed"] = json!(["KHR_materials_ior", "EXT_of_someone", "KHR_texture_transform"]);
    push(&mut root["scenes"], json!({ "name": "nothing" }));
    root["materials"][0]["alphaMode"] = json!("FOO");
    root["nodes"][0]["skin"] = json!(0);
    root["meshes"][0]["primitives"][0]["targets"] = json!([{ "POSITION": 0 }]);
    let list = &mut root["meshes"][0]["primitives"];
    push(list, json!({ "attributes": { "POSITION": 0 }, "mode": 1 }));
    for _ in 0..6 {
        push(list, json!({ "attributes": {}, "material": 0 }));
    }
    let scene = read_json(&root);
    assert_eq!(scene.frame(0).triangles.len(), 1);
    let said = scene.warnings();
    for part in [
        "1 channels",
        "nodes[0]: its skin is left out",
        "meshes[0].primitives[0]: its morph targets are left out",
        "extension KHR_materials_ior",
        "extension EXT_of_someone",
        "meshes[0].primitives[1]: skipped",
        "meshes[0].primitives[2], meshes[0].primitives[3], meshes[0].primitives[4] and 3 more: it has no positions",
        "materials[0]: its alphaMode is none of",
    ] {
        assert_eq!(
            said.iter().filter(|line| line.contains(part)).count(),
            1,
            "{part}: {said:?}"
        );
    }
    assert_eq!(said.len(), 8, "{said:?}");
    // What else is wrong is said as it was.
    root["scene"] = json!("none");
    assert!(refused(&root).contains("JSON"));
}

#[test]
fn positions_of_every_component_type() {
    // (0,0,0), (1,0,0), (0,1,0), in units of a whole, as plain integers and as fractions of the largest.
    let plain = [
        (5120, 1, false, 1),
        (5121, 1, false, 1),
        (5122, 2, false, 1),
        (5123, 2, false, 1),
    ];
    let parts = [
        (5120, 1, true, 127),
        (5121, 1, true, 255),
        (5122, 2, true, 32767),
        (5123, 2, true, 65535),
    ];
    for (component, size, normalized, whole) in plain.into_iter().chain(parts) {
        let mut bytes = Vec::new();
        for corner in [[0, 0, 0], [whole, 0, 0], [0, whole, 0_i32]] {
            let numbers = corner.iter().map(|x| x.to_le_bytes());
            let mut element = numbers.flat_map(|x| x[..size].to_vec()).collect::<Vec<u8>>();
            element.resize(8, 0);
            bytes.extend(element);
        }
        bytes.extend([0, 0, 1, 0, 2, 0]);
        let mut root = changed("/buffers/0", json!({ "byteLength": 30, "uri": embedded(&bytes) }));
        root["bufferViews"] = json!([
            { "buffer": 0, "byteLength": 24, "byteStride": 8 }, { "buffer": 0, "byteOffset": 24, "byteLength": 6 },
        ]);
        root["accessors"][0]["componentType"] = json!(component);
        root["accessors"][0]["normalized"] = json!(normalized);
        root["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
        let expected = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        assert_eq!(frame(&root).triangles[0].p, expected, "{component} {normalized}");
    }
}

/// A strip of four vertices: both triangles have their front up.
#[test]
fn strips_keep_one_side_in_front() {
    let corners = [[0.0_f32; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.5]];
    let mut root = triangle();
    root["buffers"][0] = json!({ "byteLength": 48, "uri": embedded(&bytes(corners.as_flattened())) });
    root["bufferViews"] = json!([{ "buffer": 0, "byteLength": 48 }]);
    root["accessors"] = json!([{ "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3" }]);
    let [a, b, c, d] = corners;
    for (mode, expected) in [(5, [[a, b, c], [b, d, c]]), (6, [[b, c, a], [c, d, a]])] {
        root["meshes"][0]["primitives"][0] = json!({ "attributes": { "POSITION": 0 }, "mode": mode });
        let found: Vec<_> = frame(&root).triangles.iter().map(|own| own.p).collect();
        assert_eq!(found, expected, "{mode}");
    }
}

/// Also where the parent of its parent is not in the scene.
#[test]
fn a_child_that_the_scene_lists_stays_a_child() {
    for (nodes, count) in [([1, 0], 2), ([0, 1], 3)] {
        let mut root = changed("/scenes/0/nodes", json!(nodes));
        root["nodes"] = json!([{ "translation": [0.0, 0.0, 5.0], "children": [1] }, { "mesh": 0 },
            { "translation": [0.0, 7.0, 0.0], "children": [0] }]);
        root["nodes"].as_array_mut().expect("a list").truncate(count);
        let triangles = frame(&root).triangles;
        assert_eq!((triangles.len(), triangles[0].p[0]), (1, [0.0, 0.0, 5.0]));
    }
}

#[test]
fn scenes_without_a_camera_are_seen_whole() {
    for scale in [1e-2, 1.0, 1e4] {
        let file = changed(
            "/nodes/0",
            json!({ "mesh": 0, "scale": [scale, scale, scale], "translation": [7, 8, 9] }),
        );
        let scene = read_json(&file);
        let (view, other) = (scene.frame(0).camera, scene.frame(30).camera);
        assert!(
            view == other && view.eye[2] > 9.0 && view.right[1].abs() < 1e-6,
            "{view:?}"
        );
        for p in scene.frame(0).triangles[0].p {
            let d = Vec3::from(p) - Vec3::from(view.eye);
            let half = d.dot(view.forward.into()) * (0.5 * view.yfov).tan();
            let place = [view.right, view.up].map(|axis| d.dot(axis.into()) / half);
            assert!(half > 0.0 && place.iter().all(|x| x.abs() <= 1.0), "{place:?}");
        }
    }
}

#[test]
fn optional_extensions_that_cannot_be_read_are_left_out() {
    let mut root = triangle();
    let draco = json!({ "KHR_draco_mesh_compression": { "attributes": "all" } });
    root["meshes"][0]["primitives"][0]["extensions"] = draco;
    let said = read_json(&root).warnings().join("\n");
    assert!(
        said.contains("its extension KHR_draco_mesh_compression is ignored"),
        "{said}"
    );
    root["extensionsRequired"] = json!(["KHR_draco_mesh_compression"]);
    let error = refused(&root);
    assert!(
        error.contains(".extensions.KHR_draco_mesh_compression"),
        "{error}"
    );
}

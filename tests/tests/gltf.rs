//! The glTF loader: what it reads, what it leaves out, and what it writes.

use lightbvh::light::TWO_SIDED;
use lightbvh_host::scene::{Frame, Scene};
use lightbvh_tests::gltf_files::{
    bending, busy, changed, embedded, png_white_black, push, read, read_json, triangle,
};
use serde_json::json;

fn normal_z(frame: &Frame) -> f32 {
    let [a, b, c] = frame.emissive[0].p;
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

#[test]
fn a_triangle_in_a_data_uri() {
    let scene = read_json(&triangle()).expect("a sound file");
    let frame = scene.frame(0);
    assert_eq!(frame.emissive.len(), 1);
    assert_eq!(
        frame.emissive[0].p,
        [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]
    );
    assert_eq!(frame.emissive[0].radiance, [1.0, 0.5, 0.25]);
    assert_eq!(frame.emissive[0].flags, 0);
    assert_eq!(frame.mesh_lights.len(), 1);
    // Seen whole, from the front, without a camera in the file.
    assert!(
        frame.camera.eye[2] > 1.0 && frame.camera.forward[2] < 0.0,
        "{:?}",
        frame.camera
    );
}

#[test]
fn emissive_strength_and_two_sided() {
    let mut root = changed("/materials/0/doubleSided", json!(true));
    root["materials"][0]["extensions"] =
        json!({ "KHR_materials_emissive_strength": { "emissiveStrength": 8.0 } });
    root["extensionsUsed"] = json!(["KHR_materials_emissive_strength"]);
    root["extensionsRequired"] = json!(["KHR_materials_emissive_strength"]);
    let frame = read_json(&root).expect("a sound file").frame(0);
    assert_eq!(frame.emissive[0].radiance, [8.0, 4.0, 2.0]);
    assert_eq!(frame.emissive[0].flags, TWO_SIDED);
}

#[test]
fn mirrored_instances_keep_their_front() {
    let plain = read_json(&triangle()).expect("a sound file").frame(0);
    assert!(normal_z(&plain) > 0.0);
    for mirror in [[-1.0, 1.0, 1.0], [1.0, -2.0, 1.0]] {
        let frame = read_json(&changed("/nodes/0/scale", json!(mirror)))
            .expect("a sound file")
            .frame(0);
        assert!(
            normal_z(&frame) > 0.0,
            "scale {mirror:?} must not turn the front away"
        );
    }
    // Through two negative factors nothing is mirrored: the triangle is turned about z.
    let turned = read_json(&changed("/nodes/0/scale", json!([-1.0, -1.0, 1.0])))
        .expect("a sound file")
        .frame(0);
    assert!(normal_z(&turned) > 0.0);
    // Mirroring along z alone swaps the sides in space: the front now looks along -z.
    let behind = read_json(&changed("/nodes/0/scale", json!([1.0, 1.0, -1.0])))
        .expect("a sound file")
        .frame(0);
    assert!(normal_z(&behind) < 0.0);
}

#[test]
fn zero_area_triangles_stay_in_the_list() {
    let frame = read_json(&changed("/nodes/0/scale", json!([1.0, 0.0, 1.0])))
        .expect("a sound file")
        .frame(0);
    assert_eq!(frame.emissive.len(), 1);
    assert_eq!(normal_z(&frame), 0.0);
}

#[test]
fn other_primitive_modes_are_skipped_with_a_note() {
    let mut root = triangle();
    let mut lines = root["meshes"][0]["primitives"][0].clone();
    lines["mode"] = json!(1);
    root["meshes"][0]["primitives"]
        .as_array_mut()
        .expect("a list")
        .push(lines);
    let scene = read_json(&root).expect("a sound file");
    assert_eq!(scene.triangle_count(), 1);
    assert_eq!(scene.warnings().len(), 1);
    assert!(
        scene.warnings()[0].contains("meshes[0].primitives[1]"),
        "{:?}",
        scene.warnings()
    );
}

/// Two triangles that cover the left half, or all, of a texture.
#[test]
fn emissive_textures_are_averaged_per_triangle() {
    let positions = [[0.0_f32, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    // Wholly in the white texel, wholly in the black one, and three quarters of the area in the white one.
    let uv = [
        [0.05_f32, 0.1],
        [0.45, 0.1],
        [0.05, 0.9],
        [0.55, 0.1],
        [0.95, 0.1],
        [0.55, 0.9],
        [0.0, 0.1],
        [1.0, 0.1],
        [0.0, 0.9],
    ];
    let mut bytes: Vec<u8> = Vec::new();
    for _ in 0..3 {
        bytes.extend(positions.as_flattened().iter().flat_map(|x| x.to_le_bytes()));
    }
    bytes.extend(uv.as_flattened().iter().flat_map(|x| x.to_le_bytes()));
    let root = json!({
        "asset": { "version": "2.0" },
        "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0, "TEXCOORD_0": 1 }, "material": 0 }] }],
        "materials": [{ "emissiveFactor": [1.0, 1.0, 0.5], "emissiveTexture": { "index": 0 } }],
        "textures": [{ "source": 0, "sampler": 0 }],
        "samplers": [{ "magFilter": 9728 }],
        "images": [{ "uri": embedded(&png_white_black()) }],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": 9, "type": "VEC3" },
            { "bufferView": 0, "byteOffset": 108, "componentType": 5126, "count": 9, "type": "VEC2" },
        ],
        "bufferViews": [{ "buffer": 0, "byteLength": bytes.len() }],
        "buffers": [{ "byteLength": bytes.len(), "uri": embedded(&bytes) }],
    });
    let scene = read_json(&root).expect("a sound file");
    let frame = scene.frame(0);
    // The black triangle is no light at all.
    assert_eq!(
        (
            frame.triangles.len(),
            frame.emissive.len(),
            frame.mesh_lights.len()
        ),
        (3, 2, 1)
    );
    assert_eq!(frame.emissive[0].radiance, [1.0, 1.0, 0.5]);
    let mixed = frame.emissive[1].radiance;
    assert_eq!(
        mixed,
        [0.75, 0.75, 0.375],
        "12 of 16 equal parts lie in the white texel"
    );

    let back = read(&scene.to_glb().expect("it can be written")).expect("and read back");
    assert_eq!(
        back.frame(0).emissive,
        frame.emissive,
        "radiance per triangle survives the way through .glb"
    );
}

#[test]
fn every_kind_of_element_survives_the_way_through_glb() {
    for data in [busy(), bending()] {
        let scene = Scene::new(data).expect("a sound scene");
        let back = read(&scene.to_glb().expect("it can be written")).expect("and read back");
        for frame in 0..80 {
            assert_eq!(scene.frame(frame), back.frame(frame), "frame {frame}");
        }
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

#[test]
fn channels_that_name_no_node_are_left_out() {
    let mut root = triangle();
    root["animations"] = json!([{
        "channels": [{ "sampler": 0, "target": { "path": "pointer", "extensions": { "KHR_animation_pointer": {} } } }],
        "samplers": [{ "input": 0, "output": 0 }],
    }]);
    let scene = read_json(&root).expect("a sound file");
    assert!(
        scene.warnings()[0].contains("1 channels"),
        "{:?}",
        scene.warnings()
    );
    // What else is wrong is said as it was.
    root["scene"] = json!("none");
    let error = read_json(&root).expect_err("broken").to_string();
    assert!(error.contains("JSON"), "{error}");
}

/// What the format allows and some files have: a scene without a list of nodes, a primitive without positions.
#[test]
fn what_may_be_missing_is_no_error() {
    let mut root = triangle();
    push(&mut root["scenes"], json!({ "name": "nothing" }));
    push(
        &mut root["meshes"][0]["primitives"],
        json!({ "attributes": {}, "material": 0 }),
    );
    let scene = read_json(&root).expect("sound");
    assert_eq!(scene.frame(0).emissive.len(), 1);
    let said = |word: &str| scene.warnings().iter().any(|warning| warning.contains(word));
    assert!(said("no positions"), "{:?}", scene.warnings());
}

/// What is no glTF 2.0 is called by its name.
#[test]
fn other_files_are_named() {
    let pointer = b"version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 1\n";
    let error = read(pointer).expect_err("no model").to_string();
    assert!(error.contains("git lfs pull"), "{error}");
    let old = br#"{ "asset": { "version": "1.0" }, "meshes": {} }"#;
    let error = read(old).expect_err("another format").to_string();
    assert!(error.contains("glTF 1.0"), "{error}");
}

/// A warning about many elements is one line.
#[test]
fn warnings_of_one_kind_are_one() {
    let mut root = triangle();
    let own = root["meshes"][0]["primitives"][0].clone();
    for _ in 0..6 {
        let mut primitive = own.clone();
        primitive["attributes"] = json!({});
        push(&mut root["meshes"][0]["primitives"], primitive);
    }
    let scene = read_json(&root).expect("sound");
    let lines: Vec<_> = scene
        .warnings()
        .iter()
        .filter(|line| line.contains("no positions"))
        .collect();
    assert_eq!(lines.len(), 1, "{lines:?}");
    assert!(
        lines[0].contains("meshes[0].primitives[1]") && lines[0].contains("and 3 more"),
        "{lines:?}"
    );
}

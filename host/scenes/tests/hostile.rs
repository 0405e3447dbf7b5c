//! Hostile glTF files are errors that name the element. Damaged ones are the fuzz target `gltf`.

use lightbvh_scenes::{Channel, Limits, Scene, SceneData, SceneError};
use serde_json::{Value, json};

use crate::files::{
    broken, busy, bytes, changed, embedded, png, push, read, read_json, refused, textured, triangle,
};

/// The place of a value, the value, and a part of the error.
const VALUES: &str = "
/nodes/0/translation | [1e39, 0.0, 0.0] | number out of range at line 1
/nodes/0/translation | [1e13, 0.0, 0.0] | 2^40
/nodes/0/scale | [3e38, 1.0, 1.0] | 2^40
/nodes/0/mesh | 7 | mesh 7
/nodes/0/camera | 0 | camera 0
/nodes/0/children | [0] | node 0 is below itself
/nodes/0/children | [9] | node 9
/scenes/0/nodes | [4] | node 4
/meshes/0/primitives/0/mode | 0 |   - meshes[0].primitives[0]
/scene | 3 | scene 3
/materials/0/emissiveFactor | [-1.0, 0.0, 0.0] | negative
/meshes/0/primitives/0/material | 5 | material 5
/meshes/0/primitives/0/indices | 2 | accessor 2
/meshes/0/primitives/0/indices | 0 | unsigned
/meshes/0/primitives/0/attributes | {} | no triangles
/meshes/0/primitives/0/attributes | { \"POSITION\": 1 } | expected 3
/accessors/0/count | 4 | claims 4 elements
/accessors/0/count | 18446744073709551615 | claims
/accessors/0/byteOffset | 18446744073709551615 | claims
/accessors/0/count | 2 | refers to vertex 2
/accessors/1/count | 2 | multiple of 3
/accessors/0/componentType | 1 | component type
/accessors/0/type | \"VEC9\" | element type
/accessors/0 | { \"componentType\": 5126, \"count\": 4000000000, \"type\": \"VEC3\" } | has no bufferView
/bufferViews/0/byteLength | 18446744073709551615 | claims
/bufferViews/0/byteStride | 3 | stride
/bufferViews/0/buffer | 1 | buffer 1
/buffers/0/byteLength | 43 | only 42
/buffers/0/uri | \"data:;base64,@@@\" | base64
/buffers/0/uri | \"/etc/passwd\" | relative
/buffers/0/uri | \"http://example.com/a.bin\" | relative
/extensionsRequired | [\"KHR_of_the_future\"] | KHR_of_the_future is not supported
/asset | null | JSON
/asset | { \"version\": \"3.0\" } | needs glTF 3.0
/asset | { \"version\": \"2.0\", \"minVersion\": \"2.9\" } | needs glTF 2.9
/meshes/0/primitives | [] | no triangles
";

#[test]
fn hostile_values_are_named() {
    for line in VALUES.trim().lines() {
        let parts: Vec<&str> = line.splitn(3, " | ").collect();
        let value = serde_json::from_str(parts[1]).expect(line);
        let message = refused(&changed(parts[0], value));
        assert!(message.contains(parts[2]), "{line}: {message}");
        assert!(message.contains("test"), "the file is named: {message}");
    }
}

#[test]
fn broken_scenes_are_named() {
    let mut bytes = bytes(&[f32::NAN; 9]);
    bytes.extend([0, 0, 1, 0, 2, 0]);
    let error = refused(&changed("/buffers/0/uri", json!(embedded(&bytes))));
    assert!(error.contains("is NaN"), "{error}");

    fn channel(data: &mut SceneData) -> &mut Channel {
        &mut data.animations[0].channels[0]
    }
    type Case = (fn(&mut SceneData), &'static str);
    let cases: [Case; 10] = [
        (|data| data.nodes[1].parent = Some(1), "parent of node 1"),
        (|data| channel(data).times[1] = f32::INFINITY, "time"),
        (|data| channel(data).times[1] = 5.0, "ascending"),
        (|data| channel(data).times.clear(), "keys"),
        (|data| channel(data).values.truncate(8), "expected 9"),
        (|data| channel(data).node = 2, "translation, rotation and scale"),
        (
            |data| data.meshes[1].primitives[1].radiance = Some(Vec::new()),
            "radiance",
        ),
        (|data| data.materials[0].radiance = [3e38; 3], "2^100"),
        (|data| data.cameras[0].yfov = 4.0, "field of view"),
        (|data| data.background[1] = -1.0, "background"),
    ];
    for (change, expected) in cases {
        let error = broken(busy(), change);
        assert!(error.contains(expected), "{expected}: {error}");
    }
}

#[test]
fn scenes_without_lights_pass_until_lights_are_needed() {
    let error = read_json(&changed("/materials/0", json!({}))).require_lights();
    assert!(matches!(error, Err(SceneError::NoEmissive { .. })), "{error:?}");
}

#[test]
fn instances_are_counted_before_memory_is_taken() {
    let error = broken(busy(), |data| {
        let many = (0..1 << 20).map(|i| [i % 4, (i + 1) % 4, (i + 2) % 4]);
        data.meshes[0].primitives[0].triangles = many.collect();
        let extra = data.nodes[1].clone();
        data.nodes.extend(std::iter::repeat_n(extra, 5_000));
    });
    assert!(error.contains("triangles over all instances"), "{error}");
}

/// Opens a glTF file under a limit of `memory` bytes, and returns the error.
fn within(memory: u64, root: &Value) -> String {
    let path = std::env::temp_dir().join(format!("lightbvh-{memory}-{}.gltf", std::process::id()));
    std::fs::write(&path, root.to_string()).expect("a file");
    let limits = Limits {
        memory,
        ..Limits::default()
    };
    let found = Scene::open_within(path.as_os_str(), &limits);
    std::fs::remove_file(path).expect("removed");
    found.expect_err("too much").to_string()
}

#[test]
fn strips_without_indices_take_memory_first() {
    let mut root = changed("/buffers/0/uri", json!(embedded(&vec![0; 300_000])));
    root["buffers"][0]["byteLength"] = json!(300_000);
    root["bufferViews"][0]["byteLength"] = json!(300_000);
    root["accessors"][0] =
        json!({ "bufferView": 0, "componentType": 5121, "count": 100_000, "type": "VEC3" });
    root["meshes"][0]["primitives"][0] = json!({ "attributes": { "POSITION": 0 }, "mode": 5 });
    let error = within(3_000_000, &root);
    assert!(error.contains("the list of triangles"), "{error}");
}

#[test]
fn broken_pictures_take_memory() {
    let whole = png(512, 512, |_, _| [255; 4]);
    let mut root = textured([[0.0; 2]; 3], &whole[..whole.len() / 2]);
    for (list, own) in [
        ("images", root["images"][0].clone()),
        ("textures", json!({ "source": 1 })),
        (
            "materials",
            json!({ "emissiveFactor": [1, 1, 1], "emissiveTexture": { "index": 1 } }),
        ),
    ] {
        push(&mut root[list], own);
    }
    let error = within(4_000_000, &root);
    assert!(error.contains("images[1]: a picture, decoded"), "{error}");
}

#[test]
fn names_are_cut_and_primitives_without_triangles_left_out() {
    let long = "x".repeat(10_000);
    let mut root = changed("/nodes/0/name", json!(long));
    let short = json!({ "bufferView": 1, "componentType": 5123, "count": 2, "type": "SCALAR" });
    push(&mut root["accessors"], short);
    let strip = json!({ "attributes": { "POSITION": 0 }, "indices": 2, "mode": 5 });
    push(&mut root["meshes"][0]["primitives"], strip);
    let scene = read_json(&root);
    assert_eq!(scene.data().nodes[0].name, long[..60]);
    assert_eq!(scene.data().meshes[0].primitives.len(), 1);
    for (place, value) in [
        ("/extensionsRequired", json!([long])),
        ("/buffers/0/uri", json!(long)),
        ("/asset/version", json!(long)),
    ] {
        assert!(refused(&changed(place, value)).len() < 1500, "{place}");
    }
}

#[test]
fn deep_chains_of_nodes_need_no_deep_stack() {
    let mut root = triangle();
    let depth = 20_000;
    let chain = (1..depth).map(|child| json!({ "children": [child] }));
    root["nodes"] = chain.chain([json!({ "mesh": 0 })]).collect();
    assert_eq!(read_json(&root).frame(9).triangles.len(), 1);
    let nested = format!("{{\"asset\":{}{}}}", "[".repeat(100_000), "]".repeat(100_000));
    let error = read(nested.as_bytes()).expect_err("too deep").to_string();
    assert!(error.contains("not a readable glTF 2.0 file"), "{error}");
}

#[test]
fn truncated_files_are_errors() {
    let scene = Scene::new(busy()).expect("a sound scene");
    let glb = scene.to_glb().expect("it can be written");
    for length in 0..glb.len() {
        assert!(read(&glb[..length]).is_err(), "{length} of {} bytes", glb.len());
    }
}

/// A bright lamp, a pointer of Git LFS, another version.
#[test]
fn other_files_are_named() {
    let mut root = triangle();
    root["extensions"] =
        json!({ "KHR_lights_punctual": { "lights": [{ "type": "point", "intensity": 1e38 }] } });
    root["nodes"][0]["name"] = json!("lamp");
    root["nodes"][0]["extensions"] = json!({ "KHR_lights_punctual": { "light": 0 } });
    let text = root.to_string();
    for (text, expected) in [
        (text.as_str(), ["`lamp`", "lower it"]),
        (
            "version https://git-lfs.github.com/spec/v1\n",
            ["git lfs pull"; 2],
        ),
        (
            r#"{ "asset": { "version": "1.0" }, "meshes": {} }"#,
            ["glTF 1.0"; 2],
        ),
    ] {
        let error = read(text.as_bytes()).expect_err("no model").to_string();
        assert!(expected.iter().all(|part| error.contains(part)), "{error}");
    }
}

/// Percent signs hide nothing.
#[test]
fn files_outside_of_the_folder_are_refused() {
    let folder = std::env::temp_dir().join(format!("lightbvh-gltf-{}", std::process::id()));
    std::fs::create_dir_all(folder.join("scene")).expect("a folder for files");
    std::fs::write(folder.join("secret"), [0; 60]).expect("a folder for files");
    for uri in ["../secret", "%2e%2e/secret", "%2E%2E%2Fsecret"] {
        let text = changed("/buffers/0/uri", json!(uri)).to_string();
        let found = Scene::read_gltf_slice("test", text.as_bytes(), Some(&folder.join("scene")));
        let error = found.expect_err("outside").to_string();
        assert!(error.contains("outside the scene's folder"), "{uri}: {error}");
    }
    std::fs::remove_dir_all(folder).expect("removed");
}

//! Hostile glTF files are errors that name the element. Damaged ones are the fuzz target `gltf`.

use lightbvh_scenes::{Node, Scene, SceneData, SceneError};
use serde_json::{Value, json};

use crate::files::{broken, busy, bytes, changed, embedded, read, read_json, refused, triangle};

#[test]
fn hostile_values_are_named() {
    let cases: Vec<(&str, Value, &str)> = vec![
        (
            "/nodes/0/translation",
            json!([1e39, 0.0, 0.0]),
            // No f32 holds it: refused where it is read, by line and column.
            "number out of range at line 1",
        ),
        ("/nodes/0/translation", json!([1e13, 0.0, 0.0]), "2^40"),
        ("/nodes/0/scale", json!([3e38, 1.0, 1.0]), "2^40"),
        ("/nodes/0/mesh", json!(7), "mesh 7"),
        ("/nodes/0/camera", json!(0), "camera 0"),
        ("/nodes/0/children", json!([0]), "node 0 is below itself"),
        ("/nodes/0/children", json!([9]), "node 9"),
        ("/scenes/0/nodes", json!([4]), "node 4"),
        (
            "/meshes/0/primitives/0/mode",
            json!(0),
            "\n  - meshes[0].primitives[0]",
        ),
        ("/scene", json!(3), "scene 3"),
        ("/materials/0/emissiveFactor", json!([-1.0, 0.0, 0.0]), "negative"),
        (
            "/materials/0/emissiveFactor",
            json!([1e39, 0.0, 0.0]),
            "number out of range at line 1",
        ),
        ("/meshes/0/primitives/0/material", json!(5), "material 5"),
        ("/meshes/0/primitives/0/indices", json!(2), "accessor 2"),
        ("/meshes/0/primitives/0/indices", json!(0), "unsigned"),
        ("/meshes/0/primitives/0/attributes", json!({}), "no triangles"),
        (
            "/meshes/0/primitives/0/attributes",
            json!({ "POSITION": 1 }),
            "expected 3",
        ),
        ("/accessors/0/count", json!(4), "claims 4 elements"),
        ("/accessors/0/count", json!(u64::MAX), "claims"),
        ("/accessors/0/byteOffset", json!(u64::MAX), "claims"),
        ("/accessors/0/count", json!(2), "refers to vertex 2"),
        ("/accessors/1/count", json!(2), "multiple of 3"),
        ("/accessors/0/componentType", json!(1), "component type"),
        ("/accessors/0/type", json!("VEC9"), "element type"),
        (
            "/accessors/0",
            json!({ "componentType": 5126, "count": 4_000_000_000_u32, "type": "VEC3" }),
            "4000000000",
        ),
        ("/bufferViews/0/byteLength", json!(u64::MAX), "claims"),
        ("/bufferViews/0/byteStride", json!(3), "stride"),
        ("/bufferViews/0/buffer", json!(1), "buffer 1"),
        ("/buffers/0/byteLength", json!(43), "only 42"),
        ("/buffers/0/uri", json!("data:;base64,@@@"), "base64"),
        ("/buffers/0/uri", json!("/etc/passwd"), "relative"),
        ("/buffers/0/uri", json!("http://example.com/a.bin"), "relative"),
        (
            "/extensionsRequired",
            json!(["KHR_of_the_future"]),
            "KHR_of_the_future is not supported",
        ),
        ("/asset", json!(null), "JSON"),
        ("/meshes/0/primitives", json!([]), "no triangles"),
    ];
    for (pointer, value, expected) in cases {
        let root = changed(pointer, value.clone());
        let message = refused(&root);
        assert!(message.contains(expected), "{pointer} = {value}: {message}");
        assert!(message.contains("test"), "the file is named: {message}");
    }
}

#[test]
fn nan_positions_and_bad_animations_are_named() {
    let mut bytes = bytes(&[f32::NAN; 9]);
    bytes.extend([0, 0, 1, 0, 2, 0]);
    let error = refused(&changed("/buffers/0/uri", json!(embedded(&bytes))));
    assert!(error.contains("is NaN"), "{error}");

    let broken = |change: fn(&mut SceneData)| broken(busy(), change);
    assert!(broken(|data| data.nodes[1].parent = Some(1)).contains("parent of node 1"));
    assert!(broken(|data| data.animations[0].channels[0].times[1] = f32::INFINITY).contains("time"));
    assert!(broken(|data| data.animations[0].channels[0].times[1] = 5.0).contains("ascending"));
    assert!(broken(|data| data.animations[0].channels[0].times.clear()).contains("keys"));
    assert!(
        broken(|data| {
            data.animations[0].channels[0].values.pop();
        })
        .contains("expected 9")
    );
    assert!(
        broken(|data| data.animations[0].channels[0].node = 2).contains("translation, rotation and scale")
    );
    assert!(broken(|data| data.meshes[1].primitives[1].radiance = Some(vec![[1.0; 3]])).contains("radiance"));
    assert!(broken(|data| data.materials[0].radiance = [3e38; 3]).contains("2^100"));
    assert!(broken(|data| data.cameras[0].yfov = 4.0).contains("field of view"));
    assert!(broken(|data| data.background[1] = -1.0).contains("background"));
}

#[test]
fn scenes_without_lights_pass_until_lights_are_needed() {
    let scene = read_json(&changed("/materials/0", json!({})));
    assert!(matches!(
        scene.require_lights(),
        Err(SceneError::NoEmissive { .. })
    ));
}

#[test]
fn instances_are_counted_before_memory_is_taken() {
    let mut data = busy();
    let many = (0..1 << 20).map(|i| [i % 4, (i + 1) % 4, (i + 2) % 4]).collect();
    data.meshes[0].primitives[0].triangles = many;
    let extra = Node {
        mesh: Some(0),
        ..Node::default()
    };
    data.nodes.extend(std::iter::repeat_n(extra, 5_000));
    let error = Scene::new(data).expect_err("five billion triangles must be refused");
    assert!(
        error.to_string().contains("triangles over all instances"),
        "{error}"
    );
}

#[test]
fn deep_chains_of_nodes_need_no_deep_stack() {
    let mut root = triangle();
    let depth = 20_000;
    let chain = (0..depth).map(|i| {
        if i + 1 < depth {
            json!({ "children": [i + 1] })
        } else {
            json!({ "mesh": 0 })
        }
    });
    root["nodes"] = chain.collect();
    assert_eq!(read_json(&root).frame(9).triangles.len(), 1);
    let nested = format!("{{\"asset\":{}{}}}", "[".repeat(100_000), "]".repeat(100_000));
    let error = read(nested.as_bytes()).expect_err("too deep");
    assert!(
        error.to_string().contains("not a readable glTF 2.0 file"),
        "{error}"
    );
}

#[test]
fn truncated_files_are_errors() {
    let glb = Scene::open("street")
        .expect("it opens")
        .to_glb()
        .expect("it can be written");
    // All of the small file, and cuts through the large one, densest where the structure is.
    let small = Scene::new(busy())
        .expect("a sound scene")
        .to_glb()
        .expect("it can be written");
    for length in 0..small.len() {
        assert!(
            read(&small[..length]).is_err(),
            "{length} of {} bytes must not be a scene",
            small.len()
        );
    }
    for length in (0..glb.len()).step_by(97) {
        assert!(
            read(&glb[..length]).is_err(),
            "{length} of {} bytes must not be a scene",
            glb.len()
        );
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
    let bright = refused(&root);
    assert!(
        bright.contains("`lamp`") && bright.contains("lower it"),
        "{bright}"
    );
    for (text, expected) in [
        (
            "version https://git-lfs.github.com/spec/v1\noid sha256:0\n",
            "git lfs pull",
        ),
        (r#"{ "asset": { "version": "1.0" }, "meshes": {} }"#, "glTF 1.0"),
    ] {
        let error = read(text.as_bytes()).expect_err("no model").to_string();
        assert!(error.contains(expected), "{error}");
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

//! Hostile glTF files are errors that name the element. Damaged ones are the fuzz target `gltf`.

use lightbvh_host::scene::{Node, Scene, SceneData, SceneError};
use lightbvh_tests::gltf_files::{busy, changed, embedded, read, read_json, triangle};
use serde_json::{Value, json};

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
        ("/nodes/0/children", json!([0]), "root"),
        ("/nodes/0/children", json!([9]), "node 9"),
        ("/scenes/0/nodes", json!([4]), "node 4"),
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
        let error = read_json(&root).expect_err(&format!("{pointer} = {value} must be refused"));
        let message = error.to_string();
        assert!(message.contains(expected), "{pointer} = {value}: {message}");
        assert!(message.contains("test"), "the file is named: {message}");
    }
}

#[test]
fn nan_positions_and_bad_animations_are_named() {
    let mut bytes: Vec<u8> = [f32::NAN; 9].iter().flat_map(|x| x.to_le_bytes()).collect();
    bytes.extend([0, 0, 1, 0, 2, 0]);
    let error =
        read_json(&changed("/buffers/0/uri", json!(embedded(&bytes)))).expect_err("NaN must be refused");
    assert!(error.to_string().contains("is NaN"), "{error}");

    let broken = |change: fn(&mut SceneData)| {
        let mut data = busy();
        change(&mut data);
        Scene::new(data).expect_err("must be refused").to_string()
    };
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
    assert!(broken(|data| data.animations[1].channels[1].values[6] = 3e38).contains("2^40"));
    assert!(broken(|data| data.meshes[1].primitives[1].radiance = Some(vec![[1.0; 3]])).contains("radiance"));
    assert!(broken(|data| data.materials[0].radiance = [3e38; 3]).contains("2^100"));
    assert!(broken(|data| data.materials[0].radiance = [1e30; 3]).contains("flux"));
    assert!(broken(|data| data.cameras[0].yfov = 4.0).contains("field of view"));
    assert!(broken(|data| data.background[1] = -1.0).contains("background"));
}

#[test]
fn scenes_without_lights_pass_until_lights_are_needed() {
    let scene = read_json(&changed("/materials/0", json!({}))).expect("a scene may be dark");
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
    assert_eq!(
        read_json(&root)
            .expect("deep, but sound")
            .frame(9)
            .triangles
            .len(),
        1
    );
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

#[test]
fn documents_of_the_fuzzer_are_sound_but_for_its_changes() {
    let mut state = 5_u32;
    let (mut read_whole, mut kinds) = (0, 0_u32);
    for _ in 0..3_000 {
        state = state.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        // No change of a value, nor of a byte.
        let shape = state ^ state >> 15;
        let document = lightbvh_fuzz::gltf_document(&[&shape.to_le_bytes()[..], &[0; 64]].concat());
        match read(&document) {
            Ok(scene) => {
                for warning in scene.warnings() {
                    assert!(
                        !warning.contains("counts as white") && !warning.contains("plain data"),
                        "{warning}"
                    );
                }
                read_whole += 1;
                // Views by meshopt, a Draco stream, pictures in KTX 2, skins, targets, lights without area, glass.
                kinds |= shape;
            }
            // Shapes that contradict themselves.
            Err(error) => assert!(!error.to_string().contains("unpacked"), "{shape:x}: {error}"),
        }
    }
    assert!(read_whole > 1_000, "{read_whole}");
    assert_eq!(kinds >> 21, 0x7ff, "every kind is read in some document");
}

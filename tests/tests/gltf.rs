//! The glTF loader: what it reads, what it leaves out, and that hostile files are errors, never panics.

use std::panic::{AssertUnwindSafe, catch_unwind};

use lightbvh::light::TWO_SIDED;
use lightbvh_host::scene::{
    Animation, Camera, Channel, Frame, Interpolation, Material, Mesh, Node, Primitive, Property, Scene,
    SceneData, SceneError, Transform,
};
use serde_json::{Value, json};

fn read(bytes: &[u8]) -> Result<Scene, SceneError> {
    Scene::read_gltf_slice("test", bytes, None)
}

fn read_json(root: &Value) -> Result<Scene, SceneError> {
    read(root.to_string().as_bytes())
}

/// Base64 as in RFC 4648, for buffers inside JSON.
fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::new();
    for chunk in bytes.chunks(3) {
        let word = [0, 1, 2].map(|i| u32::from(chunk.get(i).copied().unwrap_or(0)));
        let word = word[0] << 16 | word[1] << 8 | word[2];
        for digit in 0..4 {
            let filled = digit <= chunk.len();
            text.push(if filled {
                char::from(DIGITS[(word >> (18 - 6 * digit) & 63) as usize])
            } else {
                '='
            });
        }
    }
    text
}

/// One emissive triangle with vertices (0,0,0), (1,0,0), (0,1,0) and indices 0 1 2 behind them.
fn triangle() -> Value {
    let mut bytes: Vec<u8> = [0.0_f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]
        .iter()
        .flat_map(|x| x.to_le_bytes())
        .collect();
    bytes.extend([0_u16, 1, 2].iter().flat_map(|i| i.to_le_bytes()));
    json!({
        "asset": { "version": "2.0" },
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1, "material": 0 }] }],
        "materials": [{ "emissiveFactor": [1.0, 0.5, 0.25] }],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3" },
            { "bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR" },
        ],
        "bufferViews": [
            { "buffer": 0, "byteOffset": 0, "byteLength": 36 },
            { "buffer": 0, "byteOffset": 36, "byteLength": 6 },
        ],
        "buffers": [
            { "byteLength": 42, "uri": format!("data:application/octet-stream;base64,{}", base64(&bytes)) },
        ],
    })
}

/// [`triangle`] with one place changed.
fn changed(pointer: &str, value: Value) -> Value {
    let mut root = triangle();
    let (parent, key) = pointer.rsplit_once('/').expect("a pointer starts with a slash");
    let parent = root.pointer_mut(parent).expect("the parent is there");
    match parent {
        Value::Array(list) => list[key.parse::<usize>().expect("a list index")] = value,
        _ => parent[key] = value,
    }
    root
}

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

/// A 2 by 1 PNG: left texel white, right texel black (stored blocks, by hand, so that no encoder is needed).
fn png_white_black() -> Vec<u8> {
    fn crc(bytes: &[u8]) -> u32 {
        let mut crc = !0_u32;
        for &byte in bytes {
            crc ^= u32::from(byte);
            for _ in 0..8 {
                crc = if crc & 1 == 1 {
                    crc >> 1 ^ 0xedb8_8320
                } else {
                    crc >> 1
                };
            }
        }
        !crc
    }
    fn adler(bytes: &[u8]) -> u32 {
        let (mut a, mut b) = (1_u32, 0_u32);
        for &byte in bytes {
            a = (a + u32::from(byte)) % 65_521;
            b = (b + a) % 65_521;
        }
        b << 16 | a
    }
    let mut png = b"\x89PNG\r\n\x1a\n".to_vec();
    let mut chunk = |kind: &[u8; 4], content: &[u8]| {
        png.extend((content.len() as u32).to_be_bytes());
        let body = [kind.as_slice(), content].concat();
        png.extend(&body);
        png.extend(crc(&body).to_be_bytes());
    };
    chunk(b"IHDR", &[0, 0, 0, 2, 0, 0, 0, 1, 8, 2, 0, 0, 0]);
    let row = [0, 255, 255, 255, 0, 0, 0];
    let mut stream = vec![0x78, 0x01, 1, 7, 0, 248, 255];
    stream.extend(row);
    stream.extend(adler(&row).to_be_bytes());
    chunk(b"IDAT", &stream);
    chunk(b"IEND", &[]);
    png
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
        "textures": [{ "source": 0 }],
        "images": [{ "uri": format!("data:image/png;base64,{}", base64(&png_white_black())) }],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": 9, "type": "VEC3" },
            { "bufferView": 0, "byteOffset": 108, "componentType": 5126, "count": 9, "type": "VEC2" },
        ],
        "bufferViews": [{ "buffer": 0, "byteLength": bytes.len() }],
        "buffers": [{ "byteLength": bytes.len(), "uri": format!("data:;base64,{}", base64(&bytes)) }],
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

/// Two nodes, one swinging on the other, every interpolation, a camera, radiance per triangle, a matrix node.
fn busy() -> SceneData {
    let key = |x: f32| [x, 0.5 * x, 0.0, 0.0];
    let channel = |node, property, interpolation, values: Vec<[f32; 4]>, times: &[f32]| Channel {
        node,
        property,
        interpolation,
        times: times.to_vec(),
        values,
    };
    let node = |parent, transform, mesh| Node {
        name: String::from("n"),
        parent,
        transform,
        mesh,
    };
    SceneData {
        name: String::from("test"),
        nodes: vec![
            node(None, Transform::at([1.0, 2.0, 3.0]), Some(0)),
            node(Some(0), Transform::IDENTITY, Some(0)),
            node(
                Some(1),
                Transform::Matrix([[1.0, 0.5, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0], [0.1; 3]]),
                Some(1),
            ),
            node(Some(0), Transform::IDENTITY, None),
        ],
        meshes: vec![
            Mesh {
                name: String::from("a"),
                primitives: vec![tetrahedron(0, None)],
            },
            Mesh {
                name: String::from("b"),
                primitives: vec![
                    tetrahedron(1, None),
                    tetrahedron(1, Some(vec![[0.1; 3], [0.0; 3], [0.3; 3], [1e-3; 3]])),
                ],
            },
        ],
        materials: vec![
            Material {
                radiance: [12.5, 1e-3, 700.0],
                double_sided: true,
                ..Material::default()
            },
            Material {
                base_color: [0.1, 0.2, 0.3],
                metallic: 0.7,
                roughness: 0.2,
                ..Material::default()
            },
        ],
        animations: vec![
            Animation {
                name: String::from("one"),
                channels: vec![
                    channel(
                        0,
                        Property::Translation,
                        Interpolation::Linear,
                        vec![key(0.0), key(3.0), key(0.0)],
                        &[0.0, 1.0, 2.0],
                    ),
                    channel(
                        0,
                        Property::Scale,
                        Interpolation::Step,
                        vec![[1.0; 4], [-2.0, 1.0, 1.0, 0.0]],
                        &[0.0, 0.7],
                    ),
                ],
            },
            Animation {
                name: String::from("two"),
                channels: vec![
                    channel(
                        1,
                        Property::Rotation,
                        Interpolation::Linear,
                        vec![[0.0, 0.0, 0.0, 1.0], [0.0, 0.7, 0.0, 0.7]],
                        &[0.0, 1.3],
                    ),
                    channel(
                        1,
                        Property::Translation,
                        Interpolation::CubicSpline,
                        (0..6).map(|i| key(i as f32)).collect(),
                        &[0.1, 0.9],
                    ),
                ],
            },
        ],
        cameras: vec![Camera { node: 3, yfov: 0.7 }],
        background: [0.1, 0.2, 0.3],
        warnings: Vec::new(),
    }
}

fn tetrahedron(material: u32, radiance: Option<Vec<[f32; 3]>>) -> Primitive {
    let positions = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    Primitive {
        positions,
        triangles: vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
        material,
        radiance,
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

#[test]
fn hostile_values_are_named() {
    let cases: Vec<(&str, Value, &str)> = vec![
        (
            "/nodes/0/translation",
            json!([1e39, 0.0, 0.0]),
            "translation of node 0",
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
            "not finite",
        ),
        ("/meshes/0/primitives/0/material", json!(5), "material 5"),
        ("/meshes/0/primitives/0/indices", json!(2), "accessor 2"),
        ("/meshes/0/primitives/0/indices", json!(0), "unsigned"),
        ("/meshes/0/primitives/0/attributes", json!({}), "POSITION"),
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
            json!(["KHR_draco_mesh_compression"]),
            "KHR_draco_mesh_compression",
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
    let uri = format!("data:;base64,{}", base64(&bytes));
    let error = read_json(&changed("/buffers/0/uri", json!(uri))).expect_err("NaN must be refused");
    assert!(matches!(error, SceneError::NotFinite { .. }), "{error}");

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
        .contains("expected 3")
    );
    assert!(
        broken(|data| data.animations[0].channels[0].node = 2).contains("translation, rotation and scale")
    );
    assert!(broken(|data| data.animations[1].channels[1].values[2][0] = 3e38).contains("2^40"));
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
        name: String::new(),
        parent: None,
        transform: Transform::IDENTITY,
        mesh: Some(0),
    };
    data.nodes.extend(std::iter::repeat_n(extra, 5_000));
    let error = Scene::new(data).expect_err("five billion triangles must be refused");
    assert!(matches!(error, SceneError::TooMany { .. }), "{error}");
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
    assert!(matches!(
        read(nested.as_bytes()),
        Err(SceneError::Container { .. })
    ));
}

/// Opens the bytes and, where they are a scene after all, makes a frame.
fn survives(bytes: &[u8]) -> bool {
    catch_unwind(AssertUnwindSafe(|| {
        if let Ok(scene) = read(bytes) {
            let frame = scene.frame(11);
            assert!(
                frame.triangles.iter().all(|triangle| triangle
                    .p
                    .as_flattened()
                    .iter()
                    .all(|x| x.is_finite()))
            );
        }
    }))
    .is_ok()
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
    // Cut, with a header that says that this is all.
    for length in (20..small.len()).step_by(7) {
        let mut cut = small[..length].to_vec();
        cut[8..12].copy_from_slice(&(length as u32).to_le_bytes());
        assert!(survives(&cut), "cut at {length}");
    }
}

#[test]
fn flipped_bytes_never_panic() {
    let glb = Scene::new(busy())
        .expect("a sound scene")
        .to_glb()
        .expect("it can be written");
    let text = triangle().to_string().into_bytes();
    let mut state = 12_345_u32;
    let mut next = |below: usize| {
        state = state.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        ((state >> 8) as usize) % below
    };
    for round in 0..6_000 {
        let mut bytes = if round % 3 == 0 { text.clone() } else { glb.clone() };
        let mut changes = Vec::new();
        for _ in 0..=next(4) {
            let place = next(bytes.len());
            // Digits for digits find the values; any byte for any byte finds the structure.
            let byte = if bytes[place].is_ascii_digit() {
                b'0' + next(10) as u8
            } else {
                next(256) as u8
            };
            bytes[place] = byte;
            changes.push((place, byte));
        }
        assert!(survives(&bytes), "round {round}: {changes:?}");
    }
}

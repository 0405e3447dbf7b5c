//! Small glTF files and scenes.

use std::io::Cursor;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use image::{ImageFormat, Rgba, RgbaImage};
use lightbvh_scenes::{
    Animation, Camera, Channel, Influence, Interpolation, Material, Mesh, Node, Primitive, Property, Scene,
    SceneData, SceneError, Skin, Transform,
};
use serde_json::{Value, json};

/// Reads bytes as a file called `test`.
pub fn read(bytes: &[u8]) -> Result<Scene, SceneError> {
    Scene::read_gltf_slice("test", bytes, None)
}

/// The scene of a sound `.gltf` file.
pub fn read_json(root: &Value) -> Scene {
    read(root.to_string().as_bytes()).unwrap_or_else(|error| panic!("{error}"))
}

/// The reason why a `.gltf` file is refused.
pub fn refused(root: &Value) -> String {
    let found = read(root.to_string().as_bytes());
    found
        .err()
        .unwrap_or_else(|| panic!("must be refused: {root}"))
        .to_string()
}

/// The reason why a scene is refused.
pub fn broken(mut data: SceneData, change: impl FnOnce(&mut SceneData)) -> String {
    change(&mut data);
    Scene::new(data).expect_err("must be refused").to_string()
}

/// Numbers as a buffer holds them.
pub fn bytes(numbers: &[f32]) -> Vec<u8> {
    numbers.iter().flat_map(|x| x.to_le_bytes()).collect()
}

/// One emissive triangle with vertices (0,0,0), (1,0,0), (0,1,0) and indices 0 1 2 behind them.
pub fn triangle() -> Value {
    let mut bytes = bytes(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
    bytes.extend([0, 0, 1, 0, 2, 0]);
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
        "buffers": [{ "byteLength": 42, "uri": embedded(&bytes) }],
    })
}

/// [`triangle`] with one place changed.
pub fn changed(pointer: &str, value: Value) -> Value {
    let mut root = triangle();
    let (parent, key) = pointer.rsplit_once('/').expect("a pointer starts with a slash");
    let parent = root.pointer_mut(parent).expect("the parent is there");
    match parent {
        Value::Array(list) => list[key.parse::<usize>().expect("a list index")] = value,
        _ => parent[key] = value,
    }
    root
}

/// [`triangle`] with texture coordinates, which glows by a picture.
pub fn textured(coordinates: [[f32; 2]; 3], picture: &[u8]) -> Value {
    let mut root = triangle();
    let bytes = bytes(coordinates.as_flattened());
    push(
        &mut root["buffers"],
        json!({ "byteLength": 24, "uri": embedded(&bytes) }),
    );
    push(&mut root["bufferViews"], json!({ "buffer": 1, "byteLength": 24 }));
    push(
        &mut root["accessors"],
        json!({ "bufferView": 2, "componentType": 5126, "count": 3, "type": "VEC2" }),
    );
    root["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = json!(2);
    root["materials"][0]["emissiveTexture"] = json!({ "index": 0 });
    // Texels as they are: by means of four all of a small picture would glow.
    root["samplers"] = json!([{ "magFilter": 9728 }]);
    root["textures"] = json!([{ "source": 0, "sampler": 0 }]);
    root["images"] = json!([{ "uri": embedded(picture) }]);
    root
}

/// A picture as PNG.
pub fn png(width: u32, height: u32, texel: impl Fn(u32, u32) -> [u8; 4]) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    let pixels = RgbaImage::from_fn(width, height, |x, y| Rgba(texel(x, y)));
    pixels.write_to(&mut bytes, ImageFormat::Png).expect("encoded");
    bytes.into_inner()
}

/// A PNG of 2 by 1 texels: left white, right black.
pub fn png_white_black() -> Vec<u8> {
    png(2, 1, |x, _| {
        [255 * (1 - x as u8), 255 * (1 - x as u8), 255 * (1 - x as u8), 255]
    })
}

/// Appends to a list of a file.
pub fn push(list: &mut Value, value: Value) {
    list.as_array_mut().expect("a list").push(value);
}

/// `bytes` as the uri of an embedded buffer or picture.
pub fn embedded(bytes: &[u8]) -> String {
    format!("data:;base64,{}", STANDARD.encode(bytes))
}

/// Two nodes, one swinging on the other, every interpolation, a camera, radiance per triangle, a matrix node.
pub fn busy() -> SceneData {
    let key = |x: f32| [x, 0.5 * x, 0.0, 0.0];
    let channel = |node, property: Property, interpolation, values: Vec<[f32; 4]>, times: &[f32]| Channel {
        node,
        property,
        interpolation,
        times: times.to_vec(),
        values: values
            .iter()
            .flat_map(|row| &row[..property.numbers()])
            .copied()
            .collect(),
    };
    let node = |parent, transform, mesh| Node {
        name: String::from("n"),
        parent,
        transform,
        mesh,
        ..Node::default()
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
                ..Animation::default()
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
                ..Animation::default()
            },
        ],
        cameras: vec![Camera { node: 3, yfov: 0.7 }],
        background: [0.1, 0.2, 0.3],
        ..SceneData::default()
    }
}

/// Two tetrahedra that glow: one on node 0, bent by two targets whose weights are animated, one on node 1, which two joints bend,
/// node 2 and, a metre above, node 3, which turns about z.
pub fn bending() -> SceneData {
    let quarter = [
        0.0,
        0.0,
        std::f32::consts::FRAC_1_SQRT_2,
        std::f32::consts::FRAC_1_SQRT_2,
    ];
    let mut data = busy();
    let node = |parent, at, mesh| Node {
        parent,
        transform: Transform::at(at),
        mesh,
        ..Node::default()
    };
    data.nodes = vec![
        Node {
            weights: vec![0.5, 0.25],
            ..node(None, [5.0, 0.0, 0.0], Some(0))
        },
        Node {
            skin: Some(0),
            ..node(None, [100.0, 0.0, 0.0], Some(1))
        },
        node(None, [0.0, 0.0, 2.0], None),
        node(Some(2), [0.0, 1.0, 0.0], None),
        node(None, [0.0, 0.0, 20.0], None),
    ];
    data.cameras[0].node = 4;
    let influence = |weights| Influence {
        joints: [0, 1, 0, 0],
        weights,
    };
    data.meshes = vec![
        Mesh {
            name: String::from("targets"),
            primitives: vec![Primitive {
                targets: vec![vec![[0.0, 0.0, 1.0]; 4], Vec::new()],
                ..tetrahedron(0, None)
            }],
        },
        Mesh {
            name: String::from("skin"),
            primitives: vec![Primitive {
                influences: vec![vec![
                    influence([1.0, 0.0, 0.0, 0.0]),
                    influence([0.0, 0.5, 0.0, 0.0]),
                    influence([1.0, 1.0, 0.0, 0.0]),
                    influence([0.0; 4]),
                ]],
                ..tetrahedron(0, Some(vec![[1.0; 3], [0.0; 3], [2.0; 3], [3.0; 3]]))
            }],
        },
    ];
    data.skins = vec![Skin {
        joints: vec![2, 3],
        // The second joint's own space begins a metre up.
        inverse_bind: vec![
            [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0; 3]],
            [
                [1.0, 0.0, 0.0],
                [0.0, 1.0, 0.0],
                [0.0, 0.0, 1.0],
                [0.0, -1.0, 0.0],
            ],
        ],
    }];
    let turn = Channel {
        node: 3,
        property: Property::Rotation,
        interpolation: Interpolation::Step,
        times: vec![0.0, 1.0],
        values: [[0.0, 0.0, 0.0, 1.0], quarter].concat(),
    };
    let weights = Channel {
        node: 0,
        property: Property::Weights(2),
        interpolation: Interpolation::Linear,
        times: vec![0.0, 2.0],
        values: vec![0.0, 0.0, 3.0, 1.0],
    };
    data.animations = vec![Animation {
        channels: vec![turn, weights],
        ..Animation::default()
    }];
    data
}

fn tetrahedron(material: u32, radiance: Option<Vec<[f32; 3]>>) -> Primitive {
    let positions = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    Primitive {
        positions,
        triangles: vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
        material,
        radiance,
        ..Primitive::default()
    }
}

//! Small glTF files and scenes.

use std::io::Cursor;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use image::{ImageFormat, Rgba, RgbaImage};
use lightbvh_scenes::{
    Animation, Camera, Channel, Interpolation, Material, Mesh, Node, Primitive, Property, Scene, SceneData,
    SceneError, Transform,
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
    let view = add_view(&mut root, &bytes(coordinates.as_flattened()));
    let accessor = json!({ "bufferView": view, "componentType": 5126, "count": 3, "type": "VEC2" });
    push(&mut root["accessors"], accessor);
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

/// Appends a buffer of these bytes, and a view of it, whose number it returns.
pub fn add_view(root: &mut Value, bytes: &[u8]) -> usize {
    let [buffer, view] = ["buffers", "bufferViews"].map(|list| root[list].as_array().map_or(0, Vec::len));
    let length = bytes.len();
    push(
        &mut root["buffers"],
        json!({ "byteLength": length, "uri": embedded(bytes) }),
    );
    push(
        &mut root["bufferViews"],
        json!({ "buffer": buffer, "byteLength": length }),
    );
    view
}

/// `bytes` as the uri of an embedded buffer or picture.
pub fn embedded(bytes: &[u8]) -> String {
    format!("data:;base64,{}", STANDARD.encode(bytes))
}

/// The numbers of a text.
fn numbers(text: &str) -> Vec<f32> {
    let words = text.split_whitespace();
    words.map(|word| word.parse().expect("a number")).collect()
}

fn channel(node: u32, property: Property, way: Interpolation, times: &str, values: &str) -> Channel {
    Channel {
        node,
        property,
        interpolation: way,
        times: numbers(times),
        values: numbers(values),
    }
}

fn node(parent: Option<u32>, transform: Transform, mesh: Option<u32>) -> Node {
    Node {
        name: String::from("n"),
        parent,
        transform,
        mesh,
    }
}

fn mesh(primitives: Vec<Primitive>) -> Mesh {
    Mesh {
        name: String::from("m"),
        primitives,
    }
}

/// Two nodes, one swinging on the other, every interpolation, a camera, radiance per triangle, a matrix node.
pub fn busy() -> SceneData {
    use Interpolation::{CubicSpline, Linear, Step};
    let sheared = [[1.0, 0.5, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0], [0.1; 3]];
    let splines = "0 0 0 1 .5 0 2 1 0 3 1.5 0 4 2 0 5 2.5 0";
    let animation = |channels| Animation {
        channels,
        ..Animation::default()
    };
    SceneData {
        name: String::from("test"),
        nodes: vec![
            node(None, Transform::at([1.0, 2.0, 3.0]), Some(0)),
            node(Some(0), Transform::IDENTITY, Some(0)),
            node(Some(1), Transform::Matrix(sheared), Some(1)),
            node(Some(0), Transform::IDENTITY, None),
        ],
        meshes: vec![
            mesh(vec![tetrahedron(0, None)]),
            mesh(vec![
                tetrahedron(1, None),
                tetrahedron(1, Some(vec![[0.1; 3], [0.0; 3], [0.3; 3], [1e-3; 3]])),
            ]),
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
            animation(vec![
                channel(0, Property::Translation, Linear, "0 1 2", "0 0 0 3 1.5 0 0 0 0"),
                channel(0, Property::Scale, Step, "0 0.7", "1 1 1 -2 1 1"),
            ]),
            animation(vec![
                channel(1, Property::Rotation, Linear, "0 1.3", "0 0 0 1 0 .7 0 .7"),
                channel(1, Property::Translation, CubicSpline, "0.1 0.9", splines),
            ]),
        ],
        cameras: vec![Camera { node: 3, yfov: 0.7 }],
        background: [0.1, 0.2, 0.3],
        ..SceneData::default()
    }
}

fn tetrahedron(material: u32, radiance: Option<Vec<[f32; 3]>>) -> Primitive {
    Primitive {
        positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        triangles: vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
        material,
        radiance,
        ..Primitive::default()
    }
}

//! Small models with clips: a floor, two lamps above it, a lamp outside of the scene, and a camera.

use serde_json::{Value, json};

use crate::program::Folder;

/// Nodes that clips move.
pub const FLOOR: usize = 0;
pub const LAMP: usize = 1;

/// A clip of this name, and where it moves the lamp: keys a second apart.
pub type Clip<'a> = (&'a str, &'a [[f32; 3]]);

/// A quadrilateral of two triangles, seen from above where `up` is above zero.
fn quad(half: f32, up: f32) -> [f32; 18] {
    let [a, b, c, d] =
        [(-1.0, up), (1.0, up), (1.0, -up), (-1.0, -up)].map(|(x, z)| [half * x, 0.0, half * z]);
    let mut all = [0.0; 18];
    for (own, value) in all.iter_mut().zip([a, b, c, a, c, d].concat()) {
        *own = value;
    }
    all
}

/// Writes a model with these clips, and so many quadrilaterals in the lamps' mesh, in rows of four, as glTF beside its buffer.
/// Returns its path; `change` may change its JSON.
pub fn write(
    folder: &Folder,
    name: &str,
    count: usize,
    clips: &[Clip],
    change: impl FnOnce(&mut Value),
) -> String {
    let mut floats = Vec::new();
    let mut accessors = Vec::new();
    let mut add = |values: &[f32], kind: &str| {
        let wide = if kind == "VEC3" { 3 } else { 1 };
        accessors.push(json!({
            "bufferView": 0, "byteOffset": 4 * floats.len(), "componentType": 5126, "count": values.len() / wide, "type": kind,
            "min": vec![-10.0; wide], "max": vec![10.0; wide]
        }));
        floats.extend_from_slice(values);
        accessors.len() - 1
    };
    let lamps: Vec<f32> = (0..count)
        .flat_map(|k| {
            let at = [(k % 4) as f32, 0.0, (k / 4) as f32];
            let own = quad(0.3, -1.0).into_iter().zip(at.into_iter().cycle());
            own.map(|(x, at)| x + 2.0 * at).collect::<Vec<_>>()
        })
        .collect();
    let (floor, lamp) = (add(&quad(4.0, 1.0), "VEC3"), add(&lamps, "VEC3"));
    let animations: Vec<Value> = clips
        .iter()
        .map(|(name, keys)| {
            let times: Vec<f32> = (0..keys.len()).map(|key| key as f32).collect();
            let sampler = json!({ "input": add(&times, "SCALAR"), "output": add(&keys.concat(), "VEC3") });
            let channel = json!({ "sampler": 0, "target": { "node": LAMP, "path": "translation" } });
            json!({ "name": name, "samplers": [sampler], "channels": [channel] })
        })
        .collect();
    let bytes: Vec<u8> = floats.iter().flat_map(|x| x.to_le_bytes()).collect();
    let buffer = format!("{name}.bin");
    std::fs::write(folder.file(&buffer), &bytes).expect("a buffer");
    let mesh = |at: usize| json!({ "primitives": [{ "attributes": { "POSITION": at }, "material": at }] });
    let mut root = json!({
        "asset": { "version": "2.0" },
        "scene": 0,
        "scenes": [{ "nodes": [0, 1, 2, 4] }],
        "nodes": [
            { "mesh": 0 }, { "mesh": 1, "translation": [0, 2, 0] }, { "mesh": 1, "translation": [1, 2, 0] }, { "mesh": 1 },
            // Looks down, from behind the lamps.
            { "camera": 0, "translation": [0, 4, 6], "rotation": [-0.258_819, 0.0, 0.0, 0.965_926] }
        ],
        "meshes": [mesh(floor), mesh(lamp)],
        "materials": [{}, { "emissiveFactor": [1, 1, 1], "pbrMetallicRoughness": { "baseColorFactor": [0, 0, 0, 1] } }],
        "cameras": [{ "type": "perspective", "perspective": { "yfov": 0.8, "znear": 0.1 } }],
        "bufferViews": [{ "buffer": 0, "byteLength": bytes.len() }],
        "buffers": [{ "uri": buffer, "byteLength": bytes.len() }],
        "accessors": accessors
    });
    if !animations.is_empty() {
        root["animations"] = json!(animations);
    }
    change(&mut root);
    let path = folder.file(&format!("{name}.gltf"));
    std::fs::write(&path, root.to_string()).expect("a scene");
    path
}

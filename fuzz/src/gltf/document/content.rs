//! What a document says: scenes, nodes, meshes, animations, accessors.

use serde_json::{Value, json};

use super::{PNG, Packed};

const FLOAT: u32 = 5126;

pub(super) fn root(shape: u32, packed: &Packed, length: usize) -> Value {
    let has = |bit: u32| shape >> bit & 1 != 0;
    let count = 1 + (shape & 3) as usize;
    // A chain, or all of them roots.
    let roots = if has(2) { 1 } else { count };
    let mut root = json!({
        "asset": { "version": "2.0" },
        "scene": 0,
        "scenes": [{ "nodes": (0..roots).collect::<Vec<_>>() }],
        "nodes": (0..count).map(|k| node(shape, k, count)).collect::<Vec<_>>(),
        "meshes": [{ "primitives": [primitive(shape)] }],
        "materials": [material(shape)],
        "accessors": accessors(shape),
        "bufferViews": views(shape, packed),
        "buffers": [{ "byteLength": length }],
    });
    if has(3) {
        root["scenes"][0]["extras"] = json!({ "lightbvh_background": [0.1, 0.2, 0.3] });
    }
    if has(4) {
        root["cameras"] = json!([{ "type": "perspective", "perspective": { "yfov": 0.7, "znear": 0.1 } }]);
    }
    if has(28) {
        root["skins"] = json!([{ "joints": [count - 1, 0, 0, 0] }]);
    }
    if has(7) {
        root["animations"] = json!([animation(shape, count)]);
    }
    if has(8) {
        let picture = if has(25) { 6 } else { 4 };
        root["textures"] = json!([{ "source": 0 }]);
        root["images"] = json!([{ "bufferView": picture, "mimeType": "image/png" }]);
    }
    if has(30) {
        let spot = json!({ "innerConeAngle": 0.25, "outerConeAngle": 0.5 });
        let light = json!({ "type": "spot", "intensity": 5, "range": 5, "spot": spot });
        root["extensions"] = json!({ "KHR_lights_punctual": { "lights": [light] } });
    }
    root
}

fn node(shape: u32, k: usize, count: usize) -> Value {
    let has = |bit: u32| shape >> bit & 1 != 0;
    let mut node = json!({ "mesh": 0 });
    if has(28) {
        node["skin"] = json!(0);
    }
    if has(29) {
        node["weights"] = json!([0.5]);
    }
    if has(30) && k == 0 {
        node["extensions"] = json!({ "KHR_lights_punctual": { "light": 0 } });
    }
    if has(2) && k + 1 < count {
        node["children"] = json!([k + 1]);
    }
    if has(4) && k == 0 {
        node["camera"] = json!(0);
    }
    if has(5) && k == 1 {
        node["matrix"] = json!([1, 0.5, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 2, 3, 4, 1]);
    } else if has(6) {
        node["translation"] = json!([1, 2, 3]);
        node["rotation"] = json!([0, 0.6, 0, 0.8]);
        node["scale"] = json!([1, -2, 1]);
    }
    node
}

fn primitive(shape: u32) -> Value {
    let has = |bit: u32| shape >> bit & 1 != 0;
    let mut primitive = json!({ "attributes": { "POSITION": 0 }, "material": 0, "mode": 4 });
    for (bit, name, accessor) in [
        (8, "TEXCOORD_0", 6),
        (9, "_RADIANCE", 7),
        (28, "JOINTS_0", 10),
        (28, "WEIGHTS_0", 11),
    ] {
        if has(bit) {
            primitive["attributes"][name] = json!(accessor);
        }
    }
    if has(29) {
        primitive["targets"] = json!([{ "POSITION": 5 }]);
    }
    if has(22) && !has(21) {
        let draco = json!({ "bufferView": 5, "attributes": { "POSITION": 0 } });
        primitive["extensions"] = json!({ "KHR_draco_mesh_compression": draco });
    }
    if !has(10) {
        primitive["indices"] = json!(1);
    }
    primitive
}

fn material(shape: u32) -> Value {
    let has = |bit: u32| shape >> bit & 1 != 0;
    let mut material = json!({
        "emissiveFactor": [1, 0.5, 0.25],
        "pbrMetallicRoughness": { "baseColorFactor": [0.1, 0.2, 0.3, 1], "metallicFactor": 0.5 },
    });
    if has(8) {
        material["emissiveTexture"] = json!({ "index": 0, "texCoord": 0 });
        if has(31) {
            let transform = json!({ "offset": [0.25, 0.5], "rotation": 0.5, "scale": [0.5, 2] });
            material["emissiveTexture"]["extensions"] = json!({ "KHR_texture_transform": transform });
        }
    }
    if has(11) {
        material["extensions"] = json!({ "KHR_materials_emissive_strength": { "emissiveStrength": 5 } });
        if has(31) {
            let glass = json!({ "transmissionFactor": 0.75 });
            material["extensions"]["KHR_materials_transmission"] = glass;
        }
        if has(27) && has(31) {
            material["extensions"]["KHR_materials_unlit"] = json!({});
        }
    }
    if has(31) {
        material["alphaMode"] = json!("BLEND");
    }
    material
}

fn animation(shape: u32, count: usize) -> Value {
    let property = match shape >> 29 & 1 {
        0 => (shape >> 12 & 3) as usize % 3,
        _ => 3,
    };
    let kind = (shape >> 14 & 3) as usize % 3;
    // One weight for each key, in the times themselves or in the numbers that follow.
    let output = match (property, kind) {
        (3, 2) => 12,
        (3, _) => 2,
        (1, 2) => 9,
        (1, _) => 4,
        (_, 2) => 8,
        _ => 3,
    };
    let path = ["translation", "rotation", "scale", "weights"][property];
    let interpolation = ["LINEAR", "STEP", "CUBICSPLINE"][kind];
    json!({
        "channels": [{ "sampler": 0, "target": { "node": count - 1, "path": path } }],
        "samplers": [{ "input": 2, "output": output, "interpolation": interpolation }],
    })
}

fn accessors(shape: u32) -> Vec<Value> {
    let list = [
        (0, FLOAT, 4, "VEC3"),
        (1, 5123, 6, "SCALAR"),
        (2, FLOAT, 3, "SCALAR"),
        (3, FLOAT, 3, "VEC3"),
        (3, FLOAT, 3, "VEC4"),
        (0, FLOAT, 4, "VEC3"),
        (0, FLOAT, 4, "VEC2"),
        (0, FLOAT, 4, "VEC3"),
        (3, FLOAT, 9, "VEC3"),
        (3, FLOAT, 9, "VEC4"),
        (1, 5121, 4, "VEC4"),
        (3, FLOAT, 4, "VEC4"),
        (3, FLOAT, 9, "SCALAR"),
    ];
    // The last ones are there for what asks for them.
    let list = &list[..if shape >> 28 & 3 == 0 { 10 } else { 13 }];
    let accessor = |(i, &(view, component, count, kind)): (usize, &(u32, u32, u32, &str))| {
        let mut own = json!({ "componentType": component, "count": count, "type": kind });
        // Without a view an accessor holds zeros.
        if i > 0 || shape >> 16 & 3 != 3 {
            own["bufferView"] = json!(view);
            own["byteOffset"] = json!(0);
        }
        if i == 0 && shape >> 16 & 2 != 0 {
            own["sparse"] = json!({
                "count": 2,
                "indices": { "bufferView": 1, "byteOffset": 0, "componentType": 5123 },
                "values": { "bufferView": 3, "byteOffset": 0 },
            });
        }
        if i < 2 && shape >> 18 & 3 == 3 {
            own["normalized"] = json!(true);
        }
        own
    };
    list.iter().enumerate().map(accessor).collect()
}

fn views(shape: u32, packed: &Packed) -> Vec<Value> {
    let has = |bit: u32| shape >> bit & 1 != 0;
    // Joints are small numbers: the indices, four bytes beyond their end.
    let indices = if has(28) { 16 } else { 12 };
    let mut views = vec![(0, 48), (48, indices), (60, 12), (72, 144), (216, PNG.len())];
    if has(22) && !has(21) || has(25) {
        views.extend([packed.first, packed.picture]);
    }
    let view = |(i, (start, length)): (usize, (usize, usize))| {
        let mut own = json!({ "buffer": 0, "byteOffset": start, "byteLength": length });
        if i == 0 && has(20) {
            own["byteStride"] = json!(12);
        }
        if has(21) && i < 2 {
            let list = if has(24) { "INDICES" } else { "TRIANGLES" };
            let filter = if has(23) { "EXPONENTIAL" } else { "NONE" };
            let ((start, length), stride, count, mode, filter) = match i {
                0 => (packed.first, 12, 4, "ATTRIBUTES", filter),
                _ => (packed.second, 2, 6, list, "NONE"),
            };
            own["extensions"] = json!({ "EXT_meshopt_compression": {
                "buffer": 0, "byteOffset": start, "byteLength": length, "byteStride": stride, "count": count,
                "mode": mode, "filter": filter,
            } });
        }
        own
    };
    views.into_iter().enumerate().map(view).collect()
}

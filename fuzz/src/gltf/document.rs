//! A small glTF document with all that the loader reads: sound but for what the input changes.

use arbitrary::{Result, Unstructured};
use base64::Engine as _;
use serde_json::{Value, json};

/// A white and a black texel.
#[rustfmt::skip]
const PNG: &[u8] = &[
    137, 80, 78, 71, 13, 10, 26, 10, 0, 0, 0, 13, 73, 72, 68, 82, 0, 0, 0, 2,
    0, 0, 0, 1, 8, 2, 0, 0, 0, 123, 64, 232, 221, 0, 0, 0, 18, 73, 68, 65,
    84, 120, 1, 1, 7, 0, 248, 255, 0, 255, 255, 255, 0, 0, 0, 14, 248, 2, 254, 106,
    163, 121, 81, 0, 0, 0, 0, 73, 69, 78, 68, 174, 66, 96, 130,
];

/// The four positions by the vertex codec of `EXT_meshopt_compression`, through the exponential filter.
#[rustfmt::skip]
const VERTICES: &[u8] = &[
    160, 0, 1, 60, 0, 0, 0, 64, 63, 0, 1, 32, 0, 0, 0, 0, 1, 15, 0, 0, 0, 64, 63, 0, 1, 8, 0, 0, 0, 0, 1, 3, 0, 0, 0,
    64, 0, 1, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 242, 0, 0, 0, 242, 0, 0,
    0, 242,
];

/// The six indices by its triangle codec.
const INDICES: &[u8] = &[
    225, 240, 32, 0, 118, 135, 86, 103, 120, 169, 134, 101, 137, 104, 152, 1, 105, 0, 0,
];

/// Both by Draco's Edgebreaker.
#[rustfmt::skip]
const DRACO: &[u8] = &[
    68, 82, 65, 67, 79, 2, 2, 1, 1, 0, 0, 0, 4, 2, 0, 2, 0, 0, 1, 47, 255, 1, 17, 1, 255, 0, 1, 1, 0, 9, 3, 0, 0, 2, 1, 1,
    1, 0, 3, 3, 1, 32, 1, 32, 3, 0, 16, 132, 17, 104, 0, 0, 0, 0, 0, 255, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
    128, 63, 8,
];

/// Words that documents are made of.
const WORDS: [&str; 16] = [
    "SCALAR",
    "VEC2",
    "VEC3",
    "VEC4",
    "MAT3",
    "MAT4",
    "LINEAR",
    "STEP",
    "CUBICSPLINE",
    "translation",
    "rotation",
    "scale",
    "weights",
    "2.0",
    "KHR_draco_mesh_compression",
    "data:,",
];

/// A picture of four by four texels of one colour in KTX 2 by Basis Universal (UASTC).
fn ktx2() -> Vec<u8> {
    // The colour model is UASTC, of blocks of four by four.
    const DESCRIPTOR: [u8; 44] = [
        44, 0, 0, 0, 0, 0, 0, 0, 2, 0, 40, 0, 166, 1, 2, 0, 3, 3, 0, 0, 16, 0, 0, 0, 0, 0, 0, 0, 0, 0, 127,
        0, 0, 0, 0, 0, 0, 0, 0, 0, 255, 255, 255, 255,
    ];
    const BLOCK: [u8; 16] = [
        215, 176, 33, 9, 211, 8, 212, 137, 56, 144, 107, 221, 18, 48, 132, 45,
    ];
    let mut out = b"\xabKTX 20\xbb\r\n\x1a\n".to_vec();
    for word in [
        0, 1, 4, 4, 0, 0, 1, 1, 0, 104, 44, 0, 0, 0, 0, 0, 0, 148, 0, 16, 0, 16_u32, 0,
    ] {
        out.extend(word.to_le_bytes());
    }
    out.extend(DESCRIPTOR);
    out.extend(BLOCK);
    out
}

/// A document with its one buffer.
pub struct Document {
    root: Value,
    buffer: Vec<u8>,
}

impl Document {
    /// The document with up to eight values changed or removed and up to sixteen bytes of the buffer changed.
    pub fn new(u: &mut Unstructured<'_>) -> Result<Self> {
        let mut changes: Vec<(u16, u8, u8)> = Vec::new();
        for _ in 0..u.arbitrary::<u8>()? % 9 {
            changes.push(u.arbitrary()?);
        }
        let (mut root, mut buffer) = whole();
        for (place, how, to) in changes {
            keep(&mut root, &mut usize::from(place % 1024), how, to);
        }
        for _ in 0..16 {
            if let Ok((place, by)) = u.arbitrary::<(u16, u8)>() {
                let place = usize::from(place) % buffer.len();
                buffer[place] ^= by;
            }
        }
        Ok(Self { root, buffer })
    }

    /// As a container.
    pub fn glb(mut self) -> Vec<u8> {
        let mut text = self.root.to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        self.buffer.resize(self.buffer.len().next_multiple_of(4), 0);
        let word = |number: usize| (number as u32).to_le_bytes();
        [
            b"glTF\x02\0\0\0".as_slice(),
            &word(28 + text.len() + self.buffer.len()),
            &word(text.len()),
            b"JSON",
            &text,
            &word(self.buffer.len()),
            b"BIN\0",
            &self.buffer,
        ]
        .concat()
    }

    /// As text, the buffer embedded.
    pub fn json(mut self) -> Vec<u8> {
        let encoded = base64::engine::general_purpose::STANDARD.encode(&self.buffer);
        if let Some(buffer) = self.root.pointer_mut("/buffers/0").and_then(Value::as_object_mut) {
            buffer.insert("uri".into(), format!("data:;base64,{encoded}").into());
        }
        self.root.to_string().into_bytes()
    }
}

/// Changes the value of this number, if there are as many: numbers to other numbers or other types, words to other words.
/// Whether it stays.
fn keep(value: &mut Value, left: &mut usize, how: u8, to: u8) -> bool {
    if *left == 0 {
        *left = usize::MAX;
        *value = match value.as_f64() {
            Some(sound) => number(sound, how, to),
            None if how % 2 == 0 => return false,
            None => json!(WORDS[usize::from(to % 16)]),
        };
    }
    *left -= 1;
    match value {
        Value::Array(list) => list.retain_mut(|own| keep(own, left, how, to)),
        Value::Object(map) => map.retain(|_, own| keep(own, left, how, to)),
        _ => {}
    }
    true
}

fn number(sound: f64, how: u8, to: u8) -> Value {
    // Without a fraction, where an integer is meant.
    let plain = |x: f64| match x.fract() {
        0.0 => json!(x as i64),
        _ => json!(x),
    };
    match how % 16 {
        0..=2 => json!(to % 9),
        3 => plain(sound + 1.0),
        4 => plain(sound - 1.0),
        5 => json!(5120 + u32::from(to % 8)),
        6 => json!(to),
        7 => json!(-i32::from(to)),
        8 => plain(sound * f64::from(to) / 16.0),
        9 => json!(u64::MAX >> (to % 64)),
        10 => json!(10f64.powi(i32::from(to) - 128)),
        11 => json!(-0.0),
        12 => Value::Null,
        13 => json!(to.to_string()),
        14 => json!([to]),
        _ => json!({}),
    }
}

/// Four positions, two triangles, three times, nine values of four numbers, and streams that have decoders of their own.
fn whole() -> (Value, Vec<u8>) {
    let bytes = |list: &[f32]| list.iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<_>>();
    let indices: Vec<u8> = [0_u16, 1, 2, 0, 3, 1]
        .iter()
        .flat_map(|i| i.to_le_bytes())
        .collect();
    let values: Vec<f32> = (0..9_u8)
        .flat_map(|i| [f32::from(i) * 0.25, 0.5, 0.0, 1.0])
        .collect();
    let (mut buffer, mut views) = (Vec::new(), Vec::new());
    for part in [
        &bytes(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]),
        &indices,
        &bytes(&[0.0, 0.25, 1.0]),
        &bytes(&values),
        PNG,
        &ktx2(),
        DRACO,
        VERTICES,
        INDICES,
    ] {
        views.push(json!({ "buffer": 0, "byteOffset": buffer.len(), "byteLength": part.len() }));
        buffer.extend(part);
    }
    // Joints are small numbers: the indices, four bytes beyond their end.
    views[1]["byteLength"] = json!(16);
    for (view, stride, count, mode, filter) in [
        (7, 12, 4, "ATTRIBUTES", "EXPONENTIAL"),
        (8, 2, 6, "TRIANGLES", "NONE"),
    ] {
        let mut packed = views[view].clone();
        packed["byteStride"] = json!(stride);
        packed["count"] = json!(count);
        packed["mode"] = json!(mode);
        packed["filter"] = json!(filter);
        views[view]["extensions"] = json!({ "EXT_meshopt_compression": packed });
    }
    let accessor = |view, component, count, kind: &str| json!({ "bufferView": view, "byteOffset": 0, "componentType": component, "count": count, "type": kind });
    let mut accessors = vec![
        accessor(0, 5126, 4, "VEC3"),
        accessor(1, 5123, 6, "SCALAR"),
        accessor(2, 5126, 3, "SCALAR"),
        accessor(3, 5126, 3, "VEC3"),
        accessor(3, 5126, 3, "VEC4"),
        accessor(0, 5126, 4, "VEC2"),
        accessor(3, 5126, 9, "VEC3"),
        accessor(1, 5121, 4, "VEC4"),
        accessor(3, 5126, 4, "VEC4"),
        accessor(3, 5126, 9, "SCALAR"),
        accessor(7, 5126, 4, "VEC3"),
        accessor(8, 5123, 6, "SCALAR"),
        json!({ "componentType": 5126, "count": 4, "type": "VEC3" }),
    ];
    accessors[12]["sparse"] = json!({
        "count": 2,
        "indices": { "bufferView": 1, "byteOffset": 0, "componentType": 5123 },
        "values": { "bufferView": 3, "byteOffset": 0 },
    });
    let draco = json!({ "KHR_draco_mesh_compression": { "bufferView": 6, "attributes": { "POSITION": 0 } } });
    let transform =
        json!({ "KHR_texture_transform": { "offset": [0.25, 0.5], "rotation": 0.5, "scale": [0.5, 2] } });
    let channel = |sampler, path: &str| json!({ "sampler": sampler, "target": { "node": 0, "path": path } });
    let sampler = |output, kind: &str| json!({ "input": 2, "output": output, "interpolation": kind });
    let root = json!({
        "asset": { "version": "2.0" },
        "scene": 0,
        "scenes": [{ "nodes": [0], "extras": { "lightbvh_background": [0.1, 0.2, 0.3] } }],
        "nodes": [
            {
                "mesh": 0, "skin": 0, "camera": 0, "weights": [0.5], "children": [1, 2, 3],
                "translation": [1, 2, 3], "rotation": [0, 0.6, 0, 0.8], "scale": [1, -2, 1],
            },
            {
                "mesh": 1, "matrix": [1, 0.5, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 2, 3, 4, 1],
                "extensions": { "KHR_lights_punctual": { "light": 0 } },
            },
            { "mesh": 2, "extensions": { "EXT_mesh_gpu_instancing": { "attributes": { "TRANSLATION": 3, "ROTATION": 4 } } } },
            { "mesh": 3 },
        ],
        "meshes": [
            { "primitives": [{
                "attributes": { "POSITION": 0, "TEXCOORD_0": 5, "JOINTS_0": 7, "WEIGHTS_0": 8 },
                "indices": 1, "material": 0, "mode": 4, "targets": [{ "POSITION": 0 }],
            }] },
            { "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1, "material": 1, "extensions": draco }] },
            { "primitives": [{ "attributes": { "POSITION": 10, "TEXCOORD_0": 5 }, "indices": 11, "material": 2 }] },
            { "primitives": [{ "attributes": { "POSITION": 12, "_RADIANCE": 0 }, "material": 0, "mode": 5 }] },
        ],
        "materials": [
            {
                "emissiveFactor": [1, 0.5, 0.25], "emissiveTexture": { "index": 0, "texCoord": 0, "extensions": transform },
                "pbrMetallicRoughness": { "baseColorFactor": [0.1, 0.2, 0.3, 1], "metallicFactor": 0.5 },
                "extensions": { "KHR_materials_emissive_strength": { "emissiveStrength": 5 } },
            },
            {
                "alphaMode": "BLEND", "pbrMetallicRoughness": { "baseColorTexture": { "index": 1 } },
                "extensions": { "KHR_materials_transmission": { "transmissionFactor": 0.75 } },
            },
            {
                "alphaMode": "MASK", "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } },
                "normalTexture": { "index": 1, "scale": 2 }, "extensions": { "KHR_materials_unlit": {} },
            },
        ],
        "textures": [{ "source": 0 }, { "source": 1 }],
        "images": [{ "bufferView": 4, "mimeType": "image/png" }, { "bufferView": 5 }],
        "skins": [{ "joints": [3, 0, 0, 0] }],
        "cameras": [{ "type": "perspective", "perspective": { "yfov": 0.7, "znear": 0.1 } }],
        "animations": [{
            "channels": [channel(0, "translation"), channel(1, "rotation"), channel(2, "scale"), channel(3, "weights")],
            "samplers": [sampler(3, "STEP"), sampler(4, "LINEAR"), sampler(6, "CUBICSPLINE"), sampler(9, "CUBICSPLINE")],
        }],
        "extensions": { "KHR_lights_punctual": { "lights": [
            { "type": "spot", "intensity": 5, "range": 5, "spot": { "innerConeAngle": 0.25, "outerConeAngle": 0.5 } },
        ] } },
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{ "byteLength": buffer.len() }],
    });
    (root, buffer)
}

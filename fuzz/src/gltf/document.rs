//! A small glTF document with all that the loader reads: sound but for what the input changes.

use arbitrary::{Result, Unstructured};
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Value, json};

/// The document with its buffer as `data:`: four positions, two triangles, three times, nine values of four numbers, a PNG, a KTX 2
/// by Basis Universal (UASTC), and the mesh by Draco and by `EXT_meshopt_compression`.
const WHOLE: &str = include_str!("document.gltf");

/// Words that documents are made of.
const WORDS: &str = "SCALAR VEC2 VEC3 VEC4 MAT3 MAT4 LINEAR STEP CUBICSPLINE translation rotation scale weights 2.0 \
    KHR_draco_mesh_compression data:,";

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
        let encoded = STANDARD.encode(&self.buffer);
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
            None => json!(WORDS.split(' ').nth(usize::from(to % 16))),
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

/// The sound document and its buffer.
fn whole() -> (Value, Vec<u8>) {
    let mut root: Value = serde_json::from_str(WHOLE).expect("a document");
    let buffer = root.pointer_mut("/buffers/0").and_then(Value::as_object_mut);
    let uri = buffer.and_then(|buffer| buffer.remove("uri")).expect("a buffer");
    let encoded = uri.as_str().and_then(|uri| uri.strip_prefix("data:;base64,"));
    let bytes = STANDARD.decode(encoded.expect("in base64"));
    (root, bytes.expect("in base64"))
}

//! Small glTF documents: sound but for what the input changes.

mod content;
mod streams;

use arbitrary::{Result, Unstructured};
use base64::Engine as _;
use serde_json::{Value, json};

/// A white and a black texel.
#[rustfmt::skip]
const PNG: [u8; 75] = [
    137, 80, 78, 71, 13, 10, 26, 10, 0, 0, 0, 13, 73, 72, 68, 82, 0, 0, 0, 2,
    0, 0, 0, 1, 8, 2, 0, 0, 0, 123, 64, 232, 221, 0, 0, 0, 18, 73, 68, 65,
    84, 120, 1, 1, 7, 0, 248, 255, 0, 255, 255, 255, 0, 0, 0, 14, 248, 2, 254, 106,
    163, 121, 81, 0, 0, 0, 0, 73, 69, 78, 68, 174, 66, 96, 130,
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

/// A document with its one buffer.
pub struct Document {
    root: Value,
    buffer: Vec<u8>,
}

impl Document {
    /// What there is by the bits of `shape`, with up to five values changed and up to sixteen bytes of the buffer.
    pub fn new(u: &mut Unstructured<'_>) -> Result<Self> {
        let shape: u32 = u.arbitrary()?;
        let mut changes: Vec<(u8, u8, u8)> = Vec::new();
        for _ in 0..u.arbitrary::<u8>()? % 6 {
            changes.push(u.arbitrary()?);
        }
        let mut buffer = buffer();
        for _ in 0..16 {
            if let Ok((place, by)) = u.arbitrary::<(u8, u8)>() {
                let place = usize::from(place) % buffer.len();
                buffer[place] ^= by;
            }
        }
        let packed = append(&mut buffer, shape);
        let streams = packed.first.0;
        for _ in 0..if streams < buffer.len() { 8 } else { 0 } {
            if let Ok((place, by)) = u.arbitrary::<(u16, u8)>() {
                let place = streams + usize::from(place) % (buffer.len() - streams);
                buffer[place] ^= by;
            }
        }
        let mut root = content::root(shape, &packed, buffer.len());
        for (place, how, to) in changes {
            change(&mut root, &mut usize::from(place), how, to);
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
        self.root["buffers"][0]["uri"] = json!(format!("data:;base64,{encoded}"));
        self.root.to_string().into_bytes()
    }
}

/// Changes the leaf of this number, if there are as many: numbers to other numbers or other types, words to other words.
fn change(value: &mut Value, left: &mut usize, how: u8, to: u8) {
    match value {
        Value::Array(list) => list.iter_mut().for_each(|own| change(own, left, how, to)),
        Value::Object(map) => map.values_mut().for_each(|own| change(own, left, how, to)),
        leaf => {
            if *left == 0 {
                *leaf = match leaf.as_f64() {
                    Some(sound) => number(sound, how, to),
                    None => json!(WORDS[usize::from(to % 16)]),
                };
            }
            *left = left.wrapping_sub(1);
        }
    }
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

/// Where streams that have decoders of their own lie in the buffer: first byte and length.
struct Packed {
    first: (usize, usize),
    second: (usize, usize),
    picture: (usize, usize),
}

/// Puts the streams that `shape` asks for behind the plain data.
fn append(buffer: &mut Vec<u8>, shape: u32) -> Packed {
    let has = |bit: u32| shape >> bit & 1 != 0;
    let mut put = |stream: &[u8]| {
        let place = (buffer.len(), stream.len());
        buffer.extend(stream);
        place
    };
    let (first, second) = match (has(21), has(22)) {
        (true, _) => (
            streams::VERTICES[usize::from(has(23))],
            streams::INDICES[usize::from(has(24))],
        ),
        (false, true) => (streams::DRACO, &[][..]),
        (false, false) => (&[][..], &[][..]),
    };
    let (first, second) = (put(first), put(second));
    let picture = if has(8) && has(25) {
        put(&streams::ktx2((shape >> 26) as u8 & 3))
    } else {
        put(&[])
    };
    Packed {
        first,
        second,
        picture,
    }
}

/// Four positions, two triangles, three times, nine values of four numbers, an image.
fn buffer() -> Vec<u8> {
    let bytes = |list: &[f32]| list.iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<_>>();
    let positions = bytes(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]);
    let indices: Vec<u8> = [0_u16, 1, 2, 0, 3, 1]
        .iter()
        .flat_map(|i| i.to_le_bytes())
        .collect();
    let values: Vec<f32> = (0..9_u8)
        .flat_map(|i| [f32::from(i) * 0.25, 0.5, 0.0, 1.0])
        .collect();
    let times = bytes(&[0.0, 0.25, 1.0]);
    [&*positions, &*indices, &*times, &*bytes(&values), &PNG].concat()
}

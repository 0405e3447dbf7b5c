//! Small glTF documents: sound but for what the input changes.

mod content;
mod streams;

use std::fmt::Write;

use arbitrary::{Result, Unstructured};

/// A white and a black texel.
#[rustfmt::skip]
const PNG: [u8; 75] = [
    137, 80, 78, 71, 13, 10, 26, 10, 0, 0, 0, 13, 73, 72, 68, 82, 0, 0, 0, 2,
    0, 0, 0, 1, 8, 2, 0, 0, 0, 123, 64, 232, 221, 0, 0, 0, 18, 73, 68, 65,
    84, 120, 1, 1, 7, 0, 248, 255, 0, 255, 255, 255, 0, 0, 0, 14, 248, 2, 254, 106,
    163, 121, 81, 0, 0, 0, 0, 73, 69, 78, 68, 174, 66, 96, 130,
];

/// A change of a value: the number of its place in the document, how, and to what.
type Change = (u8, u8, u8);

/// A document in the making.
pub struct Document {
    text: String,
    buffer: Vec<u8>,
    changes: Vec<Change>,
    place: u8,
}

impl Document {
    /// What there is by the bits of `shape`, with up to five values changed and up to sixteen bytes of the buffer.
    pub fn new(u: &mut Unstructured<'_>) -> Result<Self> {
        let shape: u32 = u.arbitrary()?;
        let mut changes = Vec::new();
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
        let mut document = Self {
            text: String::with_capacity(4096),
            buffer,
            changes,
            place: 0,
        };
        document.write(shape, &packed);
        Ok(document)
    }

    /// As a container.
    pub fn glb(mut self) -> Vec<u8> {
        self.text.push('}');
        while self.text.len() % 4 != 0 {
            self.text.push(' ');
        }
        self.buffer.resize(self.buffer.len().next_multiple_of(4), 0);
        let length = 28 + self.text.len() + self.buffer.len();
        let mut out = Vec::with_capacity(length);
        out.extend(b"glTF\x02\0\0\0");
        out.extend((length as u32).to_le_bytes());
        out.extend((self.text.len() as u32).to_le_bytes());
        out.extend(b"JSON");
        out.extend(self.text.as_bytes());
        out.extend((self.buffer.len() as u32).to_le_bytes());
        out.extend(b"BIN\0");
        out.extend(&self.buffer);
        out
    }

    /// As text, the buffer embedded.
    pub fn json(mut self) -> Vec<u8> {
        // The buffer is the last member of the last list.
        self.text.truncate(self.text.len() - 2);
        self.text.push_str(",\"uri\":\"data:;base64,");
        for chunk in self.buffer.chunks(3) {
            let word = [0, 1, 2].map(|i| u32::from(chunk.get(i).copied().unwrap_or(0)));
            let word = word[0] << 16 | word[1] << 8 | word[2];
            for digit in 0..=chunk.len() {
                let digits = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
                self.text
                    .push(char::from(digits[(word >> (18 - 6 * digit) & 63) as usize]));
            }
        }
        self.text.push_str("\"}]}");
        self.text.into_bytes()
    }

    fn raw(&mut self, text: &str) {
        self.text.push_str(text);
    }

    /// The change of the next place, if there is one.
    fn change(&mut self) -> Option<(u8, u8)> {
        self.place = self.place.wrapping_add(1);
        let found = self.changes.iter().find(|change| change.0 == self.place);
        found.map(|&(_, how, to)| (how, to))
    }

    /// `before`, then a number that is to be `sound`.
    fn number(&mut self, before: &str, sound: f64) {
        self.raw(before);
        let change = self.change();
        let out = &mut self.text;
        let _ = match change {
            None => write!(out, "{sound}"),
            Some((how, to)) => match how % 16 {
                0..=2 => write!(out, "{}", to % 9),
                3 => write!(out, "{}", sound + 1.0),
                4 => write!(out, "{}", sound - 1.0),
                5 => write!(out, "{}", 5120 + u32::from(to % 8)),
                6 => write!(out, "{to}"),
                7 => write!(out, "-{to}"),
                8 => write!(out, "{}", sound * f64::from(to) / 16.0),
                9 => write!(out, "{}", u64::MAX >> (to % 64)),
                10 => write!(out, "1e{}", i32::from(to) - 128),
                11 => write!(out, "-0"),
                12 => write!(out, "null"),
                13 => write!(out, "\"{to}\""),
                14 => write!(out, "[{to}]"),
                _ => write!(out, "{{}}"),
            },
        };
    }

    /// `before`, then a word in quotes.
    fn word(&mut self, before: &str, sound: &str) {
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
        let word = match self.change() {
            None => sound,
            Some((_, to)) => WORDS[usize::from(to % 16)],
        };
        let _ = write!(self.text, "{before}\"{word}\"");
    }

    /// `before`, then a list.
    fn numbers(&mut self, before: &str, sound: &[f64]) {
        self.raw(before);
        for (i, &x) in sound.iter().enumerate() {
            self.number(if i == 0 { "[" } else { "," }, x);
        }
        self.raw("]");
    }
}

/// Where streams that have decoders of their own lie in the buffer: first byte and length.
pub(crate) struct Packed {
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
    let first = match (has(21), has(22)) {
        (true, _) => put(streams::VERTICES[usize::from(has(23))]),
        (false, true) => put(streams::DRACO),
        (false, false) => put(&[]),
    };
    let second = put(if has(21) {
        streams::INDICES[usize::from(has(24))]
    } else {
        &[]
    });
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
    let mut bytes = Vec::with_capacity(300);
    let mut floats = |list: &[f32]| bytes.extend(list.iter().flat_map(|x| x.to_le_bytes()));
    floats(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]);
    bytes.extend([0_u16, 1, 2, 0, 3, 1].iter().flat_map(|i| i.to_le_bytes()));
    let mut floats = |list: &[f32]| bytes.extend(list.iter().flat_map(|x| x.to_le_bytes()));
    floats(&[0.0, 0.25, 1.0]);
    for i in 0..9_u8 {
        floats(&[f32::from(i) * 0.25, 0.5, 0.0, 1.0]);
    }
    bytes.extend(PNG);
    bytes
}

//! PLY in: triangles and polygons, in text or binary of either byte order.
//!
//! Only positions and faces are read, other properties and elements are skipped. The format has no material: the scene is a grey
//! surface that an environment map or suns can light. This is no use of the crate `ply-rs-bw`, which reserves memory for the
//! length that each list announces: a text of 120 bytes makes it panic.

use super::error::SceneError;
use super::files::{Limits, Load, without_mark};
use super::model::{Material, Mesh, Node, Primitive, Scene, SceneData};
use super::polygon::Cutter;

/// Longest header, and most elements and properties.
const MAX_HEADER: usize = 1 << 20;
const MAX_PROPERTIES: usize = 1024;

const TRUNCATED: &str = "the file is truncated; copy it again";
const EXPORT: &str = "export the file again as PLY 1.0";

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    Text,
    LittleEndian,
    BigEndian,
}

#[derive(Clone, Copy, Debug)]
enum Number {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Number {
    fn named(name: &str) -> Result<Self, String> {
        Ok(match name {
            "char" | "int8" => Self::I8,
            "uchar" | "uint8" => Self::U8,
            "short" | "int16" => Self::I16,
            "ushort" | "uint16" => Self::U16,
            "int" | "int32" => Self::I32,
            "uint" | "uint32" => Self::U32,
            "float" | "float32" => Self::F32,
            "double" | "float64" => Self::F64,
            _ => return Err(format!("type `{name}` is not known")),
        })
    }

    fn bytes(self) -> u64 {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }
}

struct Property {
    name: String,
    number: Number,
    /// The type of a list's length.
    length: Option<Number>,
}

struct Element {
    name: String,
    count: u64,
    properties: Vec<Property>,
}

/// The numbers after the header.
struct Numbers<'a> {
    format: Format,
    rest: &'a [u8],
}

impl Numbers<'_> {
    fn next(&mut self, number: Number) -> Option<f64> {
        if self.format == Format::Text {
            let rest = self.rest.trim_ascii_start();
            let end = rest
                .iter()
                .position(u8::is_ascii_whitespace)
                .unwrap_or(rest.len());
            let (word, rest) = rest.split_at(end);
            self.rest = rest;
            return std::str::from_utf8(word).ok()?.parse().ok();
        }
        Some(match number {
            Number::I8 => i8::from_le_bytes(self.bytes()?).into(),
            Number::U8 => u8::from_le_bytes(self.bytes()?).into(),
            Number::I16 => i16::from_le_bytes(self.bytes()?).into(),
            Number::U16 => u16::from_le_bytes(self.bytes()?).into(),
            Number::I32 => i32::from_le_bytes(self.bytes()?).into(),
            Number::U32 => u32::from_le_bytes(self.bytes()?).into(),
            Number::F32 => f32::from_le_bytes(self.bytes()?).into(),
            Number::F64 => f64::from_le_bytes(self.bytes()?),
        })
    }

    fn bytes<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (&bytes, rest) = self.rest.split_first_chunk()?;
        self.rest = rest;
        let mut bytes: [u8; N] = bytes;
        if self.format == Format::BigEndian {
            bytes.reverse();
        }
        Some(bytes)
    }

    /// A number that counts, or names a vertex.
    fn whole(&mut self, number: Number) -> Option<u32> {
        let number = self.next(number)?;
        let is_whole = (0.0..=f64::from(u32::MAX)).contains(&number) && number.fract() == 0.0;
        is_whole.then_some(number as u32)
    }
}

impl Scene {
    /// Reads a `.ply` file in memory and checks it; `name` stands for the path in messages. No file of this kind says what
    /// emits.
    ///
    /// # Errors
    /// What [`Scene::new`] refuses, and unreadable, truncated or malformed files.
    pub fn read_ply_slice(name: &str, bytes: &[u8]) -> Result<Self, SceneError> {
        Self::read_ply(name, bytes, &Load::new(None, &Limits::default())?)
    }

    pub(super) fn read_ply(name: &str, bytes: &[u8], load: &Load) -> Result<Self, SceneError> {
        let (elements, numbers) = header(name, without_mark(name, bytes)?)?;
        let data = SceneData {
            name: name.to_owned(),
            nodes: vec![Node {
                name: String::from("ply"),
                mesh: Some(0),
                ..Node::default()
            }],
            meshes: vec![Mesh {
                name: String::from("ply"),
                primitives: vec![body(name, &elements, numbers, load)?],
            }],
            materials: vec![Material {
                base_color: [0.5; 3],
                ..Material::default()
            }],
            ..SceneData::default()
        };
        Self::loaded(data, load)
    }
}

fn malformed(path: &str, element: String, problem: impl Into<String>, advice: &'static str) -> SceneError {
    SceneError::Malformed {
        path: path.to_owned(),
        element,
        problem: problem.into(),
        advice,
    }
}

fn header<'a>(path: &str, bytes: &'a [u8]) -> Result<(Vec<Element>, Numbers<'a>), SceneError> {
    let mut rest = bytes;
    let mut format = None;
    let mut elements: Vec<Element> = Vec::new();
    let mut properties = 0;
    for line in 1.. {
        let broken = |problem: String| malformed(path, format!("line {line} of the header"), problem, EXPORT);
        let end = rest.iter().take(MAX_HEADER).position(|&byte| byte == b'\n');
        let Some(end) = end.filter(|_| bytes.len() - rest.len() <= MAX_HEADER) else {
            return Err(broken(format!(
                "the file, or the first {MAX_HEADER} bytes, end before `end_header`"
            )));
        };
        let text = String::from_utf8_lossy(&rest[..end]);
        rest = &rest[end + 1..];
        let words: Vec<&str> = text.split_ascii_whitespace().collect();
        if line == 1 && words != ["ply"] {
            return Err(broken(String::from("it does not begin with `ply`")));
        }
        match words[..] {
            ["format", name, "1.0"] => {
                format = Some(match name {
                    "ascii" => Format::Text,
                    "binary_little_endian" => Format::LittleEndian,
                    "binary_big_endian" => Format::BigEndian,
                    _ => return Err(broken(format!("format `{name}` is not known"))),
                });
            }
            ["format", _, version] => return Err(broken(format!("version `{version}` is not known"))),
            ["element", name, count] => {
                let count = count
                    .parse()
                    .map_err(|_| broken(format!("`{count}` is no number of elements")))?;
                elements.push(Element {
                    name: name.to_owned(),
                    count,
                    properties: Vec::new(),
                });
                properties += 1;
            }
            ["property", ref list @ .., item, name] if list.is_empty() || list[0] == "list" => {
                let number = Number::named(item).map_err(broken)?;
                let length = list
                    .get(1)
                    .map(|length| Number::named(length))
                    .transpose()
                    .map_err(broken)?;
                let element = elements.last_mut();
                let element = element
                    .ok_or_else(|| broken(String::from("a property comes before the first element")))?;
                element.properties.push(Property {
                    name: name.to_owned(),
                    number,
                    length,
                });
                properties += 1;
            }
            ["end_header"] => {
                let format = format.ok_or_else(|| broken(String::from("no format is named before it")))?;
                return Ok((elements, Numbers { format, rest }));
            }
            // Comments, and what else applications note.
            _ => {}
        }
        if properties > MAX_PROPERTIES {
            return Err(broken(format!("it has more than {MAX_PROPERTIES} properties")));
        }
    }
    unreachable!("a file has an end")
}

fn body(
    path: &str,
    elements: &[Element],
    mut numbers: Numbers<'_>,
    load: &Load,
) -> Result<Primitive, SceneError> {
    let mut positions = Vec::new();
    // Corners of all polygons, and where each ends: vertices may come after them.
    let (mut corners, mut ends) = (Vec::new(), Vec::new());
    for element in elements.iter().filter(|element| !element.properties.is_empty()) {
        let of = |what: &Property| match numbers.format {
            Format::Text => 2,
            _ => what.length.unwrap_or(what.number).bytes(),
        };
        let least: u64 = element.properties.iter().map(of).sum();
        let left = numbers.rest.len();
        // The last number of a text needs nothing after it.
        if element.count.saturating_mul(least) > left as u64 + 1 {
            let problem = format!(
                "{} of at least {least} bytes are announced, but only {left} bytes are left",
                element.count
            );
            return Err(malformed(
                path,
                format!("element {}", element.name),
                problem,
                TRUNCATED,
            ));
        }
        let scalar = |name: &str| {
            element
                .properties
                .iter()
                .position(|own| own.name == name && own.length.is_none())
        };
        let place = match (element.name.as_str(), ["x", "y", "z"].map(scalar)) {
            ("vertex", [Some(x), Some(y), Some(z)]) => Some([x, y, z]),
            ("vertex", _) => {
                let what = String::from("element vertex");
                return Err(malformed(
                    path,
                    what,
                    "it has no x, y and z",
                    "export the file with positions",
                ));
            }
            _ => None,
        };
        let mut row = vec![0.0_f32; element.properties.len()];
        for index in 0..element.count {
            let ends_here = || {
                let problem = "it has a number that is none, or the file ends in it";
                malformed(path, format!("{} {index}", element.name), problem, TRUNCATED)
            };
            for (property, value) in element.properties.iter().zip(&mut row) {
                let Some(length) = property.length else {
                    *value = numbers.next(property.number).ok_or_else(ends_here)? as f32;
                    continue;
                };
                let is_polygon = element.name == "face"
                    && matches!(property.name.as_str(), "vertex_indices" | "vertex_index");
                for _ in 0..numbers.whole(length).ok_or_else(ends_here)? {
                    if is_polygon {
                        corners.push(numbers.whole(property.number).ok_or_else(ends_here)?);
                    } else {
                        numbers.next(property.number).ok_or_else(ends_here)?;
                    }
                }
                if is_polygon {
                    ends.push(corners.len());
                }
            }
            positions.extend(place.map(|place| place.map(|k| row[k])));
        }
    }
    let (mut triangles, mut begin, mut cutter) = (Vec::new(), 0, Cutter::default());
    for (face, end) in ends.into_iter().enumerate() {
        let own = &corners[begin..end];
        begin = end;
        let places = own.iter().map(|&vertex| positions.get(vertex as usize).copied());
        let places: Vec<[f32; 3]> = places.collect::<Option<_>>().ok_or_else(|| {
            let problem = format!(
                "has vertices {:?}, but there are only {}",
                &own[..own.len().min(8)],
                positions.len()
            );
            malformed(
                path,
                format!("face {face}"),
                problem,
                "the file is damaged; export it again",
            )
        })?;
        cutter
            .cut(&places, |triangle| triangles.push(triangle.map(|k| own[k])))
            .map_err(|problem| {
                malformed(
                    path,
                    format!("face {face}"),
                    problem,
                    "export the file with triangles",
                )
            })?;
        load.take(path, "the list of triangles", size_of_val(own) as u64 * 3)?;
    }
    Ok(Primitive {
        positions,
        triangles,
        ..Primitive::default()
    })
}

#[cfg(test)]
mod tests;

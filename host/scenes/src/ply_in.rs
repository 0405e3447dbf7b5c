//! PLY in: triangles and polygons, in text or binary of either byte order.
//!
//! Only positions and faces are read, other properties and elements are skipped. The format has no material: the scene is a grey
//! surface without light. This is no use of the crate `ply-rs-bw`, which reserves memory for the
//! length that each list announces: a text of 120 bytes makes it panic.

use super::error::{SceneError, malformed};
use super::files::{Limits, Load, without_mark};
use super::model::{Material, Mesh, Node, Primitive, SceneData};
use super::polygon::Cutter;
use super::scene::Scene;

/// Longest header.
const MAX_HEADER: usize = 1 << 20;

const TRUNCATED: &str = "the file is truncated; copy it again";
const EXPORT: &str = "export the file again as PLY 1.0";

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    Text,
    LittleEndian,
    BigEndian,
}

/// `i` for integers, `u` for those without a sign, `f` for fractions; and bytes.
type Number = (char, usize);

fn number(name: &str) -> Result<Number, String> {
    Ok(match name {
        "char" | "int8" => ('i', 1),
        "uchar" | "uint8" => ('u', 1),
        "short" | "int16" => ('i', 2),
        "ushort" | "uint16" => ('u', 2),
        "int" | "int32" => ('i', 4),
        "uint" | "uint32" => ('u', 4),
        "float" | "float32" => ('f', 4),
        "double" | "float64" => ('f', 8),
        _ => return Err(format!("type `{name}` is not known")),
    })
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
    fn next(&mut self, (kind, bytes): Number) -> Option<f64> {
        if self.format == Format::Text {
            let rest = self.rest.trim_ascii_start();
            let end = rest.iter().position(u8::is_ascii_whitespace);
            let (word, rest) = rest.split_at(end.unwrap_or(rest.len()));
            self.rest = rest;
            return std::str::from_utf8(word).ok()?.parse().ok();
        }
        let (own, rest) = self.rest.split_at_checked(bytes)?;
        self.rest = rest;
        let mut word = [0; 8];
        word[..bytes].copy_from_slice(own);
        if self.format == Format::BigEndian {
            word[..bytes].reverse();
        }
        let word = u64::from_le_bytes(word);
        let unused = 64 - 8 * bytes;
        Some(match (kind, bytes) {
            ('f', 4) => f32::from_bits(word as u32).into(),
            ('f', _) => f64::from_bits(word),
            ('i', _) => ((word << unused) as i64 >> unused) as f64,
            _ => word as f64,
        })
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

fn header<'a>(path: &str, bytes: &'a [u8]) -> Result<(Vec<Element>, Numbers<'a>), SceneError> {
    let (mut format, mut elements) = (None, Vec::<Element>::new());
    let (mut rest, mut line) = (bytes, 0);
    loop {
        line += 1;
        let broken =
            |problem: String| malformed(format!("{path}: line {line} of the header"), problem, EXPORT);
        let end = rest.iter().take(MAX_HEADER).position(|&byte| byte == b'\n');
        let Some(end) = end.filter(|_| bytes.len() - rest.len() <= MAX_HEADER) else {
            let problem = format!("the file, or the first {MAX_HEADER} bytes, end before `end_header`");
            return Err(broken(problem));
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
                let no_count = |_| broken(format!("`{count}` is no number of elements"));
                elements.push(Element {
                    name: name.to_owned(),
                    count: count.parse().map_err(no_count)?,
                    properties: Vec::new(),
                });
            }
            ["property", ref list @ .., item, name] if list.is_empty() || list[0] == "list" => {
                let length = list.get(1).map(|length| number(length)).transpose();
                let property = Property {
                    name: name.to_owned(),
                    number: number(item).map_err(broken)?,
                    length: length.map_err(broken)?,
                };
                let element = elements.last_mut();
                let first = || broken(String::from("a property comes before the first element"));
                element.ok_or_else(first)?.properties.push(property);
            }
            ["end_header"] => {
                let format = format.ok_or_else(|| broken(String::from("no format is named before it")))?;
                return Ok((elements, Numbers { format, rest }));
            }
            // Comments, and what else applications note.
            _ => {}
        }
    }
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
        let (name, all) = (&element.name, &element.properties);
        let of = |what: &Property| match numbers.format {
            Format::Text => 2,
            _ => what.length.unwrap_or(what.number).1 as u64,
        };
        let least: u64 = all.iter().map(of).sum();
        let (count, left) = (element.count, numbers.rest.len());
        // The last number of a text needs nothing after it.
        if count.saturating_mul(least) > left as u64 + 1 {
            let problem =
                format!("{count} of at least {least} bytes are announced, but only {left} bytes are left");
            return Err(malformed(format!("{path}: element {name}"), problem, TRUNCATED));
        }
        let scalar = |name: &str| {
            all.iter()
                .position(|own| own.name == name && own.length.is_none())
        };
        let place = match (name.as_str(), ["x", "y", "z"].map(scalar)) {
            ("vertex", [Some(x), Some(y), Some(z)]) => Some([x, y, z]),
            ("vertex", _) => {
                let advice = "export the file with positions";
                return Err(malformed(
                    format!("{path}: element vertex"),
                    "it has no x, y and z",
                    advice,
                ));
            }
            _ => None,
        };
        let mut row = vec![0.0_f32; all.len()];
        for index in 0..count {
            let ends_here = || {
                let problem = "it has a number that is none, or the file ends in it";
                malformed(format!("{path}: {name} {index}"), problem, TRUNCATED)
            };
            for (property, value) in all.iter().zip(&mut row) {
                let Some(length) = property.length else {
                    *value = numbers.next(property.number).ok_or_else(ends_here)? as f32;
                    continue;
                };
                let is_polygon =
                    name == "face" && matches!(property.name.as_str(), "vertex_indices" | "vertex_index");
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
        let (own, face) = (&corners[begin..end], || format!("{path}: face {face}"));
        begin = end;
        let places = own.iter().map(|&vertex| positions.get(vertex as usize).copied());
        let places: Vec<[f32; 3]> = places.collect::<Option<_>>().ok_or_else(|| {
            let (some, count) = (&own[..own.len().min(8)], positions.len());
            let problem = format!("has vertices {some:?}, but there are only {count}");
            malformed(face(), problem, "the file is damaged; export it again")
        })?;
        cutter
            .cut(&places, |triangle| triangles.push(triangle.map(|k| own[k])))
            .map_err(|problem| malformed(face(), problem, "export the file with triangles"))?;
        load.take(path, "the list of triangles", size_of_val(own) as u64 * 3)?;
    }
    Ok(Primitive {
        positions,
        triangles,
        ..Primitive::default()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "ply\nformat ascii 1.0\ncomment two triangles\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
                        element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";

    /// The same in binary, with normals, a list of the vertices and an element in between.
    fn binary(is_little: bool) -> Vec<u8> {
        let order = if is_little { "little" } else { "big" };
        let mut out = format!(
            "ply\nformat binary_{order}_endian 1.0\nelement vertex 4\nproperty double x\nproperty float y\nproperty short z\nproperty list uchar ushort \
             extra\nproperty float nx\nproperty float ny\nproperty float nz\nelement edge 1\nproperty int a\nelement face 1\nproperty uchar flag\n\
             property list ushort uint vertex_index\nend_header\n"
        )
        .into_bytes();
        let mut put = |bytes: &[u8]| match is_little {
            true => out.extend(bytes),
            false => out.extend(bytes.iter().rev()),
        };
        for [x, y] in [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]] {
            put(&f64::to_le_bytes(x));
            put(&(y as f32).to_le_bytes());
            // z, two numbers of a list, and a normal.
            for bytes in [
                &[0, 0][..],
                &[2],
                &[7, 0],
                &[7, 0],
                &[0; 4],
                &[0; 4],
                &(-1.0_f32).to_le_bytes(),
            ] {
                put(bytes);
            }
        }
        // An edge, and a face's flag and four vertices.
        for bytes in [&[5, 0, 0, 0][..], &[1], &[4, 0]] {
            put(bytes);
        }
        (0..4_u32).for_each(|vertex| put(&vertex.to_le_bytes()));
        out
    }

    fn read(name: &str, bytes: &[u8]) -> Result<Primitive, SceneError> {
        let scene = Scene::read_ply_slice(name, bytes)?;
        Ok(scene.data().meshes[0].primitives[0].clone())
    }

    #[test]
    fn text_and_binary_hold_the_same_in_any_order() {
        let text = read("t", TEXT.as_bytes()).expect("valid");
        let square = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
        assert_eq!(text.positions, square);
        assert_eq!(text.triangles, [[0, 1, 2], [0, 2, 3]]);
        let face = "element face 1\nproperty list uchar int vertex_indices\n";
        let (header, numbers) = TEXT.split_once("0 0 0\n").expect("the first vertex");
        let header = header
            .replace(face, "")
            .replace("element vertex", &format!("{face}element vertex"));
        let first = format!("{header}4 0 1 2 3\n0 0 0\n{}", numbers.replace("4 0 1 2 3\n", ""));
        for bytes in [binary(true), binary(false), first.into_bytes()] {
            let binary = read("b", &bytes).expect("valid");
            assert_eq!(binary.positions, text.positions);
            assert_eq!(binary.triangles, text.triangles);
        }
    }

    #[test]
    fn what_is_announced_must_be_there() {
        let with = |from: &str, to: &str| TEXT.replace(from, to);
        let many = "4000000000 of at least 6 bytes";
        for (text, expected) in [
            (with("vertex 4", "vertex 4000000000"), many),
            (
                with("4 0 1 2 3", "4 0 1 2 9"),
                "[0, 1, 2, 9], but there are only 4",
            ),
            (with("4 0 1 2 3", "9 0 1 2 3"), "face 0"),
            (with("1 1 0", "1 one 0"), "vertex 2"),
            (with("end_header", "end"), "end before `end_header`"),
            (with("float x", "float w"), "no x, y and z"),
            (with("float x", "half x"), "type `half` is not known"),
            (with("ascii", "utf"), "format `utf` is not known"),
            (
                with("ascii 1.0", "ascii 2.0"),
                "line 2 of the header: version `2.0`",
            ),
            (
                "version https://git-lfs.github.com/spec/v1\n".into(),
                "git lfs pull",
            ),
        ] {
            let error = read("t.ply", text.as_bytes()).expect_err(expected).to_string();
            assert!(error.contains("t.ply: ") && error.contains(expected), "{error}");
        }
    }
}

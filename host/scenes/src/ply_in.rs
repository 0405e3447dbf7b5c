//! PLY in: positions and faces, in text or little-endian binary.
//!
//! Other properties and elements are skipped. Polygons are cut into fans around their first corner. The format has no material:
//! the scene is a grey surface that an environment map or suns can light. The crate `ply-rs-bw` is not used: an element without
//! properties keeps it busy for as long as the file's count says.

use super::error::{SceneError, malformed};
use super::files::{Limits, Load, without_mark};
use super::model::{Material, Mesh, Node, Primitive, SceneData};
use super::scene::Scene;

/// Longest header.
const MAX_HEADER: usize = 1 << 20;

const TRUNCATED: &str = "the file is truncated; copy it again";
const EXPORT: &str = "export the file again as PLY 1.0, as text or little-endian binary";

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
    is_text: bool,
    rest: &'a [u8],
}

impl Numbers<'_> {
    fn next(&mut self, (kind, bytes): Number) -> Option<f64> {
        if self.is_text {
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
    const END: &[u8] = b"\nend_header";
    let broken = |problem: &str| malformed(format!("{path}: the header"), problem, EXPORT);
    if !bytes.starts_with(b"ply") {
        return Err(broken("does not begin with `ply`"));
    }
    let first = &bytes[..bytes.len().min(MAX_HEADER)];
    let end = first.windows(END.len()).position(|own| own == END);
    let end = end.ok_or_else(|| broken("is longer than 1 MiB, or than the file"))?;
    let after = &bytes[end + END.len()..];
    let line = after.iter().position(|&byte| byte == b'\n');
    let rest = &after[line.map_or(after.len(), |line| line + 1)..];
    let (mut is_text, mut elements) = (None, Vec::<Element>::new());
    for line in String::from_utf8_lossy(&bytes[..end]).lines() {
        let words: Vec<&str> = line.split_ascii_whitespace().collect();
        match words[..] {
            ["format", "ascii", "1.0"] => is_text = Some(true),
            ["format", "binary_little_endian", "1.0"] => is_text = Some(false),
            ["element", name, count] => {
                let no_count = |_| broken(&format!("has `{count}` as a number of elements"));
                elements.push(Element {
                    name: name.to_owned(),
                    count: count.parse().map_err(no_count)?,
                    properties: Vec::new(),
                });
            }
            ["property", ref list @ .., item, name] if list.is_empty() || list[0] == "list" => {
                let number = |name: &&str| number(name).map_err(|problem| broken(&problem));
                let element = elements.last_mut();
                let element = element.ok_or_else(|| broken("has a property before the first element"))?;
                element.properties.push(Property {
                    name: name.to_owned(),
                    number: number(&item)?,
                    length: list.get(1).map(number).transpose()?,
                });
            }
            // Comments, and what else applications note.
            _ => {}
        }
    }
    let is_text = is_text.ok_or_else(|| broken("names no format that is read"))?;
    Ok((elements, Numbers { is_text, rest }))
}

fn body(
    path: &str,
    elements: &[Element],
    mut numbers: Numbers<'_>,
    load: &Load,
) -> Result<Primitive, SceneError> {
    let mut out = Primitive::default();
    for element in elements.iter().filter(|element| !element.properties.is_empty()) {
        let (name, all) = (&element.name, &element.properties);
        let of = |what: &Property| match numbers.is_text {
            true => 2,
            false => what.length.unwrap_or(what.number).1 as u64,
        };
        let least: u64 = all.iter().map(of).sum();
        let (count, left) = (element.count, numbers.rest.len());
        // The last number of a text needs nothing after it.
        if count.saturating_mul(least) > left as u64 + 1 {
            let problem = format!("{count} of at least {least} bytes each are announced in {left} bytes");
            return Err(malformed(format!("{path}: element {name}"), problem, TRUNCATED));
        }
        let axis = |axis: &str| all.iter().position(|own| own.name == axis);
        let place = ["x", "y", "z"].map(axis).into_iter().collect::<Option<Vec<_>>>();
        if name == "vertex" && place.is_none() {
            return Err(malformed(
                format!("{path}: element vertex"),
                "has no x, y and z",
                EXPORT,
            ));
        }
        let place = place.filter(|_| name == "vertex");
        let mut row = vec![0.0_f32; all.len()];
        for index in 0..count {
            let ends_here = || {
                let problem = "has a number that is none, or the file ends in it";
                malformed(format!("{path}: {name} {index}"), problem, TRUNCATED)
            };
            for (property, value) in all.iter().zip(&mut row) {
                let Some(length) = property.length else {
                    *value = numbers.next(property.number).ok_or_else(ends_here)? as f32;
                    continue;
                };
                let length = numbers.whole(length).ok_or_else(ends_here)?;
                let is_polygon =
                    name == "face" && ["vertex_indices", "vertex_index"].contains(&&*property.name);
                if is_polygon {
                    load.take(path, "the list of triangles", 36 * u64::from(length))?;
                }
                let mut fan = [0; 3];
                for corner in 0..length {
                    let number = numbers.next(property.number).ok_or_else(ends_here)?;
                    // The check of the scene finds vertices that are not there; negative numbers name none.
                    let vertex = if number < 0.0 { u32::MAX } else { number as u32 };
                    fan = [fan[0], fan[2], vertex];
                    if corner == 0 {
                        fan[0] = vertex;
                    } else if corner > 1 && is_polygon {
                        out.triangles.push(fan);
                    }
                }
            }
            let place = place.as_ref().map(|place| [0, 1, 2].map(|k| row[place[k]]));
            out.positions.extend(place);
        }
    }
    Ok(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "ply\nformat ascii 1.0\ncomment two triangles\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
                        element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";

    /// The same in binary, with a list of the vertices and an element in between.
    fn binary() -> Vec<u8> {
        let mut out = b"ply\r\nformat binary_little_endian 1.0\r\nelement vertex 4\r\nproperty double x\r\nproperty float y\r\n\
            property short z\r\nproperty list uchar ushort extra\r\nelement edge 1\r\nproperty int a\r\nelement face 1\r\nproperty uchar flag\r\n\
            property list ushort uint vertex_index\r\nend_header\r\n"
            .to_vec();
        for [x, y] in [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]] {
            out.extend(f64::to_le_bytes(x));
            out.extend((y as f32).to_le_bytes());
            // z, and two numbers of a list.
            out.extend([0, 0, 2, 7, 0, 7, 0]);
        }
        // An edge, and a face's flag and four vertices.
        out.extend([5, 0, 0, 0, 1, 4, 0]);
        (0..4_u32).for_each(|vertex| out.extend(vertex.to_le_bytes()));
        out
    }

    #[test]
    fn text_and_binary_hold_the_same() {
        for bytes in [TEXT.as_bytes(), &binary()] {
            let scene = Scene::read_ply_slice("a.ply", bytes).expect("valid");
            let own = &scene.data().meshes[0].primitives[0];
            let square = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
            assert_eq!(own.positions, square);
            assert_eq!(own.triangles, [[0, 1, 2], [0, 2, 3]]);
        }
    }

    #[test]
    fn damaged_files_are_named() {
        for (from, to, expected) in [
            ("vertex 4", "vertex 4000000000", "4000000000 of at least 6 bytes"),
            ("4 0 1 2 3", "4 0 1 2 9", "is 9, but there are only 4"),
            ("4 0 1 2 3", "4 0 1 2 -1", "is 4294967295, but there are only 4"),
            ("4 0 1 2 3", "9 0 1 2 3", "face 0"),
            ("1 1 0", "1 one 0", "vertex 2"),
            ("end_header", "end", "longer than"),
            ("float x", "float w", "no x, y and z"),
            ("float x", "half x", "type `half` is not known"),
            ("ascii", "binary_big_endian", "no format that is read"),
            (
                "ply\n",
                "version https://git-lfs.github.com/spec/v1\n",
                "git lfs pull",
            ),
            ("ply\n", "polygons\n", "begin with `ply`"),
        ] {
            let text = TEXT.replacen(from, to, 1);
            let error = Scene::read_ply_slice("t.ply", text.as_bytes())
                .expect_err(expected)
                .to_string();
            assert!(error.contains("t.ply") && error.contains(expected), "{error}");
        }
    }
}

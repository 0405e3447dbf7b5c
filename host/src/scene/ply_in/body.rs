//! The numbers of a PLY file.

use super::super::check::MAX_TRIANGLES;
use super::super::error::SceneError;
use super::super::polygon::cut;
use super::header::{Element, Format, Header, Number};
use super::{PlyMesh, malformed};

const TRUNCATED: &str = "the file is truncated; copy it again";

/// Numbers on their way out of the bytes.
struct Numbers<'a> {
    format: Format,
    rest: &'a [u8],
}

impl Numbers<'_> {
    /// The next number, if there is one.
    fn next(&mut self, number: Number) -> Option<f64> {
        if self.format == Format::Text {
            return self.word();
        }
        let (bytes, rest) = self.rest.split_at_checked(number.bytes())?;
        self.rest = rest;
        let mut word = [0_u8; 8];
        let word = &mut word[..bytes.len()];
        word.copy_from_slice(bytes);
        if self.format == Format::BigEndian {
            word.reverse();
        }
        Some(match *word {
            [a] if number == Number::I8 => f64::from(a as i8),
            [a] => f64::from(a),
            [a, b] if number == Number::I16 => f64::from(i16::from_le_bytes([a, b])),
            [a, b] => f64::from(u16::from_le_bytes([a, b])),
            [a, b, c, d] if number == Number::I32 => f64::from(i32::from_le_bytes([a, b, c, d])),
            [a, b, c, d] if number == Number::U32 => f64::from(u32::from_le_bytes([a, b, c, d])),
            [a, b, c, d] => f64::from(f32::from_le_bytes([a, b, c, d])),
            [a, b, c, d, e, f, g, h] => f64::from_le_bytes([a, b, c, d, e, f, g, h]),
            _ => return None,
        })
    }

    fn word(&mut self) -> Option<f64> {
        let rest = self.rest.trim_ascii_start();
        let end = rest
            .iter()
            .position(u8::is_ascii_whitespace)
            .unwrap_or(rest.len());
        let (word, rest) = rest.split_at(end);
        self.rest = rest;
        std::str::from_utf8(word).ok()?.parse().ok()
    }
}

/// Reads all elements.
pub(super) fn read(path: &str, header: &Header, body: &[u8]) -> Result<PlyMesh, SceneError> {
    let mut numbers = Numbers {
        format: header.format,
        rest: body,
    };
    let mut out = PlyMesh::default();
    let mut polygons = Vec::new();
    for element in &header.elements {
        let least = element.least_bytes(header.format);
        // The last number of a text needs nothing after it.
        let there = numbers.rest.len() as u64 + 1;
        if element.properties.is_empty() {
            continue;
        }
        if element.count.saturating_mul(least) > there {
            let problem = format!(
                "{} of at least {least} bytes are announced, but only {} bytes are left",
                element.count,
                numbers.rest.len()
            );
            return Err(malformed(
                path,
                format!("element {}", element.name),
                problem,
                TRUNCATED,
            ));
        }
        match element.name.as_str() {
            "vertex" => vertices(path, element, &mut numbers, &mut out)?,
            "face" => faces(path, element, &mut numbers, &mut out, Some(&mut polygons))?,
            "tristrips" => faces(path, element, &mut numbers, &mut out, None)?,
            _ => pass(path, element, &mut numbers)?,
        }
    }
    let count = out.positions.len();
    let outside = |triangle: &[u32; 3]| triangle.iter().any(|&vertex| vertex as usize >= count);
    if let Some(t) = out.triangles.iter().position(outside) {
        let problem = format!("has vertices {:?}, but there are only {count}", out.triangles[t]);
        return Err(malformed(
            path,
            format!("triangle {t}"),
            problem,
            "the file is damaged; export it again",
        ));
    }
    cut_again(&polygons, &mut out);
    Ok(out)
}

/// Cuts polygons that are fans, once all vertices are there: they may come after the faces.
fn cut_again(polygons: &[Fan], out: &mut PlyMesh) {
    let (mut corners, mut places) = (Vec::new(), Vec::new());
    for fan in polygons {
        let triangles = &mut out.triangles[fan.first as usize..][..fan.count as usize];
        corners.clear();
        corners.extend_from_slice(&triangles[0][..2]);
        corners.extend(triangles.iter().map(|triangle| triangle[2]));
        places.clear();
        places.extend(corners.iter().map(|&vertex| out.positions[vertex as usize]));
        let mut next = triangles.iter_mut();
        cut(&places, |triangle| {
            if let Some(place) = next.next() {
                *place = triangle.map(|k| corners[k]);
            }
        });
    }
}

fn ends(path: &str, element: &Element, index: u64) -> SceneError {
    malformed(
        path,
        format!("{} {index}", element.name),
        "it has a number that is none, or the file ends in it",
        TRUNCATED,
    )
}

fn vertices(
    path: &str,
    element: &Element,
    numbers: &mut Numbers<'_>,
    out: &mut PlyMesh,
) -> Result<(), SceneError> {
    let names = ["x", "y", "z", "nx", "ny", "nz"];
    let place = |name: &str| {
        (element.properties.iter()).position(|property| property.name == name && property.length.is_none())
    };
    let places = names.map(place);
    if places[..3].contains(&None) {
        return Err(malformed(
            path,
            "element vertex",
            "it has no x, y and z",
            "export the file with positions",
        ));
    }
    let has_normals = !places[3..].contains(&None);
    // As pbrt and others name them.
    let pairs = [
        ["u", "v"],
        ["s", "t"],
        ["texture_u", "texture_v"],
        ["texture_s", "texture_t"],
    ];
    let lies = pairs.iter().find_map(|names| {
        let [u, v] = names.map(place);
        Some([u?, v?])
    });
    let mut row = vec![0.0_f32; element.properties.len()];
    for index in 0..element.count {
        for (property, value) in element.properties.iter().zip(&mut row) {
            let count = match property.length {
                None => {
                    let number = numbers.next(property.number);
                    *value = number.ok_or_else(|| ends(path, element, index))? as f32;
                    continue;
                }
                Some(length) => numbers.next(length),
            };
            past(numbers, property.number, count).ok_or_else(|| ends(path, element, index))?;
        }
        let pick = |at: [Option<usize>; 3]| at.map(|place| place.map_or(0.0, |place| row[place]));
        let [x, y, z, nx, ny, nz] = places;
        out.positions.push(pick([x, y, z]));
        if has_normals {
            out.normals.push(pick([nx, ny, nz]));
        }
        if let Some(lies) = lies {
            out.coordinates.push(lies.map(|place| row[place]));
        }
    }
    Ok(())
}

/// Triangles around the first vertex of a polygon.
struct Fan {
    first: u32,
    count: u32,
}

/// Faces as fans, which `polygons` lists where they are more than a triangle. Without it, strips of triangles, of which every
/// second one turns the other way and -1 begins another.
fn faces(
    path: &str,
    element: &Element,
    numbers: &mut Numbers<'_>,
    out: &mut PlyMesh,
    mut polygons: Option<&mut Vec<Fan>>,
) -> Result<(), SceneError> {
    let strips = polygons.is_none();
    for index in 0..element.count {
        let ends = || ends(path, element, index);
        for property in &element.properties {
            let Some(length) = property.length else {
                numbers.next(property.number).ok_or_else(ends)?;
                continue;
            };
            let count = numbers.next(length);
            if !matches!(property.name.as_str(), "vertex_indices" | "vertex_index") {
                past(numbers, property.number, count).ok_or_else(ends)?;
                continue;
            }
            let count = whole(count).ok_or_else(ends)?;
            let begin = out.triangles.len() as u32;
            let (mut first, mut before, mut k) = (0, 0, 0);
            for _ in 0..count {
                let vertex = numbers.next(property.number);
                if strips && vertex == Some(-1.0) {
                    k = 0;
                    continue;
                }
                let vertex = whole(vertex).ok_or_else(ends)?;
                match k {
                    0 => first = vertex,
                    1 => {}
                    _ if strips && k % 2 == 1 => out.triangles.push([before, first, vertex]),
                    _ => out.triangles.push([first, before, vertex]),
                }
                if strips && k > 0 {
                    first = before;
                }
                before = vertex;
                k += 1;
            }
            if out.triangles.len() as u64 > MAX_TRIANGLES {
                return Err(SceneError::TooMany {
                    scene: path.to_owned(),
                    what: "triangles",
                    count: out.triangles.len() as u64,
                    limit: MAX_TRIANGLES,
                });
            }
            if let Some(polygons) = &mut polygons
                && count > 3
            {
                polygons.push(Fan {
                    first: begin,
                    count: count - 2,
                });
            }
        }
    }
    Ok(())
}

/// Passes elements of other kinds.
fn pass(path: &str, element: &Element, numbers: &mut Numbers<'_>) -> Result<(), SceneError> {
    for index in 0..element.count {
        for property in &element.properties {
            let passed = match property.length {
                None => numbers.next(property.number).map(|_| ()),
                Some(length) => {
                    let count = numbers.next(length);
                    past(numbers, property.number, count)
                }
            };
            passed.ok_or_else(|| ends(path, element, index))?;
        }
    }
    Ok(())
}

/// Passes `count` numbers of a list.
fn past(numbers: &mut Numbers<'_>, number: Number, count: Option<f64>) -> Option<()> {
    for _ in 0..whole(count)? {
        numbers.next(number)?;
    }
    Some(())
}

/// A number that counts, or names a vertex.
fn whole(number: Option<f64>) -> Option<u32> {
    number
        .filter(|&number| (0.0..=f64::from(u32::MAX)).contains(&number) && number.fract() == 0.0)
        .map(|number| number as u32)
}

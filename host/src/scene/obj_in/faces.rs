//! Vertices, faces, groups.

use std::collections::HashMap;
use std::path::Path;
use std::rc::Rc;

use super::super::check::MAX_TRIANGLES;
use super::super::error::SceneError;
use super::super::frame::emits;
use super::super::model::{Material, Mesh, Node, Primitive, SceneData};
use super::super::notes::{Notes, Place};
use super::super::read_file::read_unpacked;
use super::lines::{Lines, numbers, shown, split};
use super::mtl::Library;
use super::{REPAIR, beside, wrong};
use crate::vector::{cross, dot, sub};

/// Most vertices of a polygon.
const MAX_CORNERS: usize = 1 << 16;

/// A corner of a face: a vertex, and a normal where it has one.
type Corner = (u32, Option<u32>);

/// A triangle's vertices, and the sum of its normals where all its corners have one.
type Face = ([u32; 3], Option<[f32; 3]>);

/// What a file has said so far.
struct Reading<'a> {
    file: &'a Rc<str>,
    positions: Vec<[f32; 3]>,
    normals: Vec<[f32; 3]>,
    textures: usize,
    /// Names of groups, in the order of their first face.
    groups: Vec<String>,
    by_name: HashMap<String, u32>,
    /// Names of materials, in the order of their first face.
    materials: Vec<String>,
    by_material: HashMap<String, u32>,
    /// By group and material, in the order of their first face.
    parts: Vec<((u32, u32), Vec<Face>)>,
    by_part: HashMap<(u32, u32), usize>,
    triangles: u64,
    corners: Vec<Corner>,
}

/// Reads all of a file into a scene.
pub(super) fn read(
    file: &Rc<str>,
    bytes: &[u8],
    folder: Option<&Path>,
    data: &mut SceneData,
    notes: &mut Notes,
) -> Result<(), SceneError> {
    let mut reading = Reading {
        file,
        positions: Vec::new(),
        normals: Vec::new(),
        textures: 0,
        groups: Vec::new(),
        by_name: HashMap::new(),
        materials: Vec::new(),
        by_material: HashMap::new(),
        parts: Vec::new(),
        by_part: HashMap::new(),
        triangles: 0,
        corners: Vec::new(),
    };
    let mut library = Library::default();
    let (mut object, mut group, mut material) = (String::new(), String::new(), String::new());
    // The part that faces go to, until a name changes.
    let mut part = None;
    for (line, text) in Lines::new(bytes) {
        let (word, rest) = split(&text);
        let place = || Place {
            file: Rc::clone(file),
            line,
        };
        match word {
            "v" => reading.positions.push(numbers::<3>(file, line, rest)?),
            "vn" => reading.normals.push(numbers::<3>(file, line, rest)?),
            "vt" => reading.textures += 1,
            "f" => {
                let part = *part.get_or_insert_with(|| reading.part(&object, &group, &material));
                reading.face(line, rest, part)?;
            }
            "o" => {
                (object, group) = (rest.to_owned(), String::new());
                part = None;
            }
            "g" => {
                group = rest.to_owned();
                part = None;
            }
            "usemtl" => {
                material = rest.to_owned();
                part = None;
            }
            "mtllib" => libraries(rest, folder, &mut library, &place(), notes)?,
            "l" | "p" | "curv" | "curv2" | "surf" => {
                notes.add(
                    &place(),
                    format!("elements `{word}` are left out; only faces are read"),
                );
            }
            _ => {}
        }
    }
    reading.finish(library, data, notes);
    Ok(())
}

/// Reads the libraries that a line names: one, whose name may have spaces, or several.
fn libraries(
    rest: &str,
    folder: Option<&Path>,
    library: &mut Library,
    place: &Place,
    notes: &mut Notes,
) -> Result<(), SceneError> {
    let Some(folder) = folder else {
        notes.add(
            place,
            "material libraries are left out, as there is no folder to look in",
        );
        return Ok(());
    };
    let rest = rest.replace('\\', "/");
    let whole = beside(folder, rest.trim());
    let paths = if whole.is_file() {
        vec![whole]
    } else {
        rest.split_ascii_whitespace()
            .map(|name| beside(folder, name))
            .collect()
    };
    for path in paths {
        match read_unpacked(&path) {
            Ok(bytes) => {
                library.read(&path.display().to_string(), &bytes, path.parent(), notes)?;
            }
            Err(error) => notes.add(place, format!("a material library is left out: {error}")),
        }
    }
    Ok(())
}

impl Reading<'_> {
    /// The place in `parts` of what a group has of a material.
    fn part(&mut self, object: &str, group: &str, material: &str) -> usize {
        let group = match (object, group) {
            (object, "") => object.to_owned(),
            ("", group) => group.to_owned(),
            (object, group) => format!("{object}/{group}"),
        };
        let next = self.groups.len() as u32;
        let g = *self.by_name.entry(group.clone()).or_insert(next);
        if g == next {
            self.groups.push(group);
        }
        let next = self.materials.len() as u32;
        let m = *self.by_material.entry(material.to_owned()).or_insert(next);
        if m == next {
            self.materials.push(material.to_owned());
        }
        let next = self.parts.len();
        let part = *self.by_part.entry((g, m)).or_insert(next);
        if part == next {
            self.parts.push(((g, m), Vec::new()));
        }
        part
    }

    fn face(&mut self, line: u32, rest: &str, part: usize) -> Result<(), SceneError> {
        let mut corners = std::mem::take(&mut self.corners);
        corners.clear();
        for word in rest.split_ascii_whitespace() {
            corners.push(self.corner(line, word)?);
            if corners.len() > MAX_CORNERS {
                let problem = format!("the face has more than {MAX_CORNERS} vertices");
                return Err(wrong(self.file, line, problem, "split it"));
            }
        }
        if corners.len() < 3 {
            let problem = format!("a face has {} vertices, expected at least 3", corners.len());
            return Err(wrong(self.file, line, problem, REPAIR));
        }
        let faces = &mut self.parts[part].1;
        for pair in corners[1..].windows(2) {
            let triangle = [corners[0], pair[0], pair[1]];
            let normals = triangle.map(|(_, normal)| normal.map(|n| self.normals[n as usize]));
            let sum = match normals {
                [Some(a), Some(b), Some(c)] => Some([0, 1, 2].map(|i| a[i] + b[i] + c[i])),
                _ => None,
            };
            faces.push((triangle.map(|(vertex, _)| vertex), sum));
        }
        self.triangles += corners.len() as u64 - 2;
        self.corners = corners;
        if self.triangles > MAX_TRIANGLES {
            return Err(SceneError::TooMany {
                scene: self.file.to_string(),
                what: "triangles",
                count: self.triangles,
                limit: MAX_TRIANGLES,
            });
        }
        Ok(())
    }

    /// `vertex`, `vertex/texture`, `vertex//normal` or `vertex/texture/normal`.
    fn corner(&self, line: u32, word: &str) -> Result<Corner, SceneError> {
        let mut parts = word.split('/');
        let mut next = |what: &str, count: usize| match parts.next() {
            None | Some("") => Ok(None),
            Some(text) => self.index(line, text, what, count).map(Some),
        };
        let vertex = next("vertex", self.positions.len())?;
        next("texture coordinate", self.textures)?;
        let normal = next("normal", self.normals.len())?;
        let missing = || {
            wrong(
                self.file,
                line,
                format!("`{}` names no vertex", shown(word)),
                REPAIR,
            )
        };
        Ok((vertex.ok_or_else(missing)?, normal))
    }

    /// An index from 1, or from -1 for the last one so far, as one from 0.
    fn index(&self, line: u32, text: &str, what: &str, count: usize) -> Result<u32, SceneError> {
        let number: i64 = text.parse().map_err(|_| {
            let problem = format!("`{}` is no index of a {what}", shown(text));
            wrong(self.file, line, problem, REPAIR)
        })?;
        let count = count as i64;
        let index = if number < 0 {
            count.saturating_add(number)
        } else {
            number - 1
        };
        if !(0..count).contains(&index) {
            let problem = format!("it refers to {what} {number}, but there are only {count} before it");
            return Err(wrong(self.file, line, problem, REPAIR));
        }
        u32::try_from(index).map_err(|_| wrong(self.file, line, "it has too many vertices", "split the file"))
    }

    /// A node for each group, a primitive for each of its materials.
    fn finish(self, library: Library, data: &mut SceneData, notes: &mut Notes) {
        let place = Place {
            file: Rc::clone(self.file),
            line: 0,
        };
        for name in &self.materials {
            let found = library.materials.get(name);
            if found.is_none() && !name.is_empty() {
                let kind = format!("material `{}` is in no library, and taken as grey", shown(name));
                notes.add(&place, kind);
            }
            data.materials.push(found.cloned().unwrap_or_else(|| Material {
                name: name.clone(),
                base_color: [0.5; 3],
                ..Material::default()
            }));
        }
        for material in data.materials.iter().filter(|material| material.is_clear()) {
            if !emits(material.radiance) {
                notes.add(
                    &place,
                    "surfaces that let half of the light through or more are left out",
                );
            }
        }
        let mut meshes: Vec<Mesh> = self
            .groups
            .iter()
            .map(|name| Mesh {
                name: name.clone(),
                primitives: Vec::new(),
            })
            .collect();
        let mut place_of = vec![u32::MAX; self.positions.len()];
        for ((group, material), faces) in &self.parts {
            let lights = emits(data.materials[*material as usize].radiance);
            let mut primitive = Primitive {
                material: *material,
                ..Primitive::default()
            };
            let mut used = Vec::new();
            for (triangle, normal) in faces {
                let mut triangle = *triangle;
                if lights && normal.is_some_and(|normal| self.faces_away(triangle, normal)) {
                    triangle.swap(1, 2);
                }
                primitive.triangles.push(triangle.map(|vertex| {
                    let place = &mut place_of[vertex as usize];
                    if *place == u32::MAX {
                        *place = used.len() as u32;
                        used.push(vertex);
                    }
                    *place
                }));
            }
            primitive.positions = used
                .iter()
                .map(|&vertex| self.positions[vertex as usize])
                .collect();
            for vertex in used {
                place_of[vertex as usize] = u32::MAX;
            }
            meshes[*group as usize].primitives.push(primitive);
        }
        for (index, mesh) in (0..).zip(meshes) {
            data.nodes.push(Node {
                name: mesh.name.clone(),
                mesh: Some(index),
                ..Node::default()
            });
            data.meshes.push(mesh);
        }
    }

    fn faces_away(&self, triangle: [u32; 3], normal: [f32; 3]) -> bool {
        let [a, b, c] = triangle.map(|vertex| self.positions[vertex as usize].map(f64::from));
        dot(cross(sub(b, a), sub(c, a)), normal.map(f64::from)) < 0.0
    }
}

//! Vertices, faces, groups.

use std::collections::HashMap;
use std::rc::Rc;

use super::super::error::SceneError;
use super::super::files::{Load, without_mark};
use super::super::frame::emits;
use super::super::glow::Glow;
use super::super::model::{Material, Mesh, Node, Primitive, SceneData};
use super::super::notes::{Notes, Place};
use super::super::polygon::Cutter;
use super::lines::{Lines, numbers, shown, split};
use super::mtl::Library;
use super::{REPAIR, beside, wrong};
use crate::vector::{cross, dot, sub};

/// Most vertices of a polygon.
const MAX_CORNERS: usize = 1 << 16;

/// A corner of a face: a vertex, and texture coordinates and a normal where it has them.
type Corner = (u32, Option<u32>, Option<u32>);

/// A triangle.
struct Face {
    vertices: [u32; 3],
    /// Texture coordinates of each; [`NONE`] for a corner without.
    coordinates: [u32; 3],
    /// The sum of its normals where all its corners have one.
    normal: Option<[f32; 3]>,
}

/// No texture coordinates.
const NONE: u32 = u32::MAX;

/// What a file has said so far.
struct Reading<'a> {
    file: &'a Rc<str>,
    positions: Vec<[f32; 3]>,
    normals: Vec<[f32; 3]>,
    coordinates: Vec<[f32; 2]>,
    /// Names of groups, in the order of their first face.
    groups: Vec<String>,
    by_name: HashMap<String, u32>,
    /// Names of materials, in the order of their first face.
    materials: Vec<String>,
    by_material: HashMap<String, u32>,
    /// By group and material, in the order of their first face.
    parts: Vec<((u32, u32), Vec<Face>)>,
    by_part: HashMap<(u32, u32), usize>,
    load: &'a Load,
    /// Of the face that is read.
    corners: Vec<Corner>,
    places: Vec<[f32; 3]>,
    cutter: Cutter,
}

/// Reads all of a file into a scene.
pub(super) fn read(
    file: &Rc<str>,
    bytes: &[u8],
    load: &Load,
    data: &mut SceneData,
    notes: &mut Notes,
) -> Result<(), SceneError> {
    let mut reading = Reading {
        file,
        positions: Vec::new(),
        normals: Vec::new(),
        coordinates: Vec::new(),
        groups: Vec::new(),
        by_name: HashMap::new(),
        materials: Vec::new(),
        by_material: HashMap::new(),
        parts: Vec::new(),
        by_part: HashMap::new(),
        load,
        corners: Vec::new(),
        places: Vec::new(),
        cutter: Cutter::default(),
    };
    let mut library = Library::new(load);
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
            "vt" => {
                let lies = texture_coordinates(rest);
                if lies.is_none() {
                    notes.add(
                        &place(),
                        "texture coordinates that are no numbers, or beyond 2^20, count as 0",
                    );
                }
                reading.coordinates.push(lies.unwrap_or_default());
            }
            "f" => {
                let part = *part.get_or_insert_with(|| reading.part(&object, &group, &material));
                reading.face(line, rest, part, notes)?;
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
            "mtllib" => libraries(rest, load, &mut library, &place(), notes)?,
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
    load: &Load,
    library: &mut Library<'_>,
    place: &Place,
    notes: &mut Notes,
) -> Result<(), SceneError> {
    let Some(folder) = load.folder() else {
        notes.add(
            place,
            "material libraries are left out, as there is no folder to look in",
        );
        return Ok(());
    };
    let rest = rest.replace('\\', "/");
    let whole = beside(load, folder, rest.trim());
    let paths = if whole.is_file() {
        vec![whole]
    } else {
        rest.split_ascii_whitespace()
            .map(|name| beside(load, folder, name))
            .collect()
    };
    for path in paths {
        match load.read(&path) {
            Ok(bytes) => {
                let name = path.display().to_string();
                library.read(&name, without_mark(&name, &bytes)?, path.parent(), notes)?;
            }
            Err(error) if error.ends_the_load() => return Err(error),
            Err(error) => notes.add(place, format!("a material library is left out: {error}")),
        }
    }
    Ok(())
}

/// Greatest texture coordinate, as a scene takes them.
const FARTHEST: f32 = (1 << 20) as f32;

/// One or two coordinates, a third is left out; `None` where they are no numbers or lie too far.
fn texture_coordinates(rest: &str) -> Option<[f32; 2]> {
    let mut words = rest.split_ascii_whitespace();
    let next = |word: Option<&str>| {
        let value: f32 = word?.parse().ok()?;
        (-FARTHEST..=FARTHEST).contains(&value).then_some(value)
    };
    let first = next(words.next())?;
    let second = words.next();
    let second = if second.is_some() { next(second)? } else { 0.0 };
    Some([first, second])
}

/// The corners of a part: equal ones once. Time and memory are in proportion to the part.
struct Corners<'a> {
    /// Of parts that are painted, corners with texture coordinates of their own.
    by_both: Option<HashMap<(u32, u32), u32>>,
    /// Of others, by vertex; [`NONE`] of all before and after.
    by_vertex: &'a mut [u32],
    used: Vec<(u32, u32)>,
}

impl Corners<'_> {
    fn index(&mut self, corner: (u32, u32)) -> u32 {
        let next = self.used.len() as u32;
        let place = match &mut self.by_both {
            Some(known) => known.entry(corner).or_insert(NONE),
            None => &mut self.by_vertex[corner.0 as usize],
        };
        if *place == NONE {
            *place = next;
            self.used.push(corner);
        }
        *place
    }

    /// What there is, in the order in which it came.
    fn finish(self) -> Vec<(u32, u32)> {
        for &(vertex, _) in &self.used {
            self.by_vertex[vertex as usize] = NONE;
        }
        self.used
    }
}

/// What a corner names.
struct Index {
    what: &'static str,
    /// As it stands in the file.
    number: i64,
    /// How many there are before it.
    count: i64,
    /// From 0, where there is such a one.
    found: Option<u32>,
}

impl Index {
    fn there(self, file: &str, line: u32) -> Result<u32, SceneError> {
        let Self {
            what, number, count, ..
        } = self;
        let problem = || format!("it refers to {what} {number}, but there are only {count} before it");
        self.found.ok_or_else(|| wrong(file, line, problem(), REPAIR))
    }
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

    fn face(&mut self, line: u32, rest: &str, part: usize, notes: &mut Notes) -> Result<(), SceneError> {
        let mut corners = std::mem::take(&mut self.corners);
        corners.clear();
        let mut lacks_normals = false;
        for word in rest.split_ascii_whitespace() {
            let (corner, lacks_normal) = self.corner(line, word)?;
            corners.push(corner);
            lacks_normals |= lacks_normal;
            if corners.len() > MAX_CORNERS {
                let problem = format!("the face has more than {MAX_CORNERS} vertices");
                return Err(wrong(self.file, line, problem, "split it"));
            }
        }
        if corners.len() < 3 {
            let problem = format!("a face has {} vertices, expected at least 3", corners.len());
            return Err(wrong(self.file, line, problem, REPAIR));
        }
        if lacks_normals {
            let file = Rc::clone(self.file);
            notes.add(
                &Place { file, line },
                "faces that name normals that are not before them are read without normals; export the file again, or with its normals",
            );
        }
        let places = &mut self.places;
        places.clear();
        places.extend((corners.iter()).map(|&(vertex, _, _)| self.positions[vertex as usize]));
        let faces = &mut self.parts[part].1;
        let cut = self.cutter.cut(places, |triangle| {
            let triangle = triangle.map(|k| corners[k]);
            let normals = triangle.map(|(_, _, normal)| normal.map(|n| self.normals[n as usize]));
            let normal = match normals {
                [Some(a), Some(b), Some(c)] => Some([0, 1, 2].map(|i| a[i] + b[i] + c[i])),
                _ => None,
            };
            faces.push(Face {
                vertices: triangle.map(|(vertex, _, _)| vertex),
                coordinates: triangle.map(|(_, texture, _)| texture.unwrap_or(NONE)),
                normal,
            });
        });
        cut.map_err(|problem| wrong(self.file, line, problem, "export the file with triangles"))?;
        let bytes = (size_of::<Face>() * corners.len()) as u64;
        self.corners = corners;
        self.load.take(self.file, "the list of triangles", bytes)
    }

    /// `vertex`, `vertex/texture`, `vertex//normal` or `vertex/texture/normal`; and whether it names a normal that is not there.
    fn corner(&self, line: u32, word: &str) -> Result<(Corner, bool), SceneError> {
        let mut parts = word.split('/');
        let mut next = |what: &'static str, count: usize| match parts.next() {
            None | Some("") => Ok(None),
            Some(text) => self.index(line, text, what, count).map(Some),
        };
        let there = |index: Index| index.there(self.file, line);
        let vertex = next("vertex", self.positions.len())?.map(there).transpose()?;
        let texture = next("texture coordinate", self.coordinates.len())?;
        let texture = texture.map(there).transpose()?;
        // The shape is whole without it.
        let named = next("normal", self.normals.len())?;
        let normal = named.as_ref().and_then(|index| index.found);
        let lacks_normal = named.is_some() && normal.is_none();
        let missing = || {
            wrong(
                self.file,
                line,
                format!("`{}` names no vertex", shown(word)),
                REPAIR,
            )
        };
        Ok(((vertex.ok_or_else(missing)?, texture, normal), lacks_normal))
    }

    /// An index from 1, or from -1 for the last one so far.
    fn index(&self, line: u32, text: &str, what: &'static str, count: usize) -> Result<Index, SceneError> {
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
        let found = u32::try_from(index).ok().filter(|_| index < count);
        if found.is_none() && (0..count).contains(&index) {
            return Err(wrong(
                self.file,
                line,
                "it has too many vertices",
                "split the file",
            ));
        }
        Ok(Index {
            what,
            number,
            count,
            found,
        })
    }

    /// A node for each group, a primitive for each of its materials.
    fn finish(self, library: Library<'_>, data: &mut SceneData, notes: &mut Notes) {
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
        // Programs write `d 0` for what a picture's alpha cuts out.
        let is_left_out = |own: &Material| own.is_clear() && !emits(own.radiance);
        if data.materials.iter().all(is_left_out) && !data.materials.is_empty() {
            notes.add(
                &place,
                "all surfaces let half of the light through or more: they are taken as opaque",
            );
            for material in &mut data.materials {
                material.transmission = 0.0;
            }
        }
        for _ in data.materials.iter().filter(|own| is_left_out(own)) {
            notes.add(
                &place,
                "surfaces that let half of the light through or more are left out",
            );
        }
        let mut meshes: Vec<Mesh> = self
            .groups
            .iter()
            .map(|name| Mesh {
                name: name.clone(),
                primitives: Vec::new(),
            })
            .collect();
        let mut place_of = vec![NONE; self.positions.len()];
        let glow_of = |material: u32| library.glows.get(&self.materials[material as usize]);
        for ((group, material), faces) in &self.parts {
            let own = &data.materials[*material as usize];
            let glow = glow_of(*material);
            let lights = emits(own.radiance) || glow.is_some();
            let is_painted = own.paint.is_some();
            let mut primitive = Primitive {
                material: *material,
                ..Primitive::default()
            };
            let mut corners = Corners {
                by_both: is_painted.then(HashMap::new),
                by_vertex: &mut place_of,
                used: Vec::new(),
            };
            for face in faces {
                let mut order = [0, 1, 2];
                if lights
                    && face
                        .normal
                        .is_some_and(|normal| self.faces_away(face.vertices, normal))
                {
                    order.swap(1, 2);
                }
                let corner = |k: usize| (face.vertices[k], face.coordinates[k]);
                primitive.triangles.push(order.map(|k| corners.index(corner(k))));
            }
            let used = corners.finish();
            let lies = |(_, texture): &(u32, u32)| {
                let known = self.coordinates.get(*texture as usize);
                known.copied().unwrap_or_default()
            };
            primitive.positions = used
                .iter()
                .map(|&(vertex, _)| self.positions[vertex as usize])
                .collect();
            let has_some = used.iter().any(|&(_, texture)| texture != NONE);
            if is_painted && has_some {
                let coordinates: Vec<_> = used.iter().map(lies).collect();
                if let Some(glow) = glow {
                    let factor = own.paint.map_or([0.0; 3], |paint| paint.radiance);
                    let steps = Glow::max_steps(primitive.triangles.len());
                    let radiance = primitive.triangles.iter().map(|triangle| {
                        let corners = triangle.map(|vertex| coordinates[vertex as usize]);
                        let mean = glow.mean_over(corners, steps);
                        [0, 1, 2].map(|k| mean[k] * factor[k])
                    });
                    primitive.radiance = Some(radiance.collect());
                }
                primitive.coordinates = Some(coordinates);
            }
            meshes[*group as usize].primitives.push(primitive);
        }
        data.pictures = library.into_kept();
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

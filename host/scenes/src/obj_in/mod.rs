//! Wavefront OBJ in, with its MTL libraries.
//!
//! Read:
//! - polygons, cut into triangles, also concave ones; indices from 1, or negative ones from the end; lines that go on after `\`;
//! - objects and groups, each a node of its own with a primitive for each material: a mesh light is what a group has of a
//!   material that emits;
//! - `Kd`, `Ks` of mirrors (`illum` 3 and 5), `Ns` and `Pr` as roughness, `Pm` as metallic, `d` and `Tr`, glass (`illum` 4, 6,
//!   7 and 9), `Ke`;
//! - `map_Kd` with the opacity of `map_d`, and `map_Ke`, which are shown; lights have the mean of `map_Ke` over each triangle.
//!
//! Where vertices of a face that emits have normals, they say which side emits; else its front does, as in glTF. The format has
//! no unit and no camera: coordinates are metres, +Y is up, and `Ke` is radiance in W/(m² sr).
//!
//! The crate `tobj` is not used: it panics at `Kd 1 2` and at relative texture indices beyond the first.

mod mtl;
#[cfg(test)]
mod tests;

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use super::error::{SceneError, malformed};
use super::files::{Limits, Load, without_mark};
use super::glow::Glow;
use super::model::{Material, Mesh, Node, Primitive, SceneData, emits};
use super::notes::Notes;
use super::polygon::Cutter;
use super::scene::Scene;
use crate::vector::{dot, normal};
use mtl::Library;

const REPAIR: &str = "repair the line, or export the file again";

/// What a group has of a material.
#[derive(Default)]
struct Part {
    group: String,
    material: String,
    primitive: Primitive,
    /// Vertices by their numbers of a position and of texture coordinates.
    known: HashMap<(u32, Option<u32>), u32>,
    coordinates: Vec<[f32; 2]>,
    has_coordinates: bool,
    /// By triangle: whether the normals of its corners face away from its front.
    faces_away: Vec<bool>,
}

/// A file so far.
struct Reading<'a> {
    file: &'a str,
    load: &'a Load,
    notes: Notes,
    positions: Vec<[f32; 3]>,
    normals: Vec<[f32; 3]>,
    coordinates: Vec<[f32; 2]>,
    /// In the order of their first face.
    parts: Vec<Part>,
    by_names: HashMap<(String, String), usize>,
    cutter: Cutter,
}

impl Scene {
    /// Reads an `.obj` file in memory and the material libraries that it names, and checks it; `name` stands for the path in
    /// messages, `folder` is where material libraries lie (`None`: there are none).
    ///
    /// # Errors
    /// What [`Scene::new`] refuses, and unreadable, truncated or malformed files.
    pub fn read_obj_slice(name: &str, bytes: &[u8], folder: Option<&Path>) -> Result<Self, SceneError> {
        Self::read_obj(name, bytes, &Load::new(folder, &Limits::default())?)
    }

    pub(super) fn read_obj(file: &str, bytes: &[u8], load: &Load) -> Result<Self, SceneError> {
        let mut reading = Reading {
            file,
            load,
            notes: Notes::default(),
            positions: Vec::new(),
            normals: Vec::new(),
            coordinates: Vec::new(),
            parts: Vec::new(),
            by_names: HashMap::new(),
            cutter: Cutter::default(),
        };
        let mut library = Library::new(load);
        let (mut object, mut group, mut material) = (String::new(), String::new(), String::new());
        // The part that faces go to, until a name changes.
        let mut part = None;
        for (line, text) in lines(&String::from_utf8_lossy(without_mark(file, bytes)?)) {
            let (word, rest) = split(&text);
            match word {
                "v" => reading.positions.push(numbers::<3>(file, line, rest)?),
                "vn" => reading.normals.push(numbers::<3>(file, line, rest)?),
                // A third one is left out; one that is no number is bounded with the scene's others.
                "vt" => {
                    let mut words = rest.split_ascii_whitespace();
                    let next = |_| words.next().map_or(0.0, |word| word.parse().unwrap_or(f32::NAN));
                    reading.coordinates.push([0, 1].map(next));
                }
                "f" => {
                    let part = *part.get_or_insert_with(|| reading.part(&object, &group, &material));
                    reading.face(line, rest, part)?;
                }
                "o" | "g" | "usemtl" => {
                    part = None;
                    let rest = rest.to_owned();
                    match word {
                        "o" => (object, group) = (rest, String::new()),
                        "g" => group = rest,
                        _ => material = rest,
                    }
                }
                "mtllib" => reading.libraries(line, rest, &mut library)?,
                "l" | "p" | "curv" | "curv2" | "surf" => {
                    reading.note(
                        line,
                        format!("elements `{word}` are left out; only faces are read"),
                    );
                }
                _ => {}
            }
        }
        Self::loaded(reading.finish(library), load)
    }
}

impl Reading<'_> {
    fn note(&mut self, line: u32, what: impl Into<String>) {
        self.notes.add(format!("{} line {line}", self.file), what);
    }

    /// Reads the libraries that a line names: one, whose name may have spaces, or several.
    fn libraries(&mut self, line: u32, rest: &str, library: &mut Library<'_>) -> Result<(), SceneError> {
        let Some(folder) = self.load.folder() else {
            self.note(
                line,
                "material libraries are left out, as there is no folder to look in",
            );
            return Ok(());
        };
        let rest = rest.replace('\\', "/");
        let whole = beside(self.load, folder, rest.trim());
        let several = rest
            .split_ascii_whitespace()
            .map(|name| beside(self.load, folder, name));
        let paths: Vec<PathBuf> = if whole.is_file() {
            vec![whole]
        } else {
            several.collect()
        };
        for path in paths {
            match self.load.read(&path) {
                Ok(bytes) => library.read(&path, &bytes, &mut self.notes)?,
                Err(error) if error.ends_the_load() => return Err(error),
                Err(error) => self.note(line, format!("a material library is left out: {error}")),
            }
        }
        Ok(())
    }

    /// The place in `parts` of what a group has of a material.
    fn part(&mut self, object: &str, group: &str, material: &str) -> usize {
        let group = match (object, group) {
            (object, "") => object.to_owned(),
            ("", group) => group.to_owned(),
            (object, group) => format!("{object}/{group}"),
        };
        let (next, material) = (self.parts.len(), material.to_owned());
        let part = *self
            .by_names
            .entry((group.clone(), material.clone()))
            .or_insert(next);
        if part == next {
            self.parts.push(Part {
                group,
                material,
                ..Part::default()
            });
        }
        part
    }

    fn face(&mut self, line: u32, rest: &str, part: usize) -> Result<(), SceneError> {
        let wrong = |problem: String| wrong(self.file, line, problem);
        let mut corners: Vec<(u32, Option<u32>, Option<u32>)> = Vec::new();
        for word in rest.split_ascii_whitespace() {
            // `vertex`, `vertex/texture`, `vertex//normal` or `vertex/texture/normal`.
            let mut parts = word.split('/');
            let mut next = |what, count| index(parts.next().unwrap_or(""), what, count).map_err(wrong);
            let vertex = next("vertex", self.positions.len())?;
            let vertex = vertex.ok_or_else(|| wrong(format!("`{}` names no vertex", shown(word))))?;
            let texture = next("texture coordinate", self.coordinates.len())?;
            // The shape is whole without it, and some exporters leave out normals that they name.
            let normal = next("normal", self.normals.len()).unwrap_or(None);
            corners.push((vertex, texture, normal));
        }
        if corners.len() < 3 {
            let problem = format!("a face has {} vertices, expected at least 3", corners.len());
            return Err(wrong(problem));
        }
        let places = corners.iter().map(|corner| self.positions[corner.0 as usize]);
        let places: Vec<[f32; 3]> = places.collect();
        let part = &mut self.parts[part];
        let cut = self.cutter.cut(&places, |triangle| {
            let front = normal(triangle.map(|k| places[k]));
            let normals = triangle.map(|k| corners[k].2.map(|n| self.normals[n as usize]));
            part.faces_away.push(match normals {
                [Some(a), Some(b), Some(c)] => {
                    dot(front, [0, 1, 2].map(|i| f64::from(a[i] + b[i] + c[i]))) < 0.0
                }
                _ => false,
            });
            let triangle = triangle.map(|k| {
                let (position, texture, _) = corners[k];
                *part.known.entry((position, texture)).or_insert_with(|| {
                    let lies = texture.map(|texture| self.coordinates[texture as usize]);
                    part.has_coordinates |= lies.is_some();
                    part.coordinates.push(lies.unwrap_or_default());
                    part.primitive.positions.push(places[k]);
                    part.primitive.positions.len() as u32 - 1
                })
            });
            part.primitive.triangles.push(triangle);
        });
        cut.map_err(wrong)?;
        let bytes = (size_of::<[[u32; 3]; 6]>() * corners.len()) as u64;
        self.load.take(self.file, "the list of triangles", bytes)
    }

    /// A node for each group, a primitive for each of its materials.
    fn finish(mut self, library: Library<'_>) -> SceneData {
        let mut data = SceneData {
            name: self.file.to_owned(),
            ..SceneData::default()
        };
        let (mut groups, mut materials) = (HashMap::new(), HashMap::new());
        let parts = std::mem::take(&mut self.parts);
        // The mesh and the material of each part.
        let mut numbers = Vec::new();
        for Part { group, material, .. } in &parts {
            let mesh = *groups.entry(group).or_insert_with(|| {
                data.nodes.push(Node {
                    name: group.clone(),
                    mesh: Some(data.meshes.len() as u32),
                    ..Node::default()
                });
                data.meshes.push(Mesh {
                    name: group.clone(),
                    primitives: Vec::new(),
                });
                data.meshes.len() - 1
            });
            let number = *materials.entry(material).or_insert_with(|| {
                let found = library.materials.get(material);
                if found.is_none() && !material.is_empty() {
                    let name = shown(material);
                    let what = format!("material `{name}` is in no library, and taken as grey");
                    self.notes.add(self.file, what);
                }
                let grey = || Material {
                    name: material.clone(),
                    base_color: [0.5; 3],
                    ..Material::default()
                };
                data.materials
                    .push(found.map_or_else(grey, |found| found.material.clone()));
                data.materials.len() as u32 - 1
            });
            numbers.push((mesh, number));
        }
        // Clear surfaces would hide the lamps behind them. Programs write `d 0` for what a picture's alpha cuts out.
        let of = |part: &Part| library.materials.get(&part.material);
        let is_clear = |part: &Part| of(part).is_some_and(|own| own.is_clear);
        let is_all_clear = parts.iter().all(is_clear);
        for (part, (mesh, material)) in parts.into_iter().zip(numbers) {
            if is_clear(&part) && !is_all_clear {
                let what = format!(
                    "material `{}` is clear, and its faces are left out",
                    shown(&part.material)
                );
                self.notes.add(self.file, what);
                continue;
            }
            let glow = of(&part).and_then(|own| own.glow.as_ref());
            let (mut primitive, coordinates) = (part.primitive, part.coordinates);
            primitive.material = material;
            let own = &data.materials[material as usize];
            // Normals say which side emits.
            if emits(own.radiance) || glow.is_some() {
                let away = primitive.triangles.iter_mut().zip(part.faces_away);
                away.filter(|(_, away)| *away)
                    .for_each(|(triangle, _)| triangle.swap(1, 2));
            }
            if let Some(paint) = own.paint.filter(|_| part.has_coordinates) {
                let radiance =
                    |glow: &Glow| glow.radiance(&primitive.triangles, &coordinates, paint.radiance);
                primitive.radiance = glow.map(radiance);
                primitive.coordinates = Some(coordinates);
            }
            data.meshes[mesh].primitives.push(primitive);
        }
        data.pictures = library.into_pictures();
        data.warnings = self.notes.into_warnings();
        data
    }
}

/// Lines without comments, those that go on after `\` as one, each with its number from 1.
fn lines(text: &str) -> impl Iterator<Item = (u32, String)> + '_ {
    let mut lines = (1..).zip(text.lines().map(str::trim));
    std::iter::from_fn(move || {
        let (number, line) = lines.next()?;
        let mut text = line.to_owned();
        // A comment ends with its line.
        while !line.starts_with('#') && text.ends_with('\\') {
            text.pop();
            text.push(' ');
            text += lines.next().map_or("", |(_, line)| line);
        }
        // Names have such signs too.
        let comment = text.match_indices('#').find(|(at, _)| {
            let before = text[..*at].chars().next_back();
            before.is_none_or(|before| before.is_ascii_whitespace())
        });
        if let Some((comment, _)) = comment {
            text.truncate(comment);
        }
        Some((number, text))
    })
}

/// The first word, and what comes after it.
fn split(line: &str) -> (&str, &str) {
    let line = line.trim();
    line.split_once(|c: char| c.is_ascii_whitespace())
        .map_or((line, ""), |(word, rest)| (word, rest.trim()))
}

/// The first `N` numbers of a line, where there are as many.
fn numbers<const N: usize>(file: &str, line: u32, text: &str) -> Result<[f32; N], SceneError> {
    let words = text.split_ascii_whitespace().take(N);
    let numbers = words.map(|word| word.parse().ok().filter(|value: &f32| value.is_finite()));
    let numbers: Option<Vec<f32>> = numbers.collect();
    let numbers = numbers.and_then(|numbers| numbers.try_into().ok());
    numbers.ok_or_else(|| {
        let problem = format!("expected {N} numbers, found `{}`", shown(text));
        wrong(file, line, problem)
    })
}

/// An index from 1, or from -1 for the last one so far; none for an empty text.
fn index(text: &str, what: &str, count: usize) -> Result<Option<u32>, String> {
    if text.is_empty() {
        return Ok(None);
    }
    let no_index = |_| format!("`{}` is no index of a {what}", shown(text));
    let number: i64 = text.parse().map_err(no_index)?;
    let index = match number < 0 {
        true => (count as i64).saturating_add(number),
        false => number - 1,
    };
    let found = u32::try_from(index)
        .ok()
        .filter(|&index| (index as usize) < count);
    let missing = || format!("it refers to {what} {number}, but there are only {count} before it");
    found.ok_or_else(missing).map(Some)
}

/// The beginning of a text, for messages.
fn shown(text: &str) -> String {
    text.chars().take(60).collect()
}

/// What is wrong with a line.
fn wrong(file: &str, line: u32, problem: String) -> SceneError {
    malformed(format!("{file}, line {line}"), problem, REPAIR)
}

/// A file by a path from `folder`, or by its name alone: exporters write paths of their own machine.
fn beside(load: &Load, folder: &Path, name: &str) -> PathBuf {
    let path = folder.join(name);
    let alone = Path::new(name).file_name().map(|name| folder.join(name));
    match alone {
        Some(alone) if !load.permits(&path) && load.permits(&alone) => alone,
        _ => path,
    }
}

//! Wavefront OBJ in, with `Kd` and `Ke` of its MTL libraries.
//!
//! Polygons are cut into fans around their first corner, which is exact for convex ones. Objects and groups become a node for
//! each of their materials: a mesh light is what a group has of a material that emits. The front of a face emits, as in glTF.
//! The format has no unit and no camera: coordinates are metres, +Y is up, and `Ke` is radiance in W/(m² sr).
//!
//! The crate `tobj` is not used: it panics at `Kd 1 2`, and its errors name no line.

use std::collections::{BTreeSet, HashMap, HashSet};
use std::path::{Path, PathBuf};

use super::error::{SceneError, malformed, short};
use super::files::{Limits, Load, without_mark};
use super::model::{Material, Mesh, Node, Primitive, SceneData};
use super::notes::Notes;
use super::scene::Scene;

/// Most words that a warning names.
const NAMED: usize = 20;

/// What a group has of a material.
#[derive(Default)]
struct Part {
    primitive: Primitive,
    /// Vertices by the numbers of their positions.
    known: HashMap<u32, u32>,
}

/// A file so far.
struct Reading<'a> {
    file: &'a str,
    load: &'a Load,
    notes: Notes,
    /// Words of the libraries that are not read.
    left_out: BTreeSet<String>,
    positions: Vec<[f32; 3]>,
    /// In the order of their first face, with the names of a group and a material.
    parts: Vec<((String, String), Part)>,
    by_names: HashMap<(String, String), usize>,
    /// The libraries that were read.
    libraries: HashSet<PathBuf>,
    materials: HashMap<String, Material>,
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
            left_out: BTreeSet::new(),
            positions: Vec::new(),
            parts: Vec::new(),
            by_names: HashMap::new(),
            libraries: HashSet::new(),
            materials: HashMap::new(),
        };
        let (mut object, mut group, mut material) = ("", "", "");
        // The part that faces go to, until a name changes.
        let mut part = None;
        for (line, word, rest) in lines(&String::from_utf8_lossy(without_mark(file, bytes)?)) {
            match word {
                "v" => reading.positions.push(three(file, line, rest)?),
                "f" => {
                    let own = part.map_or_else(|| reading.part([object, group], material), Ok)?;
                    part = Some(own);
                    reading.face(line, rest, own)?;
                }
                "o" | "g" | "usemtl" => {
                    part = None;
                    match word {
                        "o" => (object, group) = (rest, ""),
                        "g" => group = rest,
                        _ => material = rest,
                    }
                }
                "mtllib" => reading.material_file(line, rest)?,
                "l" | "p" | "curv" | "curv2" | "surf" => {
                    reading.note(line, format!("`{word}` is left out; only faces are read"));
                }
                _ => {}
            }
        }
        Self::loaded(reading.finish(), load)
    }
}

impl Reading<'_> {
    fn note(&mut self, line: u32, what: impl Into<String>) {
        self.notes.add(format!("{} line {line}", self.file), what);
    }

    /// Reads an MTL file.
    fn material_file(&mut self, line: u32, name: &str) -> Result<(), SceneError> {
        // Without a folder nothing is permitted.
        let folder = self.load.folder().unwrap_or(Path::new(""));
        let path = folder.join(name.replace('\\', "/"));
        let real = self.load.real(&path);
        if real
            .as_ref()
            .is_ok_and(|real| !self.libraries.insert(real.clone()))
        {
            return Ok(());
        }
        let bytes = match real.and_then(|real| self.load.read_any(&real)) {
            Ok(bytes) => bytes,
            Err(error) if error.ends_the_load() && self.load.folder().is_some() => return Err(error),
            Err(error) => {
                self.note(line, format!("a material library is left out: {error}"));
                return Ok(());
            }
        };
        let file = path.display().to_string();
        let mut materials = Vec::<Material>::new();
        for (line, word, rest) in lines(&String::from_utf8_lossy(without_mark(&file, &bytes)?)) {
            match (word, materials.last_mut()) {
                ("newmtl", _) => materials.push(Material {
                    name: rest.to_owned(),
                    base_color: [0.8; 3],
                    ..Material::default()
                }),
                ("Kd", Some(own)) => own.base_color = three(&file, line, rest)?.map(|x| x.clamp(0.0, 1.0)),
                ("Ke", Some(own)) => own.radiance = three(&file, line, rest)?,
                _ if self.left_out.len() < NAMED => _ = self.left_out.insert(short(word)),
                _ => {}
            }
        }
        let by_name = materials.into_iter().map(|own| (own.name.clone(), own));
        self.materials.extend(by_name);
        Ok(())
    }

    /// The place in `parts` of what a group has of a material.
    fn part(&mut self, [object, group]: [&str; 2], material: &str) -> Result<usize, SceneError> {
        // The key, and the names of a node, a mesh and a material; one that is known is copied and hashed too.
        let bytes = 8 * (object.len() + group.len() + material.len());
        self.load.take(self.file, "the names of groups", bytes as u64)?;
        let group = format!("{object}/{group}").trim_matches('/').to_owned();
        let names = (group, material.to_owned());
        Ok(*self.by_names.entry(names.clone()).or_insert_with(|| {
            self.parts.push((names, Part::default()));
            self.parts.len() - 1
        }))
    }

    fn face(&mut self, line: u32, rest: &str, part: usize) -> Result<(), SceneError> {
        let count = self.positions.len();
        let Part { primitive, known } = &mut self.parts[part].1;
        let mut corners = Vec::new();
        for word in rest.split_ascii_whitespace() {
            // `vertex`, `vertex/texture`, `vertex//normal` or `vertex/texture/normal`: from 1, or from -1 for the last one so far.
            let index = match word.split('/').next().map(str::parse::<i64>) {
                Some(Ok(back @ ..0)) => count as i64 + back,
                Some(Ok(number)) => number - 1,
                _ => -1,
            };
            let Some(index) = usize::try_from(index).ok().filter(|&index| index < count) else {
                let problem = format!("`{}` names none of the {count} vertices before it", short(word));
                return Err(wrong(self.file, line, problem));
            };
            corners.push(*known.entry(index as u32).or_insert_with(|| {
                primitive.positions.push(self.positions[index]);
                primitive.positions.len() as u32 - 1
            }));
        }
        if corners.len() < 3 {
            let problem = format!("a face has {} vertices, expected at least 3", corners.len());
            return Err(wrong(self.file, line, problem));
        }
        let fan = (2..corners.len()).map(|k| [corners[0], corners[k - 1], corners[k]]);
        primitive.triangles.extend(fan);
        // A triangle, a position and its entry for each corner, in lists that grow to twice their length.
        self.load
            .take(self.file, "the list of triangles", 72 * corners.len() as u64)
    }

    /// A node for each part.
    fn finish(mut self) -> SceneData {
        let mut data = SceneData {
            name: self.file.to_owned(),
            ..SceneData::default()
        };
        let mut numbers = HashMap::new();
        for ((group, material), part) in self.parts {
            let number = *numbers.entry(material).or_insert_with_key(|name| {
                let found = self.materials.get(name).cloned();
                if found.is_none() && !name.is_empty() {
                    let what = format!("material `{}` is in no library, and taken as grey", short(name));
                    self.notes.add(self.file, what);
                }
                data.materials.push(found.unwrap_or_else(|| Material {
                    name: name.clone(),
                    base_color: [0.5; 3],
                    ..Material::default()
                }));
                data.materials.len() as u32 - 1
            });
            data.nodes.push(Node {
                name: group.clone(),
                mesh: Some(data.meshes.len() as u32),
                ..Node::default()
            });
            data.meshes.push(Mesh {
                name: group,
                primitives: vec![Primitive {
                    material: number,
                    ..part.primitive
                }],
            });
        }
        if !self.left_out.is_empty() {
            let words = self.left_out.into_iter().collect::<Vec<_>>().join("`, `");
            self.notes
                .add("", format!("words of materials are left out: `{words}`"));
        }
        data.warnings = self.notes.into_warnings();
        data
    }
}

/// The number from 1, the first word and the rest of each line that is more than a comment.
fn lines(text: &str) -> impl Iterator<Item = (u32, &str, &str)> {
    (1..).zip(text.lines()).filter_map(|(number, line)| {
        // Names have the sign of comments too, within words.
        let line = line.split(" #").next().unwrap_or("").trim();
        let (word, rest) = line
            .split_once(|c: char| c.is_ascii_whitespace())
            .unwrap_or((line, ""));
        (!word.is_empty() && !word.starts_with('#')).then(|| (number, word, rest.trim()))
    })
}

/// The first three numbers of a line.
fn three(file: &str, line: u32, text: &str) -> Result<[f32; 3], SceneError> {
    let mut words = text.split_ascii_whitespace().map(|word| word.parse().ok());
    let mut next = || words.next().flatten().filter(|value: &f32| value.is_finite());
    match [next(), next(), next()] {
        [Some(x), Some(y), Some(z)] => Ok([x, y, z]),
        _ => Err(wrong(
            file,
            line,
            format!("expected 3 numbers, found `{}`", short(text)),
        )),
    }
}

/// An error at a line.
fn wrong(file: &str, line: u32, problem: String) -> SceneError {
    malformed(
        format!("{file}, line {line}"),
        problem,
        "repair the line, or export the file again",
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROOM: &str = "# a lamp over a floor
mtllib room.mtl
v -1 0 -1
v 1 0 -1
v 1 0 1
v -1 0 1
o floor
usemtl grey#1 # of paint
f 4/1/1 3//2 2/1 1
v -0.5 1 -0.5
v 0.5 1 -0.5
v 0.5 1 0.5
v -0.5 1 0.5
o lamp
g panel
usemtl glow
f -4 -3 -2 -1
";

    const LIBRARY: &str =
        "newmtl grey#1\nKd 0.25 0.5 7\nNs 30\nnewmtl glow\nKd 0 0 0\nKe 4 5 6\nmap_Kd a.png\n";

    /// Reads a file with its library next to it, in a folder of its own.
    fn read(name: &str, obj: &str, mtl: &str) -> Result<Scene, SceneError> {
        let folder = std::env::temp_dir().join(format!("lightbvh-obj-{name}-{}", std::process::id()));
        std::fs::create_dir_all(folder.join("scene")).expect("a folder for files");
        for file in ["scene/room.mtl", "secret.mtl"] {
            std::fs::write(folder.join(file), mtl).expect("a folder for files");
        }
        let scene = Scene::read_obj_slice("room.obj", obj.as_bytes(), Some(&folder.join("scene")));
        let _ = std::fs::remove_dir_all(folder);
        scene
    }

    #[test]
    fn groups_materials_and_indices() {
        for text in [ROOM, &format!("\u{feff}{ROOM}")] {
            let scene = read("groups", text, LIBRARY).expect("valid");
            let data = scene.data();
            assert_eq!(
                scene.warnings(),
                ["words of materials are left out: `Ns`, `map_Kd`"]
            );
            assert_eq!(
                [&data.nodes[0].name, &data.nodes[1].name],
                ["floor", "lamp/panel"]
            );
            assert_eq!(data.meshes[0].primitives[0].triangles, [[0, 1, 2], [0, 2, 3]]);
            assert_eq!(data.materials[0].base_color, [0.25, 0.5, 1.0]);
            let frame = scene.frame(0);
            assert_eq!((frame.triangles.len(), frame.mesh_lights.len()), (4, 1));
            let lights = frame.emissive;
            assert_eq!(
                lights[1].p,
                [[-0.5, 1.0, -0.5], [0.5, 1.0, 0.5], [-0.5, 1.0, 0.5]]
            );
            assert_eq!((lights.len(), lights[0].radiance), (2, [4.0, 5.0, 6.0]));
        }
    }

    #[test]
    fn names_take_memory_at_each_change() {
        let faces = "usemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\n".repeat(2000);
        let obj = format!("v 0 0 0\nv 1 0 0\nv 0 1 0\no {}\n{faces}", "x".repeat(100_000));
        let error = Scene::read_obj_slice("x.obj", obj.as_bytes(), None).expect_err("too much");
        assert!(error.to_string().contains("the names of groups"), "{error}");
    }

    #[test]
    fn errors_name_the_line() {
        for (obj, line, problem) in [
            ("v 0 0 0\nf 1 2 3\n", 2, "`2` names none of the 1 vertices"),
            ("v 0 0\n", 1, "expected 3 numbers, found `0 0`"),
            ("v 0 0 nan\n", 1, "expected 3 numbers"),
            ("v 0 0 0\n\nf 1 1\n", 3, "2 vertices, expected at least 3"),
            ("v 0 0 0\nf\n", 2, "0 vertices"),
            ("v 0 0 0\nf 1 0 1\n", 2, "`0` names"),
            ("v 0 0 0\nf 1 -2 1\n", 2, "`-2` names"),
            ("v 0 0 0\nf 1 -9223372036854775808 1\n", 2, "names none"),
            ("v 0 0 0\nf 1 / 1\n", 2, "`/` names"),
        ] {
            let error = Scene::read_obj_slice("x.obj", obj.as_bytes(), None).expect_err(problem);
            let error = error.to_string();
            let place = format!("x.obj, line {line}: ");
            assert!(error.starts_with(&place) && error.contains(problem), "{error}");
        }
        let error = Scene::read_obj_slice("x.obj", b"v 0 0 0\n", None).expect_err("no face");
        assert!(matches!(error, SceneError::Empty { .. }), "{error}");
        for (mtl, problem) in [
            (LIBRARY.replace("0.25 0.5 7", "1 2"), "room.mtl, line 2"),
            (LIBRARY.replace("Ke 4", "Ke -4"), "light cannot be negative"),
        ] {
            let error = read("line", ROOM, &mtl).expect_err(problem).to_string();
            assert!(error.contains(problem), "{error}");
        }
    }

    #[test]
    fn libraries_lie_in_the_folder_or_are_left_out() {
        let error = read("outside", &ROOM.replace("room.mtl", "..\\secret.mtl"), LIBRARY);
        assert!(matches!(error, Err(SceneError::Outside { .. })), "{error:?}");
        // The format has no escapes: this is a name, of nothing.
        let scene = read("missing", &ROOM.replace("room.mtl", "%2e%2e/secret.mtl"), LIBRARY).expect("valid");
        let said = scene.warnings().join("\n");
        for part in [
            "line 2: a material library is left out",
            "`glow` is in no library",
        ] {
            assert!(scene.emissive_count() == 0 && said.contains(part), "{said}");
        }
    }
}

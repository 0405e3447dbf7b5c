//! Shapes: meshes of triangles, placed in the world or in an object.

use std::collections::hash_map::Entry;
use std::rc::Rc;

use super::super::error::SceneError;
use super::super::frame::emits;
use super::super::model::{Mesh, Primitive};
use super::super::notes::Place;
use super::super::ply_in::PlyMesh;
use super::super::transform::Affine;
use super::area::AreaLight;
use super::params::Params;
use super::state::{Loader, Placed};
use super::{REPAIR, resolve, shown, wrong};
use crate::vector::{cross, dot, sub};

/// Greatest texture coordinate, as a scene takes them.
const FARTHEST: f32 = (1 << 20) as f32;

/// Triangles in the space of their shape.
#[derive(Clone, Debug, Default)]
pub(super) struct Surface {
    pub positions: Vec<[f32; 3]>,
    /// One for each position, or none.
    pub normals: Vec<[f32; 3]>,
    /// Texture coordinates of each position, or none.
    pub coordinates: Vec<[f32; 2]>,
    /// Counter-clockwise seen from the side that emits, unless normals say otherwise.
    pub triangles: Vec<[u32; 3]>,
    /// How many triangles in a row are one light of pbrt.
    pub per_light: usize,
}

impl Surface {
    /// Coordinates as pbrt has them of meshes that do not say any: of each triangle (0, 0), (1, 0), (1, 1), of each patch its
    /// own corners. Every triangle gets vertices of its own.
    fn lie_by_default(&mut self) {
        const LOWER: [[f32; 2]; 3] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]];
        const UPPER: [[f32; 2]; 3] = [[0.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let is_patch = self.per_light == 2;
        let corners = self.triangles.as_flattened().iter();
        self.positions = corners
            .clone()
            .map(|&vertex| self.positions[vertex as usize])
            .collect();
        if !self.normals.is_empty() {
            self.normals = corners.map(|&vertex| self.normals[vertex as usize]).collect();
        }
        self.coordinates = (0..self.triangles.len())
            .flat_map(|t| if is_patch && t % 2 == 1 { UPPER } else { LOWER })
            .collect();
        for (triangle, first) in self.triangles.iter_mut().zip((0..).step_by(3)) {
            *triangle = [first, first + 1, first + 2];
        }
    }
}

impl Loader<'_> {
    /// `Shape "kind"`.
    pub fn shape(&mut self, kind: &str, params: &Params) -> Result<(), SceneError> {
        let Some(material) = self.material_with_alpha(params) else {
            return Ok(());
        };
        let before = std::mem::replace(&mut self.graphics.material, material);
        self.shape_of(kind, params)?;
        self.graphics.material = before;
        Ok(())
    }

    fn shape_of(&mut self, kind: &str, params: &Params) -> Result<(), SceneError> {
        match kind {
            "trianglemesh" => self.triangle_mesh(params, "trianglemesh"),
            "loopsubdiv" => {
                self.note(
                    &params.place,
                    "subdivision surfaces are replaced by their control meshes",
                );
                self.triangle_mesh(params, "loopsubdiv")
            }
            "bilinearmesh" => self.bilinear_mesh(params),
            "plymesh" => self.ply_mesh(params),
            "sphere" => self.sphere(params),
            "disk" => self.disk(params),
            "cylinder" => self.cylinder(params),
            _ => {
                self.note(
                    &params.place,
                    format!("shapes of kind `{}` are left out", shown(kind)),
                );
                Ok(())
            }
        }
    }

    fn triangle_mesh(&mut self, params: &Params, name: &str) -> Result<(), SceneError> {
        let positions = params.points("P")?;
        if params.find("P").is_none() {
            return Err(wrong(&params.place, "the mesh has no `P`", REPAIR));
        }
        let indices = if params.find("indices").is_some() {
            params.indices("indices", positions.len())?
        } else if positions.len() == 3 {
            vec![0, 1, 2]
        } else {
            return Err(wrong(&params.place, "the mesh has no `indices`", REPAIR));
        };
        let (triangles, rest) = indices.as_chunks::<3>();
        if !rest.is_empty() {
            let problem = format!("`indices` has {} numbers, not a multiple of 3", indices.len());
            return Err(wrong(&params.place, problem, REPAIR));
        }
        let mut normals = params.points("N")?;
        if !normals.is_empty() && normals.len() != positions.len() {
            self.note(
                &params.place,
                "normals that are not as many as the positions are left out",
            );
            normals.clear();
        }
        let coordinates = self.texture_coordinates(params, positions.len());
        let surface = Surface {
            positions,
            normals,
            coordinates,
            triangles: triangles.to_vec(),
            per_light: 1,
        };
        self.add(move || surface, name.into(), None, &params.place)
    }

    fn bilinear_mesh(&mut self, params: &Params) -> Result<(), SceneError> {
        let positions = params.points("P")?;
        if params.find("P").is_none() {
            return Err(wrong(&params.place, "the mesh has no `P`", REPAIR));
        }
        let indices = if params.find("indices").is_some() {
            params.indices("indices", positions.len())?
        } else if positions.len() == 4 {
            vec![0, 1, 2, 3]
        } else {
            return Err(wrong(&params.place, "the mesh has no `indices`", REPAIR));
        };
        let (patches, rest) = indices.as_chunks::<4>();
        if !rest.is_empty() {
            let problem = format!("`indices` has {} numbers, not a multiple of 4", indices.len());
            return Err(wrong(&params.place, problem, REPAIR));
        }
        // Corners at (0,0), (1,0), (0,1), (1,1); the front is that of the first axis turned to the second.
        let halves = |&[a, b, c, d]: &[u32; 4]| [[a, b, d], [a, d, c]];
        let coordinates = self.texture_coordinates(params, positions.len());
        let surface = Surface {
            positions,
            normals: Vec::new(),
            coordinates,
            triangles: patches.iter().flat_map(halves).collect(),
            per_light: 2,
        };
        self.add(move || surface, "bilinearmesh".into(), None, &params.place)
    }

    /// Where the vertices of a mesh lie on pictures; none where that is not said of each.
    fn texture_coordinates(&mut self, params: &Params, vertices: usize) -> Vec<[f32; 2]> {
        let Some(param) = params.find_any(&["uv", "st"]) else {
            return Vec::new();
        };
        // Version 3 has them as floats.
        if !matches!(
            param.kind.as_str(),
            "point2" | "point" | "vector2" | "vector" | "float"
        ) {
            let kind = format!(
                "`{} {}` is read as `point2 {}`",
                shown(&param.kind),
                param.name,
                param.name
            );
            self.note(&params.place, kind);
        }
        let (pairs, rest) = param.numbers.as_chunks::<2>();
        if pairs.len() != vertices || !rest.is_empty() {
            self.note(
                &params.place,
                "texture coordinates that are not as many as the positions are left out",
            );
            return Vec::new();
        }
        pairs.iter().map(|pair| pair.map(|x| x as f32)).collect()
    }

    fn ply_mesh(&mut self, params: &Params) -> Result<(), SceneError> {
        let file = params.string("filename").unwrap_or_default();
        let Some(path) = resolve(self.folder, file) else {
            let problem = match file {
                "" => "a `plymesh` has no `filename`, and is left out; name a file",
                _ => "meshes in files are left out, as there is no folder to look in",
            };
            self.note(&params.place, problem);
            return Ok(());
        };
        let mesh = match self.meshes.entry(Rc::clone(&path)) {
            Entry::Occupied(known) => Rc::clone(known.get()),
            Entry::Vacant(place) => match PlyMesh::read(&path) {
                Ok(mesh) => Rc::clone(place.insert(Rc::new(mesh))),
                Err(error) => {
                    self.note(&params.place, format!("a mesh is left out: {error}"));
                    return Ok(());
                }
            },
        };
        if params.find("displacement").is_some() {
            self.note(&params.place, "textures of displacement are left out");
        }
        let name = path
            .file_stem()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned();
        let make = move || Surface {
            positions: mesh.positions.clone(),
            normals: mesh.normals.clone(),
            coordinates: mesh.coordinates.clone(),
            triangles: mesh.triangles.clone(),
            per_light: 1,
        };
        let key = format!("ply {}", path.display());
        self.add(make, name.into(), Some(key), &params.place)
    }

    /// Adds a shape with what attributes say of it; of two with the same `key` and the same attributes only one is made.
    pub fn add(
        &mut self,
        make: impl FnOnce() -> Surface,
        name: Rc<str>,
        key: Option<String>,
        place: &Place,
    ) -> Result<(), SceneError> {
        let graphics = self.graphics.clone();
        let key = key
            .filter(|_| graphics.area.is_none() && self.object.is_none())
            .map(|key| format!("{key} {} {}", graphics.material, graphics.is_reversed));
        if let Some(&mesh) = key.as_ref().and_then(|key| self.shared.get(key)) {
            self.placed.push(Placed {
                map: graphics.ctm,
                mesh,
                name,
            });
            return Ok(());
        }
        let mut surface = make();
        if surface.triangles.is_empty() {
            self.note(place, "shapes without triangles are left out");
            return Ok(());
        }
        self.count(surface.triangles.len())?;
        let paint = self.data.materials[graphics.material as usize].paint;
        let is_painted = paint.is_some_and(|paint| paint.textures().next().is_some());
        let shows_picture = is_painted && graphics.area.is_none();
        if shows_picture && surface.coordinates.is_empty() {
            surface.lie_by_default();
        }
        // Vertices that no triangle has take memory too.
        self.count(surface.positions.len() / 4)?;
        if graphics.area.is_some() {
            orient(&mut surface);
        }
        if graphics.is_reversed {
            for triangle in &mut surface.triangles {
                triangle.swap(1, 2);
            }
        }
        let far = |uv: &[f32; 2]| !uv.iter().all(|x| (-FARTHEST..=FARTHEST).contains(x));
        if surface.coordinates.iter().any(far) {
            self.note(place, "texture coordinates beyond 2^20 are left out");
            surface.coordinates.clear();
        }
        if is_painted && (surface.coordinates.is_empty() || graphics.area.is_some()) {
            self.note(
                place,
                "surfaces that shine, and those whose texture coordinates are left out, show the mean colours of their pictures",
            );
        }
        let mut primitive = Primitive {
            material: graphics.material,
            // What emits shows no pictures.
            coordinates: (shows_picture && !surface.coordinates.is_empty())
                .then(|| std::mem::take(&mut surface.coordinates)),
            ..Primitive::default()
        };
        if let Some(area) = &graphics.area {
            let radiance = if area.power.is_some() {
                primitive.radiance = Some(radiances(area, &surface, &graphics.ctm));
                [0.0; 3]
            } else {
                area.radiance_of(0.0)
            };
            primitive.material = self.emitting(graphics.material, radiance, area.is_two_sided);
        }
        primitive.triangles = surface.triangles;
        let Some((_, primitives)) = &mut self.object else {
            primitive.positions = surface.positions;
            let mesh = self.data.meshes.len() as u32;
            self.data.meshes.push(Mesh {
                name: name.to_string(),
                primitives: vec![primitive],
            });
            if let Some(key) = key {
                self.shared.insert(key, mesh);
            }
            self.placed.push(Placed {
                map: graphics.ctm,
                mesh,
                name,
            });
            return Ok(());
        };
        // Objects have their shapes' transforms in them.
        let moved = |p: &[f32; 3]| graphics.ctm.point(p.map(f64::from)).map(|x| x as f32);
        primitive.positions = surface.positions.iter().map(moved).collect();
        if graphics.ctm.mirrors() {
            for triangle in &mut primitive.triangles {
                triangle.swap(1, 2);
            }
        }
        primitives.push(primitive);
        if graphics.area.is_some() {
            self.note(
                place,
                "shapes in objects shine in each instance, where pbrt leaves their light out",
            );
        }
        Ok(())
    }

    /// A material that emits.
    fn emitting(&mut self, material: u32, radiance: [f32; 3], is_two_sided: bool) -> u32 {
        let key = (material, radiance.map(f32::to_bits), is_two_sided);
        if let Some(&known) = self.emitting.get(&key) {
            return known;
        }
        let mut own = self.data.materials[material as usize].clone();
        own.radiance = radiance;
        own.double_sided = is_two_sided;
        own.paint = None;
        if emits(radiance) {
            own.name = format!("{} that emits", own.name);
        }
        let index = self.add_material(own);
        self.emitting.insert(key, index);
        index
    }
}

/// Turns triangles whose normals lie behind them.
fn orient(surface: &mut Surface) {
    if surface.normals.len() != surface.positions.len() {
        return;
    }
    for triangle in &mut surface.triangles {
        let of = |list: &[[f32; 3]], i: usize| list[triangle[i] as usize].map(f64::from);
        let [a, b, c] = [0, 1, 2].map(|i| of(&surface.positions, i));
        let front = cross(sub(b, a), sub(c, a));
        let sum: f64 = (0..3).map(|i| dot(front, of(&surface.normals, i))).sum();
        if sum < 0.0 {
            triangle.swap(1, 2);
        }
    }
}

/// Radiance of each triangle of lights whose power is given.
fn radiances(area: &AreaLight, surface: &Surface, map: &Affine) -> Vec<[f32; 3]> {
    let size = |triangle: &[u32; 3]| {
        let [a, b, c] = triangle.map(|vertex| map.point(surface.positions[vertex as usize].map(f64::from)));
        let n = cross(sub(b, a), sub(c, a));
        0.5 * dot(n, n).sqrt()
    };
    let lights = surface.triangles.chunks(surface.per_light.max(1));
    lights
        .flat_map(|light| {
            let radiance = area.radiance_of(light.iter().map(size).sum());
            std::iter::repeat_n(radiance, light.len())
        })
        .collect()
}

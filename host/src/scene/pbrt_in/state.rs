//! What a file has said so far.

use std::collections::HashMap;
use std::path::Path;
use std::rc::Rc;

use super::super::check::MAX_TRIANGLES;
use super::super::error::SceneError;
use super::super::model::{Material, Primitive, SceneData};
use super::super::notes::{Notes, Place};
use super::super::picture_file::Pictures;
use super::super::ply_in::PlyMesh;
use super::super::transform::Affine;
use super::area::AreaLight;
use super::camera::Camera;
use super::infinite::Infinite;
use super::light::Small;
use super::params::Param;
use super::texture::Texture;

/// What attributes hold.
#[derive(Clone)]
pub(super) struct Graphics {
    /// From the space of shapes to the world.
    pub ctm: Affine,
    /// Whether transforms change the time at which frames are seen, the first.
    pub is_start_active: bool,
    pub is_reversed: bool,
    /// Index into [`SceneData::materials`].
    pub material: u32,
    pub area: Option<Rc<AreaLight>>,
    /// Parameters by `Attribute`, each with what it is for.
    pub attributes: Rc<Vec<(String, Rc<Param>)>>,
}

/// What a pushed state is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scope {
    Attributes,
    /// Only transforms, in versions before the fourth.
    Transforms,
    Object,
}

/// What stands somewhere: a mesh by index.
pub(super) struct Placed {
    pub map: Affine,
    pub mesh: u32,
    pub name: Rc<str>,
}

/// A file under way.
pub(super) struct Loader<'a> {
    pub folder: Option<&'a Path>,
    pub data: SceneData,
    pub notes: Notes,
    pub graphics: Graphics,
    pub stack: Vec<(Scope, Graphics)>,
    pub spaces: HashMap<String, Affine>,
    pub textures: HashMap<String, Texture>,
    pub materials: HashMap<String, u32>,
    /// Materials that emit, by what they are without, radiance and whether both sides emit.
    pub emitting: HashMap<(u32, [u32; 3], bool), u32>,
    /// Materials that cover a part of what is behind them, by what they are without and that part.
    pub blended: HashMap<(u32, u32), u32>,
    pub pictures: Pictures,
    pub meshes: HashMap<Rc<Path>, Rc<PlyMesh>>,
    /// Meshes that may stand in several places, by what they are made of.
    pub shared: HashMap<String, u32>,
    pub objects: HashMap<String, u32>,
    /// The object under way.
    pub object: Option<(String, Vec<Primitive>)>,
    pub placed: Vec<Placed>,
    pub quadrics: u32,
    /// Whole spheres that shine from both sides, so far.
    pub shells: u32,
    pub small: Vec<Small>,
    pub infinite: Vec<Infinite>,
    pub camera: Option<Camera>,
    /// Columns and rows.
    pub film: [f64; 2],
    pub triangles: u64,
    pub files: u32,
    pub bytes: u64,
}

impl<'a> Loader<'a> {
    pub fn new(name: &str, folder: Option<&'a Path>) -> Self {
        let data = SceneData {
            name: name.to_owned(),
            materials: vec![Material {
                base_color: [0.5; 3],
                ..Material::default()
            }],
            ..SceneData::default()
        };
        Self {
            folder,
            data,
            notes: Notes::default(),
            graphics: Graphics {
                ctm: Affine::IDENTITY,
                is_start_active: true,
                is_reversed: false,
                material: 0,
                area: None,
                attributes: Rc::default(),
            },
            stack: Vec::new(),
            spaces: HashMap::new(),
            textures: HashMap::new(),
            materials: HashMap::new(),
            emitting: HashMap::new(),
            blended: HashMap::new(),
            pictures: Pictures::default(),
            meshes: HashMap::new(),
            shared: HashMap::new(),
            objects: HashMap::new(),
            object: None,
            placed: Vec::new(),
            quadrics: 0,
            shells: 0,
            small: Vec::new(),
            infinite: Vec::new(),
            camera: None,
            film: [1280.0, 720.0],
            triangles: 0,
            files: 0,
            bytes: 0,
        }
    }

    /// See [`Notes::add`].
    pub fn note(&mut self, place: &Place, kind: impl Into<String>) {
        self.notes.add(place, kind);
    }

    /// Counts triangles that are kept in memory.
    pub fn count(&mut self, triangles: usize) -> Result<(), SceneError> {
        self.triangles += triangles as u64;
        if self.triangles > MAX_TRIANGLES {
            return Err(SceneError::TooMany {
                scene: self.data.name.clone(),
                what: "triangles",
                count: self.triangles,
                limit: MAX_TRIANGLES,
            });
        }
        Ok(())
    }

    /// Appends a material.
    pub fn add_material(&mut self, material: Material) -> u32 {
        self.data.materials.push(material);
        self.data.materials.len() as u32 - 1
    }
}

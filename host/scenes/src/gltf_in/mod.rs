//! glTF 2.0 in: `.gltf` with external or embedded buffers, and `.glb`.
//!
//! The `gltf` crate gives the JSON model and the parts of `.glb`. Its other readers index buffers by numbers from the file and
//! panic on hostile ones, so buffers are read here, every range checked before it is used and every count before anything is
//! allocated for it.
//!
//! Read:
//! - triangles, strips and fans, in plain and quantised accessors (`KHR_mesh_quantization`), compressed views
//!   (`EXT_meshopt_compression`, `KHR_meshopt_compression`) and Draco streams (`KHR_draco_mesh_compression`);
//! - instances, animation of nodes in all interpolations, perspective cameras;
//! - metallic-roughness factors and base colour textures; emission by factor, texture (averaged per triangle where lights are chosen) and
//!   `KHR_materials_emissive_strength`; `doubleSided`; alpha that cuts out, blended alpha as if cut at a half;
//! - pictures in PNG, JPEG, WebP (`EXT_texture_webp`) and KTX 2 by Basis Universal (`KHR_texture_basisu`), placed by
//!   `KHR_texture_transform`. One that cannot be had is noted and counts
//!   as white, and where it is what glows as black;
//! - `KHR_materials_transmission`: surfaces are left out from a factor of a half on, and so are blended ones below an opacity of
//!   a half, unless they emit;
//! - `KHR_lights_punctual`: points and spots; directional lights are left out, which no tree holds.
//!
//! Radiance is taken as W/(m² sr) where glTF says nits; only the exposure differs. The rest is left out with a note in
//! [`super::SceneData::warnings`], or refused by name where the file says that it is required; of required extensions that only
//! refine the look of surfaces (`KHR_materials_*`) there is a note too.

mod accessor;
mod animation;
mod attributes;
mod container;
mod draco;
mod extensions;
mod image;
mod ktx2;
mod light;
mod material;
mod mesh;
mod meshopt;
mod node;
mod texture;

use std::borrow::Cow;
use std::cell::{OnceCell, RefCell};
use std::fmt::Display;
use std::path::Path;

use gltf::json;

use super::error::{SceneError, malformed};
use super::files::{Limits, Load};
use super::model::SceneData;
use super::notes::Notes;
use super::scene::Scene;

/// Attribute of vertices, without the underscore: radiance of the triangle that the vertex belongs to. Written by
/// [`super::glb_out`] for emission that differs from triangle to triangle; glTF leaves names with `_` to applications.
pub(super) const RADIANCE_ATTRIBUTE: &str = "RADIANCE";

/// Key in the scene's `extras`: background radiance, three numbers.
pub(super) const BACKGROUND_EXTRA: &str = "lightbvh_background";

/// What to do about what cannot be unpacked, and about data that contradict each other.
const UNPACK: &str = "unpack the file, for example with `gltf-transform copy`, or export it again";
const DAMAGED: &str = "the file is damaged; export it again";

impl Scene {
    /// Reads a `.gltf` or `.glb` file in memory and checks it; `name` stands for the path in messages, `folder` is where
    /// external buffers and images lie (`None`: there are none).
    ///
    /// # Errors
    /// What [`Scene::new`] refuses, and unreadable, truncated or malformed files.
    pub fn read_gltf_slice(name: &str, bytes: &[u8], folder: Option<&Path>) -> Result<Self, SceneError> {
        Self::read_gltf(name, bytes, &Load::new(folder, &Limits::default())?)
    }

    pub(super) fn read_gltf(name: &str, bytes: &[u8], load: &Load) -> Result<Self, SceneError> {
        let (text, binary) = container::split(name, bytes)?;
        let (root, pointers) = container::parse(name, &text)?;
        container::check_version(name, &root.asset)?;
        let mut document = Document {
            path: name,
            load,
            root: &root,
            buffers: Vec::new(),
            unpacked: vec![OnceCell::new(); root.buffer_views.len()],
            pictures: RefCell::default(),
            notes: RefCell::default(),
        };
        document.check_extensions()?;
        if pointers > 0 {
            let what = format!("{pointers} channels of animations move no node, and are left out");
            document.note("", what);
        }
        document.buffers = container::buffers(&document, binary)?;
        let mut data = SceneData {
            name: name.to_owned(),
            ..SceneData::default()
        };
        let mut looks = material::read(&document)?;
        data.meshes = mesh::read(&document, &mut looks)?;
        data.materials = looks.into_iter().map(|look| look.material).collect();
        let order = node::read(&document, &mut data)?;
        light::punctual(&document, &order, &mut data);
        data.animations = animation::read(&document, &order)?;
        data.pictures = document.pictures.take().into_kept();
        data.warnings = document.notes.take().into_warnings();
        Self::loaded(data, load)
    }
}

/// A parsed file and what has been read of it.
struct Document<'a> {
    path: &'a str,
    load: &'a Load,
    root: &'a json::Root,
    /// By index; each has the length that the JSON claims, or none where it only stands in for compressed data.
    buffers: Vec<Cow<'a, [u8]>>,
    /// What compressed views hold, by view, once it has been asked for.
    unpacked: Vec<OnceCell<Vec<u8>>>,
    pictures: RefCell<image::Pictures>,
    notes: RefCell<Notes>,
}

impl Document<'_> {
    fn malformed(&self, element: impl Display, problem: impl Into<String>, advice: &str) -> SceneError {
        malformed(format!("{}: {element}", self.path), problem, advice)
    }

    /// See [`Notes::add`].
    fn note(&self, element: &str, what: impl Into<String>) {
        self.notes.borrow_mut().add(element, what);
    }

    /// `list[index]`, or an error that names who asked.
    fn get<'r, T>(
        &self,
        list: &'r [T],
        index: json::Index<T>,
        what: &str,
        element: &str,
    ) -> Result<&'r T, SceneError> {
        list.get(index.value()).ok_or_else(|| {
            let problem = format!(
                "refers to {what} {}, but there are only {}",
                index.value(),
                list.len()
            );
            self.malformed(element, problem, "repair the reference or export the file again")
        })
    }
}

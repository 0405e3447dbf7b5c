//! glTF 2.0 in: `.gltf` with external or embedded buffers, and `.glb`.
//!
//! The `gltf` crate gives the JSON model only. Its own readers index buffers by numbers from the file and panic on
//! hostile ones, so buffers are read here, every range checked before it is used and every count before anything is
//! allocated for it.
//!
//! Read:
//! - triangles, strips and fans, in plain, sparse and quantised accessors (`KHR_mesh_quantization`), compressed views
//!   (`EXT_meshopt_compression`, `KHR_meshopt_compression`) and Draco streams (`KHR_draco_mesh_compression`);
//! - instances (`EXT_mesh_gpu_instancing` too), animation of nodes and of weights in all interpolations, skins and morph
//!   targets, perspective cameras;
//! - metallic-roughness factors and textures, or specular-glossiness factors (`KHR_materials_pbrSpecularGlossiness`); normal
//!   textures; emission by factor, texture (averaged per triangle where lights are chosen) and
//!   `KHR_materials_emissive_strength`; `doubleSided`; alpha that cuts out or blends;
//! - pictures in PNG, JPEG, WebP (`EXT_texture_webp`) and KTX 2 (`KHR_texture_basisu`: eight bits a channel, plain or by
//!   Zstandard, and what Basis Universal makes), placed by `KHR_texture_transform`. One that cannot be had is noted and counts
//!   as white, and where it is what glows as black;
//! - `KHR_materials_transmission`, by its factor and the mean of its texture: from a half on, light goes straight through and
//!   is tinted. Where [`super::Paint`] is not shown, such surfaces, and blended ones, are left out unless they emit
//!   ([`super::Material::is_clear`]);
//! - `KHR_materials_unlit`: the colour is emitted, so that it is seen as it is, and nothing is reflected. It lights what is near;
//! - `EXT_lights_ies`: photometric files (ANSI/IES LM-63, types A, B and C) become lights of the tree with a profile.
//! - `KHR_lights_punctual`: points and spots are lights of the tree, suns stand beside it. Ranges are not applied, which is said.
//!
//! Radiance is taken as W/(m² sr) where glTF says nits; only the exposure differs. The rest is left out with a note in
//! [`super::SceneData::warnings`], or refused by name where the file says that it is required; of required extensions that only
//! refine the look of surfaces (`KHR_materials_*`) there is a note too.

mod accessor;
mod animation;
mod asset;
mod attributes;
mod bend;
mod container;
mod draco;
mod emission;
mod extensions;
mod ies;
mod image;
mod instancing;
mod ktx2;
mod material;
mod mesh;
mod meshopt;
mod node;
mod paint;
mod punctual;
#[cfg(test)]
mod tests;
mod texture;

pub use asset::Asset;

use std::borrow::Cow;
use std::cell::{OnceCell, RefCell};
use std::path::Path;

use gltf::json;

use super::error::SceneError;
use super::files::{Limits, Load};
use super::model::{Scene, SceneData};

/// Attribute of vertices, without the underscore: radiance of the triangle that the vertex belongs to. Written by
/// [`super::glb_out`] for emission that differs from triangle to triangle; glTF leaves names with `_` to applications.
pub(super) const RADIANCE_ATTRIBUTE: &str = "RADIANCE";

pub(super) use ies::NAME as IES;

/// Key in the scene's `extras`: background radiance, three numbers.
pub(super) const BACKGROUND_EXTRA: &str = "lightbvh_background";

/// Warnings kept; the rest is counted.
const MAX_WARNINGS: usize = 50;

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
        let (root, pointers) = container::parse(name, text)?;
        let mut document = Document {
            path: name,
            load,
            root: &root,
            buffers: Vec::new(),
            unpacked: vec![OnceCell::new(); root.buffer_views.len()],
            pictures: RefCell::default(),
            warnings: RefCell::default(),
        };
        document.check_extensions()?;
        if pointers > 0 {
            document.warn(format!(
                "{pointers} channels of animations move no node, and are left out"
            ));
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
        bend::skins(&document, &order, &mut data)?;
        punctual::read(&document, &order, &mut data)?;
        ies::read(&document, &order, &mut data)?;
        (data.animations, data.idle) = animation::read(&document, &order)?;
        data.pictures = document.pictures.take().into_kept();
        data.warnings = document.into_warnings();
        data.part_clips();
        Self::loaded(data, load)
    }
}

/// What is said of several elements, said once: `materials[0], materials[3] and 7 more: ...`.
fn grouped(warnings: Vec<String>) -> Vec<String> {
    let mut groups: Vec<(Vec<String>, String)> = Vec::new();
    for warning in warnings {
        let said = warning
            .split_once(": ")
            .filter(|(element, _)| element.ends_with(']'));
        let (elements, what) = match said {
            Some((element, what)) => (vec![element.to_owned()], what.to_owned()),
            None => (Vec::new(), warning),
        };
        match groups
            .iter_mut()
            .find(|(of, known)| !of.is_empty() && !elements.is_empty() && *known == what)
        {
            // Several textures of an element say the same.
            Some((of, _)) if of.last() == elements.last() => {}
            Some((of, _)) => of.extend(elements),
            None => groups.push((elements, what)),
        }
    }
    let line = |(elements, what): (Vec<String>, String)| {
        let named = elements
            .iter()
            .take(3)
            .map(String::as_str)
            .collect::<Vec<_>>()
            .join(", ");
        match elements.len() {
            0 => what,
            1..=3 => format!("{named}: {what}"),
            more => format!("{named} and {} more: {what}", more - 3),
        }
    };
    groups.into_iter().map(line).collect()
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
    warnings: RefCell<Vec<String>>,
}

impl Document<'_> {
    fn malformed(
        &self,
        element: impl Into<String>,
        problem: impl Into<String>,
        advice: &'static str,
    ) -> SceneError {
        let path = self.path.to_owned();
        SceneError::Malformed {
            path,
            element: element.into(),
            problem: problem.into(),
            advice,
        }
    }

    fn unsupported(
        &self,
        element: impl Into<String>,
        feature: impl Into<String>,
        advice: &'static str,
    ) -> SceneError {
        self.malformed(element, format!("{} is not supported", feature.into()), advice)
    }

    fn warn(&self, warning: String) {
        self.warnings.borrow_mut().push(warning);
    }

    fn into_warnings(self) -> Vec<String> {
        let mut warnings = grouped(self.warnings.into_inner());
        if warnings.len() > MAX_WARNINGS {
            let more = warnings.len() - MAX_WARNINGS;
            warnings.truncate(MAX_WARNINGS);
            warnings.push(format!("and {more} more"));
        }
        warnings
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

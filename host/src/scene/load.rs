//! Scenes by name or path.

use std::path::Path;

use super::error::SceneError;
use super::model::Scene;
use super::{carousel, square, stage, street};

/// Names of the built-in scenes that commands take by default.
pub const BUILT_IN: [&str; 3] = ["street", "square", "carousel"];

/// Name of a further one, which has lights of every kind. Those stand for the paper's, of triangles alone.
pub const STAGE: &str = "stage";

impl Scene {
    /// Opens a built-in scene by name, or a file by path: `.pbrt`, `.obj` and `.ply`, each as it is or with `.gz` after it, or
    /// `.gltf` and `.glb`, which is also what files of other names are taken for.
    ///
    /// # Errors
    /// [`SceneError::UnknownScene`] for what is neither; what [`Scene::read_gltf`], [`Scene::read_pbrt`], [`Scene::read_obj`] and
    /// [`Scene::read_ply`] refuse.
    pub fn open(spec: &str) -> Result<Self, SceneError> {
        match spec {
            "street" => return street::street(),
            "square" => return square::square(),
            "carousel" => return carousel::carousel(),
            STAGE => return stage::stage(),
            _ => {}
        }
        let path = Path::new(spec);
        let name = spec.to_ascii_lowercase();
        let name = name.strip_suffix(".gz").unwrap_or(&name);
        if name.ends_with(".pbrt") {
            return Self::read_pbrt(path);
        }
        if name.ends_with(".obj") {
            return Self::read_obj(path);
        }
        if name.ends_with(".ply") {
            return Self::read_ply(path);
        }
        let is_gltf = path.extension().is_some_and(|extension| {
            extension.eq_ignore_ascii_case("gltf") || extension.eq_ignore_ascii_case("glb")
        });
        // A bare word is more likely a misspelt name than a file without an extension.
        if is_gltf || path.is_file() {
            return Self::read_gltf(path);
        }
        Err(SceneError::UnknownScene {
            name: spec.to_owned(),
            built_in: format!("{}, {STAGE}", BUILT_IN.join(", ")),
        })
    }
}

//! Scenes by name or path.

use std::path::Path;

use super::error::SceneError;
use super::model::Scene;
use super::{carousel, square, street};

/// Names of the built-in scenes.
pub const BUILT_IN: [&str; 3] = ["street", "square", "carousel"];

impl Scene {
    /// Opens a built-in scene by name, or a `.gltf` or `.glb` file by path.
    ///
    /// # Errors
    /// [`SceneError::UnknownScene`] for what is neither; what [`Scene::read_gltf`] refuses.
    pub fn open(spec: &str) -> Result<Self, SceneError> {
        match spec {
            "street" => return street::street(),
            "square" => return square::square(),
            "carousel" => return carousel::carousel(),
            _ => {}
        }
        let path = Path::new(spec);
        let is_gltf = path.extension().is_some_and(|extension| {
            extension.eq_ignore_ascii_case("gltf") || extension.eq_ignore_ascii_case("glb")
        });
        // A bare word is more likely a misspelt name than a file without an extension.
        if is_gltf || path.is_file() {
            return Self::read_gltf(path);
        }
        Err(SceneError::UnknownScene {
            name: spec.to_owned(),
            built_in: BUILT_IN.join(", "),
        })
    }
}

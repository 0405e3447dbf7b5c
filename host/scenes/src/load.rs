//! Scenes by name or path.

use std::ffi::OsStr;
use std::path::Path;

use lightbvh::EmissiveTriangle;
use lightbvh_kernels::shading::trace::SurfaceTriangle;

use super::error::SceneError;
#[cfg(not(feature = "formats"))]
use super::error::not_compiled;
use super::files::{Limits, Load};
use super::model::SceneData;
use super::scene::Scene;
use super::{carousel, square, stage, street};

/// Names of the built-in scenes that commands take by default.
pub const BUILT_IN: [&str; 3] = ["street", "square", "carousel"];

/// Name of a further one, which has lights of every kind. Those stand for the paper's, of triangles alone.
pub const STAGE: &str = "stage";

impl Scene {
    /// Opens a built-in scene by name, or a file by path, within the usual [`Limits`]: `.obj`, `.gltf` or `.glb`. A
    /// file of another name is read as glTF.
    ///
    /// # Errors
    /// As [`Scene::open_within`].
    pub fn open(spec: impl AsRef<OsStr>) -> Result<Self, SceneError> {
        Self::open_within(spec.as_ref(), &Limits::default())
    }

    /// The same within `limits`.
    ///
    /// # Errors
    /// [`SceneError::UnknownScene`] if it is neither; what [`Scene::new`] refuses, and unreadable, truncated or malformed
    /// files; what `limits` do not permit.
    pub fn open_within(spec: &OsStr, limits: &Limits) -> Result<Self, SceneError> {
        match spec.to_str() {
            Some("street") => return street::street(),
            Some("square") => return square::square(),
            Some("carousel") => return carousel::carousel(),
            Some(STAGE) => return stage::stage(),
            _ => {}
        }
        let path = Path::new(spec);
        let name = path.display().to_string();
        let ends_in = |ending: &str| {
            let extension = path.extension();
            extension.is_some_and(|extension| extension.eq_ignore_ascii_case(ending))
        };
        // A bare word is more likely a misspelt name than a file without an extension.
        if !["obj", "gltf", "glb"].into_iter().any(ends_in) && !path.is_file() {
            let built_in = format!("{}, {STAGE}", BUILT_IN.join(", "));
            return Err(SceneError::UnknownScene(name, built_in));
        }
        let load = Load::new(path.parent(), limits)?;
        let bytes = load.read_any(path)?;
        #[cfg(not(feature = "formats"))]
        if ends_in("obj") {
            return Err(not_compiled(&name, "OBJ"));
        }
        #[cfg(feature = "formats")]
        if ends_in("obj") {
            return Self::read_obj(&name, &bytes, &load);
        }
        Self::read_gltf(&name, &bytes, &load)
    }

    /// Checks what a loader made, and that there is memory for its frames.
    pub(super) fn loaded(data: SceneData, load: &Load) -> Result<Self, SceneError> {
        let scene = Self::new(data)?;
        let triangles = size_of::<SurfaceTriangle>() * scene.counts.triangles;
        let lights = size_of::<EmissiveTriangle>() * scene.counts.emissive;
        load.take(
            scene.name(),
            "a frame with all instances",
            (triangles + lights) as u64,
        )?;
        Ok(scene)
    }
}

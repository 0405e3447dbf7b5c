//! Extensions: which are read, which change nothing that is used here, which are refused.

use gltf::json;
use serde::de::DeserializeOwned;
use serde_json::{Map, Value};

use super::super::error::{SceneError, not_compiled};
use super::Document;

/// Extensions that are read.
const READ: [&str; 14] = [
    "EXT_lights_ies",
    "EXT_mesh_gpu_instancing",
    "EXT_meshopt_compression",
    "EXT_texture_webp",
    "KHR_draco_mesh_compression",
    "KHR_lights_punctual",
    "KHR_materials_emissive_strength",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_mesh_quantization",
    "KHR_meshopt_compression",
    "KHR_texture_basisu",
    "KHR_texture_transform",
];

/// Extensions that only add what a renderer of lights has no use for: a file that requires one is shown nevertheless.
const HARMLESS: [&str; 4] = [
    "KHR_xmp",
    "KHR_xmp_json_ld",
    "EXT_structural_metadata",
    "EXT_mesh_features",
];

/// Extensions that this program may be compiled without.
const OPTIONAL: [&str; 5] = [
    "EXT_meshopt_compression",
    "EXT_texture_webp",
    "KHR_draco_mesh_compression",
    "KHR_meshopt_compression",
    "KHR_texture_basisu",
];

/// What refines surfaces; without it they look plainer.
const LOOK: &str = "KHR_materials_";

impl Document<'_> {
    /// Refuses files that require what is not read; notes what is left out.
    pub(super) fn check_extensions(&self) -> Result<(), SceneError> {
        for (index, name) in self.root.extensions_required.iter().enumerate() {
            let name = name.as_str();
            if OPTIONAL.contains(&name) && !cfg!(feature = "formats") {
                return Err(not_compiled(self.path, name));
            }
            if !READ.contains(&name) && !HARMLESS.contains(&name) && !name.starts_with(LOOK) {
                let advice = "export the file without this extension";
                let problem = format!("{name} is not supported");
                return Err(self.malformed(format!("extensionsRequired[{index}]"), problem, advice));
            }
        }
        for name in &self.root.extensions_used {
            if !READ.contains(&name.as_str()) {
                self.note("", format!("extension {name} is ignored"));
            }
        }
        Ok(())
    }

    /// The object of extension `name` among `others`. One that cannot be read is an error where the file requires it,
    /// and left out with a note where not.
    pub(super) fn extension<T: DeserializeOwned>(
        &self,
        others: &Map<String, Value>,
        name: &str,
        element: &str,
    ) -> Result<Option<T>, SceneError> {
        let Some(value) = others.get(name) else {
            return Ok(None);
        };
        match T::deserialize(value) {
            Ok(extension) => Ok(Some(extension)),
            Err(error) if self.requires(name) => {
                let element = format!("{element}.extensions.{name}");
                Err(self.malformed(element, error.to_string(), "export the file again"))
            }
            Err(error) => {
                self.note(element, format!("its extension {name} is ignored: {error}"));
                Ok(None)
            }
        }
    }

    pub(super) fn requires(&self, name: &str) -> bool {
        self.root
            .extensions_required
            .iter()
            .any(|required| required == name)
    }

    /// Whether a buffer without data stands in for compressed views.
    pub(super) fn is_fallback(&self, buffer: &json::Buffer) -> bool {
        let others = buffer.extensions.as_ref().map(|extensions| &extensions.others);
        let says = |name: &str| others?.get(name)?.get("fallback")?.as_bool();
        super::meshopt::NAMES.iter().any(|name| says(name) == Some(true))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn documentation_names_every_extension_that_is_read() {
        let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/scenes.md");
        let text = std::fs::read_to_string(path).expect("docs/scenes.md");
        for name in READ.iter().chain(&HARMLESS) {
            assert!(text.contains(&format!("`{name}`")), "{name}");
        }
    }
}

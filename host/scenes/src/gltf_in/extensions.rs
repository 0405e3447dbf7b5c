//! Extensions: which are read, which change nothing that is used here, which are refused.

use gltf::json;
use serde::de::DeserializeOwned;
use serde_json::{Map, Value};

use super::super::error::{SceneError, not_compiled};
use super::Document;

/// Extensions that are read, and whether the feature `formats` is needed for it.
const READ: [(&str, bool); 12] = [
    ("EXT_lights_ies", false),
    ("EXT_mesh_gpu_instancing", false),
    ("EXT_meshopt_compression", true),
    ("EXT_texture_webp", true),
    ("KHR_draco_mesh_compression", true),
    ("KHR_lights_punctual", false),
    ("KHR_materials_emissive_strength", false),
    ("KHR_materials_transmission", false),
    ("KHR_mesh_quantization", false),
    ("KHR_meshopt_compression", true),
    ("KHR_texture_basisu", true),
    ("KHR_texture_transform", false),
];

/// Extensions that only add what a renderer of lights has no use for: a file that requires one is shown nevertheless.
const HARMLESS: [&str; 4] = [
    "KHR_xmp",
    "KHR_xmp_json_ld",
    "EXT_structural_metadata",
    "EXT_mesh_features",
];

/// What refines surfaces; without it they look plainer.
const LOOK: &str = "KHR_materials_";

impl Document<'_> {
    /// Refuses files that require what is not read; notes what is left out.
    pub(super) fn check_extensions(&self) -> Result<(), SceneError> {
        for (index, name) in self.root.extensions_required.iter().enumerate() {
            let name = name.as_str();
            match READ.iter().find(|(read, _)| *read == name) {
                Some((_, true)) if !cfg!(feature = "formats") => return Err(not_compiled(self.path, name)),
                None if !HARMLESS.contains(&name) && !name.starts_with(LOOK) => {
                    let (element, problem) = (
                        format!("extensionsRequired[{index}]"),
                        format!("{name} is not supported"),
                    );
                    return Err(self.malformed(element, problem, "export the file without this extension"));
                }
                _ => {}
            }
        }
        for name in &self.root.extensions_used {
            if !READ.iter().any(|(read, _)| read == name) {
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
            Err(error) if self.root.extensions_required.iter().any(|own| own == name) => {
                let element = format!("{element}.extensions.{name}");
                Err(self.malformed(element, error.to_string(), "export the file again"))
            }
            Err(error) => {
                self.note(element, format!("its extension {name} is ignored: {error}"));
                Ok(None)
            }
        }
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
        for name in READ.iter().map(|(name, _)| name).chain(&HARMLESS) {
            assert!(text.contains(&format!("`{name}`")), "{name}");
        }
    }
}

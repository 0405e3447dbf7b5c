//! Who made a file: the `asset` of its JSON part (glTF 2.0, section 3.2).

use std::path::Path;

use serde::Serialize;

use super::super::error::SceneError;
use super::super::files::{Limits, Load};
use super::container;

/// What a glTF file says of itself.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Asset {
    /// A message that credits the creator.
    pub copyright: Option<String>,
    /// The program that wrote the file.
    pub generator: Option<String>,
}

impl Asset {
    /// Reads it from a `.gltf` or `.glb` file.
    ///
    /// # Errors
    /// [`SceneError`] for a file that is unreadable, truncated or no glTF.
    pub fn read(path: &Path) -> Result<Self, SceneError> {
        let name = path.display().to_string();
        let bytes = Load::new(None, &Limits::default())?.read_any(path)?;
        let (text, _) = container::split(&name, &bytes)?;
        let (root, _) = container::parse(&name, text)?;
        Ok(Self {
            copyright: root.asset.copyright,
            generator: root.asset.generator,
        })
    }
}

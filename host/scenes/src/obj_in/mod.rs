//! Wavefront OBJ in, with its MTL libraries.
//!
//! Read:
//! - polygons, cut into triangles, also concave ones; indices from 1, or negative ones from the end; lines that go on after `\`;
//! - objects and groups, each a node of its own with a primitive for each material: a mesh light is what a group has of a
//!   material that emits;
//! - `Kd`, `Ks` of mirrors (`illum` 3 and 5), `Ns` and `Pr` as roughness, `Pm` as metallic, `d` and `Tr`, glass (`illum` 4, 6,
//!   7 and 9), `Ke`;
//! - `map_Kd` with the opacity of `map_d`, and `map_Ke`, which are shown; lights have the mean of `map_Ke` over each triangle.
//!
//! Where vertices of a face that emits have normals, they say which side emits; else its front does, as in glTF. The format has
//! no unit and no camera: coordinates are metres, +Y is up, and `Ke` is radiance in W/(m² sr).
//!
//! The crate `tobj` is not used: it panics at `Kd 1 2` and at relative texture indices beyond the first, refuses faces that name
//! missing normals, and its errors name neither line nor value.

mod faces;
mod lines;
mod mtl;
mod pictures;
#[cfg(test)]
mod tests;

use std::path::{Path, PathBuf};
use std::rc::Rc;

use super::error::SceneError;
use super::files::{Limits, Load, without_mark};
use super::model::{Scene, SceneData};
use super::notes::Notes;

impl Scene {
    /// Reads an `.obj` file in memory and the material libraries that it names, and checks it; `name` stands for the path in
    /// messages, `folder` is where material libraries lie (`None`: there are none).
    ///
    /// # Errors
    /// What [`Scene::new`] refuses, and unreadable, truncated or malformed files.
    pub fn read_obj_slice(name: &str, bytes: &[u8], folder: Option<&Path>) -> Result<Self, SceneError> {
        Self::read_obj(name, bytes, &Load::new(folder, &Limits::default())?)
    }

    pub(super) fn read_obj(name: &str, bytes: &[u8], load: &Load) -> Result<Self, SceneError> {
        let bytes = without_mark(name, bytes)?;
        let mut notes = Notes::default();
        let mut data = SceneData {
            name: name.to_owned(),
            ..SceneData::default()
        };
        let file: Rc<str> = name.into();
        faces::read(&file, bytes, load, &mut data, &mut notes)?;
        data.warnings = notes.into_warnings();
        Self::loaded(data, load)
    }
}

/// What is wrong with a line.
fn wrong(file: &str, line: u32, problem: impl Into<String>, advice: &'static str) -> SceneError {
    SceneError::Text {
        path: file.to_owned(),
        line,
        problem: problem.into(),
        advice,
    }
}

/// A file by a path from `folder`, or by its name alone: exporters write paths of their own machine.
fn beside(load: &Load, folder: &Path, name: &str) -> PathBuf {
    let path = folder.join(name);
    let alone = Path::new(name).file_name().map(|name| folder.join(name));
    match alone {
        Some(alone) if !load.permits(&path) && load.permits(&alone) => alone,
        _ => path,
    }
}

const REPAIR: &str = "repair the line, or export the file again";

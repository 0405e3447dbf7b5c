//! pbrt in: scene files of version 4, and what versions 1 to 3 wrote otherwise as far as it is known
//! ("pbrt-v4 Input File Format", pbrt.org/fileformat-v4).
//!
//! Read:
//! - all transforms, attributes, coordinate systems, objects and instances, `Include` and `Import`; files by gzip;
//! - triangle, bilinear and PLY meshes, spheres, discs and cylinders; control meshes of subdivision surfaces as they are;
//! - area lights, which are triangles, or lights by formula where a whole sphere or disc shines: by radiance, or by `power`,
//!   which in pbrt is that of each triangle; points, spots, distant lights; infinite lights, constant or by a picture in pbrt's
//!   equal-area squares, or by longitude and latitude where the picture is no square;
//! - colours as RGB, blackbodies, spectra in the file, in files and by name; as in pbrt, light that is not given as RGB has the
//!   luminance `scale`;
//! - perspective cameras. pbrt's cameras are left-handed: z is mirrored where the camera is, so that the picture is not;
//! - materials, as near as two lobes come to them; pictures of their colours, other textures as their means. Surfaces of glass
//!   and of none are left out.
//!
//! What is not read is named in [`super::SceneData::warnings`], once for each kind; so are parameters that no directive has.

mod alpha;
mod area;
mod camera;
mod cie;
mod directive;
pub(super) mod equal_area;
mod finish;
mod infinite;
mod known;
mod light;
mod material;
mod matrix;
mod metal;
mod nesting;
mod params;
mod quadric;
mod shape;
mod spectrum;
mod state;
#[cfg(test)]
mod tests;
mod texture;
mod token;

use std::path::Path;
use std::rc::Rc;

use super::error::SceneError;
use super::model::Scene;
use super::notes::Place;
use super::read_file::{read_file, unpacked};
use state::Loader;
use token::Lexer;

/// Deepest `Include` and `Import`; deepest nesting of attributes.
const MAX_INCLUDES: u32 = 32;
const MAX_NESTING: usize = 4096;

/// Most files, and bytes of all of them together.
const MAX_FILES: u32 = 100_000;
const MAX_BYTES: u64 = 1 << 32;

const REPAIR: &str = "repair the line, or export the file again";

impl Scene {
    /// Reads a `.pbrt` file and what it includes, and checks it.
    ///
    /// # Errors
    /// What [`Scene::new`] refuses, and unreadable, truncated or malformed files.
    pub fn read_pbrt(path: &Path) -> Result<Self, SceneError> {
        let bytes = read_file(path)?;
        Self::read_pbrt_slice(&path.display().to_string(), &bytes, path.parent())
    }

    /// The same for a file in memory; `name` stands for the path in messages, `folder` is where other files lie (`None`: there
    /// are none).
    ///
    /// # Errors
    /// As [`Scene::read_pbrt`].
    pub fn read_pbrt_slice(name: &str, bytes: &[u8], folder: Option<&Path>) -> Result<Self, SceneError> {
        let bytes = unpacked(name, bytes)?;
        let mut loader = Loader::new(name, folder);
        let mut lexer = Lexer::new(name.into(), &bytes);
        loader.file(&mut lexer, 0)?;
        loader.finish()
    }
}

/// What is wrong at a line.
fn wrong(place: &Place, problem: impl Into<String>, advice: &'static str) -> SceneError {
    SceneError::Text {
        path: place.file.to_string(),
        line: place.line,
        problem: problem.into(),
        advice,
    }
}

/// The beginning of a text, for messages.
fn shown(text: &str) -> String {
    text.chars().take(60).collect()
}

/// A file that is named in a file, as pbrt looks for it: from the folder of the scene.
fn resolve(folder: Option<&Path>, name: &str) -> Option<Rc<Path>> {
    let name = name.replace('\\', "/");
    folder
        .filter(|_| !name.is_empty())
        .map(|folder| folder.join(name).into())
}

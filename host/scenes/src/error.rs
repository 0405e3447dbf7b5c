//! What can be wrong with a scene: every variant says what, where, and what to do.

use std::io;
use std::path::PathBuf;

/// Why a scene could not be opened, checked or written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SceneError {
    /// The name is neither a built-in scene, of which the names follow, nor something that looks like a file.
    #[error("unknown scene `{0}`: name a built-in scene ({1}) or a .gltf, .glb or .obj file")]
    UnknownScene(String, String),
    /// A file could not be read.
    #[error("cannot read {0}: {1}; check that the file is there and that you may read it")]
    Read(PathBuf, #[source] io::Error),
    /// A file could not be written.
    #[error("cannot write {0}: {1}; choose a folder that exists and that you may write to")]
    Write(PathBuf, #[source] io::Error),
    /// A file or a scene breaks a rule, or needs something that is not read: the line or the element, what was found, and what
    /// was expected or what to do about it.
    #[error("{0}: {1}; {2}")]
    Malformed(String, String, String),
    /// A file that the scene names lies where the scene may not read.
    #[error(
        "{0} lies outside the scene's folder, and is not read; move it there, or permit its folder with `--read-from DIR`"
    )]
    Outside(PathBuf),
    /// A load would take more memory than it may: what takes it, and how many bytes it takes, are left, and were there.
    #[error(
        "{0} takes {asked} bytes, but {left} of {limit} are left for this scene; permit more with `--memory MIB`, or make the scene smaller",
        asked = .1[0], left = .1[1], limit = .1[2]
    )]
    Memory(String, [u64; 3]),
    /// The scene has no triangle at all; what was left out when it was read follows, which may be why.
    #[error("scene `{0}` has no triangles; it needs at least one mesh of them{1}")]
    Empty(String, String),
    /// The scene has no light that the command knows; what else lights it follows in words, or nothing.
    #[error(
        "scene `{0}` has no emissive triangle{1}; give a material an emissiveFactor above zero (glTF) or a Ke (OBJ), or use one of \
         the built-in scenes"
    )]
    NoEmissive(String, String),
}

/// The beginning of a text from a file: names are for messages, and each node may name the same mesh.
pub(super) fn short(text: &str) -> String {
    text.chars().take(60).collect()
}

/// Most bytes of a sentence about a file, which may quote it.
const MAX_SENTENCE: usize = 1000;

/// A sentence, cut where the file made it long.
pub(super) fn sentence(text: impl Into<String>) -> String {
    let mut text = text.into();
    text.truncate(text.floor_char_boundary(MAX_SENTENCE));
    text
}

/// [`SceneError::Malformed`].
pub(super) fn malformed(
    place: impl Into<String>,
    problem: impl Into<String>,
    advice: impl Into<String>,
) -> SceneError {
    SceneError::Malformed(place.into(), sentence(problem), advice.into())
}

/// The program was compiled without the feature `formats`, which reads `what`.
pub(super) fn not_compiled(place: &str, what: &str) -> SceneError {
    let problem = format!("{what} is read only where the feature `formats` is compiled in");
    malformed(
        place,
        problem,
        "build with `--features formats`, or export the file without it",
    )
}

impl SceneError {
    /// Whether a load ends with it, also where a picture or a library could be left out.
    pub(super) fn ends_the_load(&self) -> bool {
        matches!(self, Self::Outside(_) | Self::Memory(..))
    }
}

//! What can be wrong with a scene: every variant says what, where, and what to do.

use std::io;
use std::path::PathBuf;

/// Why a scene could not be opened, checked or written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SceneError {
    /// The name is neither a built-in scene nor something that looks like a file.
    #[error("unknown scene `{name}`: name a built-in scene ({built_in}) or a .gltf or .glb file")]
    UnknownScene {
        /// What was asked for.
        name: String,
        /// The names that would have worked.
        built_in: String,
    },
    /// A file could not be read.
    #[error("cannot read {path}: {source}; check that the file is there and that you may read it")]
    Read {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
    /// A file could not be written.
    #[error("cannot write {path}: {source}; choose a folder that exists and that you may write to")]
    Write {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
    /// The file is not glTF, or is truncated.
    #[error("{path} is not a readable glTF 2.0 file: {problem}; export it again as .glb or .gltf")]
    Container {
        /// The file.
        path: String,
        /// What was expected and what was found.
        problem: String,
    },
    /// An element of the file breaks a rule of glTF 2.0.
    #[error("{path}: {element}: {problem}; {advice}")]
    Malformed {
        /// The file.
        path: String,
        /// The element, as its place in the file's JSON.
        element: String,
        /// What was expected and what was found.
        problem: String,
        /// What to do about it.
        advice: &'static str,
    },
    /// The file needs something that this loader does not do.
    #[error("{path}: {element}: {feature} is not supported; {advice}")]
    Unsupported {
        /// The file.
        path: String,
        /// The element, as its place in the file's JSON.
        element: String,
        /// What it asks for.
        feature: String,
        /// What to do about it.
        advice: &'static str,
    },
    /// A value is NaN or infinite.
    #[error(
        "scene `{scene}`: {element} is {value}, which is not finite; repair the model and export it again"
    )]
    NotFinite {
        /// The scene.
        scene: String,
        /// The element.
        element: String,
        /// What was found.
        value: f64,
    },
    /// A value lies outside its range.
    #[error("scene `{scene}`: {element} is {value}, expected {expected}")]
    OutOfRange {
        /// The scene.
        scene: String,
        /// The element.
        element: String,
        /// What was found.
        value: f64,
        /// The range, in words.
        expected: &'static str,
    },
    /// An index points past the end of what it refers to.
    #[error(
        "scene `{scene}`: {element} is {index}, but there are only {count}; repair the model's references"
    )]
    BadIndex {
        /// The scene.
        scene: String,
        /// The element that holds the index.
        element: String,
        /// The index.
        index: u64,
        /// How many elements there are.
        count: u64,
    },
    /// Two lists that belong together have different lengths.
    #[error("scene `{scene}`: {element} has {found} entries, expected {expected}; export the scene again")]
    BadLength {
        /// The scene.
        scene: String,
        /// The list.
        element: String,
        /// Its length.
        found: u64,
        /// The length it must have.
        expected: u64,
    },
    /// More elements than 32-bit indices, or memory, can hold.
    #[error(
        "scene `{scene}` has {count} {what}, more than the {limit} that fit; split the scene or use fewer instances"
    )]
    TooMany {
        /// The scene.
        scene: String,
        /// What there is too much of.
        what: &'static str,
        /// How many there are.
        count: u64,
        /// How many there may be.
        limit: u64,
    },
    /// The scene has no triangle at all.
    #[error("scene `{scene}` has no triangles; it needs at least one node with a triangle mesh")]
    Empty {
        /// The scene.
        scene: String,
    },
    /// The scene has nothing that emits light.
    #[error(
        "scene `{scene}` has no emissive triangle; give a material an emissiveFactor above zero, \
         or use one of the built-in scenes"
    )]
    NoEmissive {
        /// The scene.
        scene: String,
    },
}

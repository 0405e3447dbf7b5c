//! What can be wrong with a scene: every variant says what, where, and what to do.

use std::io;
use std::path::PathBuf;

/// Why a scene could not be opened, checked or written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SceneError {
    /// The name is neither a built-in scene nor something that looks like a file.
    #[error("unknown scene `{name}`: name a built-in scene ({built_in}) or a .gltf, .glb, .obj or .ply file")]
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
    /// An element of the file breaks a rule of its format, glTF 2.0 or PLY, or needs something that this loader does not do.
    #[error("{path}: {element}: {problem}; {advice}")]
    Malformed {
        /// The file.
        path: String,
        /// The element, in glTF as its place in the file's JSON.
        element: String,
        /// What was expected and what was found.
        problem: String,
        /// What to do about it.
        advice: &'static str,
    },
    /// A file that the scene names lies where the scene may not read.
    #[error(
        "{path} lies outside the scene's folder, and is not read; move it there, or permit its folder with `--read-from DIR`"
    )]
    Outside {
        /// The file, as the scene names it.
        path: PathBuf,
    },
    /// A load would take more memory than it may.
    #[error(
        "{place}: {what} takes {bytes} bytes, but {left} of {limit} are left for this scene; permit more with `--memory MIB`, or make the scene smaller"
    )]
    Memory {
        /// The file or the element.
        place: String,
        /// What takes it.
        what: &'static str,
        /// How much was asked for, bytes.
        bytes: u64,
        /// How much is left, bytes.
        left: u64,
        /// How much there was, bytes.
        limit: u64,
    },
    /// A picture that is damaged, or of an unknown format.
    #[error(
        "cannot decode {name}: {problem}; use PNG, JPEG, WebP, TGA, HDR, EXR or KTX 2 of at most 16384 pixels a side"
    )]
    Picture {
        /// The file or the element.
        name: String,
        /// What is wrong.
        problem: String,
    },
    /// The program was compiled without what reads this.
    #[error(
        "{path}: {what} is read only where the feature `{feature}` is compiled in; build with `--features {feature}`, or export the file without it"
    )]
    NotCompiled {
        /// The file.
        path: String,
        /// What is not read.
        what: String,
        /// The feature of this crate, and of `lightbvh-host`.
        feature: &'static str,
    },
    /// A line of an OBJ or MTL file is wrong.
    #[error("{path}, line {line}: {problem}; {advice}")]
    Text {
        /// The file.
        path: String,
        /// Counted from 1.
        line: u32,
        /// What was expected and what was found.
        problem: String,
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
    /// A value out of its range, an index past the end of what it refers to, or two lists of different lengths.
    #[error("scene `{scene}`: {problem}")]
    Invalid {
        /// The scene.
        scene: String,
        /// The element, what was found and what was expected.
        problem: String,
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
    #[error(
        "scene `{scene}` has no triangles; it needs at least one mesh of them{}",
        and_left_out(left_out)
    )]
    Empty {
        /// The scene.
        scene: String,
        /// What was left out when it was read, which may be why.
        left_out: Vec<String>,
    },
    /// The scene has nothing that emits light.
    #[error(
        "scene `{scene}` has no emissive triangle, and no light of another kind; give a material an emissiveFactor above zero (glTF) or a Ke \
         (OBJ), give `lightbvh render` an --environment, or use one of the built-in scenes"
    )]
    NoEmissive {
        /// The scene.
        scene: String,
    },
    /// What lights the scene is nothing that the command knows.
    #[error(
        "scene `{scene}` has no emissive triangle, and this command does not know what lights it ({lights}); {of_every_kind} take such scenes, or \
         give a material an emissiveFactor above zero (glTF) or a Ke (OBJ)",
        of_every_kind = OF_EVERY_KIND
    )]
    OtherLights {
        /// The scene.
        scene: String,
        /// What there is, in words.
        lights: String,
    },
}

/// Where a feature is not compiled in.
pub(super) fn not_compiled(path: &str, what: impl Into<String>, feature: &'static str) -> SceneError {
    SceneError::NotCompiled {
        path: path.to_owned(),
        what: what.into(),
        feature,
    }
}

impl SceneError {
    /// Whether a load ends with it, also where a picture or a library could be left out.
    pub(super) fn ends_the_load(&self) -> bool {
        matches!(self, Self::Outside { .. } | Self::Memory { .. })
    }
}

/// What was left out, each on a line.
fn and_left_out(left_out: &[String]) -> String {
    let mut text = String::new();
    for (index, what) in left_out.iter().enumerate() {
        text += if index == 0 { ". What was left out:" } else { "" };
        text += &format!("\n  - {what}");
    }
    text
}

/// The commands that take lights of every kind.
const OF_EVERY_KIND: &str = "`lightbvh render`, `verify` and `inspect`";

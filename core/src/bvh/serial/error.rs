//! What is wrong with words that are no light BVH.

use core::fmt;

use crate::bvh::EditReason;
use crate::light::LightError;
use crate::validate::Violation;

/// Why words are not read as a light BVH.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum ReadError {
    /// They do not begin as a light BVH does.
    Magic {
        /// The first word found.
        found: u32,
    },
    /// They are of another version of the format.
    Version {
        /// The version that is read.
        expected: u32,
        /// Theirs.
        found: u32,
    },
    /// Their nodes have another layout, or their lights are of another kind.
    Layout {
        /// The layout to be read.
        expected: &'static str,
        /// The kind of lights to be read.
        lights: &'static str,
    },
    /// Their nodes have another width.
    Width {
        /// The width to be read.
        expected: usize,
        /// Theirs.
        found: u32,
    },
    /// They are more or fewer than they say.
    Length {
        /// Number of words that they say, or that what they hold takes at least.
        expected: usize,
        /// Their number.
        found: usize,
    },
    /// A word is out of range.
    Word {
        /// Its place among the words.
        at: usize,
        /// What it is.
        what: &'static str,
        /// The word.
        found: u32,
    },
    /// Places in use overlap, or lie outside of their array.
    Places {
        /// Of what.
        what: &'static str,
    },
    /// A triangle is outside the domain.
    Light {
        /// Its index.
        triangle: u32,
        /// What is wrong with it.
        error: LightError,
    },
    /// An instance is outside the domain.
    Instance {
        /// Its index.
        instance: u32,
        /// What is wrong with it.
        reason: EditReason,
    },
    /// The tree is none.
    Tree(Violation),
}

impl fmt::Display for ReadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Magic { found } => write!(
                f,
                "the first word is {found:#010x}, not that of a light BVH; give what to_words wrote, in little-endian order"
            ),
            Self::Version { expected, found } => write!(
                f,
                "format {found}, expected {expected}; build the light BVH anew from its triangles"
            ),
            Self::Layout { expected, lights } => {
                write!(
                    f,
                    "nodes of another layout than \"{expected}\" over lights of kind \"{lights}\"; read them as what was written"
                )
            }
            Self::Width { expected, found } => write!(
                f,
                "nodes of {found} children, expected {expected}; read them as what was written"
            ),
            Self::Length { expected, found } => {
                write!(
                    f,
                    "{found} words, expected {expected}; the file is cut or damaged"
                )
            }
            Self::Word { at, what, found } => {
                write!(
                    f,
                    "word {at}, {what}, is {found}, which is out of range; the file is damaged"
                )
            }
            Self::Places { what } => {
                write!(f, "places of {what} overlap or lie outside; the file is damaged")
            }
            Self::Light { triangle, error } => write!(f, "light {triangle}: {error}"),
            Self::Instance { instance, reason } => write!(f, "instance {instance}: {reason}"),
            Self::Tree(violation) => write!(f, "{violation}; the file is damaged"),
        }
    }
}

impl core::error::Error for ReadError {}

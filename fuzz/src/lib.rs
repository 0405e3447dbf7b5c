//! What the fuzz targets do, as plain functions of bytes: the fuzzer calls them, and so does the test that replays the
//! inputs in `regressions/`.
//!
//! A function panics where the crate is wrong, and returns where the bytes are too few or the input is refused.

mod edits;
#[cfg(feature = "gltf")]
mod gltf;
pub mod input;
mod node_words;
mod read_words;
#[cfg(feature = "gltf")]
mod texts;
mod trees;

use std::ops::Range;

#[cfg(feature = "gltf")]
pub use gltf::gltf_document;

/// A target's name and body.
pub type Target = (&'static str, fn(&[u8], Forms));

/// All targets.
pub const TARGETS: &[Target] = &[
    ("edits", edits::edits),
    #[cfg(feature = "gltf")]
    ("gltf", gltf::gltf),
    ("node_words", node_words::node_words),
    ("read_words", read_words::read_words),
    #[cfg(feature = "gltf")]
    ("texts", texts::texts),
    ("trees", trees::trees),
];

/// Which forms of a tree (layout, width, levels) an input goes through, where a target knows several.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Forms {
    /// One, chosen by the first bytes of the input: more inputs per second.
    One,
    /// Every one, for inputs that are replayed.
    All,
}

impl Forms {
    /// Numbers of the forms, of `count`, that `data` goes through.
    fn of(self, data: &[u8], count: u32) -> Range<u32> {
        match self {
            Self::All => 0..count,
            Self::One => {
                let mut word = [0; 4];
                for (to, from) in word.iter_mut().zip(data) {
                    *to = *from;
                }
                let form = lightbvh::exact::hash(u32::from_le_bytes(word)) % count;
                form..form + 1
            }
        }
    }
}

//! What the fuzz targets do, as plain functions of bytes: the fuzzer calls them, and so does the test that replays the
//! inputs in `regressions/`.
//!
//! A function panics where the crate is wrong, and returns where the bytes are too few or the input is refused.

mod edits;
pub mod exact;
#[cfg(feature = "gltf")]
mod gltf;
pub mod input;
mod node_words;
mod read_words;
#[cfg(feature = "gltf")]
mod texts;
mod trees;

use std::ops::Range;

pub use edits::edits;
pub use exact::exact;
#[cfg(feature = "gltf")]
pub use gltf::{gltf, gltf_document};
pub use node_words::node_words;
pub use read_words::read_words;
#[cfg(feature = "gltf")]
pub use texts::texts;
pub use trees::trees;

/// A target's name and body.
pub type Target = (&'static str, fn(&[u8], Forms));

/// All targets.
pub const TARGETS: &[Target] = &[
    ("edits", edits),
    ("exact", exact),
    #[cfg(feature = "gltf")]
    ("gltf", gltf),
    ("node_words", node_words),
    ("read_words", read_words),
    #[cfg(feature = "gltf")]
    ("texts", texts),
    ("trees", trees),
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

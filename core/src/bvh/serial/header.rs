//! The first words: what follows, and how much of it.

use super::error::ReadError;
use super::words::Words;
use crate::build::{BuildParams, Effort, Heuristic};
use crate::light::{EmissiveTriangle, Light};
use crate::lights::MAX_LIGHTS;
use crate::node::Node;
use crate::trail::max_levels;

/// Version of the words of [`Bvh::to_words`](crate::Bvh::to_words).
pub const FORMAT: u32 = 10;

/// "LBVH" as bytes in little-endian order.
const MAGIC: u32 = u32::from_le_bytes(*b"LBVH");

/// Words of a header.
pub(super) const HEADER_WORDS: usize = 20;

const SINGLE: u32 = 1;
const FORGOTTEN: u32 = 2;
const OPENS: u32 = 4;

fn flag(is_set: bool, bit: u32) -> u32 {
    if is_set { bit } else { 0 }
}

/// What the first words say.
#[derive(Clone, Copy, Debug)]
pub(super) struct Header {
    pub params: BuildParams,
    pub single: bool,
    pub forgotten: bool,
    pub bottom_depth: u32,
    /// Lengths of the arrays, places not in use included.
    pub nodes: u32,
    pub triangles: u32,
    pub meshes: u32,
    pub instances: u32,
    /// One more than the greatest number of a light.
    pub lights: u32,
    /// Number of ranges of lights that are no more.
    pub removed: u32,
    /// Root of the top level, length of its array of nodes, and number of its free nodes.
    pub top_root: u32,
    pub top_nodes: u32,
    pub top_free: u32,
    /// Number of instances that may be opened, and length of the array of parts' places.
    pub opened: u32,
    pub parts: u32,
}

impl Header {
    /// The words; that of the length is still to be set, to [`LENGTH`].
    pub fn words<N: Node<W>, const W: usize>(&self) -> [u32; HEADER_WORDS] {
        let heuristic = HEURISTICS.iter().position(|&own| own == self.params.heuristic);
        let effort = EFFORTS.iter().position(|&own| own == self.params.effort);
        [
            MAGIC,
            FORMAT,
            0,
            layout_of::<N, W>(),
            W as u32,
            flag(self.single, SINGLE) | flag(self.forgotten, FORGOTTEN) | flag(self.params.opens, OPENS),
            heuristic.unwrap_or(0) as u32 | ((effort.unwrap_or(0) as u32) << 8),
            self.params.buckets,
            self.bottom_depth,
            self.nodes,
            self.triangles,
            self.meshes,
            self.instances,
            self.lights,
            self.removed,
            self.top_root,
            self.top_nodes,
            self.top_free,
            self.opened,
            self.parts,
        ]
    }

    pub fn read<N: Node<W>, const W: usize>(words: &mut Words<'_>) -> Result<Self, ReadError> {
        let found = words.one()?;
        if found != MAGIC {
            return Err(ReadError::Magic { found });
        }
        let found = words.one()?;
        if found != FORMAT {
            return Err(ReadError::Version {
                expected: FORMAT,
                found,
            });
        }
        let length = words.one()? as usize;
        if length != words.len() {
            return Err(ReadError::Length {
                expected: length,
                found: words.len(),
            });
        }
        if words.one()? != layout_of::<N, W>() {
            return Err(ReadError::Layout {
                expected: N::NAME,
                lights: N::Light::NAME,
            });
        }
        let found = words.one()?;
        if found as usize != W {
            return Err(ReadError::Width { expected: W, found });
        }
        let flags = words.one()?;
        words.expect(flags & !(SINGLE | FORGOTTEN | OPENS) == 0, "flags")?;
        let built = words.one()?;
        let heuristic = HEURISTICS.get((built & 255) as usize);
        let effort = EFFORTS.get((built >> 8) as usize);
        let (Some(&heuristic), Some(&effort)) = (heuristic, effort) else {
            return Err(words.wrong("heuristic and effort"));
        };
        let buckets = words.one()?;
        let bottom_depth = words.one()?;
        words.expect(bottom_depth <= max_levels(W), "levels of the bottom levels")?;
        let [nodes, triangles] = words.array()?;
        words.expect(triangles as usize <= MAX_LIGHTS, "number of triangles")?;
        let [meshes, instances, lights] = words.array()?;
        words.expect(lights as usize <= MAX_LIGHTS, "end of the lights' numbers")?;
        let [removed, top_root, top_nodes, top_free, opened, parts] = words.array()?;
        if top_root >= top_nodes {
            return Err(ReadError::Places {
                what: "the top level's root",
            });
        }
        // Each place was written once, with a leaf.
        words.expect(parts as usize <= W * words.len(), "number of parts")?;
        Ok(Self {
            params: BuildParams {
                heuristic,
                buckets,
                effort,
                opens: flags & OPENS != 0,
            },
            single: flags & SINGLE != 0,
            forgotten: flags & FORGOTTEN != 0,
            bottom_depth,
            nodes,
            triangles,
            meshes,
            instances,
            lights,
            removed,
            top_root,
            top_nodes,
            top_free,
            opened,
            parts,
        })
    }
}

/// Place of the number of words.
pub(super) const LENGTH: usize = 2;

/// By code.
const HEURISTICS: [Heuristic; 3] = [Heuristic::Sah, Heuristic::Saoh, Heuristic::Ward];
/// By code.
const EFFORTS: [Effort; 2] = [Effort::Usual, Effort::Most];

/// A layout's name as a word: FNV-1a of its bytes.
pub(super) fn layout(name: &str) -> u32 {
    hashed(0x811c_9dc5, name)
}

fn hashed(start: u32, text: &str) -> u32 {
    text.bytes().fold(start, |hash, byte| {
        (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193)
    })
}

/// The word of a layout, and of the lights of its trees where they are no emissive triangles.
fn layout_of<N: Node<W>, const W: usize>() -> u32 {
    let own = layout(N::NAME);
    if N::Light::NAME == EmissiveTriangle::NAME {
        own
    } else {
        hashed(own, N::Light::NAME)
    }
}

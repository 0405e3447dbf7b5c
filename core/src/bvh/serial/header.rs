//! The first words: what follows, and how much of it.

use alloc::format;

use bytemuck::{Pod, Zeroable};

use super::words::{ReadError, Words, misplaced};
use crate::build::{BuildParams, Heuristic};
use crate::light::{EmissiveTriangle, Light};
use crate::lights::MAX_LIGHTS;
use crate::node::Node;
use crate::trail::max_levels;

/// Version of the words of [`Bvh::to_words`](crate::Bvh::to_words).
pub const FORMAT: u32 = 13;

/// "LBVH" as bytes in little-endian order.
pub(super) const MAGIC: u32 = u32::from_le_bytes(*b"LBVH");

/// Words of a header.
pub(super) const HEADER_WORDS: usize = 20;

/// Bits of the flags.
pub(super) const SINGLE: u32 = 1;
pub(super) const FORGOTTEN: u32 = 2;
pub(super) const OPENS: u32 = 4;

/// By code.
const HEURISTICS: [Heuristic; 3] = [Heuristic::Sah, Heuristic::Saoh, Heuristic::Ward];

/// The first words, in order.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(super) struct Header {
    pub magic: u32,
    pub format: u32,
    /// Number of all words.
    pub length: u32,
    pub layout: u32,
    pub width: u32,
    pub flags: u32,
    /// Code of the heuristic.
    pub heuristic: u32,
    pub buckets: u32,
    pub bottom_depth: u32,
    /// Lengths of the arrays, places not in use included.
    pub nodes: u32,
    pub lights: u32,
    pub meshes: u32,
    pub instances: u32,
    /// One more than the greatest number of a light.
    pub numbers: u32,
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

/// The code of a heuristic.
pub(super) fn code(heuristic: Heuristic) -> u32 {
    HEURISTICS.iter().position(|&own| own == heuristic).unwrap_or(0) as u32
}

impl Header {
    pub fn has(&self, flag: u32) -> bool {
        self.flags & flag != 0
    }

    /// Reads the header, and how trees are built.
    pub fn read<N: Node<W>, const W: usize>(words: &mut Words<'_>) -> Result<(Self, BuildParams), ReadError> {
        let own: Self = bytemuck::cast(words.array::<HEADER_WORDS>()?);
        let (lights, name) = (N::Light::NAME, N::NAME);
        let refused = |text| Err(ReadError(text));
        if own.magic != MAGIC {
            return refused(format!(
                "the first word is {:#010x}, not that of a light BVH; give what to_words wrote, in little-endian order",
                own.magic
            ));
        }
        if own.format != FORMAT {
            return refused(format!(
                "format {}, expected {FORMAT}; rebuild the light BVH from its lights",
                own.format
            ));
        }
        if own.length as usize != words.all.len() {
            return Err(words.length(own.length as usize));
        }
        if own.layout != layout::<N, W>() {
            return refused(format!(
                "nodes of another layout than \"{name}\" over lights of kind \"{lights}\"; read them as what was written"
            ));
        }
        if own.width as usize != W {
            return refused(format!(
                "nodes of {} children, expected {W}; read them as what was written",
                own.width
            ));
        }
        let heuristic = HEURISTICS.get(own.heuristic as usize);
        // Each place of a part was written once, with a leaf.
        let most_parts = W * words.all.len();
        for (at, what, holds) in [
            (5, "flags", own.flags & !(SINGLE | FORGOTTEN | OPENS) == 0),
            (6, "heuristic", heuristic.is_some()),
            (
                8,
                "levels of the bottom levels",
                own.bottom_depth <= max_levels(W),
            ),
            (10, "number of lights", own.lights as usize <= MAX_LIGHTS),
            (
                13,
                "end of the lights' numbers",
                own.numbers as usize <= MAX_LIGHTS,
            ),
            (19, "number of parts", own.parts as usize <= most_parts),
        ] {
            let word = Words {
                all: words.all,
                next: at + 1,
            };
            word.expect(holds, what)?;
        }
        if own.top_root >= own.top_nodes {
            return Err(misplaced("the top level's root"));
        }
        let params = BuildParams {
            heuristic: heuristic.copied().unwrap_or(Heuristic::Ward),
            buckets: own.buckets,
            opens: own.has(OPENS),
        };
        Ok((own, params))
    }
}

/// The word of a layout, and of the lights of its trees if they are no emissive triangles: FNV-1a of the bytes of their names.
pub(super) fn layout<N: Node<W>, const W: usize>() -> u32 {
    let lights = match N::Light::NAME {
        EmissiveTriangle::NAME => "",
        other => other,
    };
    N::NAME
        .bytes()
        .chain(lights.bytes())
        .fold(0x811c_9dc5, |hash, byte| {
            (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193)
        })
}

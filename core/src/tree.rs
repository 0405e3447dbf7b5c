//! A light BVH as traversal sees it: borrowed arrays, the same on both processors.

use bytemuck::{Pod, Zeroable};

use crate::trail::{BitTrail, Path};

/// "No such index."
pub const INVALID: u32 = u32::MAX;

/// A mesh light: what a leaf of the top level links to.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
pub struct MeshLight {
    /// Node index of the root of its bottom level.
    pub root: u32,
    /// Its bit trail in the top level, low and high word.
    pub trail: [u32; 2],
    /// Its first triangle; its triangles are contiguous.
    pub first: u32,
}

const _: () = assert!(size_of::<MeshLight>() == 16);

/// A light BVH of one or two levels over nodes of type `N`.
///
/// Both shapes share every function: in a two-level tree the leaves of the starting tree are mesh lights, in a
/// single-level tree they are triangles and `meshes` is empty.
#[derive(Clone, Copy)]
pub struct LightTree<'a, N> {
    /// All nodes of all trees; at least one.
    pub nodes: &'a [N],
    /// Index of the node that a walk starts at.
    pub root: u32,
    /// The mesh lights.
    pub meshes: &'a [MeshLight],
    /// Bit trails of the triangles within the tree that holds them, `trail_words` words each.
    pub trails: &'a [u32],
    /// 1 when every tree of triangles is at most 32 bits deep, else 2.
    pub trail_words: u32,
}

impl<N> LightTree<'_, N> {
    /// The way to triangle `light` of mesh `mesh` ([`INVALID`] in a single-level tree). Indices out of range give a way
    /// that leads elsewhere; no access is out of range.
    #[inline]
    #[must_use]
    pub fn path_of(&self, light: u32, mesh: u32) -> Path {
        let word = light.wrapping_mul(self.trail_words);
        let low = if word < self.trails.len() as u32 {
            self.trails[word as usize]
        } else {
            0
        };
        let wide = self.trail_words == 2 && word.wrapping_add(1) < self.trails.len() as u32;
        let high = if wide { self.trails[(word + 1) as usize] } else { 0 };
        let own = BitTrail { low, high };
        if mesh < self.meshes.len() as u32 {
            let trail = self.meshes[mesh as usize].trail;
            Path {
                top: BitTrail {
                    low: trail[0],
                    high: trail[1],
                },
                bottom: own,
            }
        } else {
            Path {
                top: own,
                bottom: BitTrail { low: 0, high: 0 },
            }
        }
    }
}

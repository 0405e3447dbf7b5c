//! A light BVH as traversal sees it: borrowed arrays, the same on both processors.

use bytemuck::{Pod, Zeroable};

use crate::bounds::LightBounds;
use crate::point::{Receiver, ShadingPoint};
use crate::trail::{BitTrail, Path};

/// "No such index."
pub const INVALID: u32 = u32::MAX;

/// What a leaf of the top level links to: the way into a bottom level. [`MeshLight`] for bottom levels in world space,
/// [`Instance`](crate::Instance) for bottom levels in a space of their own that several leaves may share.
pub trait MeshLeaf: Pod + Send + Sync {
    /// A point in the space of the bottom level.
    type Local: Receiver;

    /// The leaf of a bottom level in world space whose triangles are lights of the same index: the node index of its root,
    /// and its index among the bottom levels.
    fn world(root: u32, blas: u32) -> Self;
    /// Node index of the root of its bottom level.
    fn root(&self) -> u32;
    /// Index of its bottom level.
    fn blas(&self) -> u32;
    /// Its bit trail in the top level.
    fn trail(&self) -> BitTrail;
    /// Sets its bit trail in the top level.
    fn set_trail(&mut self, trail: BitTrail);
    /// The light that triangle `triangle` of the bottom level is here.
    fn light_of(&self, triangle: u32) -> u32;
    /// The triangle of the bottom level that light `light` is.
    fn triangle_of(&self, light: u32) -> u32;
    /// A point of the world as the top level sees it.
    fn outside(point: &ShadingPoint) -> Self::Local;
    /// A point of the world in the space of the bottom level.
    fn inside(&self, point: &ShadingPoint) -> Self::Local;
    /// Bounds in the world of what has the bounds `local` in the bottom level's space.
    fn to_world(&self, local: &LightBounds) -> LightBounds;
}

/// A mesh light whose bottom level lies in world space.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
pub struct MeshLight {
    /// Node index of the root of its bottom level.
    pub root: u32,
    /// Its bit trail in the top level, low and high word.
    pub trail: [u32; 2],
    /// Index of its bottom level.
    pub blas: u32,
}

const _: () = assert!(size_of::<MeshLight>() == 16);

impl MeshLeaf for MeshLight {
    type Local = ShadingPoint;

    fn world(root: u32, blas: u32) -> Self {
        Self {
            root,
            trail: [0; 2],
            blas,
        }
    }

    #[inline(always)]
    fn root(&self) -> u32 {
        self.root
    }

    #[inline(always)]
    fn blas(&self) -> u32 {
        self.blas
    }

    #[inline(always)]
    fn trail(&self) -> BitTrail {
        BitTrail {
            low: self.trail[0],
            high: self.trail[1],
        }
    }

    fn set_trail(&mut self, trail: BitTrail) {
        self.trail = [trail.low, trail.high];
    }

    #[inline(always)]
    fn light_of(&self, triangle: u32) -> u32 {
        triangle
    }

    #[inline(always)]
    fn triangle_of(&self, light: u32) -> u32 {
        light
    }

    #[inline(always)]
    fn outside(point: &ShadingPoint) -> ShadingPoint {
        *point
    }

    #[inline(always)]
    fn inside(&self, point: &ShadingPoint) -> ShadingPoint {
        *point
    }

    #[inline(always)]
    fn to_world(&self, local: &LightBounds) -> LightBounds {
        *local
    }
}

/// A light BVH of one or two levels over nodes of type `N`, its top level's leaves of type `L`.
///
/// Both shapes share every function: in a two-level tree the leaves of the starting tree are mesh lights, in a
/// single-level tree they are triangles and `meshes` is empty.
#[derive(Clone, Copy)]
pub struct LightTree<'a, N, L = MeshLight> {
    /// All nodes of all trees; at least one.
    pub nodes: &'a [N],
    /// Index of the node that a walk starts at.
    pub root: u32,
    /// The mesh lights.
    pub meshes: &'a [L],
    /// Bit trails of the triangles within the tree that holds them, `trail_words` words each.
    pub trails: &'a [u32],
    /// 1 when every tree of triangles is at most 32 bits deep, else 2.
    pub trail_words: u32,
}

impl<N, L: MeshLeaf> LightTree<'_, N, L> {
    /// The way to light `light` of mesh light `mesh` ([`INVALID`] in a single-level tree). Indices out of range give a way
    /// that leads elsewhere; no access is out of range.
    #[inline]
    #[must_use]
    pub fn path_of(&self, light: u32, mesh: u32) -> Path {
        if mesh < self.meshes.len() as u32 {
            let leaf = &self.meshes[mesh as usize];
            Path {
                top: leaf.trail(),
                bottom: self.trail(leaf.triangle_of(light)),
            }
        } else {
            Path {
                top: self.trail(light),
                bottom: BitTrail { low: 0, high: 0 },
            }
        }
    }

    /// Trail of a triangle in the tree that holds it.
    #[inline]
    fn trail(&self, triangle: u32) -> BitTrail {
        let word = triangle.wrapping_mul(self.trail_words);
        let low = if word < self.trails.len() as u32 {
            self.trails[word as usize]
        } else {
            0
        };
        let wide = self.trail_words == 2 && word.wrapping_add(1) < self.trails.len() as u32;
        let high = if wide { self.trails[(word + 1) as usize] } else { 0 };
        BitTrail { low, high }
    }

    /// The light that triangle `triangle` of the bottom level of mesh light `mesh` is; the triangle itself where there is
    /// no mesh light.
    #[inline(always)]
    pub(crate) fn light_of(&self, triangle: u32, mesh: u32) -> u32 {
        if mesh < self.meshes.len() as u32 {
            self.meshes[mesh as usize].light_of(triangle)
        } else {
            triangle
        }
    }

    /// `point` in the space of the nodes below mesh light `mesh`, or of the top level where there is none.
    #[inline(always)]
    pub(crate) fn receiver(&self, point: &ShadingPoint, mesh: u32) -> L::Local {
        if mesh < self.meshes.len() as u32 {
            self.meshes[mesh as usize].inside(point)
        } else {
            L::outside(point)
        }
    }
}

//! The receiver of light.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;

/// A point to be lit (pbrt's `LightSampleContext`).
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct ShadingPoint {
    /// Position, metres, magnitude at most 2^40.
    pub p: [f32; 3],
    /// Unit normal of an opaque surface: only light from its side counts. Zero for a point in a volume, which
    /// receives from everywhere.
    pub n: [f32; 3],
}

impl ShadingPoint {
    /// Position.
    #[inline]
    #[must_use]
    pub fn position(&self) -> Vec3 {
        Vec3::new(self.p[0], self.p[1], self.p[2])
    }

    /// Normal, or zero.
    #[inline]
    #[must_use]
    pub fn normal(&self) -> Vec3 {
        Vec3::new(self.n[0], self.n[1], self.n[2])
    }
}

/// A receiver in the space of the tree that is walked, and how exactly it is known there.
///
/// A point given in world space is known exactly. One brought into the space of a mesh is rounded on the way, and so are
/// the mesh's triangles on their way into the world: importance must not take a light for invisible that only rounding put
/// out of sight. Types that round nothing pay nothing.
pub trait Receiver: Copy {
    /// Whether [`slack`](Self::slack), [`near_squared`](Self::near_squared) and [`tilt`](Self::tilt) may be other than 0.
    const ROUNDED: bool;

    /// Position, metres of the tree's space.
    fn position(&self) -> Vec3;
    /// Unit normal, or zero in a volume.
    fn normal(&self) -> Vec3;
    /// By how much the distance from any light may be off, in each direction; metres of the tree's space.
    fn slack(&self) -> f32;
    /// Squared distance below which the slack turns the direction of a light by more than 2^-11 rad, m².
    fn near_squared(&self) -> f32;
    /// By how much the normal of any light may be turned, rad.
    fn tilt(&self) -> f32;
}

impl Receiver for ShadingPoint {
    const ROUNDED: bool = false;

    #[inline(always)]
    fn position(&self) -> Vec3 {
        Self::position(self)
    }

    #[inline(always)]
    fn normal(&self) -> Vec3 {
        Self::normal(self)
    }

    #[inline(always)]
    fn slack(&self) -> f32 {
        0.0
    }

    #[inline(always)]
    fn near_squared(&self) -> f32 {
        0.0
    }

    #[inline(always)]
    fn tilt(&self) -> f32 {
        0.0
    }
}

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

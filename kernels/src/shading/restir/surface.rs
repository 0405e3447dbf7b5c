//! The surface that a pixel sees, as the later steps need it.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;
use lightbvh::ShadingPoint;
use lightbvh::exact::{clamp, flush, pow2};
use lightbvh::vector::{dot, length_squared};

use super::super::grid::{STEP, TINY, flush_vector};
use super::super::pixel::Seen;

/// The least cosine between the normals of pixels that reuse each other's samples: 25 degrees (ReSTIR section 5).
const MIN_NORMAL_COSINE: f32 = 0.906_307_8;
/// Their distances from the camera differ by at most a tenth (ReSTIR section 5); here, squared.
const MIN_DISTANCE_RATIO_SQUARED: f32 = 0.81;
const MAX_DISTANCE_RATIO_SQUARED: f32 = 1.21;
/// Squared distances from the camera, m², count as at least and at most this.
const MIN_DISTANCE_SQUARED: f32 = pow2(-60);
const MAX_DISTANCE_SQUARED: f32 = pow2(80);

/// What a camera ray saw; 56 bytes. Pixels of a frame form its G-buffer.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Surface {
    /// The point to be lit and its normal; zero normal where there is nothing to be lit.
    pub point: ShadingPoint,
    /// Unit direction to the viewer.
    pub wo: [f32; 3],
    /// Index of the material.
    pub material: u32,
    /// What arrives without being reflected, W/(m² sr).
    pub direct: [f32; 3],
    /// Squared distance from the camera, m².
    pub distance_squared: f32,
}

const _: () = assert!(size_of::<Surface>() == 56);

impl Surface {
    /// The record of what was seen from `eye`.
    #[inline]
    #[must_use]
    pub fn new(seen: &Seen, eye: Vec3) -> Self {
        Self {
            point: seen.point,
            wo: [seen.wo.x, seen.wo.y, seen.wo.z],
            material: seen.material,
            direct: [seen.direct.x, seen.direct.y, seen.direct.z],
            distance_squared: distance_squared(seen.point.position(), eye),
        }
    }

    /// Whether there is anything to be lit.
    #[inline]
    #[must_use]
    pub fn is_lit(&self) -> bool {
        length_squared(self.point.normal()) > 0.0
    }

    /// Unit direction to the viewer.
    #[inline]
    #[must_use]
    pub fn wo(&self) -> Vec3 {
        Vec3::new(self.wo[0], self.wo[1], self.wo[2])
    }

    /// Whether samples for `other` are likely to be good here too: both are lit, face the same way and are about as far
    /// away. `distance_squared` is this surface's distance from the camera that sees `other`.
    #[inline]
    #[must_use]
    pub fn is_like(&self, other: &Self, distance_squared: f32) -> bool {
        let n = flush_vector(self.point.normal(), STEP);
        let m = flush_vector(other.point.normal(), STEP);
        let cosine = dot(n, m);
        let d = other.distance_squared;
        self.is_lit()
            && other.is_lit()
            && cosine >= MIN_NORMAL_COSINE
            && d >= distance_squared * MIN_DISTANCE_RATIO_SQUARED
            && d <= distance_squared * MAX_DISTANCE_RATIO_SQUARED
    }
}

/// The squared distance of two points, m², within what [`Surface::is_like`] compares.
#[inline]
#[must_use]
pub fn distance_squared(a: Vec3, b: Vec3) -> f32 {
    let squared = length_squared(flush_vector(a - b, STEP));
    clamp(flush(squared, TINY), MIN_DISTANCE_SQUARED, MAX_DISTANCE_SQUARED)
}

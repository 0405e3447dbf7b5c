//! The pinhole camera.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;
use lightbvh::exact::hash;

use super::numbers::r2;
use super::ray::{FAR, Ray};
use crate::shading::grid::div;

/// A camera as the frame of its image plane at distance 1; 48 bytes. The host computes it, trigonometry and all.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Camera {
    /// Position, metres.
    pub origin: [f32; 3],
    /// From the image's centre to the middle of its right edge.
    pub right: [f32; 3],
    /// From the image's centre to the middle of its upper edge.
    pub up: [f32; 3],
    /// From the camera to the image's centre.
    pub forward: [f32; 3],
}

const _: () = assert!(size_of::<Camera>() == 48);

impl Camera {
    /// The ray through a random point of the pixel in column `x` and row `y` (row 0 on top), the same for the same `random` and
    /// `jitter`. Points of successive `jitter` fill the pixel evenly.
    #[inline]
    #[must_use]
    pub fn ray(&self, [x, y]: [u32; 2], [width, height]: [u32; 2], random: u32, jitter: u32) -> Ray {
        let [across, down] = r2([hash(random), hash(random.wrapping_add(1))], jitter);
        let across = plane_coordinate(x, width, across);
        let down = plane_coordinate(y, height, down);
        let direction = (vector(self.forward) + vector(self.right) * across) - vector(self.up) * down;
        Ray::new(vector(self.origin), direction, FAR)
    }
}

/// Where in [-1, 1) the point at `within` of pixel `i` of `count` lies.
#[inline]
fn plane_coordinate(i: u32, count: u32, within: f32) -> f32 {
    (i as i32 as f32 + within) * div(2.0, count as i32 as f32) - 1.0
}

#[inline]
fn vector(v: [f32; 3]) -> Vec3 {
    Vec3::new(v[0], v[1], v[2])
}

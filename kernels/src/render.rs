//! Pass `render`: direct lighting, one invocation per pixel. Reads the scene, the ray BVH and whatever the picker chooses
//! lights by; writes the pixel.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;
use lightbvh::exact::hash;

use crate::shading::camera::Camera;
use crate::shading::pick::PickLight;
use crate::shading::pixel::{Scene, reflected, see};

/// What all pixels of an image have in common besides the scene; push constants, 32 bytes.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct RenderParams {
    /// Columns, 1 to 2^24.
    pub width: u32,
    /// Rows, 1 to 2^24.
    pub height: u32,
    /// Lights sampled for each pixel, at most 2^24.
    pub samples: u32,
    /// Chooses the random numbers of the lights. Images that differ in nothing else show the same surfaces.
    pub seed: u32,
    /// Chooses the points within the pixels that camera rays go through: the mean over several is smooth at edges.
    pub jitter: u32,
    /// Radiance of what no surface covers, linear RGB, W/(m² sr).
    pub background: [f32; 3],
}

const _: () = assert!(size_of::<RenderParams>() == 32);

/// The radiance that reaches the camera through pixel `index`, linear RGB, W/(m² sr). Pixels are numbered by rows from
/// the upper left.
#[inline]
#[must_use]
pub fn render_pixel<P: PickLight>(
    scene: &Scene<'_>,
    camera: &Camera,
    params: &RenderParams,
    picker: &P,
    index: u32,
) -> [f32; 3] {
    let width = if params.width == 0 { 1 } else { params.width };
    let y = index / width;
    let x = index - y * width;
    let pixel = hash(index);
    let ray = camera.ray(x, y, width, params.height, pixel.wrapping_add(params.jitter));
    let background = Vec3::new(params.background[0], params.background[1], params.background[2]);
    let seen = see(scene, &ray, background);
    let seed = hash(pixel.wrapping_add(hash(params.seed)));
    let radiance = seen.direct + reflected(scene, &seen, picker, params.samples, seed);
    [radiance.x, radiance.y, radiance.z]
}

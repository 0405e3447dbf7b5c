//! Light along paths of several reflections, as pass `render_paths` has it.

use glam::Vec3;
use lightbvh::exact::{div, hash};

use crate::render::RenderParams;
use crate::shading::camera::Camera;
use crate::shading::emitter::Emitter;
use crate::shading::grid::{TINY, flush_vector};
use crate::shading::path::path_radiance;
use crate::shading::pick::PickLight;
use crate::shading::pixel::Scene;

/// The radiance that reaches the camera through pixel `index` along paths of up to `bounces` reflections, linear RGB,
/// W/(m² sr): the mean of [`samples`](RenderParams::samples) paths. Pixels are numbered by rows from the upper left, and
/// all paths of a pixel begin with the same camera ray, as the light samples of [`render_pixel`](crate::render::render_pixel).
#[inline]
#[must_use]
pub fn path_pixel<L: Emitter, P: PickLight>(
    scene: &Scene<'_, L>,
    camera: &Camera,
    params: &RenderParams,
    bounces: u32,
    picker: &P,
    index: u32,
) -> [f32; 3] {
    let width = if params.width == 0 { 1 } else { params.width };
    let y = index / width;
    let x = index - y * width;
    let pixel = hash(index);
    let ray = camera.ray([x, y], [width, params.height], pixel, params.jitter);
    let background = Vec3::new(params.background[0], params.background[1], params.background[2]);
    let seed = hash(pixel.wrapping_add(hash(params.seed)));
    let mut sum = Vec3::ZERO;
    for sample in 0..params.samples {
        sum += path_radiance(
            scene,
            &ray,
            background,
            picker,
            bounces,
            hash(seed.wrapping_add(sample)),
        );
    }
    let count = if params.samples == 0 { 1 } else { params.samples };
    let mean = flush_vector(sum * div(1.0, count as i32 as f32), TINY);
    [mean.x, mean.y, mean.z]
}

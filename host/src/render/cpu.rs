//! The render passes on the CPU: the kernel's function for each pixel, over all cores.

use lightbvh_kernels::render::{RenderParams, path_pixel, render_pixel};
use lightbvh_kernels::shading::camera::Camera;
use lightbvh_kernels::shading::emitter::Emitter;
use lightbvh_kernels::shading::pick::PickLight;
use lightbvh_kernels::shading::pixel::Scene;
use rayon::prelude::*;

/// Radiance of every pixel, by rows from the upper left. Pixels do not depend on each other, so neither does the image on
/// the number of threads.
pub fn render<L: Emitter, P: PickLight + Sync>(
    scene: &Scene<'_, L>,
    camera: &Camera,
    params: &RenderParams,
    picker: &P,
) -> Vec<[f32; 3]> {
    (0..params.width * params.height)
        .into_par_iter()
        .map(|pixel| render_pixel(scene, camera, params, picker, pixel))
        .collect()
}

/// [`render`], for paths of up to `bounces` reflections.
pub fn render_path<L: Emitter, P: PickLight + Sync>(
    scene: &Scene<'_, L>,
    camera: &Camera,
    params: &RenderParams,
    bounces: u32,
    picker: &P,
) -> Vec<[f32; 3]> {
    (0..params.width * params.height)
        .into_par_iter()
        .map(|pixel| path_pixel(scene, camera, params, bounces, picker, pixel))
        .collect()
}

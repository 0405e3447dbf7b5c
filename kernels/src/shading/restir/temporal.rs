//! The second step: the reservoir that the pixel's surface had in the frame before (ReSTIR section 4.1, Algorithm 5).

use glam::Vec3;
use lightbvh::exact::{abs, flush, hash, pow2};
use lightbvh::reservoir::{LightSample, Resampling};
use lightbvh::vector::{dot, length_squared};

use super::super::camera::Camera;
use super::super::emitter::Emitter;
use super::super::emitters::Emitters;
use super::super::grid::{STEP, TINY, div, flush_vector};
use super::super::material::Material;
use super::super::trace::NONE;
use super::combine::{Balance, Combine};
use super::surface::{Surface, distance_squared};
use super::target::lit;
use super::{PixelReservoir, RestirParams, TEMPORAL, step_seed};

/// Depths, m, and squared lengths of camera axes below this leave the image.
const MIN_DEPTH: f32 = pow2(-60);

/// The frame before, as far as its pixels are reused.
#[derive(Clone, Copy)]
pub struct Before<'a> {
    /// Who looked.
    pub camera: &'a Camera,
    /// What its pixels saw.
    pub gbuffer: &'a [Surface],
    /// What was left of its samples after shading.
    pub reservoirs: &'a [PixelReservoir],
    /// By number of a light then: its number and instance now, or [`NONE`].
    pub to_current: &'a [[u32; 2]],
}

/// The sample as the other side of a remap names its light; as it is where there is none.
#[inline]
fn translate(map: &[[u32; 2]], sample: &LightSample, remapped: u32) -> LightSample {
    let mut light = sample.light;
    let mut instance = sample.instance;
    if remapped != 0 {
        light = NONE;
        instance = NONE;
        if sample.light < map.len() as u32 {
            light = map[sample.light as usize][0];
            instance = map[sample.light as usize][1];
        }
    }
    LightSample {
        light,
        instance,
        uv: [sample.uv[0], sample.uv[1]],
    }
}

/// The pixel of an image of `width` by `height` through which `camera` sees `p`, or [`NONE`].
#[inline]
#[must_use]
pub fn project(camera: &Camera, p: Vec3, width: u32, height: u32) -> u32 {
    let origin = Vec3::new(camera.origin[0], camera.origin[1], camera.origin[2]);
    let right = flush_vector(Vec3::new(camera.right[0], camera.right[1], camera.right[2]), STEP);
    let up = flush_vector(Vec3::new(camera.up[0], camera.up[1], camera.up[2]), STEP);
    let forward = flush_vector(
        Vec3::new(camera.forward[0], camera.forward[1], camera.forward[2]),
        STEP,
    );
    let d = flush_vector(p - origin, STEP);
    // The axes are orthogonal: d = (a / |r|²) r + (b / |u|²) u + (c / |f|²) f, and the image plane is at f.
    let squared = length_squared(forward);
    let depth = flush(dot(d, forward), TINY);
    let across = flush(dot(d, right), TINY) * squared;
    let down = flush(-dot(d, up), TINY) * squared;
    let half_width = length_squared(right) * depth;
    let half_height = length_squared(up) * depth;
    let in_front = depth > MIN_DEPTH && half_width > TINY && half_height > TINY;
    let inside = in_front && abs(across) < half_width && abs(down) < half_height;
    let mut pixel = NONE;
    if inside {
        let x = cell(div(across, half_width), width);
        let y = cell(div(down, half_height), height);
        pixel = y.wrapping_mul(width).wrapping_add(x);
    }
    pixel
}

/// In which of `count` equal parts of [-1, 1] `x` lies.
#[inline]
fn cell(x: f32, count: u32) -> u32 {
    let scaled = (x + 1.0) * (0.5 * (count as i32 as f32));
    let cell = if scaled > 0.0 { scaled as u32 } else { 0 };
    if cell < count { cell } else { count.wrapping_sub(1) }
}

/// Merges the reservoir of the pixel where the frame before saw `surface` into this frame's.
///
/// `emitters` and `materials` are this frame's; `combine` asks the frame before. `to_previous` gives, by number of a light now,
/// its number and instance then or [`NONE`]; without [`Combine::is_unbiased`] it is not read.
#[inline]
#[must_use]
pub fn temporal<L: Emitter>(
    combine: &Combine<'_, L>,
    materials: &[Material],
    emitters: &Emitters<'_, L>,
    before: &Before<'_>,
    to_previous: &[[u32; 2]],
    params: &RestirParams,
    surface: &Surface,
    current: PixelReservoir,
    index: u32,
) -> PixelReservoir {
    let mut found = current;
    let position = surface.point.position();
    let pixel = project(before.camera, position, params.width, params.height);
    let known = pixel < before.gbuffer.len() as u32 && pixel < before.reservoirs.len() as u32;
    if known && params.history > 0 {
        let then = before.gbuffer[pixel as usize];
        let eye = before.camera.origin;
        let distance = distance_squared(position, Vec3::new(eye[0], eye[1], eye[2]));
        if surface.is_like(&then, distance) {
            let old = before.reservoirs[pixel as usize]
                .reservoir
                .limited(params.history);
            let mut history = old;
            history.sample = translate(before.to_current, &old.sample, params.remapped);

            let seed = step_seed(params, index, TEMPORAL);
            let mut stream = Resampling::EMPTY;
            let own = lit(materials, emitters, surface, &current.reservoir.sample).target;
            stream.merge(&current.reservoir, own, 0, hash(seed));
            let theirs = lit(materials, emitters, surface, &history.sample).target;
            stream.merge(&history, theirs, 1, hash(seed.wrapping_add(1)));

            let mut balance = Balance::ZERO;
            if combine.is_unbiased && stream.target > 0.0 {
                let sample = translate(to_previous, &stream.sample, params.remapped);
                // The reservoirs of the frame before hold only what was visible in it.
                let answer = combine.ask(materials, &then, &sample, stream.source == 1);
                found.shadow_rays = found.shadow_rays.wrapping_add(answer.shadow_rays);
                balance.add(&stream, 0, current.reservoir.count, stream.target);
                balance.add(&stream, 1, history.count, answer.target);
            }
            found.reservoir = combine.finish(&stream, &balance);
        }
    }
    found
}

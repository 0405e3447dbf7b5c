//! The third step: reservoirs of pixels around (ReSTIR section 4.1, Algorithm 5).

use lightbvh::exact::{hash, unit_f32};
use lightbvh::reservoir::Resampling;

use super::super::emitter::Emitter;
use super::super::emitters::Emitters;
use super::super::material::Material;
use super::super::trace::NONE;
use super::combine::{Balance, Combine};
use super::surface::Surface;
use super::target::lit;
use super::{PixelReservoir, RestirParams, SPATIAL, step_seed};

/// Random numbers that one neighbour uses.
const RANDOM_PER_NEIGHBOR: u32 = 3;

/// The pixel to reuse from as number `neighbor` (1 and up; 0 is the pixel itself): within a disc around pixel `index`, by
/// rejection from its square in at most four tries. [`NONE`] outside the image.
#[inline]
#[must_use]
pub fn neighbor_pixel(params: &RestirParams, index: u32, neighbor: u32, random: u32) -> u32 {
    let width = if params.width == 0 { 1 } else { params.width };
    let y = index / width;
    let x = index - y * width;
    let radius = params.radius as i32 as f32;
    let mut dx = 0.0;
    let mut dy = 0.0;
    let mut done = false;
    for attempt in 0..4 {
        let word = hash(random.wrapping_add(attempt));
        let u = unit_f32(word) * 2.0 - 1.0;
        let v = unit_f32(hash(word)) * 2.0 - 1.0;
        let inside = u * u + v * v <= 1.0;
        dx = if done { dx } else { u * radius };
        dy = if done { dy } else { v * radius };
        done = done || inside;
    }
    let column = (x as i32).wrapping_add(rounded(dx));
    let row = (y as i32).wrapping_add(rounded(dy));
    let in_image =
        column >= 0 && row >= 0 && (column as u32) < params.width && (row as u32) < params.height && done;
    let other = (row as u32).wrapping_mul(width).wrapping_add(column as u32);
    if neighbor == 0 {
        index
    } else if in_image && other != index {
        other
    } else {
        NONE
    }
}

/// The nearest integer; halves away from zero.
#[inline]
fn rounded(x: f32) -> i32 {
    if x < 0.0 {
        (x - 0.5) as i32
    } else {
        (x + 0.5) as i32
    }
}

/// Merges the reservoirs of up to [`RestirParams::neighbors`] pixels around into that of pixel `index`. `combine` asks this
/// frame.
#[inline]
#[must_use]
pub fn spatial<L: Emitter>(
    combine: &Combine<'_, L>,
    materials: &[Material],
    emitters: &Emitters<'_, L>,
    gbuffer: &[Surface],
    reservoirs: &[PixelReservoir],
    params: &RestirParams,
    index: u32,
) -> PixelReservoir {
    let surface = gbuffer[index as usize];
    let mut found = reservoirs[index as usize];
    if surface.is_lit() {
        let seed = hash(step_seed(params, index, SPATIAL).wrapping_add(params.spatial_pass));
        let mut stream = Resampling::EMPTY;
        for neighbor in 0..params.neighbors.wrapping_add(1) {
            let random = seed.wrapping_add(neighbor.wrapping_mul(RANDOM_PER_NEIGHBOR));
            let pixel = neighbor_pixel(params, index, neighbor, hash(random));
            if pixel < gbuffer.len() as u32 && pixel < reservoirs.len() as u32 {
                let other = gbuffer[pixel as usize];
                if surface.is_like(&other, surface.distance_squared) {
                    let reservoir = reservoirs[pixel as usize].reservoir;
                    let target = lit(materials, emitters, &surface, &reservoir.sample).target;
                    stream.merge(&reservoir, target, neighbor, hash(random.wrapping_add(1)));
                }
            }
        }
        let mut balance = Balance::ZERO;
        if combine.is_unbiased && stream.target > 0.0 {
            for neighbor in 0..params.neighbors.wrapping_add(1) {
                let random = seed.wrapping_add(neighbor.wrapping_mul(RANDOM_PER_NEIGHBOR));
                let pixel = neighbor_pixel(params, index, neighbor, hash(random));
                if pixel < gbuffer.len() as u32 && pixel < reservoirs.len() as u32 {
                    let other = gbuffer[pixel as usize];
                    if surface.is_like(&other, surface.distance_squared) {
                        // The own ray is left to the shading, which makes a blocked sample's weight zero.
                        let answer = combine.ask(materials, &other, &stream.sample, neighbor == 0);
                        found.shadow_rays = found.shadow_rays.wrapping_add(answer.shadow_rays);
                        let count = reservoirs[pixel as usize].reservoir.count;
                        balance.add(&stream, neighbor, count, answer.target);
                    }
                }
            }
        }
        found.reservoir = combine.finish(&stream, &balance);
    }
    found
}

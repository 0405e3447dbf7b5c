//! The last step: the shadow ray of the sample that was left, and the colour.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;

use super::super::emitter::Emitter;
use super::super::grid::{TINY, flush_vector};
use super::super::pixel::Scene;
use super::super::skin::Skin;
use super::super::sky::{Sky, sky_sample};
use super::painted::seen_again;
use super::surface::Surface;
use super::target::{as_painted, lit, visible, weighted};
use super::{PixelReservoir, RestirParams, SHADE, step_seed};

/// A pixel of the image; 16 bytes.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Shaded {
    /// Radiance, linear RGB, W/(m² sr).
    pub radiance: [f32; 3],
    /// Shadow rays that this frame traced for the pixel, over all steps.
    pub shadow_rays: u32,
}

const _: () = assert!(size_of::<Shaded>() == 16);

/// The pixel's colour, and its reservoir as the next frame may use it: with [`RestirParams::drops_occluded`], of weight zero
/// if its sample is occluded.
#[inline]
#[must_use]
pub fn shade<L: Emitter>(
    scene: &Scene<'_, L>,
    params: &RestirParams,
    surface: &Surface,
    last: &PixelReservoir,
    pixel: u32,
) -> (Shaded, PixelReservoir) {
    let mut kept = *last;
    let mut reflected = Vec3::ZERO;
    let (material, tint) = seen_again(scene, surface);
    if last.reservoir.weight > 0.0 {
        let sample = last.reservoir.sample;
        let arriving = lit(scene.materials, &scene.emitters, surface, &sample);
        let mut seen = false;
        if arriving.target > 0.0 {
            kept.shadow_rays = kept.shadow_rays.wrapping_add(1);
            seen = visible(&scene.surfaces, surface, arriving.end, sample.light);
        }
        if seen {
            let contribution = as_painted(scene, surface, &material, &sample, &arriving);
            reflected = weighted(contribution, last.reservoir.weight);
        }
        if !seen && params.drops_occluded != 0 {
            kept.reservoir = last.reservoir.occluded();
        }
    }
    if <L::Sky<'_> as Sky>::IS_SAMPLED && surface.is_lit() && surface.material < scene.materials.len() as u32
    {
        // Reservoirs hold lights of the tree; what is without end is sampled anew.
        let seed = step_seed(params, pixel, SHADE);
        reflected += sky_sample(scene, &surface.point, surface.wo(), &material, seed, 0);
        kept.shadow_rays = kept.shadow_rays.wrapping_add(1);
    }
    if <L::Skin<'_> as Skin>::IS_PAINTED {
        reflected = flush_vector(reflected * tint, TINY);
    }
    let shaded = Shaded {
        radiance: [
            surface.direct[0] + reflected.x,
            surface.direct[1] + reflected.y,
            surface.direct[2] + reflected.z,
        ],
        shadow_rays: kept.shadow_rays,
    };
    (shaded, kept)
}

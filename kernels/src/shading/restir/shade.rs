//! The last step: the shadow ray of the sample that was left, and the colour.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;
use lightbvh::exact::{flush, min, pow2};

use super::super::grid::TINY;
use super::super::pixel::Scene;
use super::surface::Surface;
use super::target::{lit, visible};
use super::{PixelReservoir, RestirParams};

/// Contributions count as at most this, W/(m² sr), so that their product with any weight is finite.
const MAX_CONTRIBUTION: f32 = pow2(60);

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
pub fn shade(
    scene: &Scene<'_>,
    params: &RestirParams,
    surface: &Surface,
    last: &PixelReservoir,
) -> (Shaded, PixelReservoir) {
    let mut kept = *last;
    let mut reflected = Vec3::ZERO;
    if last.reservoir.weight > 0.0 {
        let sample = last.reservoir.sample;
        let arriving = lit(scene.materials, &scene.emitters, surface, &sample);
        let mut seen = false;
        if arriving.target > 0.0 {
            kept.shadow_rays = kept.shadow_rays.wrapping_add(1);
            seen = visible(&scene.surfaces, surface, arriving.end, sample.light);
        }
        if seen {
            let w = last.reservoir.weight;
            let c = arriving.contribution;
            reflected = Vec3::new(weighted(c.x, w), weighted(c.y, w), weighted(c.z, w));
        }
        if !seen && params.drops_occluded != 0 {
            kept.reservoir = last.reservoir.occluded();
        }
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

#[inline]
fn weighted(contribution: f32, weight: f32) -> f32 {
    flush(min(contribution, MAX_CONTRIBUTION) * weight, TINY)
}

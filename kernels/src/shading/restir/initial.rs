//! The first step: what the pixel sees, and one light sample out of many candidates (ReSTIR Algorithm 3), kept if nothing
//! shadows it (visibility reuse, Algorithm 5).

use glam::Vec3;
use lightbvh::exact::hash;
use lightbvh::reservoir::Reservoir;

use super::super::camera::Camera;
use super::super::candidates::{Candidates, resampled};
use super::super::emitter::Emitter;
use super::super::numbers::Numbers;
use super::super::pick::PickLight;
use super::super::picks::Picks;
use super::super::pixel::{Scene, see};
use super::surface::Surface;
use super::target::{lit, visible};
use super::{INITIAL, PixelReservoir, RestirParams, step_seed};

/// What pixel `index` sees: the same point for every seed.
#[inline]
#[must_use]
pub fn first_surface<L: Emitter>(
    scene: &Scene<'_, L>,
    camera: &Camera,
    params: &RestirParams,
    index: u32,
) -> Surface {
    let width = if params.width == 0 { 1 } else { params.width };
    let y = index / width;
    let x = index - y * width;
    let ray = camera.ray([x, y], [width, params.height], hash(index), params.jitter);
    let background = Vec3::new(params.background[0], params.background[1], params.background[2]);
    let seen = see(scene, &ray, background);
    let eye = Vec3::new(camera.origin[0], camera.origin[1], camera.origin[2]);
    Surface::new(&seen, eye)
}

/// One sample for `surface` out of [`RestirParams::candidates`] that `picker` draws.
#[inline]
#[must_use]
pub fn first_reservoir<L: Emitter, P: PickLight>(
    scene: &Scene<'_, L>,
    params: &RestirParams,
    picker: &P,
    surface: &Surface,
    index: u32,
) -> PixelReservoir {
    let mut found = PixelReservoir {
        reservoir: Reservoir::EMPTY,
        shadow_rays: 0,
    };
    if surface.is_lit() {
        let seed = step_seed(params, index, INITIAL);
        let which = Candidates {
            first: 0,
            count: params.candidates,
            scattered: 0,
        };
        found.reservoir = resampled(
            scene,
            picker,
            surface,
            &mut Picks::new(Numbers::of(seed), 0, params.candidates, params.candidates),
            which,
            hash(seed.wrapping_add(Numbers::USED)),
        )
        .reservoir;
        if found.reservoir.weight > 0.0 {
            let sample = found.reservoir.sample;
            let end = lit(scene.materials, &scene.emitters, surface, &sample).end;
            found.shadow_rays = 1;
            if !visible(&scene.surfaces, surface, end, sample.light) {
                found.reservoir = found.reservoir.occluded();
            }
        }
    }
    found
}

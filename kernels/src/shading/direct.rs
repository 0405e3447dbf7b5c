//! The light that a surface reflects once, by samples that are each one light out of several candidates, in proportion to what each would
//! contribute if nothing were between: resampled importance sampling (J. Talbot, D. Cline, P. Egbert, "Importance Resampling for
//! Global Illumination", 2005). The target is the luminance of that contribution (B. Bitterli et al., "Spatiotemporal reservoir
//! resampling", 2020, section 3).

use glam::Vec3;
use lightbvh::device::emission::luminance_of;
use lightbvh::device::vector::{flush3, length_squared};
use lightbvh::exact::{flush, hash, min, pow2};
use lightbvh::reservoir::{Resampling, target};

use super::area::Connection;
use super::emitter::Emitter;
use super::grid::{TINY, div};
use super::numbers::{Numbers, Part};
use super::params::RenderParams;
use super::pick::PickLight;
use super::picks::Picks;
use super::pixel::{Scene, Seen, arriving};
use super::trace::NONE;

/// Most candidates of a sample.
pub const MAX_CANDIDATES: u32 = 1 << 8;

/// Contributions count as at most this, W/(m² sr), so that their product with any weight is finite.
const MAX_CONTRIBUTION: f32 = pow2(60);

/// Estimates the light that `seen` reflects to its viewer: the mean of the samples of `params`, of lights chosen by `picker`. `seed`
/// chooses the random numbers.
///
/// The candidates of a sample follow each other in the order of lights, so its ray goes where its part of the lights is, and together
/// the rays go everywhere. Each candidate's own distribution is that of a single pick, and the expectation of a sum does not ask how its
/// terms depend on each other, so the weight is that of independent candidates.
#[inline]
#[must_use]
pub fn reflected<L: Emitter, P: PickLight>(
    scene: &Scene<'_, L>,
    seen: &Seen,
    picker: &P,
    params: &RenderParams,
    seed: u32,
) -> Vec3 {
    let most = if params.candidates < MAX_CANDIDATES {
        params.candidates
    } else {
        MAX_CANDIDATES
    };
    let count = if most == 0 { 1 } else { most };
    let mut sum = Vec3::ZERO;
    if length_squared(seen.point.normal()) > 0.0 && seen.material < scene.materials.len() as u32 {
        let material = scene.material(seen);
        let all = if params.all == 0 {
            params.samples
        } else {
            params.all
        };
        let part = Part {
            index: params.part,
            of: params.parts,
        };
        let of_all = |samples: u32| samples.wrapping_mul(count);
        let mut picks = Picks::new(
            Numbers::of_part(seed, part, of_all(all)),
            of_all(params.first),
            of_all(params.samples),
            of_all(all),
        );
        for sample in 0..params.samples {
            let number = part.number(params.first.wrapping_add(sample));
            let random = hash(seed.wrapping_add(Numbers::USED).wrapping_add(number));
            let mut stream = Resampling::EMPTY;
            let mut found = Connection::NONE;
            let mut found_light = NONE;
            for candidate in 0..count {
                let k = sample.wrapping_mul(count).wrapping_add(candidate);
                let picked = picks.next(picker, &seen.point, k);
                let uv = picks.uv(k);
                let mut own = Connection::NONE;
                if picked.pmf > 0.0 {
                    let light = scene.emitters.light(picked.light, picked.instance);
                    let light = scene.glowing(light, picked.light, uv);
                    own = light.connect(seen.point, seen.wo, material, 1.0, uv);
                }
                let c = own.contribution;
                let target = target(luminance_of(&[c.x, c.y, c.z]));
                let random = hash(random.wrapping_add(candidate));
                if stream.candidate(target, picked.pmf, random) {
                    found = own;
                    found_light = picked.light;
                }
            }
            found.contribution = weighted(found.contribution, stream.weight());
            if found.is_lit() {
                sum += arriving(scene, &seen.point, &found, found_light);
            }
        }
    }
    let count = if params.samples == 0 { 1 } else { params.samples };
    flush3(sum * div(1.0, count as i32 as f32), TINY)
}

/// A contribution times a reservoir's weight, by components.
#[inline]
fn weighted(contribution: Vec3, weight: f32) -> Vec3 {
    let times = |c: f32| flush(min(c, MAX_CONTRIBUTION) * weight, TINY);
    Vec3::new(
        times(contribution.x),
        times(contribution.y),
        times(contribution.z),
    )
}

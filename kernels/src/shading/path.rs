//! Light along whole paths: at each surface one sampled light and one sampled direction, which share what both can find
//! (pbrt-v4, sections 13.2 to 13.4; weights by [`mis_weight`]).

use glam::Vec3;
use lightbvh::device::vector::{dot, flush3, length_squared};
use lightbvh::exact::{floor_u32, flush, hash, max, min, unit_f32};
use lightbvh::light::mis_weight;
use lightbvh::{Random64, ShadingPoint};

use super::emitter::Emitter;
use super::grid::{STEP, TINY, bounded_product, div};
use super::pick::PickLight;
use super::pixel::{Scene, arriving, encounter};
use super::ray::{FAR, Ray};
use super::trace::NONE;

/// Most surfaces that a path may be reflected by.
pub const MAX_BOUNCES: u32 = 64;

/// Paths reflected this often go on only with the probability of their throughput (J. Arvo and D. Kirk, "Particle
/// Transport and Image Synthesis", 1990).
const ROULETTE_FROM: u32 = 3;

/// Random numbers at one surface: three for the light, three for the direction, one for the end.
const RANDOM_LIGHT: u32 = 0;
const RANDOM_DIRECTION: u32 = 3;
const RANDOM_END: u32 = 6;

/// Estimates the radiance that arrives along `ray` by one path of up to `bounces` reflections; `seed` chooses its random
/// numbers. With one bounce that is the light seen, and the light reflected once: what direct lighting estimates, and
/// the background's reflection besides.
///
/// Light seen by the ray itself counts fully, and so does the background wherever a ray leaves the scene: no light is
/// sampled towards it.
#[inline]
#[must_use]
pub fn path_radiance<L: Emitter, P: PickLight>(
    scene: &Scene<'_, L>,
    ray: &Ray,
    background: Vec3,
    picker: &P,
    bounces: u32,
    seed: u32,
) -> Vec3 {
    let bounces = if bounces < MAX_BOUNCES {
        bounces
    } else {
        MAX_BOUNCES
    };
    let mut ray = *ray;
    let mut radiance = Vec3::ZERO;
    let mut throughput = Vec3::ONE;
    // Where the ray was reflected, and with what density into its direction; 0 from the camera, where no light is sampled.
    let mut from = ShadingPoint {
        p: [0.0; 3],
        n: [0.0; 3],
    };
    let mut density = 0.0;
    let mut bounce = 0;
    let mut alive = true;
    while alive {
        let random = hash(seed.wrapping_add(bounce));
        let met = encounter(scene, &ray, background);
        let seen = met.seen;

        let mut weight = 1.0;
        if met.light != NONE && density > 0.0 {
            let light = scene.emitters.light(met.light, met.instance);
            let pmf = picker.pmf(&from, met.light, met.instance);
            weight = if light.is_met() {
                mis_weight(density, light.density(ray.direction * met.distance, pmf))
            } else {
                0.0
            };
        }
        radiance += bounded(throughput, seen.direct * weight);

        let n = flush3(seen.point.normal(), STEP);
        alive = bounce < bounces && length_squared(n) > 0.0 && seen.material < scene.materials.len() as u32;
        if alive {
            let material = scene.material(&seen);
            let number = Random64::from(hash(random.wrapping_add(RANDOM_LIGHT)));
            let picked = picker.pick(&seen.point, number);
            if picked.pmf > 0.0 {
                let light = scene.emitters.light(picked.light, picked.instance);
                let uv = [draw(random, RANDOM_LIGHT + 1), draw(random, RANDOM_LIGHT + 2)];
                let light = scene.glowing(light, picked.light, uv);
                let found = light.connect(seen.point, seen.wo, material, picked.pmf, uv);
                if found.is_lit() {
                    let left = arriving(scene, &seen.point, &found, picked.light);
                    let weight = mis_weight(found.density, found.scattering_density);
                    radiance += bounded(throughput, left * weight);
                }
            }

            let wi = material.sample(
                n,
                seen.wo,
                [
                    draw(random, RANDOM_DIRECTION),
                    draw(random, RANDOM_DIRECTION + 1),
                    draw(random, RANDOM_DIRECTION + 2),
                ],
            );
            let scattering = material.scatter(n, wi, seen.wo);
            density = scattering.density;
            let mut factor = 0.0;
            if density > 0.0 {
                factor = div(flush(dot(n, wi), STEP), density);
            }
            throughput = bounded(throughput, scattering.reflectance * factor);
            bounce += 1;
            throughput *= survival(throughput, bounce, draw(random, RANDOM_END));
            alive = throughput.x + throughput.y + throughput.z > 0.0;
            from = seen.point;
            ray = Ray::new(seen.point.position(), wi, FAR);
        }
    }
    radiance
}

/// By what the throughput of a path is multiplied that may end here: 0 where it ends, else 1 over the probability that
/// it does not, which is a multiple of 2^-8 and so met exactly.
#[inline]
fn survival(throughput: Vec3, bounce: u32, random: f32) -> f32 {
    let largest = min(max(max(throughput.x, throughput.y), throughput.z), 1.0);
    let probability = min(
        (floor_u32(largest * 256.0) + 1) as i32 as f32 * ROULETTE_STEP,
        1.0,
    );
    let mut factor = 1.0;
    if bounce >= ROULETTE_FROM {
        factor = if random < probability {
            div(1.0, probability)
        } else {
            0.0
        };
    }
    factor
}

const ROULETTE_STEP: f32 = 1.0 / 256.0;

#[inline]
fn draw(random: u32, number: u32) -> f32 {
    unit_f32(hash(random.wrapping_add(number)))
}

/// The product by components, none of them tiny, none too large for a sum of many.
#[inline]
fn bounded(a: Vec3, b: Vec3) -> Vec3 {
    Vec3::new(
        bounded_product(a.x, flush(b.x, TINY)),
        bounded_product(a.y, flush(b.y, TINY)),
        bounded_product(a.z, flush(b.z, TINY)),
    )
}

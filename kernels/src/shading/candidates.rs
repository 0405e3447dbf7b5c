//! One light out of several candidates, in proportion to what each would contribute if nothing were between: resampled importance
//! sampling (J. Talbot, D. Cline, P. Egbert, "Importance Resampling for Global Illumination", 2005; ReSTIR Algorithm 3).

use lightbvh::EmissiveTriangle;
use lightbvh::exact::{clamp, hash, unit_f32};
use lightbvh::reservoir::{LightSample, Resampling, Reservoir};

use super::emitters::Emitters;
use super::grid::{STEP, flush_vector, snap_point};
use super::material::Material;
use super::pick::PickLight;
use super::picks::Picks;
use super::pixel::{MAX_CANDIDATES, Scene, load_material};
use super::ray::{FAR, Ray};
use super::restir::surface::Surface;
use super::restir::target::lit;
use super::trace::{NONE, closest_hit};

/// Most directions of a sample.
pub const MAX_SCATTERED: u32 = 1 << 4;

/// The candidates of a pixel that one of its samples is chosen from: `count` from `first` on. They follow each other in the order of
/// lights, so a sample's ray goes where its part of the lights is, and together the rays go everywhere.
#[derive(Clone, Copy, Debug)]
pub struct Candidates {
    /// The first.
    pub first: u32,
    /// How many.
    pub count: u32,
}

/// One of the candidates of `picker` for `surface`. `picks` are all of the pixel, `seed` draws the one among these.
///
/// Each candidate's own distribution is that of a single pick, and the expectation of a sum does not ask how its terms depend on
/// each other, so the weight is that of independent candidates.
#[inline]
#[must_use]
pub fn resampled<P: PickLight>(
    materials: &[Material],
    emitters: &Emitters<'_>,
    picker: &P,
    surface: &Surface,
    picks: &mut Picks,
    which: Candidates,
    seed: u32,
) -> Reservoir {
    let mut stream = Resampling::EMPTY;
    for candidate in 0..which.count {
        let k = which.first.wrapping_add(candidate);
        let picked = picks.next(picker, &surface.point, k);
        let sample = LightSample {
            light: picked.light,
            instance: picked.instance,
            uv: picks.uv(k),
        };
        let arriving = lit(materials, emitters, surface, &sample);
        let random = hash(seed.wrapping_add(candidate));
        stream.candidate(sample, arriving.target, picked.pmf, random);
    }
    stream.finish_equal()
}

/// [`resampled`] with `scattered` more candidates, at most [`MAX_SCATTERED`]: what lies in directions that the surface itself would
/// reflect into, one ray each. A small bright light of a mirror is found by the first kind, a large one in a gloss by the second.
///
/// The balance heuristic shares each point of a light among both kinds (E. Veach and L. Guibas, "Optimally Combining Sampling
/// Techniques for Monte Carlo Rendering", 1995, section 3; within resampling: ReSTIR section 2.4 and D. Lin et al., "Generalized
/// Resampled Importance Sampling", 2022, section 4): its weight is p̂ / (n p + m q) by whichever it was found, with the
/// probabilities p and q that each kind has for it. So the estimate stays unbiased, and no quotient has a small density alone
/// below it.
#[inline]
#[must_use]
pub fn resampled_with_scattered<P: PickLight>(
    scene: &Scene<'_>,
    picker: &P,
    surface: &Surface,
    picks: &mut Picks,
    which: Candidates,
    scattered: u32,
    seed: u32,
) -> Reservoir {
    let scattered = if scattered < MAX_SCATTERED {
        scattered
    } else {
        MAX_SCATTERED
    };
    let balance = Balance {
        picked: which.count as i32 as f32,
        scattered: scattered as i32 as f32,
    };
    let mut stream = Resampling::EMPTY;
    for candidate in 0..which.count {
        let k = which.first.wrapping_add(candidate);
        let picked = picks.next(picker, &surface.point, k);
        let sample = LightSample {
            light: picked.light,
            instance: picked.instance,
            uv: picks.uv(k),
        };
        let arriving = lit(scene.materials, &scene.emitters, surface, &sample);
        let density = if picked.pmf > 0.0 {
            balance.density(picked.pmf, arriving.scattered)
        } else {
            0.0
        };
        stream.candidate(
            sample,
            arriving.target,
            density,
            hash(seed.wrapping_add(candidate)),
        );
    }
    let material = load_material(scene.materials, surface.material);
    let n = flush_vector(surface.point.normal(), STEP);
    for k in 0..scattered {
        let numbers = seed.wrapping_add(SCATTERED + 4 * k);
        let u = [
            draw(numbers),
            draw(numbers.wrapping_add(1)),
            draw(numbers.wrapping_add(2)),
        ];
        let ray = Ray::new(surface.point.position(), material.sample(n, surface.wo(), u), FAR);
        let hit = closest_hit(&scene.surfaces, &ray);
        let triangles = scene.surfaces.triangles;
        if hit.triangle < triangles.len() as u32 {
            let light = triangles[hit.triangle as usize].light;
            let instance = triangles[hit.triangle as usize].instance;
            if light != NONE {
                let emitter = scene.emitters.light(light, instance);
                let sample = LightSample {
                    light,
                    instance,
                    uv: coordinates(&ray, &emitter),
                };
                let arriving = lit(scene.materials, &scene.emitters, surface, &sample);
                let pmf = picker.pmf(&surface.point, light, instance);
                let density = balance.density(pmf, arriving.scattered);
                stream.candidate(sample, arriving.target, density, hash(numbers.wrapping_add(3)));
            }
        }
    }
    stream.finish_balanced(1.0, 1.0)
}

/// The first number of a sample that chooses directions.
const SCATTERED: u32 = MAX_CANDIDATES;

/// How many candidates there are of each kind.
#[derive(Clone, Copy)]
struct Balance {
    picked: f32,
    scattered: f32,
}

impl Balance {
    /// n p + m q, for a light picked with probability `pmf`.
    #[inline]
    fn density(self, pmf: f32, scattered: f32) -> f32 {
        self.picked * pmf + self.scattered * scattered
    }
}

/// The numbers that choose the point of `light` which the ray hits.
#[inline]
fn coordinates(ray: &Ray, light: &EmissiveTriangle) -> [f32; 2] {
    // As the ray BVH has them.
    let p0 = snap_point(light.vertex(0));
    let e1 = snap_point(light.vertex(1)) - p0;
    let e2 = snap_point(light.vertex(2)) - p0;
    let [a, b] = ray.barycentric(p0, e1, e2);
    let a = clamp(a, 0.0, 1.0);
    [a, clamp(b, 0.0, 1.0 - a)]
}

#[inline]
fn draw(number: u32) -> f32 {
    unit_f32(hash(number))
}

//! One light out of several candidates, in proportion to what each would contribute if nothing were between: resampled importance
//! sampling (J. Talbot, D. Cline, P. Egbert, "Importance Resampling for Global Illumination", 2005; ReSTIR Algorithm 3).

use lightbvh::EmissiveTriangle;
use lightbvh::exact::{clamp, hash, unit_f32};
use lightbvh::reservoir::{LightSample, Resampling, Reservoir};

use super::grid::{STEP, flush_vector, snap_point};
use super::pick::PickLight;
use super::picks::Picks;
use super::pixel::{Scene, load_material};
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
    /// How many, at least one.
    pub count: u32,
    /// Directions besides, at most [`MAX_SCATTERED`]: the light that lies in each is a candidate too. The surface chooses them as it
    /// reflects, so they find what a gloss mirrors.
    pub scattered: u32,
}

/// One of the candidates of `picker` for `surface`. `picks` are all of the pixel, `seed` draws the one among these.
///
/// Each candidate's own distribution is that of a single pick, and the expectation of a sum does not ask how its terms depend on
/// each other, so the weight is that of independent candidates.
///
/// With directions, the balance heuristic shares each point of a light among both kinds (E. Veach and L. Guibas, "Optimally Combining
/// Sampling Techniques for Monte Carlo Rendering", 1995, section 3; within resampling: D. Lin et al., "Generalized Resampled
/// Importance Sampling", 2022, section 4): however it was found, its weight is p̂ / (n p + m q), where p and q are the densities of
/// n picks and m directions. So the estimate stays unbiased, and no weight has a small density alone below it.
#[inline]
#[must_use]
pub fn resampled<P: PickLight>(
    scene: &Scene<'_>,
    picker: &P,
    surface: &Surface,
    picks: &mut Picks,
    which: Candidates,
    seed: u32,
) -> Reservoir {
    let scattered = if which.scattered < MAX_SCATTERED {
        which.scattered
    } else {
        MAX_SCATTERED
    };
    let (n, m) = (which.count as i32 as f32, scattered as i32 as f32);
    let mut stream = Resampling::EMPTY;
    for candidate in 0..which.count.wrapping_add(scattered) {
        let found = if candidate < which.count {
            let k = which.first.wrapping_add(candidate);
            let picked = picks.next(picker, &surface.point, k);
            Found {
                sample: LightSample {
                    light: picked.light,
                    instance: picked.instance,
                    uv: picks.uv(k),
                },
                pmf: picked.pmf,
                counts: picked.pmf > 0.0,
            }
        } else {
            mirrored(scene, picker, surface, seed.wrapping_add(DIRECTIONS * candidate))
        };
        let arriving = lit(scene.materials, &scene.emitters, surface, &found.sample);
        let mut density = found.pmf;
        if scattered > 0 {
            density = if found.counts {
                n * found.pmf + m * arriving.scattered
            } else {
                0.0
            };
        }
        let random = hash(seed.wrapping_add(candidate));
        stream.candidate(found.sample, arriving.target, density, random);
    }
    let whole = if scattered > 0 {
        1.0
    } else {
        stream.count as i32 as f32
    };
    stream.finish_balanced(1.0, whole)
}

/// A candidate.
struct Found {
    sample: LightSample,
    /// With which it is picked.
    pmf: f32,
    /// Whether there is one.
    counts: bool,
}

/// The light in a direction that `surface` would reflect into, chosen by `numbers` and the two after it.
#[inline]
fn mirrored<P: PickLight>(scene: &Scene<'_>, picker: &P, surface: &Surface, numbers: u32) -> Found {
    let mut found = Found {
        sample: LightSample::NONE,
        pmf: 0.0,
        counts: false,
    };
    let material = load_material(scene.materials, surface.material);
    let n = flush_vector(surface.point.normal(), STEP);
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
            let uv = coordinates(&ray, &scene.emitters.light(light, instance));
            found = Found {
                sample: LightSample { light, instance, uv },
                pmf: picker.pmf(&surface.point, light, instance),
                counts: true,
            };
        }
    }
    found
}

/// Numbers from one direction's to the next; beyond what draws among the candidates.
const DIRECTIONS: u32 = 1 << 10;

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

//! One light out of several candidates, in proportion to what each would contribute if nothing were between: resampled importance
//! sampling (J. Talbot, D. Cline, P. Egbert, "Importance Resampling for Global Illumination", 2005).

use lightbvh::exact::{hash, max, min, rsqrt, unit_f32};
use lightbvh::reservoir::{LightSample, MAX_WEIGHT, MIN_PMF, Resampling, Reservoir};
use lightbvh::vector::length_squared;

use super::emitter::Emitter;
use super::grid::{STEP, bounded_quotient, flush_vector};
use super::pick::PickLight;
use super::picks::Picks;
use super::pixel::{Scene, Seen, load_material};
use super::ray::{FAR, Ray};
use super::target::{Lit, lit, visible};
use super::trace::{LANES, NONE, closest_hit};

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

/// One of the candidates of `picker` for what is `seen`. `picks` are all of the pixel, `seed` draws the one among these.
///
/// Each candidate's own distribution is that of a single pick, and the expectation of a sum does not ask how its terms depend on
/// each other, so the weight is that of independent candidates.
///
/// With directions, the balance heuristic shares each point of a light among both kinds (E. Veach and L. Guibas, "Optimally Combining
/// Sampling Techniques for Monte Carlo Rendering", 1995, section 3; within resampling: D. Lin et al., "Generalized Resampled
/// Importance Sampling", 2022, section 4): however it was found, its weight is p̂ / (n p + m q), where p and q are the densities of
/// n picks and m directions. So no weight has a small density alone below it. What is visible and yet found by no direction, since
/// another surface lies in the light's plane or just before it, only [`Chosen::arrives`] can tell.
#[inline]
#[must_use]
pub fn resampled<L: Emitter, P: PickLight>(
    scene: &Scene<'_, L>,
    picker: &P,
    seen: &Seen,
    picks: &mut Picks,
    which: Candidates,
    seed: u32,
) -> Chosen {
    let scattered = if which.scattered < MAX_SCATTERED {
        which.scattered
    } else {
        MAX_SCATTERED
    };
    let (n, m) = (which.count as i32 as f32, scattered as i32 as f32);
    let mut stream = Resampling::EMPTY;
    let mut unfound = 1.0;
    for candidate in 0..which.count.wrapping_add(scattered) {
        let found = if candidate < which.count {
            let k = which.first.wrapping_add(candidate);
            let picked = picks.next(picker, &seen.point, k);
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
            mirrored(scene, picker, seen, seed.wrapping_add(DIRECTIONS * candidate))
        };
        let arriving = lit(scene, seen, &found.sample);
        let mut density = found.pmf;
        let mut alone = 1.0;
        if scattered > 0 {
            let (picked, directed) = (n * found.pmf, m * arriving.scattered);
            density = if found.counts { picked + directed } else { 0.0 };
            if candidate < which.count {
                let missing = bounded_quotient(directed, max(picked, MIN_PMF));
                alone = 1.0 + min(missing, MAX_WEIGHT);
            } else {
                alone = 0.0;
            }
        }
        let random = hash(seed.wrapping_add(candidate));
        stream.candidate(found.sample, arriving.target, density, random);
        unfound = if stream.source == candidate {
            alone
        } else {
            unfound
        };
    }
    let whole = if scattered > 0 {
        1.0
    } else {
        stream.count as i32 as f32
    };
    Chosen {
        reservoir: stream.finish(whole),
        unfound,
    }
}

/// One of the candidates.
#[derive(Clone, Copy, Debug)]
pub struct Chosen {
    /// It, with the weight that it has if it is visible, and if directions were tried, found by them.
    pub reservoir: Reservoir,
    /// What is missing from the weight of a pick that no direction finds, (n p + m q) / (n p): 1 where none would be tried. 0 for
    /// what a direction found.
    pub unfound: f32,
}

impl Chosen {
    /// The factor on its weight when rays have told whether `arriving`, its light, arrives: 0 where it is hidden, 1 as a rule.
    ///
    /// A pick may be visible while directions to the same point meet something else: shadow rays end just before the light, and what
    /// lies in its plane hides nothing. Directions then leave out what the balance heuristic left to them, so the pick takes all.
    #[inline]
    #[must_use]
    pub fn arrives<L: Emitter>(&self, scene: &Scene<'_, L>, seen: &Seen, arriving: &Lit) -> f32 {
        let light = self.reservoir.sample.light;
        let mut factor = 1.0;
        if self.unfound > 0.0 {
            let mut found = NONE;
            if self.unfound > 1.0 {
                // Of length 1 as those of directions: rounding decides alike among surfaces at one distance.
                let origin = seen.point.position();
                let d = flush_vector(arriving.on - origin, STEP);
                found = along(scene, &Ray::new(origin, d * rsqrt(length_squared(d)), FAR)).light;
            }
            if found != light {
                factor = if visible(scene, seen, arriving.end, light) {
                    self.unfound
                } else {
                    0.0
                };
            }
        }
        factor
    }
}

/// A candidate.
struct Found {
    sample: LightSample,
    /// With which it is picked.
    pmf: f32,
    /// Whether there is one.
    counts: bool,
}

/// The light in a direction that what is `seen` would reflect into, chosen by `numbers` and the two after it.
#[inline]
fn mirrored<L: Emitter, P: PickLight>(scene: &Scene<'_, L>, picker: &P, seen: &Seen, numbers: u32) -> Found {
    let mut found = Found {
        sample: LightSample::NONE,
        pmf: 0.0,
        counts: false,
    };
    let material = load_material(scene.materials, seen.material);
    let n = flush_vector(seen.point.normal(), STEP);
    let u = [
        draw(numbers),
        draw(numbers.wrapping_add(1)),
        draw(numbers.wrapping_add(2)),
    ];
    let ray = Ray::new(seen.point.position(), material.sample(n, seen.wo, u), FAR);
    let Met { light, instance } = along(scene, &ray);
    if light != NONE {
        let own = scene.emitters.light(light, instance);
        if own.is_met() {
            found = Found {
                sample: LightSample {
                    light,
                    instance,
                    uv: own.coordinates(&ray),
                },
                pmf: picker.pmf(&seen.point, light, instance),
                counts: true,
            };
        }
    }
    found
}

/// The light that is the nearest surface of a ray, if one is.
struct Met {
    light: u32,
    instance: u32,
}

#[inline]
fn along<L: Emitter>(scene: &Scene<'_, L>, ray: &Ray) -> Met {
    let hit = closest_hit(&scene.surfaces, ray);
    let blocks = scene.surfaces.blocks;
    let mut met = Met {
        light: NONE,
        instance: NONE,
    };
    let (block, lane) = (hit.triangle as usize / LANES, hit.triangle as usize % LANES);
    if block < blocks.len() {
        met.light = blocks[block].light[lane];
        met.instance = blocks[block].instance[lane];
    }
    met
}

/// Numbers from one direction's to the next; beyond what draws among the candidates.
const DIRECTIONS: u32 = 1 << 10;

#[inline]
fn draw(number: u32) -> f32 {
    unit_f32(hash(number))
}

//! Light from without end: an environment map and suns, beside the light BVH. A type, so that scenes without pay for nothing.

use glam::Vec3;
use lightbvh::device::vector::dot;
use lightbvh::exact::{hash, max, unit_f32};
use lightbvh::light::infinite::{DistantLight, EnvironmentMap, Split};
use lightbvh::{Random64, ShadingPoint};

use super::area::{Connection, luminance, reflected};
use super::grid::{STEP, bounded_quotient, flush_vector};
use super::material::Material;
use super::ray::FAR;

/// Most sources: the environment, and suns.
const SOURCES: usize = 8;
/// Most suns of a scene.
pub const MAX_SUNS: usize = SOURCES - 1;

/// What is beyond all surfaces.
pub trait Sky: Copy + Send + Sync {
    /// Whether points are lit by it.
    const IS_SAMPLED: bool;

    /// What a ray sees that meets nothing; `background` where there is no map.
    #[inline]
    fn seen(&self, _direction: Vec3, background: Vec3) -> Vec3 {
        background
    }

    /// One direction that light comes from, chosen by three numbers.
    #[inline]
    fn connect(
        &self,
        _point: &ShadingPoint,
        _wo: Vec3,
        _material: &Material,
        _random: u32,
        _uv: [f32; 2],
    ) -> Connection {
        Connection::NONE
    }

    /// The density over solid angle with which [`connect`](Self::connect) finds a direction at `point`, 1/sr; 0 where there is no map.
    #[inline]
    fn density(&self, _point: &ShadingPoint, _direction: Vec3) -> f32 {
        0.0
    }
}

/// Nothing but a background.
#[derive(Clone, Copy, Debug)]
pub struct NoSky;

impl Sky for NoSky {
    const IS_SAMPLED: bool = false;
}

/// A map and suns, as buffers hold them.
#[derive(Clone, Copy, Debug)]
pub struct SkyView<'a> {
    /// The first stands for the map: without direction, its irradiance is what a surface receives of it on average. Then the suns, at most
    /// [`MAX_SUNS`].
    pub suns: &'a [DistantLight],
    /// [`EnvironmentMap::counts`]; empty without a map.
    pub counts: &'a [u32],
    /// [`EnvironmentMap::radiance`].
    pub radiance: &'a [[f32; 3]],
}

impl<'a> SkyView<'a> {
    #[inline]
    fn map(&self) -> EnvironmentMap<'a> {
        let texels = self.radiance.len() as u32;
        // 4^levels texels.
        let levels = if texels > 0 {
            texels.trailing_zeros() >> 1
        } else {
            0
        };
        EnvironmentMap {
            levels,
            counts: self.counts,
            radiance: self.radiance,
        }
    }

    /// The probabilities of the map and of each sun, in proportion to what they send to the point if nothing is between.
    #[inline]
    fn split(&self, point: &ShadingPoint) -> Split<SOURCES> {
        let mut weights = [0.0; SOURCES];
        // By index: rust-gpu has no iterators over slices.
        #[expect(clippy::needless_range_loop)]
        for source in 0..SOURCES {
            if source < self.suns.len() {
                let sun = self.suns[source];
                let irradiance = if source == 0 {
                    sun.irradiance
                } else {
                    sun.irradiance_at(point)
                };
                weights[source] = luminance(irradiance);
            }
        }
        Split::new(weights)
    }
}

impl Sky for SkyView<'_> {
    const IS_SAMPLED: bool = true;

    #[inline]
    fn seen(&self, direction: Vec3, background: Vec3) -> Vec3 {
        let mut seen = background;
        if !self.radiance.is_empty() {
            let [r, g, b] = self.map().radiance([direction.x, direction.y, direction.z]);
            seen = Vec3::new(r, g, b);
        }
        seen
    }

    #[inline]
    fn connect(
        &self,
        point: &ShadingPoint,
        wo: Vec3,
        material: &Material,
        random: u32,
        uv: [f32; 2],
    ) -> Connection {
        let share = self.split(point).choose(Random64::from(random));
        let mut direction = Vec3::ZERO;
        let mut radiance = [0.0; 3];
        // What the light is divided by: a density, or of a sun a probability.
        let mut divisor = 0.0;
        let is_map = share.index == 0;
        if is_map && share.pmf > 0.0 {
            let found = self.map().sample(share.rest, uv);
            direction = Vec3::new(found.direction[0], found.direction[1], found.direction[2]);
            radiance = found.radiance;
            divisor = share.pmf * found.density;
        }
        if !is_map && share.index < self.suns.len() as u32 {
            let sun = self.suns[share.index as usize];
            direction = Vec3::new(sun.direction[0], sun.direction[1], sun.direction[2]);
            radiance = sun.irradiance;
            divisor = share.pmf;
        }
        let n = flush_vector(point.normal(), STEP);
        let receiving = dot(n, direction);
        let mut arriving = Connection {
            direction,
            reach: FAR,
            density: if is_map { divisor } else { 0.0 },
            ..Connection::NONE
        };
        if receiving > STEP && divisor > 0.0 {
            let scattering = material.scatter(n, direction, wo);
            let scale = bounded_quotient(receiving, divisor);
            arriving.contribution = reflected(scattering.reflectance, scale, radiance);
            arriving.scattering_density = if is_map { scattering.density } else { 0.0 };
        }
        arriving
    }

    #[inline]
    fn density(&self, point: &ShadingPoint, direction: Vec3) -> f32 {
        let mut density = 0.0;
        if !self.radiance.is_empty() {
            let found = self.map().density([direction.x, direction.y, direction.z]);
            density = max(self.split(point).pmf(0) * found, 0.0);
        }
        density
    }
}

/// Steps of a sequence of three numbers in units of 2^-32: the first three powers of 1 / g for the root g of g⁴ = g + 1 (M. Roberts,
/// "The Unreasonable Effectiveness of Quasirandom Sequences", 2018).
const R3: [u32; 3] = [0xd1b5_4a33, 0xabc9_8389, 0x8cb9_2ba7];
/// Tells its numbers from those of lights.
const SKY: u32 = 0x5bd1_e995;

/// Sample `number`, of those that `seed` chooses, of the light from without end that a point reflects.
#[inline]
#[must_use]
pub fn sky_sample<S: Sky>(
    sky: &S,
    point: &ShadingPoint,
    wo: Vec3,
    material: &Material,
    seed: u32,
    number: u32,
) -> Connection {
    let seed = hash(seed ^ SKY);
    let at = |k: u32, step: u32| hash(seed.wrapping_add(k)).wrapping_add(number.wrapping_mul(step));
    let uv = [unit_f32(at(1, R3[1])), unit_f32(at(2, R3[2]))];
    sky.connect(point, wo, material, at(0, R3[0]), uv)
}

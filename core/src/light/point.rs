//! A point on a light.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;

use super::{MIN_OFFSET, TWO_SIDED};
use crate::exact::{self, div, flush, pow2};
use crate::point::ShadingPoint;
use crate::vector::{dot, flush3, greatest_exponent, is_zero, length_squared, vector};

/// A point on a light, and the density with which it was chosen. Plain words, the same on devices.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct LightPoint {
    /// The point, metres.
    pub p: [f32; 3],
    /// Density over the light's area, 1/m², at most 2^120; 0 where it has none. Of a triangle, a rectangle and a disc the inverse of their
    /// area, of a sphere that of the part a receiver may see, the same for all its points (where a ray met the light, that of any
    /// [`point_for`](super::Light::point_for) the receiver is the density); 1 of an [`IS_POINT`](Self::IS_POINT).
    ///
    /// For a light chosen with probability `pmf`, seen at distance `d` under the cosine `c` of its normal, the density over solid
    /// angle is `pmf · density · d² / c` (pbrt-v4, section 6.5.4).
    pub density: f32,
    /// Unit normal of the front side; zero where the light has no area.
    pub normal: [f32; 3],
    /// [`EmissiveTriangle::flags`](super::EmissiveTriangle::flags), or [`IS_POINT`](Self::IS_POINT).
    pub flags: u32,
    /// Radiance, W/(m² sr), where `flags` do not say otherwise.
    pub radiance: [f32; 3],
}

const _: () = assert!(size_of::<LightPoint>() == 44);

/// What is sent counts as zero below this, for radiance 1 too: a device would flush some of it.
const LEAST_SENT: f32 = exact::pow2(-120);

impl LightPoint {
    /// Bit of [`flags`](Self::flags): a light without size. `radiance` is its intensity towards the receiver, W/sr, `density` 1, and there is
    /// no cosine at the light.
    pub const IS_POINT: u32 = 2;

    /// The point `p` of a surface of the normal `n`; without density and normal where the light has no area.
    #[inline(always)]
    pub(super) fn on_surface(
        (p, n): (Vec3, Vec3),
        has_area: bool,
        density: f32,
        flags: u32,
        radiance: [f32; 3],
    ) -> Self {
        let density = exact::min(density, MAX_DENSITY);
        Self {
            p: [p.x, p.y, p.z],
            density: if has_area { density } else { 0.0 },
            normal: if has_area { [n.x, n.y, n.z] } else { [0.0; 3] },
            flags,
            radiance,
        }
    }

    /// What the light sends to a point, W/m², one estimate: radiance times both cosines over squared distance and density, nothing between
    /// them. At a point in a volume the receiver's cosine is 1. Zero where it lies within 2^-50 m, and where it is below 2^-120, for radiance 1
    /// too.
    #[inline(always)]
    #[must_use]
    pub fn irradiance(&self, receiver: &ShadingPoint) -> [f32; 3] {
        let Seen {
            d,
            exponent: e,
            squared,
            per_distance,
        } = self.seen_from(receiver.position());
        let n = receiver.normal();
        let incident = dot(d, n) * per_distance;
        let incident = if is_zero(n) {
            1.0
        } else {
            exact::max(incident, 0.0)
        };
        let emitted = self.emitted(d, per_distance);
        let cosines = exact::flush(incident * emitted, exact::pow2(-40));
        let is_near = (squared < 0.25) | (self.density <= 0.0);
        let per_area = exact::div(
            cosines,
            squared * exact::significand(exact::max(self.density, exact::pow2(-120))),
        );
        let scale = -(e + e + exact::exponent(exact::max(self.density, exact::pow2(-120))));
        let scale = if scale > 120 {
            120
        } else if scale < -120 {
            -120
        } else {
            scale
        };
        let factor = if is_near {
            0.0
        } else {
            exact::flush(per_area * exact::pow2(scale), LEAST_SENT)
        };
        let sent = |radiance: f32| exact::flush(exact::min(radiance * factor, f32::MAX), LEAST_SENT);
        [
            sent(self.radiance[0]),
            sent(self.radiance[1]),
            sent(self.radiance[2]),
        ]
    }
}

/// The segment from a receiver to a point on a light.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Seen {
    /// From the receiver to the point, in units of 2^`exponent` metres, its squared length, and the inverse of its length.
    pub d: Vec3,
    pub exponent: i32,
    pub squared: f32,
    pub per_distance: f32,
}

impl LightPoint {
    #[inline(always)]
    pub(crate) fn seen_from(&self, from: Vec3) -> Seen {
        let away = vector(&self.p) - from;
        let exponent = greatest_exponent(away, -50);
        let d = flush3(away * exact::pow2(-exponent), exact::pow2(-60));
        let squared = exact::max(length_squared(d), exact::pow2(-60));
        Seen {
            d,
            exponent,
            squared,
            per_distance: exact::rsqrt(squared),
        }
    }

    /// The cosine at the light, or 1 where it has none.
    #[inline(always)]
    fn emitted(&self, d: Vec3, per_distance: f32) -> f32 {
        let emitted = -(dot(d, vector(&self.normal)) * per_distance);
        let emitted = if self.flags & TWO_SIDED != 0 {
            exact::abs(emitted)
        } else {
            exact::max(emitted, 0.0)
        };
        if self.flags & Self::IS_POINT != 0 {
            1.0
        } else {
            emitted
        }
    }

    /// Density over solid angle, 1/sr, with which a receiver at `from` finds the point where its light is chosen with probability `pmf`: `pmf · density ·
    /// d² / c` (pbrt-v4, section 6.5.4), at most 2^120. Zero where the light does not emit to there, and of lights that no ray meets: points and spots.
    #[inline(always)]
    #[must_use]
    pub fn density_seen(&self, from: Vec3, pmf: f32) -> f32 {
        let seen = self.seen_from(from);
        let cosine = exact::flush(self.emitted(seen.d, seen.per_distance), exact::pow2(-40));
        let has_area = self.flags & Self::IS_POINT == 0;
        let counts = has_area & (cosine > 0.0) & (self.density > 0.0) & (seen.squared >= 0.25);
        let density = exact::max(self.density, exact::pow2(-120));
        let value = exact::div(
            seen.squared * exact::significand(density),
            if counts { cosine } else { 1.0 },
        );
        let e = seen.exponent + seen.exponent + exact::exponent(density);
        let e = if e > 75 {
            75
        } else if e < -75 {
            -75
        } else {
            e
        };
        let found = exact::min(value * exact::pow2(e), MAX_DENSITY) * pmf;
        if counts {
            exact::flush(found, LEAST_SENT)
        } else {
            0.0
        }
    }
}

/// Greatest density over area, 1/m².
const MAX_DENSITY: f32 = exact::pow2(120);

/// Ratios of densities below this count as zero, so that their squares are normal numbers.
const LEAST_RATIO: f32 = pow2(-60);

/// The power heuristic with exponent 2 (E. Veach and L. Guibas, "Optimally Combining Sampling Techniques for Monte Carlo
/// Rendering", 1995, section 5.2; one sample by each technique): the weight of a direction found with density `own`, which
/// the other finds with density `other`; both 0 or normal numbers. 1 where `own` is 0: points and spots, which no ray meets. On devices densities
/// are 0 or at least 2^-100, and at most 2^104.
///
/// The weights of the two techniques, each the other's `other`, sum to one within one rounding of each.
#[cfg_attr(target_arch = "spirv", inline(never))]
#[cfg_attr(not(target_arch = "spirv"), inline)]
#[must_use]
pub fn mis_weight(own: f32, other: f32) -> f32 {
    let less = own < other;
    let greater = if less { other } else { own };
    let smaller = if less { own } else { other };
    let mut ratio = 0.0;
    if smaller > 0.0 {
        ratio = flush(div(smaller, greater), LEAST_RATIO);
    }
    let squared = ratio * ratio;
    div(if less & (own > 0.0) { squared } else { 1.0 }, 1.0 + squared)
}

/// A uniformly distributed point on the triangle at `p0` with edges `e1` and `e2`, from two numbers in [0, 1): a point of the
/// parallelogram, folded over its diagonal (G. Turk, "Generating random points in triangles", Graphics Gems, 1990). No root,
/// and both numbers stay stratified but for the fold. Parts of edges below 2^-103 m count as zero: no sum is subnormal.
#[inline]
#[must_use]
pub fn uniform_point(p0: Vec3, e1: Vec3, e2: Vec3, u: f32, v: f32) -> Vec3 {
    let fold = u + v > 1.0;
    let a = if fold { 1.0 - u } else { u };
    let b = if fold { 1.0 - v } else { v };
    (p0 + flush3(e1 * a, MIN_OFFSET)) + flush3(e2 * b, MIN_OFFSET)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kit::triangle;

    #[test]
    fn density_is_the_inverse_of_the_area_at_every_size() {
        // Area 6 in units of the scale squared.
        for e in [-100, -63, -58, -30, 0, 7, 38] {
            let s = exact::pow2(e);
            let light = triangle([[s, 0.0, 2.0 * s], [4.0 * s, 0.0, 2.0 * s], [s, 4.0 * s, 2.0 * s]]);
            let at = light.point([0.25, 0.5]);
            let expected = ((1.0 / 6.0) * 2.0_f64.powi(-2 * e)).min(2.0_f64.powi(120));
            assert!(
                (f64::from(at.density) / expected - 1.0).abs() < 1e-6,
                "2^{e}: {at:?}"
            );
            assert_eq!((at.normal, at.p), ([0.0, 0.0, 1.0], [1.75 * s, 2.0 * s, 2.0 * s]));
        }
        for e in [-90, -60, -40, -20] {
            let sliver = triangle([[0.0; 3], [1.0, 0.0, 0.0], [1.0, exact::pow2(e), 0.0]]);
            let at = sliver.point([0.25, 0.5]);
            let expected = 2.0_f64.powi(1 - e);
            assert!(
                (f64::from(at.density) / expected - 1.0).abs() < 1e-6,
                "2^{e}: {at:?}"
            );
            assert_eq!(at.normal, [0.0, 0.0, 1.0]);
        }
    }

    #[test]
    fn light_within_a_tiny_distance_counts_as_none() {
        for flags in [0, LightPoint::IS_POINT] {
            let at = LightPoint {
                flags,
                ..triangle([[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]).point([0.0; 2])
            };
            let p = [at.p[0], at.p[1], exact::pow2(-55)];
            let receiver = ShadingPoint { p, n: [0.0; 3] };
            assert_eq!(at.irradiance(&receiver), [0.0; 3]);
            assert_eq!(at.density_seen(receiver.position(), 1.0), 0.0);
        }
    }

    #[test]
    fn a_triangle_without_area_has_no_density() {
        for p in [
            [[1.0; 3]; 3],
            [[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]],
            [[0.0; 3]; 3],
        ] {
            let at = triangle(p).point([0.5, 0.25]);
            assert_eq!((at.density, at.normal), (0.0, [0.0; 3]), "{p:?}");
        }
    }

    /// Moments of the uniform distribution: mean at the centroid, covariance Σ(v − c)(v − c)ᵀ / 12.
    #[test]
    fn points_are_uniform() {
        let light = triangle([[1.0, 2.0, 3.0], [3.0, 2.0, 2.0], [0.0, 5.0, 3.0]]);
        let c = [4.0 / 3.0, 3.0, 8.0 / 3.0];
        let off = |p: [f32; 3]| [0, 1, 2].map(|k| f64::from(p[k]) - c[k]);
        let (mut mean, mut square, n) = ([0.0_f64; 3], 0.0_f64, 512);
        for i in 0..n * n {
            let uv = [i % n, i / n].map(|k| (k as f32 + 0.5) / n as f32);
            let d = off(light.point(uv).p).map(|d| d / f64::from(n));
            mean = [0, 1, 2].map(|k| mean[k] + d[k] / f64::from(n));
            square += d.iter().map(|d| d * d).sum::<f64>();
        }
        let spread: f64 = light.p.iter().flat_map(|&v| off(v)).map(|d| d * d).sum();
        assert!(mean.iter().all(|d| d.abs() < 1e-4), "{mean:?}");
        assert!((square / spread * 12.0 - 1.0).abs() < 1e-3, "{square} {spread}");
    }
}

//! Next-event estimation: what one chosen emissive triangle contributes to a point, by one random point on it.

use glam::Vec3;
use lightbvh::device::vector::{cross, dot, length_squared};
use lightbvh::exact::{abs, flush, max, min, pow2, rsqrt};
use lightbvh::light::uniform_point;
use lightbvh::{EmissiveTriangle, ShadingPoint};

use super::grid::{STEP, TINY, TINY_AREA, bounded_product, bounded_quotient, div, flush_vector};
use super::material::Material;

/// How far a point is moved off its triangle, relative to the triangle's largest coordinate.
///
/// A point computed on a triangle is off its plane by some units of 2^-24 times the coordinates it was computed from,
/// and the ray test by as much again, so 2^-18 leaves a margin of several. The price is a bias: what lies nearer to the
/// surface than that (0.04 mm where coordinates reach 10 m) casts no shadow.
pub(super) const OFFSET: f32 = pow2(-18);

/// Receivers nearer to the light's point than 2^-30 m get nothing: the estimate has a pole there.
pub(super) const NEAREST_SQUARED: f32 = pow2(-60);

/// Densities over solid angle are cut to this: only their ratios count, and those of a light seen under so small an angle
/// are decided.
pub(super) const MAX_DENSITY: f32 = pow2(100);

/// Relative luminance of linear RGB (Rec. ITU-R BT.709-6).
#[inline]
#[must_use]
pub fn luminance(rgb: [f32; 3]) -> f32 {
    (0.2126 * rgb[0] + 0.7152 * rgb[1]) + 0.0722 * rgb[2]
}

/// What of `radiance` a surface of reflectance `f` reflects, times `scale`, by components.
#[inline]
pub(super) fn reflected(f: Vec3, scale: f32, radiance: [f32; 3]) -> Vec3 {
    Vec3::new(
        bounded_product(bounded_product(f.x, scale), radiance[0]),
        bounded_product(bounded_product(f.y, scale), radiance[1]),
        bounded_product(bounded_product(f.z, scale), radiance[2]),
    )
}

/// The distance by which rays start off, and end before, a triangle with these vertices, metres.
#[inline]
#[must_use]
pub fn offset_distance(p0: Vec3, p1: Vec3, p2: Vec3) -> f32 {
    let largest = max(
        max(largest_component(p0), largest_component(p1)),
        largest_component(p2),
    );
    max(largest, OFFSET) * OFFSET
}

#[inline]
pub(super) fn largest_component(v: Vec3) -> f32 {
    max(max(abs(v.x), abs(v.y)), abs(v.z))
}

/// Light from one direction, and what it would contribute if nothing were between.
#[derive(Clone, Copy, Debug)]
pub struct Connection {
    /// The light that the receiver reflects to its viewer, divided by the probability of the light and the density of
    /// the point: an estimate of the direct light of all lights, W/(m² sr). Zero where the light faces away, or is
    /// behind the surface.
    pub contribution: Vec3,
    /// Direction of the shadow ray: to just before the light, metres.
    pub direction: Vec3,
    /// Density over solid angle of finding the direction this way, 1/sr.
    pub density: f32,
    /// Density over solid angle of finding it by [`Material::sample`], 1/sr; 0 of what no such direction finds.
    pub scattering_density: f32,
}

impl Connection {
    /// No light.
    pub const NONE: Self = Self {
        contribution: Vec3::ZERO,
        direction: Vec3::ZERO,
        density: 0.0,
        scattering_density: 0.0,
    };

    /// Whether anything would arrive if nothing were between.
    #[inline]
    #[must_use]
    pub fn is_lit(&self) -> bool {
        self.contribution.x + self.contribution.y + self.contribution.z > 0.0
    }
}

/// Squared distance of a point from a light along `d`, and what of the light faces the point: twice its area times the
/// cosine there times the distance, m³. Zero where the light faces away, or is too near, small or edge-on to count.
#[inline]
fn facing(d: Vec3, m: Vec3, two_sided: bool) -> (f32, f32) {
    let squared = length_squared(d);
    let front = -dot(m, d);
    let emitting = if two_sided { abs(front) } else { front };
    let counts = emitting > TINY && squared > NEAREST_SQUARED;
    (squared, if counts { emitting } else { 0.0 })
}

/// Density over solid angle of what [`facing`] tells of, for a light chosen with probability `pmf` and a uniformly
/// distributed point on it: `pmf |d|² / (A cos)`, 0 below 2^-100.
#[inline]
fn density(squared: f32, emitting: f32, pmf: f32) -> f32 {
    let mut density = 0.0;
    if emitting > 0.0 {
        let twice_area_cos = max(emitting * rsqrt(squared), TINY_AREA);
        density = flush(2.0 * pmf * min(div(squared, twice_area_cos), MAX_DENSITY), TINY);
    }
    density
}

/// The density over solid angle with which [`connect`] finds what is seen of `light` at `d` from a point, when the light
/// is chosen there with probability `pmf`, 1/sr.
#[inline]
#[must_use]
pub fn light_density(d: Vec3, light: &EmissiveTriangle, pmf: f32) -> f32 {
    let p0 = light.vertex(0);
    let e1 = flush_vector(light.vertex(1) - p0, STEP);
    let e2 = flush_vector(light.vertex(2) - p0, STEP);
    let m = flush_vector(cross(e1, e2), TINY_AREA);
    let (squared, emitting) = facing(flush_vector(d, STEP), m, light.is_two_sided());
    density(squared, emitting, pmf)
}

/// Connects `point` with a uniformly distributed point `y` of `light`, which was chosen with probability `pmf`.
///
/// With `d = y - p` and the light's normal `m` of length `2 A`, density `1 / A` over the area becomes over solid angle
/// `|d|² / (A cos)`, so that `f L cos cos' A / (|d|² pmf) = f L (n . d) (-m . d) / (2 |d|⁴ pmf)`: no root is taken.
/// A point without normal (`n` zero) is one in a volume and gets nothing here.
#[inline]
#[must_use]
pub fn connect(
    point: &ShadingPoint,
    wo: Vec3,
    material: &Material,
    light: &EmissiveTriangle,
    pmf: f32,
    uv: [f32; 2],
) -> Connection {
    let (p0, p1, p2) = (light.vertex(0), light.vertex(1), light.vertex(2));
    let e1 = flush_vector(p1 - p0, STEP);
    let e2 = flush_vector(p2 - p0, STEP);
    let m = flush_vector(cross(e1, e2), TINY_AREA);
    let y = uniform_point(p0, e1, e2, uv[0], uv[1]);

    let n = flush_vector(point.normal(), STEP);
    let d = flush_vector(y - point.position(), STEP);
    let receiving = dot(n, d);
    let (squared, emitting) = facing(d, m, light.is_two_sided());
    let lit = receiving > 0.0 && emitting > 0.0 && pmf > 0.0;

    let mut contribution = Vec3::ZERO;
    let mut scattering_density = 0.0;
    if lit {
        let weight = flush(div(receiving, squared) * div(emitting, squared), TINY);
        let scale = bounded_quotient(0.5 * weight, pmf);
        let scattering = material.scatter(n, d * rsqrt(squared), wo);
        contribution = reflected(scattering.reflectance, scale, light.radiance);
        scattering_density = scattering.density;
    }

    // Off the light's plane, towards the receiver.
    let offset = offset_distance(p0, p1, p2);
    let area_squared = length_squared(m);
    let towards = if dot(m, d) > 0.0 { -offset } else { offset };
    let shift = if area_squared > 0.0 {
        m * rsqrt(area_squared) * towards
    } else {
        Vec3::ZERO
    };
    Connection {
        contribution,
        direction: (y + shift) - point.position(),
        density: density(squared, emitting, pmf),
        scattering_density,
    }
}

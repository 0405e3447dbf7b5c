//! What a point on a light contributes to a receiver, and the offsets that keep a surface from shadowing itself.

use glam::Vec3;
use lightbvh::exact::{abs, max, pow2};

use super::grid::bounded_product;

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
    /// Density over solid angle of finding it by [`Material::sample`](super::material::Material::sample), 1/sr; 0 of what no such direction finds.
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

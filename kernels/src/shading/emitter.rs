//! A light as the renderer shows it. Each pass is compiled for one type of light: triangles alone, or any kind, so that a scene of
//! triangles pays for no other.

use glam::Vec3;
use lightbvh::device::vector::{dot, flush3, length_squared};
use lightbvh::exact::{abs, flush, max, min, rsqrt};
use lightbvh::light::{AnyLight, Light};
use lightbvh::{EmissiveTriangle, LightPoint, ShadingPoint};

use super::area::{Connection, MAX_DENSITY, NEAREST_SQUARED, OFFSET, largest_component, reflected};
use super::grid::{STEP, TINY, TINY_AREA, bounded_product, bounded_quotient, div, sqrt};
use super::material::Material;
use super::textures::{NoTextures, TextureView, Textures};

/// A light that points are lit by, and that rays may meet.
pub trait Emitter: Light {
    /// The textures of such scenes.
    type Textures<'a>: Textures;

    /// Connects `point` with the point of this light that `uv` chooses, where the light was chosen with probability `pmf`.
    // A function of its own on devices, by value: passes connect in several places, and it is long.
    #[cfg_attr(target_arch = "spirv", inline(never))]
    #[cfg_attr(not(target_arch = "spirv"), inline)]
    #[must_use]
    fn connect(
        self,
        point: ShadingPoint,
        wo: Vec3,
        material: Material,
        pmf: f32,
        uv: [f32; 2],
    ) -> Connection {
        let at = self.point_for(point.position(), uv);
        connect_point(&point, wo, &material, &at, pmf, self.is_met())
    }

    /// Whether rays that leave a surface find its light too. What they do not find, [`connect`](Self::connect) alone brings, and where
    /// they meet it, it counts only if the camera sees it.
    fn is_met(&self) -> bool;

    /// The density over solid angle with which [`connect`](Self::connect) finds what is seen of it at `d` from a point, when it is chosen
    /// there with probability `pmf`, 1/sr. Of lights that [are met](Self::is_met).
    #[inline]
    fn density(&self, d: Vec3, pmf: f32) -> f32 {
        // Lights that are met are flat: all their points have one normal and one density.
        let at = self.point_for(Vec3::ZERO, [0.0; 2]);
        let (squared, facing) = facing(flush3(d, STEP), &at);
        density(squared, facing, at.density, pmf)
    }

    /// Whether its surface emits from both sides.
    fn has_two_sides(&self) -> bool;

    /// The radiance of its surface, seen from its front or back.
    #[inline]
    fn emitted(&self, front: bool) -> Vec3 {
        let mut seen = Vec3::ZERO;
        if front || self.has_two_sides() {
            let [r, g, b] = self.emission();
            seen = Vec3::new(r, g, b);
        }
        seen
    }

    /// Its radiance, or what it has in place of that.
    fn emission(&self) -> [f32; 3];

    /// It with another.
    #[inline]
    #[must_use]
    fn with_emission(self, _emission: [f32; 3]) -> Self {
        self
    }
}

impl Emitter for EmissiveTriangle {
    type Textures<'a> = NoTextures;

    #[inline]
    fn is_met(&self) -> bool {
        true
    }

    #[inline]
    fn has_two_sides(&self) -> bool {
        self.is_two_sided()
    }

    #[inline]
    fn emission(&self) -> [f32; 3] {
        self.radiance
    }
}

/// Triangles and rectangles are met. A sphere and a disc are seen as facets within them, which hold some of their points and not others, so
/// no ray but the camera's counts; points and spots are not seen.
impl Emitter for AnyLight {
    type Textures<'a> = TextureView<'a>;

    #[inline]
    fn is_met(&self) -> bool {
        let kind = self.kind();
        kind == Self::TRIANGLE || kind == Self::RECTANGLE
    }

    #[inline]
    fn has_two_sides(&self) -> bool {
        self.is_two_sided()
    }

    #[inline]
    fn emission(&self) -> [f32; 3] {
        Self::emission(self)
    }

    #[inline]
    fn with_emission(self, emission: [f32; 3]) -> Self {
        Self::with_emission(self, emission)
    }
}

#[inline]
fn place(at: &LightPoint) -> Vec3 {
    Vec3::new(at.p[0], at.p[1], at.p[2])
}

/// Squared distance of a point from `at` along `d`, and the distance times the cosine at the light, which is 1 where it has no surface.
/// Zero where it faces away, or is too near or edge-on to count.
#[inline]
fn facing(d: Vec3, at: &LightPoint) -> (f32, f32) {
    let squared = length_squared(d);
    let own = flush3(Vec3::new(at.normal[0], at.normal[1], at.normal[2]), STEP);
    let front = -dot(own, d);
    let has_surface = at.flags & LightPoint::IS_POINT == 0;
    let is_two_sided = at.flags & EmissiveTriangle::TWO_SIDED != 0;
    let emitting = if has_surface {
        if is_two_sided { abs(front) } else { front }
    } else {
        sqrt(squared)
    };
    let counts = emitting > TINY_AREA && squared > NEAREST_SQUARED && at.density > 0.0;
    (squared, if counts { emitting } else { 0.0 })
}

/// Density over solid angle of what [`facing`] tells of: `pmf per_area |d|³ / facing`, 0 below 2^-100.
#[inline]
fn density(squared: f32, facing: f32, per_area: f32, pmf: f32) -> f32 {
    let mut density = 0.0;
    if facing > 0.0 {
        let cosine = max(facing * rsqrt(squared), TINY_AREA);
        let per_area = bounded_product(min(div(squared, cosine), MAX_DENSITY), per_area);
        density = flush(pmf * per_area, TINY);
    }
    density
}

/// Connects `point` with `at`, a point of a light that was chosen with probability `pmf`, with `d` from one to the other:
/// `f L (n . d) (-m . d) / (|d|⁴ density pmf)` for the light's unit normal `m`, and `|d|` in the place of `-m . d` where it has none.
#[inline]
fn connect_point(
    point: &ShadingPoint,
    wo: Vec3,
    material: &Material,
    at: &LightPoint,
    pmf: f32,
    is_met: bool,
) -> Connection {
    let y = place(at);
    let n = flush3(point.normal(), STEP);
    let d = flush3(y - point.position(), STEP);
    let receiving = dot(n, d);
    let (squared, facing) = facing(d, at);

    let mut contribution = Vec3::ZERO;
    let mut scattering_density = 0.0;
    if receiving > 0.0 && facing > 0.0 && pmf > 0.0 {
        let weight = flush(div(receiving, squared) * div(facing, squared), TINY);
        let scale = bounded_quotient(bounded_quotient(weight, at.density), pmf);
        let scattering = material.scatter(n, d * rsqrt(squared), wo);
        contribution = reflected(scattering.reflectance, scale, at.radiance);
        scattering_density = if is_met { scattering.density } else { 0.0 };
    }

    // Off the light's plane, towards the receiver.
    let own = flush3(Vec3::new(at.normal[0], at.normal[1], at.normal[2]), STEP);
    let offset = max(largest_component(y), OFFSET) * OFFSET;
    let towards = if dot(own, d) > 0.0 { -offset } else { offset };
    Connection {
        contribution,
        direction: (y + own * towards) - point.position(),
        density: density(squared, facing, at.density, pmf),
        scattering_density,
    }
}

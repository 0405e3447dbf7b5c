//! p̂, the target that samples are resampled by: the luminance of the unshadowed contribution (ReSTIR section 3).

use glam::Vec3;
use lightbvh::exact::{flush, min, pow2};
use lightbvh::reservoir::{LightSample, target};

use super::super::area::{Connection, luminance};
use super::super::emitter::Emitter;
use super::super::emitters::Emitters;
use super::super::grid::{TINY, bounded_quotient};
use super::super::material::Material;
use super::super::pixel::{Scene, load_material};
use super::super::ray::Ray;
use super::super::skin::{SHADOW, Skin, Through};
use super::super::trace::{NONE, Surfaces, any_hit, through};
use super::surface::Surface;

/// Contributions count as at most this, W/(m² sr), so that their product with any weight is finite.
const MAX_CONTRIBUTION: f32 = pow2(60);

/// Densities over the unit square count as at most this, so that no weight is tiny.
const MAX_SCATTERED: f32 = pow2(50);

/// What a light sample contributes to a surface if nothing is between.
#[derive(Clone, Copy, Debug)]
pub struct Lit {
    /// The integrand over lights and the unit square, W/(m² sr).
    pub contribution: Vec3,
    /// p̂: zero where the contribution is, else in the range that [`target`] states.
    pub target: f32,
    /// The density over the light's unit square with which [`Material::sample`] finds the point.
    pub scattered: f32,
    /// The end of the shadow ray.
    pub end: Vec3,
    /// The point on the light, which that is just before.
    pub on: Vec3,
}

/// The light of `sample` at `surface`; nothing for a light or material that is not there. Both have the means of what is painted on them: a
/// target need not be exact, and [`as_painted`] is.
#[inline]
#[must_use]
pub fn lit<L: Emitter>(
    materials: &[Material],
    emitters: &Emitters<'_, L>,
    surface: &Surface,
    sample: &LightSample,
) -> Lit {
    let mut lit = Lit {
        contribution: Vec3::ZERO,
        target: 0.0,
        scattered: 0.0,
        end: Vec3::ZERO,
        on: Vec3::ZERO,
    };
    if sample.light != NONE && surface.material < materials.len() as u32 && surface.is_lit() {
        let material = load_material(materials, surface.material);
        let light = emitters.light(sample.light, sample.instance);
        let connection = light.connect(
            &surface.point,
            surface.wo(),
            &material,
            1.0,
            [sample.uv[0], sample.uv[1]],
        );
        let c = connection.contribution;
        lit.contribution = c;
        lit.target = target(luminance([c.x, c.y, c.z]));
        lit.scattered = scattered(&connection);
        lit.end = connection.target;
        lit.on = connection.on;
    }
    lit
}

/// Over the unit square of its points a light has the density 1: over solid angle, that of the connection.
#[inline]
fn scattered(connection: &Connection) -> f32 {
    let mut scattered = 0.0;
    if connection.density > 0.0 {
        let ratio = bounded_quotient(connection.scattering_density, connection.density);
        scattered = min(ratio, MAX_SCATTERED);
    }
    scattered
}

/// Whether nothing lies between the surface and the point of `light` that `end` is just before: one shadow ray.
#[inline]
#[must_use]
pub fn visible<S: Skin>(surfaces: &Surfaces<'_, S>, surface: &Surface, end: Vec3, light: u32) -> bool {
    let origin = surface.point.position();
    let ray = Ray::new(origin, end - origin, 1.0);
    !any_hit(surfaces, &ray, light)
}

/// What `sample` contributes to `surface`, which it is seen from: as painted, through what lets light through. `mean` is what [`lit`] says.
#[inline]
#[must_use]
pub fn as_painted<L: Emitter>(
    scene: &Scene<'_, L>,
    surface: &Surface,
    material: &Material,
    sample: &LightSample,
    mean: &Lit,
) -> Vec3 {
    let mut contribution = mean.contribution;
    if <L::Skin<'_> as Skin>::IS_PAINTED {
        let uv = [sample.uv[0], sample.uv[1]];
        let light = scene.emitters.light(sample.light, sample.instance);
        let light = scene.glowing(light, sample.light, surface.point.position(), uv);
        contribution = light
            .connect(&surface.point, surface.wo(), material, 1.0, uv)
            .contribution;
        if scene.surfaces.skin.has_veils() {
            let origin = surface.point.position();
            let ray = Ray::new(origin, mean.end - origin, 1.0);
            contribution = through::<SHADOW, _>(&scene.surfaces, &ray, sample.light).of(contribution);
        }
    }
    contribution
}

/// A contribution times a reservoir's weight, by components.
#[inline]
#[must_use]
pub fn weighted(contribution: Vec3, weight: f32) -> Vec3 {
    Vec3::new(
        flush(min(contribution.x, MAX_CONTRIBUTION) * weight, TINY),
        flush(min(contribution.y, MAX_CONTRIBUTION) * weight, TINY),
        flush(min(contribution.z, MAX_CONTRIBUTION) * weight, TINY),
    )
}

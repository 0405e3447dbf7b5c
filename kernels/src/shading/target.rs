//! p̂, the target that candidates are resampled by: the luminance of the unshadowed contribution (B. Bitterli et al.,
//! "Spatiotemporal reservoir resampling", 2020, section 3).

use glam::Vec3;
use lightbvh::exact::{flush, min, pow2};
use lightbvh::reservoir::{LightSample, target};

use super::area::{Connection, luminance};
use super::emitter::Emitter;
use super::grid::{TINY, bounded_quotient};
use super::material::Material;
use super::pixel::{Scene, Seen, load_material};
use super::ray::Ray;
use super::skin::{SHADOW, Skin, Through};
use super::trace::{NONE, any_hit, through};

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

/// The light of `sample` at what is `seen`, whose material is there; nothing for a light that is not there. Both have the means of
/// their textures: a target need not be exact, and [`as_painted`] is.
#[inline]
#[must_use]
pub fn lit<L: Emitter>(scene: &Scene<'_, L>, seen: &Seen, sample: &LightSample) -> Lit {
    let mut lit = Lit {
        contribution: Vec3::ZERO,
        target: 0.0,
        scattered: 0.0,
        end: Vec3::ZERO,
        on: Vec3::ZERO,
    };
    if sample.light != NONE {
        let material = load_material(scene.materials, seen.material);
        let light = scene.emitters.light(sample.light, sample.instance);
        let uv = [sample.uv[0], sample.uv[1]];
        let connection = light.connect(&seen.point, seen.wo, &material, 1.0, uv);
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

/// Whether nothing lies between what is `seen` and the point of `light` that `end` is just before: one shadow ray.
#[inline]
#[must_use]
pub fn visible<L: Emitter>(scene: &Scene<'_, L>, seen: &Seen, end: Vec3, light: u32) -> bool {
    let origin = seen.point.position();
    !any_hit(&scene.surfaces, &Ray::new(origin, end - origin, 1.0), light)
}

/// What `sample` contributes to what is `seen`: by the textures themselves, through what lets light through. `mean` is what [`lit`]
/// returns.
#[inline]
#[must_use]
pub fn as_painted<L: Emitter>(
    scene: &Scene<'_, L>,
    seen: &Seen,
    material: &Material,
    sample: &LightSample,
    mean: &Lit,
) -> Vec3 {
    let mut contribution = mean.contribution;
    if <L::Skin<'_> as Skin>::IS_PAINTED {
        let uv = [sample.uv[0], sample.uv[1]];
        let light = scene.emitters.light(sample.light, sample.instance);
        let light = scene.glowing(light, sample.light, seen.point.position(), uv);
        contribution = light
            .connect(&seen.point, seen.wo, material, 1.0, uv)
            .contribution;
        if scene.surfaces.skin.has_veils() {
            let origin = seen.point.position();
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

//! One call for a light sample with all that shading needs, and one for its density where a ray meets a light.

use super::Bvh;
use super::edit::InstanceId;
use crate::exact::{self, pow2};
use crate::importance::ImportanceModel;
use crate::light::{Light, LightPoint};
use crate::model::Model;
use crate::point::{Receiver, ShadingPoint};
use crate::random::Random64;
use crate::vector::vector;

/// A light sample: the light, a point on it, and its irradiance. The estimate is [`irradiance`](Self::irradiance) over [`pmf`](Self::pmf).
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Sampled<L> {
    /// The light, in the world.
    pub light: L,
    /// Whose it is.
    pub instance: InstanceId,
    /// Its place in its mesh, as that was given, counting from 0.
    pub part: u32,
    /// Probability of the light, in (0, 1].
    pub pmf: f32,
    /// The point on it, with its density over area.
    pub point: LightPoint,
    /// Direction from the receiver to the point, of length 1 within 2^-16; zero where it lies within 2^-50 m.
    pub direction: [f32; 3],
    /// Distance to the point, metres.
    pub distance: f32,
    /// Density over solid angle, `pmf` included, 1/sr; 0 where no ray meets the light, as of points and spots.
    pub pdf: f32,
    /// Irradiance at the front of the receiver from the point, visibility apart, W/m², linear RGB: [`LightPoint::irradiance`].
    pub irradiance: [f32; 3],
}

impl<L> Sampled<L> {
    /// The weight of this sample beside a ray whose direction the surface chose with density `scattering`, 1/sr, by the power heuristic
    /// (Veach & Guibas 1995); 1 where no ray meets the light. The ray's weight is 1 − [`mis_weight`](fn@mis_weight) of
    /// [`Bvh::pdf_of_hit`].
    #[must_use]
    pub fn mis_weight(&self, scattering: f32) -> f32 {
        mis_weight(self.pdf, scattering)
    }
}

/// The power heuristic's weight of a light sample of density `light`, 1/sr, beside a ray of density `scattering`; 1 where `light` is 0.
#[must_use]
pub fn mis_weight(light: f32, scattering: f32) -> f32 {
    // By the ratio, for squares overflow; NaN where both are beyond all numbers.
    let ratio = scattering / light;
    let weight = 1.0 / (1.0 + ratio * ratio);
    if light > 0.0 && !weight.is_nan() {
        weight
    } else {
        1.0
    }
}

impl<M: Model<W>, const W: usize> Bvh<M, W> {
    /// Chooses a light for a receiver by `number`, and a point on it by `uv`, two numbers in [0, 1). `None` where no light that it may take has
    /// flux as of the last [`refit`](Self::refit), and for a receiver that is none: NaN, beyond 2^60 m, or with a normal that is not of
    /// length 1.
    ///
    /// ```
    /// # use lightbvh::{LightBvh, ShadingPoint};
    /// # let (bvh, point) = (LightBvh::default(), ShadingPoint { p: [0.0; 3], n: [0.0; 3] });
    /// if let Some(sampled) = bvh.sample_light(&point, 7_u32, [0.5, 0.25]) {
    ///     let arrives = sampled.irradiance.map(|e| e / sampled.pmf); // times the BRDF, if a shadow ray finds nothing
    /// }
    /// ```
    #[must_use]
    pub fn sample_light<P: Receiver + AsRef<ShadingPoint>>(
        &self,
        point: &P,
        number: impl Into<Random64>,
        uv: [f32; 2],
    ) -> Option<Sampled<M::Light>>
    where
        M::Importance: ImportanceModel<M::Node, W, P>,
    {
        let at = point.as_ref();
        if !at.is_within_reach() {
            return None;
        }
        let found = self.tree().sample(point, number);
        let index = if self.single { 0 } else { found.instance };
        let light = self.light(found.light, index)?;
        let instance = self.instance_id(index)?;
        let on = light.point_for(at.position(), uv);
        let seen = on.seen_from(at.position());
        let direction = seen.d * seen.per_distance;
        Some(Sampled {
            light,
            instance,
            part: found.light - self.placed[index as usize].numbers.start,
            pmf: found.pmf,
            point: on,
            direction: [direction.x, direction.y, direction.z],
            distance: exact::sqrt(seen.squared) * pow2(seen.exponent),
            pdf: on.density_seen(at.position(), found.pmf),
            irradiance: on.irradiance(at),
        })
    }

    /// Density over solid angle, 1/sr, with which [`sample_light`](Self::sample_light) finds the point `position`, metres, on light
    /// `part` of an instance, where a ray from the receiver has met it: for multiple importance sampling. 0 where the light does not emit to there. `None` where
    /// there is no such instance or part, and for a receiver that is none. Near the rim of a sphere it differs from that of the
    /// sample, for `position` has fewer digits than the angle.
    #[must_use]
    pub fn pdf_of_hit<P: Receiver + AsRef<ShadingPoint>>(
        &self,
        point: &P,
        instance: InstanceId,
        part: u32,
        position: [f32; 3],
    ) -> Option<f32>
    where
        M::Importance: ImportanceModel<M::Node, W, P>,
    {
        let at = point.as_ref();
        if !at.is_within_reach() {
            return None;
        }
        let pmf = self.pmf_of(point, instance, part)?;
        let number = self.lights_of(instance)?.start + part;
        let light = self.light(number, instance.index())?;
        let on = light.point_at(at.position(), vector(&position));
        Some(on.density_seen(at.position(), pmf))
    }
}

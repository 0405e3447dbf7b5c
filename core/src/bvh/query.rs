//! Samples and their probabilities.

use super::Bvh;
use super::edit::InstanceId;
use crate::importance::ImportanceModel;
use crate::model::Model;
use crate::point::Receiver;
use crate::random::Random64;
use crate::traverse::SampledLight;

impl<M: Model<W>, const W: usize> Bvh<M, W> {
    /// Chooses a light for a receiver, a [`ShadingPoint`](crate::ShadingPoint) within the domain of
    /// [`checked`](crate::ShadingPoint::checked) or one of which the importance knows more; see [`LightTree::sample`](crate::LightTree::sample). Without
    /// lights none is chosen.
    #[must_use]
    pub fn sample<P: Receiver>(&self, point: &P, random: impl Into<Random64>) -> SampledLight
    where
        M::Importance: ImportanceModel<M::Node, W, P>,
    {
        point.assert_within_reach();
        self.tree().sample(point, random)
    }

    /// Chooses a light for each of `points`, points as for [`sample`](Self::sample); see [`LightTree::sample_batch`](crate::LightTree::sample_batch).
    pub fn sample_batch<P: Receiver>(&self, points: &[P], randoms: &[Random64], sampled: &mut [SampledLight])
    where
        M::Importance: ImportanceModel<M::Node, W, P>,
    {
        self.tree().sample_batch(points, randoms, sampled);
    }

    /// Chooses `COUNT` lights for `point` by numbers at equal distances; see [`LightTree::sample_many`](crate::LightTree::sample_many).
    #[must_use]
    pub fn sample_many<P: Receiver, const COUNT: usize>(
        &self,
        point: &P,
        random: impl Into<Random64>,
    ) -> [SampledLight; COUNT]
    where
        M::Importance: ImportanceModel<M::Node, W, P>,
    {
        self.tree().sample_many(point, random)
    }

    /// Probability with which [`sample`](Self::sample) returns `light` of `instance`, as a [`SampledLight`] names them, at
    /// `point`: to the bit the one that comes with the sample. 0 where there is no such light, and where it is not that
    /// instance's. A single level has one instance, whichever is named.
    #[must_use]
    pub fn pmf<P: Receiver>(&self, point: &P, light: u32, instance: u32) -> f32
    where
        M::Importance: ImportanceModel<M::Node, W, P>,
    {
        point.assert_within_reach();
        self.tree().pmf(point, light, instance)
    }

    /// [`pmf`](Self::pmf) of triangle `triangle`, as the mesh was given, of an instance: what multiple importance sampling asks
    /// where a ray hits it. `None` where there is no such instance, or its mesh has no such triangle.
    #[must_use]
    pub fn pmf_of<P: Receiver>(&self, point: &P, instance: InstanceId, triangle: u32) -> Option<f32>
    where
        M::Importance: ImportanceModel<M::Node, W, P>,
    {
        let lights = self.lights_of(instance)?;
        let light = lights.start.checked_add(triangle)?;
        lights
            .contains(&light)
            .then(|| self.pmf(point, light, instance.index()))
    }
}

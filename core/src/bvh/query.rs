//! Samples and their probabilities.

use super::trails::Sampled;
use super::{Bvh, Trails};
use crate::importance::ImportanceModel;
use crate::node::LightNode;
use crate::point::{Receiver, ShadingPoint};
use crate::traverse::{Random64, SampledLight};
#[cfg(doc)]
use crate::tree::LightTree;

impl<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// Chooses a light for `point`, which is within the domain of [`ShadingPoint::checked`]; see [`LightTree::sample`]. Without
    /// lights none is chosen.
    #[must_use]
    pub fn sample(&self, point: &ShadingPoint, random: impl Into<Random64>) -> SampledLight {
        debug_assert!(
            point.is_within_reach(),
            "not a shading point: {point:?}; `ShadingPoint::checked` says why"
        );
        const { Sampled::<N, I, W, T>::ALLOWED };
        self.arrays().sample(point, random)
    }

    /// Chooses a light for each of `points`, points as for [`sample`](Self::sample); see [`LightTree::sample_batch`].
    pub fn sample_batch(&self, points: &[ShadingPoint], randoms: &[Random64], sampled: &mut [SampledLight]) {
        const { Sampled::<N, I, W, T>::ALLOWED };
        self.arrays().sample_batch(points, randoms, sampled);
    }

    /// Chooses `COUNT` lights for `point` by numbers at equal distances; see [`LightTree::sample_many`].
    #[must_use]
    pub fn sample_many<const COUNT: usize>(
        &self,
        point: &ShadingPoint,
        random: impl Into<Random64>,
    ) -> [SampledLight; COUNT] {
        const { Sampled::<N, I, W, T>::ALLOWED };
        self.arrays().sample_many(point, random)
    }

    /// Chooses a light for each place of `sampled` by numbers at equal distances; see [`LightTree::sample_spaced`].
    pub fn sample_spaced(
        &self,
        point: &ShadingPoint,
        random: impl Into<Random64>,
        first: u32,
        count: u32,
        sampled: &mut [SampledLight],
    ) {
        const { Sampled::<N, I, W, T>::ALLOWED };
        self.arrays().sample_spaced(point, random, first, count, sampled);
    }
}

impl<N: LightNode<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// [`sample`](Self::sample) for a receiver of which an importance may know more than a [`ShadingPoint`] says; see
    /// [`LightTree::sample_for`].
    #[must_use]
    pub fn sample_for<P: Receiver>(&self, receiver: &P, random: impl Into<Random64>) -> SampledLight
    where
        I: ImportanceModel<N, W, P>,
    {
        const { Sampled::<N, I, W, T, P>::ALLOWED };
        self.arrays().sample_for(receiver, random)
    }

    /// [`sample_many`](Self::sample_many) for such a receiver; see [`LightTree::sample_many_for`].
    #[must_use]
    pub fn sample_many_for<P: Receiver, const COUNT: usize>(
        &self,
        receiver: &P,
        random: impl Into<Random64>,
    ) -> [SampledLight; COUNT]
    where
        I: ImportanceModel<N, W, P>,
    {
        const { Sampled::<N, I, W, T, P>::ALLOWED };
        self.arrays().sample_many_for(receiver, random)
    }
}

impl<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize> Bvh<N, I, W> {
    /// Probability with which [`sample`](Self::sample) returns `light` of `instance`, as a [`SampledLight`] names them, at `point`:
    /// to the bit the one that comes with the sample. 0 where there is no such light. A single level has one instance, whichever is
    /// named.
    ///
    /// For multiple importance sampling, where a ray of the caller's hits triangle `k` of an instance's mesh, the light is
    /// [`lights_of`](Self::lights_of)`(id).start + k`, and the instance `id.index()`.
    #[must_use]
    pub fn pmf(&self, point: &ShadingPoint, light: u32, instance: u32) -> f32 {
        debug_assert!(
            point.is_within_reach(),
            "not a shading point: {point:?}; `ShadingPoint::checked` says why"
        );
        self.tree().pmf(point, light, instance)
    }
}

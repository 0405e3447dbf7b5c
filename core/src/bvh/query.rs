//! Samples and their probabilities.

use super::edit::InstanceId;
use super::trails::Sampled;
use super::{Bvh, Trails};
use crate::importance::ImportanceModel;
use crate::node::Node;
use crate::point::{Receiver, ShadingPoint};
use crate::traverse::{Random64, SampledLight};
#[cfg(doc)]
use crate::tree::LightTree;

impl<N: Node<W>, I: ImportanceModel<N, W>, const W: usize, T: Trails> Bvh<N, I, W, T> {
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

impl<N: Node<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
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

    /// [`sample_batch`](Self::sample_batch) for such receivers; see [`LightTree::sample_batch_for`]. Features `simd` and
    /// `prefetch` are for points alone.
    pub fn sample_batch_for<P: Receiver>(
        &self,
        receivers: &[P],
        randoms: &[Random64],
        sampled: &mut [SampledLight],
    ) where
        I: ImportanceModel<N, W, P>,
    {
        const { Sampled::<N, I, W, T, P>::ALLOWED };
        self.arrays().sample_batch_for(receivers, randoms, sampled);
    }
}

impl<N: Node<W>, I, const W: usize> Bvh<N, I, W> {
    /// [`pmf`](Self::pmf) for such a receiver: to the bit what comes with [`sample_for`](Self::sample_for).
    #[must_use]
    pub fn pmf_for<P: Receiver>(&self, receiver: &P, light: u32, instance: u32) -> f32
    where
        I: ImportanceModel<N, W, P>,
    {
        self.tree().pmf_for(receiver, light, instance)
    }

    /// [`pmf_of`](Self::pmf_of) for such a receiver.
    #[must_use]
    pub fn pmf_of_for<P: Receiver>(&self, receiver: &P, instance: InstanceId, triangle: u32) -> Option<f32>
    where
        I: ImportanceModel<N, W, P>,
    {
        let light = self.light_of(instance, triangle)?;
        Some(self.pmf_for(receiver, light, instance.index()))
    }

    /// The number of the light that is triangle `triangle` of an instance, as its mesh was given.
    fn light_of(&self, instance: InstanceId, triangle: u32) -> Option<u32> {
        let lights = self.lights_of(instance)?;
        let light = lights.start.checked_add(triangle)?;
        lights.contains(&light).then_some(light)
    }
}

impl<N: Node<W>, I: ImportanceModel<N, W>, const W: usize> Bvh<N, I, W> {
    /// Probability with which [`sample`](Self::sample) returns `light` of `instance`, as a [`SampledLight`] names them, at
    /// `point`: to the bit the one that comes with the sample. 0 where there is no such light, and where it is not that
    /// instance's. A single level has one instance, whichever is named.
    ///
    /// For a triangle of a mesh that a ray of the caller's hits, [`pmf_of`](Self::pmf_of) asks by the instance's id.
    #[must_use]
    pub fn pmf(&self, point: &ShadingPoint, light: u32, instance: u32) -> f32 {
        debug_assert!(
            point.is_within_reach(),
            "not a shading point: {point:?}; `ShadingPoint::checked` says why"
        );
        self.tree().pmf(point, light, instance)
    }

    /// [`pmf`](Self::pmf) of triangle `triangle`, as the mesh was given, of an instance: what multiple importance sampling asks
    /// where a ray hits it. `None` where there is no such instance, or its mesh has no such triangle.
    #[must_use]
    pub fn pmf_of(&self, point: &ShadingPoint, instance: InstanceId, triangle: u32) -> Option<f32> {
        let light = self.light_of(instance, triangle)?;
        Some(self.pmf(point, light, instance.index()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec::Vec;

    use crate::kit::triangle;
    use crate::{LightBvh, Transform};

    #[test]
    fn the_mesh_s_own_numbers_ask_for_the_same_probability() {
        let mut bvh = LightBvh::default();
        let lamp = |x: f32| triangle([[x, 3.0, 0.0], [x + 1.0, 3.0, 0.0], [x, 3.0, 1.0]]);
        let mesh = bvh.add_mesh((0..40).map(|k| lamp(k as f32)).collect()).unwrap();
        let ids = [0.0, 5.0, 50.0].map(|z| bvh.add_instance(mesh, Transform::at([0.0, 0.0, z])).unwrap());
        bvh.refit();
        let point = ShadingPoint {
            p: [3.0, 0.0, 4.0],
            n: [0.0, 1.0, 0.0],
        };
        let mut sum = 0.0;
        for id in ids {
            let lights = bvh.lights_of(id).unwrap();
            for triangle in 0..40 {
                let pmf = bvh.pmf_of(&point, id, triangle).unwrap();
                let light = lights.start + triangle;
                assert_eq!(pmf.to_bits(), bvh.pmf(&point, light, id.index()).to_bits());
                // A point is a receiver too.
                assert_eq!(pmf, bvh.pmf_for(&point, light, id.index()));
                assert_eq!(Some(pmf), bvh.pmf_of_for(&point, id, triangle));
                sum += f64::from(pmf);
            }
            assert_eq!(bvh.pmf_of(&point, id, 40), None);
            assert_eq!(bvh.pmf_of(&point, id, u32::MAX), None);
        }
        assert!((sum - 1.0).abs() < 1e-6, "{sum}");
        assert_eq!(bvh.pmf_of_for(&point, ids[0], 40), None);
        let randoms: Vec<Random64> = (0..20_u32).map(|k| (k << 27).into()).collect();
        let mut sampled = [[SampledLight::NONE; 20]; 2];
        bvh.sample_batch(&[point; 20], &randoms, &mut sampled[0]);
        bvh.sample_batch_for(&[point; 20], &randoms, &mut sampled[1]);
        assert_eq!(sampled[0], sampled[1]);
        // A light of another instance has none.
        let first = bvh.lights_of(ids[0]).unwrap().start;
        assert_eq!(bvh.pmf(&point, first, ids[1].index()), 0.0);
        bvh.remove_instance(ids[1]).unwrap();
        assert_eq!(bvh.pmf_of(&point, ids[1], 0), None);
    }
}

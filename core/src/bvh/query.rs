//! Samples and their probabilities, the same of each owner of a tree.

use super::edit::InstanceId;
use super::{Bvh, StaticBvh};
use crate::importance::ImportanceModel;
use crate::node::Node;
use crate::point::Receiver;
use crate::random::Random64;
use crate::traverse::SampledLight;

macro_rules! samples {
    ($owner:ident) => {
        impl<N: Node<W>, I, const W: usize> $owner<N, I, W> {
            /// Chooses a light for a receiver, a [`ShadingPoint`](crate::ShadingPoint) within the domain of
            /// [`checked`](crate::ShadingPoint::checked) or one of which the importance knows more; see [`LightTree::sample`](crate::LightTree::sample). Without
            /// lights none is chosen.
            #[must_use]
            pub fn sample<P: Receiver>(&self, point: &P, random: impl Into<Random64>) -> SampledLight
            where
                I: ImportanceModel<N, W, P>,
            {
                point.assert_within_reach();
                self.tree().sample(point, random)
            }

            /// Chooses a light for each of `points`, points as for [`sample`](Self::sample); see [`LightTree::sample_batch`](crate::LightTree::sample_batch).
            pub fn sample_batch<P: Receiver>(
                &self,
                points: &[P],
                randoms: &[Random64],
                sampled: &mut [SampledLight],
            ) where
                I: ImportanceModel<N, W, P>,
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
                I: ImportanceModel<N, W, P>,
            {
                self.tree().sample_many(point, random)
            }

            /// Probability with which [`sample`](Self::sample) returns `light` of `instance`, as a [`SampledLight`] names them, at
            /// `point`: to the bit the one that comes with the sample. 0 where there is no such light, and where it is not that
            /// instance's. A single level has one instance, whichever is named.
            #[must_use]
            pub fn pmf<P: Receiver>(&self, point: &P, light: u32, instance: u32) -> f32
            where
                I: ImportanceModel<N, W, P>,
            {
                point.assert_within_reach();
                self.tree().pmf(point, light, instance)
            }
        }
    };
}

samples!(Bvh);
samples!(StaticBvh);

impl<N: Node<W>, I, const W: usize> Bvh<N, I, W> {
    /// [`pmf`](Self::pmf) of triangle `triangle`, as the mesh was given, of an instance: what multiple importance sampling asks
    /// where a ray hits it. `None` where there is no such instance, or its mesh has no such triangle.
    #[must_use]
    pub fn pmf_of<P: Receiver>(&self, point: &P, instance: InstanceId, triangle: u32) -> Option<f32>
    where
        I: ImportanceModel<N, W, P>,
    {
        let lights = self.lights_of(instance)?;
        let light = lights.start.checked_add(triangle)?;
        lights
            .contains(&light)
            .then(|| self.pmf(point, light, instance.index()))
    }
}

#[cfg(test)]
mod tests {
    use crate::kit::triangle;
    use crate::{LightBvh, ShadingPoint, Transform};

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
                sum += f64::from(pmf);
            }
            assert_eq!(bvh.pmf_of(&point, id, 40), None);
            assert_eq!(bvh.pmf_of(&point, id, u32::MAX), None);
        }
        assert!((sum - 1.0).abs() < 1e-6, "{sum}");
        // A light of another instance has none.
        let first = bvh.lights_of(ids[0]).unwrap().start;
        assert_eq!(bvh.pmf(&point, first, ids[1].index()), 0.0);
        bvh.remove_instance(ids[1]).unwrap();
        assert_eq!(bvh.pmf_of(&point, ids[1], 0), None);
    }
}

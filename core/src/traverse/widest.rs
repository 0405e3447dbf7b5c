//! The walks, compiled for several sets of vector instructions, of which the machine's widest is taken when the program runs.
//!
//! All are compiled from one source without contraction, so they give the same words. Without the feature `simd` there is one:
//! that of the instructions that the program is compiled for.

#[cfg(feature = "simd")]
mod dispatched {
    use pulp::{Arch, Simd, WithSimd};

    use crate::importance::ImportanceModel;
    use crate::node::LightNode;
    use crate::point::ShadingPoint;
    use crate::traverse::{Random64, SampledLight};
    use crate::tree::LightTree;

    /// Arguments of a walk, as the dispatcher takes them.
    struct Job<'a, N, I, A, const W: usize> {
        tree: &'a LightTree<'a, N, I, W>,
        arguments: A,
    }

    struct One<'a>(&'a ShadingPoint, Random64);
    struct Known<'a>(&'a ShadingPoint, u32, u32);
    struct Batch<'a>(&'a [ShadingPoint], &'a [Random64], &'a mut [SampledLight]);

    impl<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize> WithSimd for Job<'_, N, I, One<'_>, W> {
        type Output = SampledLight;

        #[inline(always)]
        fn with_simd<S: Simd>(self, _: S) -> SampledLight {
            crate::traverse::sample::sample(self.tree, self.arguments.0, self.arguments.1)
        }
    }

    impl<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize> WithSimd for Job<'_, N, I, Known<'_>, W> {
        type Output = f32;

        #[inline(always)]
        fn with_simd<S: Simd>(self, _: S) -> f32 {
            let Known(point, light, instance) = self.arguments;
            crate::traverse::sample::pmf(self.tree, point, light, instance)
        }
    }

    impl<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize> WithSimd for Job<'_, N, I, Batch<'_>, W> {
        type Output = ();

        #[inline(always)]
        fn with_simd<S: Simd>(self, _: S) {
            let Batch(points, randoms, sampled) = self.arguments;
            crate::traverse::batch::sample_batch(self.tree, points, randoms, sampled);
        }
    }

    fn run<'a, N, I, A, const W: usize>(
        tree: &'a LightTree<'a, N, I, W>,
        arguments: A,
    ) -> <Job<'a, N, I, A, W> as WithSimd>::Output
    where
        Job<'a, N, I, A, W>: WithSimd,
    {
        Arch::new().dispatch(Job { tree, arguments })
    }

    pub fn sample<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(
        tree: &LightTree<'_, N, I, W>,
        point: &ShadingPoint,
        random: Random64,
    ) -> SampledLight {
        run(tree, One(point, random))
    }

    pub fn pmf<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(
        tree: &LightTree<'_, N, I, W>,
        point: &ShadingPoint,
        light: u32,
        instance: u32,
    ) -> f32 {
        run(tree, Known(point, light, instance))
    }

    pub fn sample_batch<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(
        tree: &LightTree<'_, N, I, W>,
        points: &[ShadingPoint],
        randoms: &[Random64],
        sampled: &mut [SampledLight],
    ) {
        run(tree, Batch(points, randoms, sampled));
    }
}

#[cfg(feature = "simd")]
pub(super) use dispatched::{pmf, sample, sample_batch};

#[cfg(not(feature = "simd"))]
pub(super) use super::batch::sample_batch;
#[cfg(not(feature = "simd"))]
pub(super) use super::sample::{pmf, sample};

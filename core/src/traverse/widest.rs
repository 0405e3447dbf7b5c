//! The walks, compiled for several sets of vector instructions, of which the machine's widest is taken when the program runs.
//!
//! All are compiled from one source without contraction, so they give the same words. Without the feature `simd` there is one:
//! that of the instructions that the program is compiled for.

#[cfg(feature = "simd")]
mod dispatched {
    use core::marker::PhantomData;

    use pulp::{Arch, Simd, WithSimd};

    use crate::importance::ImportanceModel;
    use crate::node::LightNode;
    use crate::point::ShadingPoint;
    use crate::traverse::{Random64, SampledLight};
    use crate::tree::LightTree;

    /// Arguments of a walk, as the dispatcher takes them.
    struct Job<'a, N, I, A, const W: usize> {
        tree: &'a LightTree<'a, N>,
        arguments: A,
        importance: PhantomData<I>,
    }

    struct One<'a>(&'a ShadingPoint, Random64);
    struct Known<'a>(&'a ShadingPoint, u32, u32);
    struct Batch<'a>(&'a [ShadingPoint], &'a [Random64], &'a mut [SampledLight]);

    impl<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize> WithSimd for Job<'_, N, I, One<'_>, W> {
        type Output = SampledLight;

        #[inline(always)]
        fn with_simd<S: Simd>(self, _: S) -> SampledLight {
            crate::traverse::sample::<N, I, W>(self.tree, self.arguments.0, self.arguments.1)
        }
    }

    impl<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize> WithSimd for Job<'_, N, I, Known<'_>, W> {
        type Output = f32;

        #[inline(always)]
        fn with_simd<S: Simd>(self, _: S) -> f32 {
            let Known(point, light, instance) = self.arguments;
            crate::traverse::pmf::<N, I, W>(self.tree, point, light, instance)
        }
    }

    impl<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize> WithSimd for Job<'_, N, I, Batch<'_>, W> {
        type Output = ();

        #[inline(always)]
        fn with_simd<S: Simd>(self, _: S) {
            let Batch(points, randoms, sampled) = self.arguments;
            crate::traverse::sample_batch::<N, I, W>(self.tree, points, randoms, sampled);
        }
    }

    fn run<'a, N, I, A, const W: usize>(
        tree: &'a LightTree<'a, N>,
        arguments: A,
    ) -> <Job<'a, N, I, A, W> as WithSimd>::Output
    where
        Job<'a, N, I, A, W>: WithSimd,
    {
        Arch::new().dispatch(Job::<N, I, A, W> {
            tree,
            arguments,
            importance: PhantomData,
        })
    }

    pub fn sample<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(
        tree: &LightTree<'_, N>,
        point: &ShadingPoint,
        random: Random64,
    ) -> SampledLight {
        run::<N, I, One<'_>, W>(tree, One(point, random))
    }

    pub fn pmf<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(
        tree: &LightTree<'_, N>,
        point: &ShadingPoint,
        light: u32,
        instance: u32,
    ) -> f32 {
        run::<N, I, Known<'_>, W>(tree, Known(point, light, instance))
    }

    pub fn sample_batch<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(
        tree: &LightTree<'_, N>,
        points: &[ShadingPoint],
        randoms: &[Random64],
        sampled: &mut [SampledLight],
    ) {
        run::<N, I, Batch<'_>, W>(tree, Batch(points, randoms, sampled));
    }
}

#[cfg(feature = "simd")]
pub(crate) use dispatched::{pmf, sample, sample_batch};

#[cfg(not(feature = "simd"))]
pub(crate) use super::{pmf, sample, sample_batch};

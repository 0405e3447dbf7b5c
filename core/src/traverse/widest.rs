//! The walks with the machine's widest registers; without the feature `simd`, as they are.

#[cfg(feature = "simd")]
mod dispatched {
    use crate::importance::ImportanceModel;
    use crate::node::Node;
    use crate::point::Receiver;
    use crate::random::Random64;
    use crate::traverse::{SampledLight, batch, many, sample};
    use crate::tree::LightTree;
    use crate::widest::widest;

    pub fn sample<N: Node<W>, I: ImportanceModel<N, W, P>, P: Receiver, const W: usize>(
        tree: &LightTree<'_, N, I, W>,
        point: &P,
        random: Random64,
    ) -> SampledLight {
        widest(
            #[inline(always)]
            || sample::sample(tree, point, random),
        )
    }

    pub fn pmf<N: Node<W>, I: ImportanceModel<N, W, P>, P: Receiver, const W: usize>(
        tree: &LightTree<'_, N, I, W>,
        point: &P,
        light: u32,
        instance: u32,
    ) -> f32 {
        widest(
            #[inline(always)]
            || sample::pmf(tree, point, light, instance),
        )
    }

    pub fn sample_many<
        N: Node<W>,
        I: ImportanceModel<N, W, P>,
        P: Receiver,
        const W: usize,
        const COUNT: usize,
    >(
        tree: &LightTree<'_, N, I, W>,
        point: &P,
        random: Random64,
    ) -> [SampledLight; COUNT] {
        widest(
            #[inline(always)]
            || many::sample_many(tree, point, random),
        )
    }

    pub fn sample_spaced<N: Node<W>, I: ImportanceModel<N, W, P>, P: Receiver, const W: usize>(
        tree: &LightTree<'_, N, I, W>,
        point: &P,
        random: Random64,
        first: u32,
        count: u32,
        sampled: &mut [SampledLight],
    ) {
        widest(
            #[inline(always)]
            || many::sample_spaced(tree, point, random, first, count, sampled),
        );
    }

    pub fn sample_batch<N: Node<W>, I: ImportanceModel<N, W, P>, P: Receiver, const W: usize>(
        tree: &LightTree<'_, N, I, W>,
        points: &[P],
        randoms: &[Random64],
        sampled: &mut [SampledLight],
    ) {
        widest(
            #[inline(always)]
            || batch::sample_batch(tree, points, randoms, sampled),
        );
    }
}

#[cfg(feature = "simd")]
pub(super) use dispatched::{pmf, sample, sample_batch, sample_many, sample_spaced};

#[cfg(not(feature = "simd"))]
pub(super) use super::batch::sample_batch;
#[cfg(not(feature = "simd"))]
pub(super) use super::many::{sample_many, sample_spaced};
#[cfg(not(feature = "simd"))]
pub(super) use super::sample::{pmf, sample};

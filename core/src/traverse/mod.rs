//! Sampling one light with its exact probability, and the probability of any light.
//!
//! At each node a child is chosen with a probability in proportion to its weight (paper section 3.6). Weights are positive
//! wherever there is flux, so every walk ends at a light after at most as many steps as the tree is deep; nothing is searched.
//!
//! One number drives the whole walk. It is a fixed-point number whose leading bits choose among the children of the root; what
//! remains of it, stretched to the whole range again, chooses at the next node. The order of numbers is thereby the order of
//! lights in the tree: stratified numbers give stratified lights. Ranges are integers, and the probability returned is the very
//! share of numbers that lead to the light.

mod batch;
mod sample;
#[cfg(test)]
mod tests;
mod walk;

pub use sample::SampledLight;

use crate::importance::ImportanceModel;
use crate::node::Node;
use crate::point::Receiver;
use crate::random::Random64;
use crate::tree::LightTree;
use crate::widest::widest;

impl<N: Node<W>, I, const W: usize> LightTree<'_, N, I, W> {
    /// Chooses one light for `point` by `random` (paper section 3.6), after at most as many steps as the tree is deep. `point` is
    /// a [`ShadingPoint`](crate::ShadingPoint), or a receiver of which the importance knows more, as
    /// [`Glossy`](crate::importance::Glossy) does of a [`GlossyPoint`](crate::point::GlossyPoint).
    ///
    /// A light is returned whenever one has flux and, with masks, may be taken. The pmf is to the bit the one that [`pmf`](Self::pmf) gives for the light, and
    /// the share of random numbers that choose it.
    #[inline(always)]
    #[must_use]
    pub fn sample<P: Receiver>(&self, point: &P, random: impl Into<Random64>) -> SampledLight
    where
        I: ImportanceModel<N, W, P>,
    {
        let random = random.into();
        widest(
            #[inline(always)]
            || sample::sample(self, point, random),
        )
    }

    /// Chooses a light for each point by its random number, to the same words as [`sample`](Self::sample) one at a time, but
    /// faster: several walks hide each other's waits for memory. `points`, `randoms` and `sampled` are of one length; what is
    /// longer is left alone.
    #[inline(always)]
    pub fn sample_batch<P: Receiver>(&self, points: &[P], randoms: &[Random64], sampled: &mut [SampledLight])
    where
        I: ImportanceModel<N, W, P>,
    {
        widest(
            #[inline(always)]
            || batch::sample_batch(self, points, randoms, sampled),
        );
    }

    /// Chooses `COUNT` lights for `point` by numbers at equal distances: light `k` is that of [`sample`](Self::sample) by
    /// [`random.spaced(k, COUNT)`](Random64::spaced), with that pmf. Each 32 evaluate nodes that they share once.
    ///
    /// The expectation of the mean of f / pmf over them is the sum of f over all lights, as of independent samples; its variance
    /// is smaller as a rule, for the numbers are in the order of lights. At most `COUNT` nodes are evaluated on each level.
    #[inline(always)]
    #[must_use]
    pub fn sample_many<P: Receiver, const COUNT: usize>(
        &self,
        point: &P,
        random: impl Into<Random64>,
    ) -> [SampledLight; COUNT]
    where
        I: ImportanceModel<N, W, P>,
    {
        let mut sampled = [SampledLight::NONE; COUNT];
        self.sample_spaced(point, random, 0, COUNT as u32, &mut sampled);
        sampled
    }

    /// Chooses a light for each place of `sampled`: place `k` is that of [`sample`](Self::sample) by
    /// [`random.spaced(first + k, count)`](Random64::spaced), with that pmf. [`sample_many`](Self::sample_many) for a
    /// count known at run time.
    #[inline(always)]
    pub fn sample_spaced<P: Receiver>(
        &self,
        point: &P,
        random: impl Into<Random64>,
        first: u32,
        count: u32,
        sampled: &mut [SampledLight],
    ) where
        I: ImportanceModel<N, W, P>,
    {
        let random = random.into();
        widest(
            #[inline(always)]
            || batch::sample_spaced(self, point, random, first, count, sampled),
        );
    }

    /// The probability with which [`sample`](Self::sample) returns light `light` of instance `instance`
    /// at `point`: 0 if there is no such light. A single level has one instance, whichever is named.
    #[inline(always)]
    #[must_use]
    pub fn pmf<P: Receiver>(&self, point: &P, light: u32, instance: u32) -> f32
    where
        I: ImportanceModel<N, W, P>,
    {
        widest(
            #[inline(always)]
            || sample::pmf(self, point, light, instance),
        )
    }
}

//! A layout over lights of another kind than emissive triangles.

use core::marker::PhantomData;

use bytemuck::{Pod, Zeroable};
use glam::Vec3;

use super::{BoundsNode, Cluster, Holds, MomentLayout, Node};
use crate::beam::{Beam, Limits, Space};
use crate::light::Light;
use crate::summary::Lanes;

/// A node of layout `N` in a tree whose leaves are lights `L`: the same words, the same weights.
///
/// `Bvh<Lit<MomentNode<8>, PointLight>, Defensive<Moments, 6>, 8>` is `LightBvh` over points. [`crate::light`] says what instances
/// that scale make of flux, and what does not know other lights yet.
#[repr(transparent)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Zeroable, Pod)]
pub struct Lit<N, L> {
    node: N,
    lights: PhantomData<L>,
}

impl<N: Pod + Send + Sync, L: Light> Holds for Lit<N, L> {
    type Light = L;
}

impl<N: Node<W>, L: Light, const W: usize> Node<W> for Lit<N, L> {
    type Summary = N::Summary;

    const EMPTY: Self = Self {
        node: N::EMPTY,
        lights: PhantomData,
    };
    const NAME: &'static str = N::NAME;
    const HAS_MASKS: bool = N::HAS_MASKS;
    const HAS_BEAMS: bool = N::HAS_BEAMS;

    #[inline(always)]
    fn kind(&self, slot: usize) -> u32 {
        self.node.kind(slot)
    }

    #[inline(always)]
    fn link(&self, slot: usize) -> u32 {
        self.node.link(slot)
    }

    #[inline(always)]
    fn summary(&self, slot: usize) -> Self::Summary {
        self.node.summary(slot)
    }

    fn set_child(&mut self, slot: usize, kind: u32, link: u32) {
        self.node.set_child(slot, kind, link);
    }

    fn relink(&mut self, slot: usize, link: u32) {
        self.node.relink(slot, link);
    }

    #[inline(always)]
    fn set_lanes(&mut self, summaries: &Lanes<W>) {
        self.node.set_lanes(summaries);
    }

    #[inline(always)]
    fn mask(&self, slot: usize) -> u32 {
        self.node.mask(slot)
    }

    #[inline(always)]
    fn beam(&self, slot: usize) -> Beam {
        self.node.beam(slot)
    }

    #[inline(always)]
    fn end(&self, slot: usize) -> f32 {
        self.node.end(slot)
    }

    #[inline(always)]
    fn set_limits(&mut self, limits: &[Limits; W], summaries: &Lanes<W>) {
        self.node.set_limits(limits, summaries);
    }

    #[inline(always)]
    fn merged_limits(&self, whole: &Self::Summary) -> Limits {
        self.node.merged_limits(whole)
    }

    #[inline(always)]
    fn merged(&self) -> Self::Summary {
        self.node.merged()
    }
}

impl<N: MomentLayout<W>, L: Light, const W: usize> MomentLayout<W> for Lit<N, L> {
    #[inline(always)]
    fn moment_weights(&self, p: Vec3, n: Vec3, space: Space) -> [f32; W] {
        self.node.moment_weights(p, n, space)
    }
}

impl<N: BoundsNode<W>, L: Light, const W: usize> BoundsNode<W> for Lit<N, L> {
    #[inline(always)]
    fn cluster(&self, slot: usize) -> Cluster {
        self.node.cluster(slot)
    }
}

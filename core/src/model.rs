//! Models of a light BVH.

use crate::importance::{DefaultImportance, Eq4, ImportanceModel, Leveled, Linked, Moments};
use crate::light::{AnyLight, EmissiveTriangle, Light};
use crate::node::{CompactNode, DefaultNode, Holds, LinkedSpotMomentNode, Node, SpotMomentNode};
use crate::point::Receiver;
use crate::random::Random64;
use crate::traverse::SampledLight;
use crate::tree::LightTree;

/// A model of a light BVH: light type, layout of nodes of width `W`, and importance. A pair of a
/// layout and an importance is a model, too: `Bvh<(MomentNode<8>, Moments)>`.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no model of width {W}",
    note = "`LightBvh`, `AnyLights` and `MaskedLights` are 8 wide; a pair of a layout and an importance is as wide as its layout: \
            `Bvh<(CompactNode<4>, Eq4), 4>`"
)]
pub trait Model<const W: usize> {
    /// The light type.
    type Light: Light;
    /// The layout of nodes.
    type Node: Node<W> + Holds<Light = Self::Light>;
    /// The importance.
    type Importance;
}

/// A receiver that a light BVH of the model `M` chooses lights for: its importance weighs children for one.
// The bound is on `P`: with one on the importance, a wrong receiver would be a plain type error without a note.
pub trait ReceiverOf<M: Model<W>, const W: usize>: Receiver {
    /// [`LightTree::sample`].
    #[doc(hidden)]
    fn choose(&self, tree: &LightTree<'_, M::Node, M::Importance, W>, random: Random64) -> SampledLight;

    /// [`LightTree::pmf`].
    #[doc(hidden)]
    fn probability(&self, tree: &LightTree<'_, M::Node, M::Importance, W>, light: u32, instance: u32) -> f32;
}

impl<M: Model<W>, P: Receiver, const W: usize> ReceiverOf<M, W> for P
where
    M::Importance: ImportanceModel<M::Node, W, P>,
{
    #[inline]
    fn choose(&self, tree: &LightTree<'_, M::Node, M::Importance, W>, random: Random64) -> SampledLight {
        tree.sample(self, random)
    }

    #[inline]
    fn probability(&self, tree: &LightTree<'_, M::Node, M::Importance, W>, light: u32, instance: u32) -> f32 {
        tree.pmf(self, light, instance)
    }
}

/// The summary that its nodes store of each child.
#[cfg(feature = "alloc")]
pub(crate) type SummaryOf<M, const W: usize> = <<M as Model<W>>::Node as Node<W>>::Summary;

impl<N: Node<W>, I, const W: usize> Model<W> for (N, I) {
    type Light = N::Light;
    type Node = N;
    type Importance = I;
}

/// [`LightBvh`](crate::LightBvh)'s: emissive triangles, moments on packed nodes of 8 children, 1/64 of uniform choice.
#[derive(Clone, Copy, Debug)]
pub struct Triangles;

impl Model<8> for Triangles {
    type Light = EmissiveTriangle;
    type Node = DefaultNode;
    type Importance = DefaultImportance;
}

/// [`AnyLights`](crate::AnyLights)'s: [`Triangles`] over lights of every kind, whose nodes know cones and ranges.
#[derive(Clone, Copy, Debug)]
pub struct AnyKind;

impl Model<8> for AnyKind {
    type Light = AnyLight;
    type Node = SpotMomentNode<8, AnyLight>;
    type Importance = DefaultImportance;
}

/// [`MaskedLights`](crate::MaskedLights)'s: [`AnyKind`] with masks.
#[derive(Clone, Copy, Debug)]
pub struct Masked;

impl Model<8> for Masked {
    type Light = AnyLight;
    type Node = LinkedSpotMomentNode<8, AnyLight>;
    type Importance = Linked<Leveled<Moments, 11>>;
}

/// The paper's: Eq. 4 on quantised bounds, 4 children to a node.
#[derive(Clone, Copy, Debug)]
pub struct Paper;

impl Model<4> for Paper {
    type Light = EmissiveTriangle;
    type Node = CompactNode<4>;
    type Importance = Eq4;
}

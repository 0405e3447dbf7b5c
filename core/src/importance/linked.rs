//! Any importance, over the lights that a receiver may take alone.

use core::marker::PhantomData;

use super::{ImportanceModel, Space};
use crate::exact::{self, exponent, pow2};
use crate::node::Node;
use crate::point::LinkedPoint;

/// Light linking: the importance `I` over the lights whose instance mask shares a bit with the receiver's. Needs a layout with masks, as
/// [`LinkedSpotMomentNode`](crate::node::LinkedSpotMomentNode); other layouts do not compile.
///
/// The weight of a child is zero where the union of its instances' masks has no bit of the receiver's. Lights without flux are in no union. Masks are of
/// [instances](crate::Edit::SetMask): a single level has none.
/// A light has a positive probability if and only if it has flux and a common bit; these probabilities sum to one. Without such a light none is
/// chosen. Costs one word per child.
///
/// If all masks share a bit with the receiver's, light and probability are those of `I`, to the bit.
///
/// A share of uniform choice goes to all lights, those without a common bit among them. So neither `Linked<Defensive<_, _>>` nor
/// `Defensive<Linked<_>, _>` compiles. [`Leveled`](super::Leveled) takes its place.
///
/// Other receivers take masks too, for example a leaf with two sides.
/// ```
/// # use lightbvh::importance::{Leveled, Linked, LinkedPoint, Transmissive, TransmissivePoint};
/// # use lightbvh::node::LinkedSpotMomentNode;
/// # use lightbvh::{Bvh, Moments, ShadingPoint};
/// # let leaf = TransmissivePoint { point: ShadingPoint { p: [0.0; 3], n: [0.0; 3] }, front: 0.5, back: 0.5 };
/// let receiver = LinkedPoint { point: leaf, mask: 1 };
/// let lights = Bvh::<(LinkedSpotMomentNode<8>, Linked<Leveled<Transmissive<Moments>, 9>>)>::default();
/// let sampled = lights.sample(&receiver, 1_u32);
/// ```
/// ```compile_fail
/// # use lightbvh::importance::{Defensive, Linked, LinkedPoint};
/// # use lightbvh::node::LinkedSpotMomentNode;
/// # use lightbvh::{Bvh, Moments, ShadingPoint};
/// # let receiver = LinkedPoint { point: ShadingPoint { p: [0.0; 3], n: [0.0; 3] }, mask: 1 };
/// let sampled = Bvh::<(LinkedSpotMomentNode<8>, Linked<Defensive<Moments, 6>>)>::default().sample(&receiver, 1_u32);
/// ```
/// ```compile_fail
/// # use lightbvh::importance::{Defensive, Linked, LinkedPoint};
/// # use lightbvh::node::LinkedSpotMomentNode;
/// # use lightbvh::{Bvh, Moments, ShadingPoint};
/// # let receiver = LinkedPoint { point: ShadingPoint { p: [0.0; 3], n: [0.0; 3] }, mask: 1 };
/// let sampled = Bvh::<(LinkedSpotMomentNode<8>, Defensive<Linked<Moments>, 6>)>::default().sample(&receiver, 1_u32);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Linked<I>(PhantomData<I>);

impl<N: Node<W>, I: ImportanceModel<N, W, P>, P, const W: usize> ImportanceModel<N, W, LinkedPoint<P>>
    for Linked<I>
{
    const UNIFORM_HALVINGS: u32 = {
        assert!(N::HAS_MASKS, "masks are stored by `LinkedSpotMomentNode`");
        assert!(
            I::UNIFORM_HALVINGS == 0,
            "a share of uniform choice would go to lights that are masked out; `Leveled` takes its place"
        );
        0
    };
    const IS_PARTIAL: bool = true;

    #[inline(always)]
    fn weights_in(node: &N, receiver: &LinkedPoint<P>, space: Space) -> [f32; W] {
        let mut weights = I::weights_in(node, &receiver.point, space);
        let mut greatest = 0.0;
        for slot in 0..W {
            let is_common = exact::mask_of(node.mask(slot) & receiver.mask != 0);
            weights[slot] = exact::masked(is_common, weights[slot]);
            greatest = exact::max(greatest, weights[slot]);
        }
        // All allowed weights may lie far below the child that set the scale. A power of two changes no share.
        let e = exponent(greatest);
        let up = pow2(if e < 0 { -e } else { 0 });
        for slot in 0..W {
            weights[slot] *= up;
        }
        weights
    }
}

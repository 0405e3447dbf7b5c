//! Any importance, from both sides of a surface.

use core::marker::PhantomData;

use super::{ImportanceModel, Space};
use crate::exact;
use crate::point::TransmissivePoint;

/// The importance `I` from both sides of a [`TransmissivePoint`]: front · w(n) + back · w(−n), w the weight that `I` gives at a normal. On the
/// layouts of `I`; twice its work.
///
/// A weight is positive wherever there is flux. If both parts are zero, both sides get equal weight.
/// A point whose normal is zero is one in a volume. `Defensive<Transmissive<Moments>, 6>` adds a share of uniform choice.
///
/// `I` gives weights of a node one scale for both normals, as all importances of this crate do.
#[derive(Clone, Copy, Debug)]
pub struct Transmissive<I>(PhantomData<I>);

impl<N, I: ImportanceModel<N, W>, const W: usize> ImportanceModel<N, W, TransmissivePoint>
    for Transmissive<I>
{
    const UNIFORM_HALVINGS: u32 = I::UNIFORM_HALVINGS;
    const IS_PARTIAL: bool = I::IS_PARTIAL;

    #[inline(always)]
    fn weights_in(node: &N, receiver: &TransmissivePoint, space: Space) -> [f32; W] {
        let front = I::weights_in(node, &receiver.point, space);
        let back = I::weights_in(node, &receiver.turned(), space);
        // The greater part counts as 1, so that no weight falls below the lesser of the two.
        let greater = exact::max(receiver.front, receiver.back);
        let receives = greater > 0.0;
        let of = |part: f32| if receives { exact::div(part, greater) } else { 1.0 };
        let (of_front, of_back) = (of(receiver.front), of(receiver.back));
        let mut weights = [0.0; W];
        for slot in 0..W {
            weights[slot] = of_front * front[slot] + of_back * back[slot];
        }
        weights
    }
}

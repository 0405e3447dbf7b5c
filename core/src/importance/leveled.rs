//! Any importance, with a least share for each child.

use core::marker::PhantomData;

use super::{ImportanceModel, Space};
use crate::exact::{self, pow2};

/// The importance `I`, with a least share: at each node every child that `I` gives weight has at least about 2^-`HALVINGS` of the weight of all.
/// `HALVINGS` is from 1 to 20.
///
/// Like [`Defensive`](super::Defensive), but at each node. Only children that
/// `I` allows get a share, so [`Linked`](super::Linked) accepts it. The bound is weaker: a light that is underrated at k nodes of its path keeps
/// 2^-(k · `HALVINGS`).
#[derive(Clone, Copy, Debug)]
pub struct Leveled<I, const HALVINGS: u32>(PhantomData<I>);

impl<N, I: ImportanceModel<N, W, P>, P, const HALVINGS: u32, const W: usize> ImportanceModel<N, W, P>
    for Leveled<I, HALVINGS>
{
    const UNIFORM_HALVINGS: u32 = {
        assert!(1 <= HALVINGS && HALVINGS <= 20, "a share from 1/2 to 2^-20");
        I::UNIFORM_HALVINGS
    };
    const IS_PARTIAL: bool = I::IS_PARTIAL;

    #[inline(always)]
    fn weights_in(node: &N, point: &P, space: Space) -> [f32; W] {
        let mut weights = I::weights_in(node, point, space);
        let mut sum = 0.0;
        for slot in 0..W {
            sum += weights[slot];
        }
        let least = sum * pow2(-(HALVINGS as i32));
        for slot in 0..W {
            let raised = exact::max(weights[slot], least);
            weights[slot] = exact::masked(exact::mask_of(weights[slot] > 0.0), raised);
        }
        weights
    }
}

//! The default importance: means of flux, distance and both cosines.

use core::marker::PhantomData;

use super::{ExactMath, ImportanceModel, Math, Space};
use crate::node::MomentLayout;
use crate::point::ShadingPoint;

/// Φ · cos θ · cos θ' / d², each a mean over the lights of a child as their moments give it; on the layouts that hold
/// [`LightMoments`](crate::moments::LightMoments). Formulas and constants are explained, with what was measured, in
/// `docs/walk.md`.
///
/// Its weights have the same bits on every processor, unless it is told to take each processor's own operations:
/// `Moments<NativeMath>`. `docs/numerics.md` says what that saves, and what it costs.
#[derive(Clone, Copy, Debug)]
pub struct Moments<M = ExactMath>(PhantomData<M>);

impl<M: Math, N: MomentLayout<W>, const W: usize> ImportanceModel<N, W> for Moments<M> {
    #[inline(always)]
    fn weights_in(node: &N, point: &ShadingPoint, space: Space) -> [f32; W] {
        node.moment_weights::<M>(point.position(), point.normal(), space)
    }

    #[inline(always)]
    fn quotient(a: f32, b: f32) -> f32 {
        M::div(a, b)
    }
}

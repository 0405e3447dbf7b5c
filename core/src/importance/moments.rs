//! The default importance: means of flux, distance and both cosines.

use super::{ImportanceModel, Space};
use crate::node::MomentLayout;
use crate::point::{Cell, ShadingPoint};
use crate::vector::vector;

/// Φ · cos θ · cos θ' / d², each a mean over the lights of a child as their moments give it; on the layouts that hold
/// [`LightMoments`](crate::moments::LightMoments). Formulas and constants are explained, with what was measured, in
/// `docs/walk.md`.
#[derive(Clone, Copy, Debug)]
pub struct Moments;

impl<N: MomentLayout<W>, const W: usize> ImportanceModel<N, W> for Moments {
    #[inline(always)]
    fn weights_in(node: &N, point: &ShadingPoint, space: Space) -> [f32; W] {
        node.moment_weights(point.position(), point.normal(), space)
    }
}

/// The mean over a cell. The variance of its points widens the lights' spread, and the spread of normals softens the cosine. The distance is
/// from the nearest point of the box.
impl<N: MomentLayout<W>, const W: usize> ImportanceModel<N, W, Cell> for Moments {
    #[inline(always)]
    fn weights_in(node: &N, cell: &Cell, space: Space) -> [f32; W] {
        node.cell_weights(vector(&cell.center), vector(&cell.n), vector(&cell.half), space)
    }
}

//! Flux over squared distance, without cosines.

use super::sight::offset;
use super::{ImportanceModel, Scaled, on_one_scale};
use crate::exact::{self, exponent, pow2, recip_rough, significand};
use crate::node::Node;
use crate::point::ShadingPoint;
use crate::summary::Summary;
use crate::vector::length_squared;

/// Squared distances count as at least this, m²: 2^-100.
const MIN_DISTANCE_SQUARED: f32 = pow2(-100);

/// Φ/(d² + σ²), σ² the variance of the lights' positions: the cheap end of the trade between speed and accuracy, right where
/// lights shine everywhere. On any layout.
#[derive(Clone, Copy, Debug)]
pub struct FluxOverDistance;

impl<N: Node<W>, const W: usize> ImportanceModel<N, W> for FluxOverDistance {
    #[inline(always)]
    fn weights_in(node: &N, point: &ShadingPoint, _: f32) -> [f32; W] {
        let mut scaled = [Scaled::ZERO; W];
        for slot in 0..W {
            let summary = node.summary(slot);
            let (phi, away) = (summary.phi(), offset(summary.center(), point));
            let soft = exact::max(length_squared(away) + summary.spread(), MIN_DISTANCE_SQUARED);
            let value = significand(phi) * recip_rough(significand(soft));
            scaled[slot] = Scaled::of(phi, value, -exponent(soft));
        }
        on_one_scale(&scaled)
    }
}

//! Flux over squared distance, and flux alone: without cosines.

use super::sight::{offset, over_distance};
use super::{ImportanceModel, Scaled, Space, on_one_scale};
use crate::exact::significand;
use crate::node::Node;
use crate::point::ShadingPoint;
use crate::summary::Summary;
use crate::vector::length_squared;

/// Φ/(d² + σ²), σ² the variance of the lights' positions: the cheap end of the trade between speed and accuracy, right where
/// lights shine everywhere. On any layout.
#[derive(Clone, Copy, Debug)]
pub struct FluxOverDistance;

impl<N: Node<W>, const W: usize> ImportanceModel<N, W> for FluxOverDistance {
    #[inline(always)]
    fn weights_in(node: &N, point: &ShadingPoint, _: Space) -> [f32; W] {
        let mut scaled = [Scaled::ZERO; W];
        for slot in 0..W {
            let summary = node.summary(slot);
            let (phi, away) = (summary.phi(), offset(summary.center(), point));
            scaled[slot] = over_distance(phi, length_squared(away) + summary.spread(), 1.0);
        }
        on_one_scale(&scaled)
    }
}

/// Φ, whatever the point: every light has its share of the flux, as by pbrt-v4's `PowerLightSampler`, though by a walk. On any
/// layout. The measure of what distance and cosines are worth, and right where all lights are equally far.
///
/// In two levels the flux of an instance is that of its bounds or moments in the world.
#[derive(Clone, Copy, Debug)]
pub struct Flux;

impl<N: Node<W>, const W: usize> ImportanceModel<N, W> for Flux {
    #[inline(always)]
    fn weights_in(node: &N, _: &ShadingPoint, _: Space) -> [f32; W] {
        let mut scaled = [Scaled::ZERO; W];
        for slot in 0..W {
            let phi = node.summary(slot).phi();
            scaled[slot] = Scaled::of(phi, significand(phi), 0);
        }
        on_one_scale(&scaled)
    }
}

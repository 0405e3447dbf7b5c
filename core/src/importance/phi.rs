//! Flux alone.

use super::{ImportanceModel, Scaled, on_one_scale};
use crate::exact::significand;
use crate::node::Node;
use crate::point::ShadingPoint;
use crate::summary::Summary;

/// Φ, whatever the point: every light has its share of the flux, as by pbrt-v4's `PowerLightSampler`, though by a walk. On any
/// layout. The measure of what distance and cosines are worth, and right where all lights are equally far.
///
/// In two levels the flux of an instance is that of its bounds or moments in the world.
#[derive(Clone, Copy, Debug)]
pub struct Flux;

impl<N: Node<W>, const W: usize> ImportanceModel<N, W> for Flux {
    #[inline(always)]
    fn weights_in(node: &N, _: &ShadingPoint, _: f32) -> [f32; W] {
        let mut scaled = [Scaled::ZERO; W];
        for slot in 0..W {
            let phi = node.summary(slot).phi();
            scaled[slot] = Scaled::of(phi, significand(phi), 0);
        }
        on_one_scale(&scaled)
    }
}

//! Flux alone.

use super::{ImportanceModel, Scaled, on_one_scale};
use crate::exact::{exponent, significand};
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
    const UNIFORM_HALVINGS: u32 = 0;

    #[inline(always)]
    fn weights(node: &N, _: &ShadingPoint) -> [f32; W] {
        let mut scaled = [Scaled {
            significand: 0.0,
            exponent: -1024,
        }; W];
        for slot in 0..W {
            let phi = node.summary(slot).phi();
            // The comparison also turns the NaN of hostile words into "no importance".
            let shines = phi > 0.0;
            scaled[slot] = Scaled {
                significand: if shines { significand(phi) } else { 0.0 },
                exponent: if shines { exponent(phi) } else { -1024 },
            };
        }
        on_one_scale(&scaled)
    }
}

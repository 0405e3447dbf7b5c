//! Lights as a piece of a ray through a volume sees them.

mod line;

use super::{ImportanceModel, Scaled, Space, on_one_scale};
use crate::exact::{self, pow2, rsqrt_rough, significand};
use crate::node::MomentLayout;
use crate::point::RaySegment;
use crate::vector::{dot, length_squared};
use crate::weight::{SOFT, recip, soft};
use line::Line;

/// The light that a [`RaySegment`] receives: flux times the angle under which the lights see the segment, over their least distance from its line (Conty
/// Estevez & Kulla 2018, their Eq. 4: what 1/d² comes to along a line), times the emitters' cosine, a mean of two places on
/// the segment. On the layouts of [`Moments`](super::Moments).
///
/// - ∫ 1/(d² + s²) dt over the segment of length L is θ/D, with D² = the squared least distance + s², and θ the angle of the segment
///   at that distance; s² is the variance of the lights' positions by which [`Moments`](super::Moments) softens distances. The weight
///   takes θ/(D L), which has a limit for segments without length: 1/(d² + s²).
/// - tan(θ/2) = D L/(a b + a·b + s²), a and b from the lights to both ends. Its arc is x/(1 + 0.28 x²), or π/2 less that of 1/x: within 1 %.
/// - The emitters' cosine is that of [`Moments`](super::Moments) evaluated at 1/4 and 3/4 of the angle, found by the angle bisector theorem.
///
/// Phase functions and transmittance are the caller's. A weight is positive wherever there is flux.
#[derive(Clone, Copy, Debug)]
pub struct Subtended;

/// √2.
const SQRT_2: f32 = core::f32::consts::SQRT_2;
/// As in [`Moments`](super::Moments): the variance in the cosine's distance, in squared deviations across.
const FAR: f32 = 2.5;
/// Squared distances are at least this, in units of the scale.
const LEAST_SQUARED: f32 = pow2(-30);

impl<N: MomentLayout<W>, const W: usize> ImportanceModel<N, W, RaySegment> for Subtended {
    #[inline(always)]
    fn weights_in(node: &N, segment: &RaySegment, _: Space) -> [f32; W] {
        let mut scaled = [Scaled::ZERO; W];
        for slot in 0..W {
            let set = node.summary(slot);
            let size = glam::Vec3::new(set.across, set.along, 0.0);
            let line = Line::of(segment, set.c, size);
            let (across, along) = (set.across * line.to_one, set.along * line.to_one);
            let variance = across * across;
            let s_squared = variance + LEAST_SQUARED;
            let rest = exact::max(1.0 - length_squared(set.m), pow2(-18));
            let spread = rest * rsqrt_rough(rest);
            let mut emitted = 0.0;
            let places = line.quarters(s_squared);
            for k in 0..2 {
                let place = places[k];
                let squared = length_squared(place) + LEAST_SQUARED;
                let inverse = rsqrt_rough(squared + FAR * variance);
                let depth = SQRT_2 * (along * inverse);
                let s = (SOFT + depth) + spread * (0.5 - depth);
                let doubled = dot(set.m, place) * (2.0 * inverse);
                let (above, below) = soft(doubled, s, s);
                emitted += above * recip(below);
            }
            let mean = line.mean(s_squared) * emitted;
            scaled[slot] = Scaled::of(set.phi, significand(set.phi) * mean, -2 * line.exponent);
        }
        on_one_scale(&scaled)
    }
}

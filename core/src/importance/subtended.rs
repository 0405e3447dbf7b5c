//! Lights as a piece of a ray through a volume sees them.

mod line;

use core::marker::PhantomData;

use super::{Eq4, ExactMath, ImportanceModel, Math, Moments, Scaled, Space, on_one_scale};
use crate::exact::{self, pow2, significand};
use crate::moments::LEAST_LENGTH;
use crate::node::{BoundsNode, MomentLayout};
use crate::point::{RaySegment, ShadingPoint};
use crate::vector::{dot, flush3, length_squared};
use crate::weight::{SOFT, soft};
use line::Line;

/// What a [`RaySegment`] receives: flux times the angle under which the lights see the segment, over their least distance from its line (Conty
/// Estevez & Kulla 2018, their Eq. 4: what 1/d² comes to along a line), times the emitters' cosine, a mean of two places on
/// the segment. `Subtended<Moments>` on the layouts of [`Moments`], `Subtended<Eq4>` on those of [`Eq4`].
///
/// - ∫ 1/(d² + s²) dt over the segment of length L is θ/D, with D² = the squared least distance + s², and θ the angle of the segment
///   at that distance; s² is the variance of the lights' positions by which [`Moments`] softens distances, or r²/12 as in [`Eq4`]. The weight
///   takes θ/(D L), which has a limit for segments without length: 1/(d² + s²).
/// - tan(θ/2) = D L/(a b + a·b + s²), a and b from the lights to both ends. Its arc is x/(1 + 0.28 x²), or π/2 less that of 1/x: within 1 %.
/// - The emitters' cosine is that of [`Moments`] or [`Eq4`] where a quarter and three quarters of the angle lie before: bisectors, found by the
///   theorem, not by a tangent.
///
/// Phase functions and transmittance are the caller's. A weight is positive wherever there is flux.
#[derive(Clone, Copy, Debug)]
pub struct Subtended<I>(PhantomData<I>);

/// √2.
const SQRT_2: f32 = core::f32::consts::SQRT_2;
/// As in [`Moments`]: the variance in the cosine's distance, in squared deviations across.
const FAR: f32 = 2.5;
/// As in [`Eq4`]: share of r² that softens distances. A constant of its own: rust-gpu does not fold an expression of literals.
const SOFTENING: f32 = 1.0 / 12.0;
/// Squared distances are at least this, in units of the scale.
const LEAST_SQUARED: f32 = pow2(-30);

/// Φ · `mean`, which is a mean of 1/d² in units of the scale 2^`scale`.
#[inline(always)]
fn weight(phi: f32, mean: f32, scale: i32) -> Scaled {
    Scaled::of(phi, significand(phi) * mean, -2 * scale)
}

impl<M: Math, N: MomentLayout<W>, const W: usize> ImportanceModel<N, W, RaySegment>
    for Subtended<Moments<M>>
{
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
            let spread = rest * M::rsqrt(rest);
            let mut emitted = 0.0;
            let places = line.quarters::<M>(s_squared);
            for k in 0..2 {
                let place = places[k];
                let squared = length_squared(place) + LEAST_SQUARED;
                let inverse = M::rsqrt(M::add_product(squared, FAR, variance));
                let depth = SQRT_2 * (along * inverse);
                let s = M::add_product(SOFT + depth, spread, 0.5 - depth);
                let doubled = dot(set.m, place) * (2.0 * inverse);
                let (above, below) = soft::<M>(doubled, s, s);
                emitted += above * M::recip(below);
            }
            scaled[slot] = weight(set.phi, line.mean::<M>(s_squared) * emitted, line.exponent);
        }
        on_one_scale(&scaled)
    }

    #[inline(always)]
    fn quotient(a: f32, b: f32) -> f32 {
        M::div(a, b)
    }
}

impl<N: BoundsNode<W>, const W: usize> ImportanceModel<N, W, RaySegment> for Subtended<Eq4> {
    #[inline(always)]
    fn weights_in(node: &N, segment: &RaySegment, _: Space) -> [f32; W] {
        let mut scaled = [Scaled::ZERO; W];
        for slot in 0..W {
            let cluster = node.cluster(slot);
            let line = Line::of(segment, cluster.center, cluster.extent);
            let extent = cluster.extent * line.to_one;
            let s_squared = length_squared(extent) * SOFTENING + LEAST_SQUARED;
            let mut emitted = 0.0;
            let places = line.quarters::<ExactMath>(s_squared);
            for k in 0..2 {
                let p = cluster.center + flush3(places[k] * pow2(line.exponent), LEAST_LENGTH);
                let point = ShadingPoint {
                    p: [p.x, p.y, p.z],
                    n: [0.0; 3],
                };
                emitted += Eq4::factor(&cluster, &point).0;
            }
            let mean = line.mean::<ExactMath>(s_squared) * emitted;
            scaled[slot] = weight(cluster.phi, mean, line.exponent);
        }
        on_one_scale(&scaled)
    }
}

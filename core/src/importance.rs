//! How much a set of lights may matter to a point: what children are chosen by.
//!
//! The value need not be accurate, only the same on both processors and positive wherever light can arrive; so square
//! roots and reciprocals are the cheap same-bits forms, and every rounding is made up for outward.

use glam::Vec3;

use crate::exact::{self, exponent, pow2, recip, rsqrt, significand};
use crate::point::ShadingPoint;
use crate::vector::{dot, length_squared};

/// What importance needs to know of the lights below a child; a node layout decodes it.
#[derive(Clone, Copy, Debug)]
pub struct Cluster {
    /// Centre C of the box, metres.
    pub center: Vec3,
    /// Squared radius of a sphere around the box, m².
    pub radius_squared: f32,
    /// Axis of the normals' cone; length 1 within 2^-9.
    pub axis: Vec3,
    /// cos θ_o.
    pub cos_theta_o: f32,
    /// sin θ_o.
    pub sin_theta_o: f32,
    /// cos θ_e.
    pub cos_theta_e: f32,
    /// Flux Φ, W.
    pub phi: f32,
}

/// An importance `significand · 2^exponent`. The exponent is kept apart because Φ/d² of the accepted domain spans
/// 2^±300: lights of one scene are compared by the difference of their exponents, so no scale of scene or flux can
/// push one of them to zero or infinity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Importance {
    /// Zero, or in `[2^-66, 8)`.
    pub significand: f32,
    /// Exponent of two; meaningless when the significand is zero.
    pub exponent: i32,
}

/// A measure of what a cluster may contribute at a point. Types choose it, so that kernels contain one only.
pub trait ImportanceModel {
    /// Importance of `cluster` at `point`: zero only if no light in it can contribute there.
    fn importance(cluster: &Cluster, point: &ShadingPoint) -> Importance;
}

/// Outward slack of both cosines, 2^-8. It covers the axis's quantisation (2^-9), two Newton steps (2^-17) and what
/// `sqrt(1 − c²)` makes of them near |c| = 1 (2^-8.3); `tests/tests/importance.rs` looks for a contributing light that
/// is given no importance.
const SLACK: f32 = 0.003_906_25;

/// Share of r² added to d² (see [`Eq4`]). A constant of its own: rust-gpu does not fold an expression of literals.
const SOFTENING: f32 = 1.0 / 12.0;

/// Squared distances count as at least this, m²: 2^-100.
const MIN_DISTANCE_SQUARED: f32 = pow2(-100);

/// 2^-60.
const TINY: f32 = pow2(-60);

/// Eq. 4 of Freire & Pereira 2023 (after Conty Estevez & Kulla 2018, section 4.2, Eq. 3): flux, distance, orientation of
/// the emitters and incident angle.
///
/// θ_u, the uncertainty angle, is that of the sphere around the box. Two departures from the letter of Eq. 4:
/// - ‖X − C‖² is softened by r²/12, since the centre stands for lights all over the box. Falcor and pbrt clamp instead;
///   the ablation that favours the soft form is reproduced by `lightbvh bench`'s variance table.
/// - cos θ'_i is not taken as absolute: an opaque surface receives nothing from behind. A zero normal drops the factor.
#[derive(Clone, Copy, Debug)]
pub struct Eq4;

impl ImportanceModel for Eq4 {
    #[inline(always)]
    fn importance(cluster: &Cluster, point: &ShadingPoint) -> Importance {
        let (v, distance_squared, inverse) = direction(cluster, point);

        // sin and cos of θ_u; inside the sphere the lights may be anywhere.
        let sin_u_squared = cluster.radius_squared * (inverse * inverse);
        let inside = sin_u_squared >= 1.0;
        let sin_u = root(sin_u_squared);
        let cos_u = root(exact::max(1.0 - sin_u_squared, 0.0));

        // cos θ'_i = cos max(0, θ_i − θ_u), and 1 in a volume.
        let n = point.normal();
        let in_volume = n.x == 0.0 && n.y == 0.0 && n.z == 0.0;
        let cos_i = cosine(dot(n, v) * inverse);
        let sin_i = root(1.0 - cos_i * cos_i);
        let towards = if cos_i >= cos_u {
            1.0
        } else {
            cos_i * cos_u + sin_i * sin_u
        };
        let incident = if in_volume || inside {
            1.0
        } else {
            positive(towards + SLACK)
        };

        // cos θ' = cos max(0, θ − θ_o − θ_u), with α = θ_o + θ_u; an α above π shows in its negative sine.
        let cos_t = cosine(-(dot(cluster.axis, v) * inverse));
        let sin_t = root(1.0 - cos_t * cos_t);
        let cos_alpha = cluster.cos_theta_o * cos_u - cluster.sin_theta_o * sin_u;
        let sin_alpha = cluster.sin_theta_o * cos_u + cluster.cos_theta_o * sin_u;
        let surrounded = inside || sin_alpha < 0.0 || cos_t >= cos_alpha;
        let facing = if surrounded {
            1.0
        } else {
            cos_t * cos_alpha + sin_t * sin_alpha
        };
        let reach = facing + SLACK;
        let orientation = if reach > cluster.cos_theta_e {
            positive(reach)
        } else {
            0.0
        };

        over_distance(cluster, distance_squared, incident * orientation)
    }
}

/// Flux over distance only: the cheap end of the trade between speed and accuracy, right where lights shine everywhere.
#[derive(Clone, Copy, Debug)]
pub struct FluxOverDistance;

impl ImportanceModel for FluxOverDistance {
    #[inline(always)]
    fn importance(cluster: &Cluster, point: &ShadingPoint) -> Importance {
        let distance_squared = length_squared(cluster.center - point.position());
        over_distance(cluster, distance_squared, 1.0)
    }
}

/// C − X, its squared length (at least 2^-100) and the reciprocal of its length.
#[inline(always)]
fn direction(cluster: &Cluster, point: &ShadingPoint) -> (Vec3, f32, f32) {
    let v = cluster.center - point.position();
    let distance_squared = exact::max(length_squared(v), MIN_DISTANCE_SQUARED);
    (v, distance_squared, rsqrt(distance_squared))
}

/// Φ · factor / (d² + r²/12), exponents apart.
#[inline(always)]
fn over_distance(cluster: &Cluster, distance_squared: f32, factor: f32) -> Importance {
    let soft = exact::max(
        distance_squared + cluster.radius_squared * SOFTENING,
        MIN_DISTANCE_SQUARED,
    );
    let value = significand(cluster.phi) * recip(significand(soft)) * factor;
    // The comparison also turns the NaN of hostile words into "no importance".
    let alive = cluster.phi > 0.0 && value > 0.0;
    Importance {
        significand: if alive { value } else { 0.0 },
        exponent: exponent(cluster.phi) - exponent(soft),
    }
}

/// Square root of `x` in 0..=2 by the cheap reciprocal root; x below 2^-60 counts as 0.
#[inline(always)]
fn root(x: f32) -> f32 {
    let bounded = exact::max(x, TINY);
    if x < TINY { 0.0 } else { bounded * rsqrt(bounded) }
}

/// A computed cosine brought into −1..=1. Below 2^-60 it is +0: a sign that hangs on a subnormal product would not be
/// the same on a device that flushes those.
#[inline(always)]
fn cosine(x: f32) -> f32 {
    exact::clamp(exact::flush(x, TINY), -1.0, 1.0)
}

/// `x` if above zero, else +0.
#[inline(always)]
fn positive(x: f32) -> f32 {
    if x > 0.0 { x } else { 0.0 }
}

/// Brings the importances of a node's children to one scale and sums them in slot order.
///
/// A positive importance stays positive: below 2^-60 of the greatest it counts as that much, which is more than it
/// deserves and less than any random number resolves.
#[inline(always)]
pub(crate) fn to_weights<const W: usize>(importances: &[Importance; W]) -> ([f32; W], f32) {
    let mut greatest = -1024;
    for slot in 0..W {
        let i = importances[slot];
        greatest = if i.significand > 0.0 && i.exponent > greatest {
            i.exponent
        } else {
            greatest
        };
    }
    let mut weights = [0.0; W];
    let mut sum = 0.0;
    for slot in 0..W {
        let i = importances[slot];
        let below = i.exponent - greatest;
        let weight = i.significand * pow2(if below < -60 { -60 } else { below });
        weights[slot] = weight;
        sum += weight;
    }
    (weights, sum)
}

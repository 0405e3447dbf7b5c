//! How much a set of lights may matter to a point: what children are chosen by.
//!
//! The value need not be accurate, only the same on both processors and positive wherever light can arrive; so square
//! roots and reciprocals are the cheap same-bits forms, and every rounding is made up for outward.

use glam::Vec3;

use crate::exact::{self, exponent, pow2, recip_rough, rsqrt_rough, significand};
use crate::point::Receiver;
use crate::vector::{dot, length_squared};

/// What importance needs to know of the lights below a child; a node layout decodes it.
#[derive(Clone, Copy, Debug)]
pub struct Cluster {
    /// Centre C of the box, metres.
    pub center: Vec3,
    /// Half extents of the box, metres.
    pub extent: Vec3,
    /// Squared radius of a sphere around the box, m².
    pub radius_squared: f32,
    /// Axis of the normals' cone; of length 1, or shorter by at most 2^-8.
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
    /// Zero, or in `[2^-20, 8)`.
    pub significand: f32,
    /// Exponent of two; −1024 without any flux.
    pub exponent: i32,
}

/// A measure of what a cluster may contribute at a point. Types choose it, so that kernels contain one only.
pub trait ImportanceModel {
    /// Importance of `cluster` at `point`: zero only if no light in it can contribute there.
    fn importance<R: Receiver>(cluster: &Cluster, point: &R) -> Importance;

    /// Whether [`importance`](Self::importance) is positive; a model may know that at a lower price.
    #[inline(always)]
    fn reaches<R: Receiver>(cluster: &Cluster, point: &R) -> bool {
        Self::importance(cluster, point).significand > 0.0
    }
}

/// Outward slack of the cosine towards the emitters, 2^-8. At its zero, where it decides, cos θ' is off by less than
/// √5 · 6.6e-4 for the roots' one Newton step and 2^-11 for the root of a rounded 1 − cos²: together 2e-3, half the
/// slack. (Quantisation is not in it: stored cones are widened for it.) `tests/tests/importance.rs` looks for a
/// contributing light that is given no importance. The incident cosine, which the box decides, takes it for its least
/// value.
const SLACK: f32 = 0.003_906_25;

/// Share of the distance by which a box may lie below the horizon, 2^-20: it covers the rounding of the products.
const HORIZON_SLACK: f32 = pow2(-20);

/// Share of r² added to d² (see [`Eq4`]). A constant of its own: rust-gpu does not fold an expression of literals.
const SOFTENING: f32 = 1.0 / 12.0;

/// Squared distances count as at least this, m²: 2^-100.
const MIN_DISTANCE_SQUARED: f32 = pow2(-100);

/// Length added along the cone's axis: a sign that hangs on a subnormal product, which it absorbs, would not be the same
/// on a device that flushes those. A relative 2^-60 of the least distance.
const TINY_LENGTH: f32 = pow2(-110);

/// Eq. 4 of Freire & Pereira 2023 (after Conty Estevez & Kulla 2018, section 4.2, Eq. 3): flux, distance, orientation of
/// the emitters and incident angle.
///
/// θ_u, the uncertainty angle, is that of the sphere around the box. Three departures from the letter of Eq. 4:
/// - ‖X − C‖² is softened by r²/12, since the centre stands for lights all over the box. Falcor and pbrt clamp
///   instead; the two forms have not been measured against each other in this code.
/// - cos θ'_i is not taken as absolute: an opaque surface receives nothing from behind. A zero normal drops the factor.
/// - cos θ'_i is bounded by the box's highest corner above the surface, not by the sphere: it is zero just when the whole
///   box lies below the horizon. The sphere leaves many branches alive below which nothing is; with it,
///   100,000 scattered lights took a sixth more node visits per sample.
#[derive(Clone, Copy, Debug)]
pub struct Eq4;

impl ImportanceModel for Eq4 {
    #[inline(always)]
    fn importance<R: Receiver>(cluster: &Cluster, point: &R) -> Importance {
        let (factor, d_squared) = Self::factor(cluster, point);
        over_distance(cluster, d_squared, factor)
    }

    /// The factor is zero or above 2^-48, and what flux and distance add to it lies between 1/4 and 4.
    #[inline(always)]
    fn reaches<R: Receiver>(cluster: &Cluster, point: &R) -> bool {
        (cluster.phi > 0.0) & (Self::factor(cluster, point).0 > 0.0)
    }
}

impl Eq4 {
    /// |cos θ_i'| cos θ' as bounds, and d².
    #[inline(always)]
    fn factor<R: Receiver>(cluster: &Cluster, point: &R) -> (f32, f32) {
        let v = cluster.center - point.position();
        let n = point.normal();
        let d_squared = exact::max(length_squared(v), MIN_DISTANCE_SQUARED);
        let r_squared = cluster.radius_squared;

        // Lengths instead of sines and cosines: with d = |v|, d cos θ = −axis·v, d sin θ_u = r, and the others by
        // Pythagoras. Every root then starts from d² and none waits for another. Selects, not branches: the compiler
        // computes a node's children side by side.
        let along_axis = TINY_LENGTH - dot(cluster.axis, v);
        let across_axis = root(d_squared - along_axis * along_axis);
        let radius = root(r_squared);
        let tangent = root(d_squared - r_squared);
        let inverse = rsqrt_rough(d_squared);
        let inverse_squared = inverse * inverse;

        // Inside the sphere the lights may be anywhere, and so they may for a point known too roughly at this distance.
        let inside = if R::ROUNDED {
            exact::max(r_squared, point.near_squared()) >= d_squared
        } else {
            r_squared >= d_squared
        };

        // The incident cosine that the highest corner of the box has, as seen at the centre's distance; 1 in a volume.
        let in_volume = (n.x == 0.0) & (n.y == 0.0) & (n.z == 0.0);
        let reach_up = (exact::abs(n.x) * cluster.extent.x + exact::abs(n.y) * cluster.extent.y)
            + exact::abs(n.z) * cluster.extent.z;
        let reach_up = if R::ROUNDED {
            reach_up + point.slack()
        } else {
            reach_up
        };
        let cos_incident = (dot(n, v) + reach_up) * inverse;
        let bounded = exact::min(exact::max(cos_incident, SLACK), 1.0);
        let above = if cos_incident < -HORIZON_SLACK {
            0.0
        } else {
            bounded
        };
        let incident = if in_volume { 1.0 } else { above };

        // cos θ' = cos max(0, θ − θ_o − θ_u), with α = θ_o + θ_u; an α above π shows in its negative sine.
        let cos_alpha = cluster.cos_theta_o * tangent - cluster.sin_theta_o * radius;
        let sin_alpha = cluster.sin_theta_o * tangent + cluster.cos_theta_o * radius;
        let facing = (along_axis * cos_alpha + across_axis * sin_alpha) * inverse_squared;
        let surrounded = inside | (sin_alpha < 0.0) | (along_axis >= cos_alpha);
        let outward = if R::ROUNDED { SLACK + point.tilt() } else { SLACK };
        let reach = if surrounded { 1.0 } else { facing } + outward;
        let orientation = if reach > cluster.cos_theta_e { reach } else { 0.0 };

        (incident * orientation, d_squared)
    }
}

/// Flux over distance only: the cheap end of the trade between speed and accuracy, right where lights shine everywhere.
#[derive(Clone, Copy, Debug)]
pub struct FluxOverDistance;

impl ImportanceModel for FluxOverDistance {
    #[inline(always)]
    fn importance<R: Receiver>(cluster: &Cluster, point: &R) -> Importance {
        let distance_squared = length_squared(cluster.center - point.position());
        over_distance(cluster, distance_squared, 1.0)
    }
}

/// Φ · factor / (d² + r²/12), exponents apart.
#[inline(always)]
fn over_distance(cluster: &Cluster, distance_squared: f32, factor: f32) -> Importance {
    let soft = exact::max(
        distance_squared + cluster.radius_squared * SOFTENING,
        MIN_DISTANCE_SQUARED,
    );
    let value = significand(cluster.phi) * recip_rough(significand(soft)) * factor;
    // The comparison also turns the NaN of hostile words into "no importance".
    let shines = cluster.phi > 0.0;
    Importance {
        significand: if shines & (value > 0.0) { value } else { 0.0 },
        exponent: if shines {
            exponent(cluster.phi) - exponent(soft)
        } else {
            -1024
        },
    }
}

/// Square root by the rough reciprocal root; 2^-62 for anything below 2^-124.
#[inline(always)]
fn root(x: f32) -> f32 {
    const LEAST: f32 = pow2(-124);
    let bounded = exact::max(x, LEAST);
    bounded * rsqrt_rough(bounded)
}

/// Brings the importances of a node's children to one scale and sums them pair by pair.
///
/// The scale is the greatest exponent of all, whether that child has importance or not: so it is known long before the
/// significands are. A positive importance stays positive: below 2^-60 of the scale it counts as that much, which is
/// more than it deserves and less than any random number resolves.
#[inline(always)]
pub(crate) fn to_weights<const W: usize>(importances: &[Importance; W]) -> ([f32; W], f32) {
    let mut greatest = -1024;
    for slot in 0..W {
        let e = importances[slot].exponent;
        greatest = if e > greatest { e } else { greatest };
    }
    let mut weights = [0.0; W];
    for slot in 0..W {
        let i = importances[slot];
        let below = i.exponent - greatest;
        let bounded = if below < -60 { -60 } else { below };
        weights[slot] = i.significand * f32::from_bits(((bounded + 127) as u32) << 23);
    }
    (weights, pairwise_sum(&weights))
}

/// The sum of neighbours, of pairs of neighbours, and so on: the order in which a child is chosen.
#[inline(always)]
fn pairwise_sum<const W: usize>(weights: &[f32; W]) -> f32 {
    let mut sums = *weights;
    let mut stride = 1;
    for _ in 0..4 {
        for slot in 0..W {
            if slot & (2 * stride - 1) == 0 && slot + stride < W {
                sums[slot] += sums[slot + stride];
            }
        }
        stride *= 2;
    }
    sums[0]
}

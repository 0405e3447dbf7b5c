//! The paper's importance, Eq. 4.

use super::sight::{LEAST_ALONG, MIN_DISTANCE_SQUARED, offset, over_distance, root};
use super::{ImportanceModel, Scaled, Space, on_one_scale};
use crate::exact::{self, pow2, rsqrt_rough};
use crate::node::{BoundsNode, Cluster};
use crate::point::ShadingPoint;
use crate::vector::{dot, is_zero, length_squared};

/// Slack of the cosines, 2^-8: the least that the receiver's counts where its bound is not zero, and what is added to the emitters'.
const SLACK: f32 = 0.003_906_25;

/// Least factor, 2^-10, also where a bound is zero. It then says that nothing below contributes, but a rounded bound is no
/// proof, and no weight is zero where there is flux. A smaller one was not measured here.
const FLOOR: f32 = pow2(-10);

/// Share of the distance by which a box may lie below the horizon, 2^-20: it covers the rounding of the products.
const HORIZON_SLACK: f32 = pow2(-20);

/// Share of r² added to d² (see [`Eq4`]). A constant of its own: rust-gpu does not fold an expression of literals.
const SOFTENING: f32 = 1.0 / 12.0;

/// Eq. 4 of Freire & Pereira 2023 (after Conty Estevez & Kulla 2018, section 4.2, Eq. 3): flux, distance, orientation of
/// the emitters and incident angle.
///
/// θ_u, the uncertainty angle, is that of the sphere around the box. Five departures from the letter of Eq. 4:
/// - ‖X − C‖² is softened by r²/12, since the centre stands for lights all over the box; Falcor and pbrt clamp instead.
/// - cos θ'_i is not taken as absolute: an opaque surface receives nothing from behind. A zero normal drops the factor.
/// - cos θ'_i is bounded by the box's highest corner above the surface, not by the sphere: it is zero just when the whole
///   box lies below the horizon.
/// - Where the receiver's cosine is not zero it is at least 2^-8, and cos θ' is 2^-8 more than its bound: rounding and
///   quantisation then take no light away.
/// - The product of both cosines is at least 2^-10, also where a bound says zero.
#[derive(Clone, Copy, Debug)]
pub struct Eq4;

impl<N: BoundsNode<W>, const W: usize> ImportanceModel<N, W> for Eq4 {
    #[inline(always)]
    fn weights_in(node: &N, point: &ShadingPoint, _: Space) -> [f32; W] {
        let mut scaled = [Scaled::ZERO; W];
        for slot in 0..W {
            scaled[slot] = Eq4::scaled(&node.cluster(slot), point);
        }
        on_one_scale(&scaled)
    }
}

impl Eq4 {
    /// Φ over the softened distance, times the product of the cosines' bounds, [`FLOOR`] where that is zero.
    #[inline(always)]
    pub(super) fn scaled(cluster: &Cluster, point: &ShadingPoint) -> Scaled {
        let v = offset(cluster.center, point);
        let n = point.normal();
        let d_squared = exact::max(length_squared(v), MIN_DISTANCE_SQUARED);
        let r_squared = cluster.radius_squared;

        // Lengths instead of sines and cosines: with d = |v|, d cos θ = −axis·v, d sin θ_u = r, and the others by
        // Pythagoras. Every root then starts from d² and none waits for another. Selects, not branches: the compiler
        // computes a node's children side by side.
        let along_axis = -exact::flush(dot(cluster.axis, v), LEAST_ALONG);
        let across_axis = root(d_squared - along_axis * along_axis);
        let radius = root(r_squared);
        let tangent = root(d_squared - r_squared);
        let inverse = rsqrt_rough(d_squared);
        let inverse_squared = inverse * inverse;

        // Inside the sphere the lights may be anywhere.
        let inside = r_squared >= d_squared;

        // The incident cosine that the highest corner of the box has, as seen at the centre's distance; 1 in a volume.
        let reach_up = (exact::abs(n.x) * cluster.extent.x + exact::abs(n.y) * cluster.extent.y)
            + exact::abs(n.z) * cluster.extent.z;
        let cos_incident = (dot(n, v) + reach_up) * inverse;
        let bounded = exact::min(exact::max(cos_incident, SLACK), 1.0);
        let above = if cos_incident < -HORIZON_SLACK {
            0.0
        } else {
            bounded
        };
        let incident = if is_zero(n) { 1.0 } else { above };

        // cos θ' = cos max(0, θ − θ_o − θ_u), with α = θ_o + θ_u; an α above π shows in its negative sine.
        let cos_alpha = cluster.cos_theta_o * tangent - cluster.sin_theta_o * radius;
        let sin_alpha = cluster.sin_theta_o * tangent + cluster.cos_theta_o * radius;
        let (cos_alpha, sin_alpha) = (
            exact::flush(cos_alpha, LEAST_ALONG),
            exact::flush(sin_alpha, LEAST_ALONG),
        );
        let facing = (along_axis * cos_alpha + across_axis * sin_alpha) * inverse_squared;
        let surrounded = inside | (sin_alpha < 0.0) | (along_axis >= cos_alpha);
        let reach = if surrounded { 1.0 } else { facing } + SLACK;
        let orientation = if reach > 0.0 { reach } else { 0.0 };

        let factor = exact::max(incident * orientation, FLOOR);
        over_distance(cluster.phi, d_squared + r_squared * SOFTENING, factor)
    }
}

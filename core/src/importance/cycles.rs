//! Cycles' importance: a greatest and a least one.

use glam::Vec3;

use super::sight::{
    FLOOR, LEAST_ALONG, LEAST_OFFSET, MIN_DISTANCE_SQUARED, Sight, in_volume, offset, over_distance, root,
};
use super::{Cluster, ImportanceModel, Scaled, on_one_scale};
use crate::exact::{self, pow2, recip, rsqrt_rough};
use crate::node::BoundsNode;
use crate::point::ShadingPoint;
use crate::vector::{cross, dot, flush3, length_squared};

/// Least cosines' product that counts as a least importance, 2^-20: a smaller one is rounding.
const LEAST: f32 = pow2(-20);

/// Square of a length added to that of a corner across the centre's direction, m².
const TINY_SQUARED: f32 = pow2(-100);

/// What a sum is bounded by below, so that it has a reciprocal.
const LEAST_SUM: f32 = pow2(-100);

/// The importance of Cycles' light tree: `light_tree_node_importance`, `light_tree_importance` and `get_left_probability`
/// (`src/kernel/light/tree.h`, after Conty Estevez & Kulla 2018). On the layouts that hold bounds.
///
/// Half of the choices are in proportion to the greatest importance that a child's lights may have, half to the least:
/// - greatest: Φ · cos max(0, θ_i − θ_u) · cos max(0, θ − θ_o − θ_u) / max(d, r/2)²; zero where the box lies below the horizon, where
///   the first cosine is negative, and where the second's angle is beyond θ_e;
/// - least: Φ · cos(θ_i + θ_u) · cos(θ + θ_o + θ_u) / max(d, r/2)²; zero where the second's angle is beyond θ_e, and where θ or θ_u is
///   beyond 90°. Where all are zero, each child with a greatest importance has the same share.
///
/// θ_u reaches to the farthest corner of the box as seen from its centre's direction: it is smaller than that of the sphere; within the
/// box it is 180°. d is the distance of the centre, r half the box's diagonal.
///
/// Departures: Cycles' nodes have two children, and `W` here; of a single light it asks the triangle itself, with a nearest and a
/// farthest distance, of which bounds know nothing; the cosines' product of the greatest importance is at least 2^-10, where Cycles
/// gives zero, or, at the very centre of a box, NaN; one of the least importance below 2^-20 is zero. In a volume both of the receiver's
/// cosines are 1, where Cycles integrates along a ray.
#[derive(Clone, Copy, Debug)]
pub struct Cycles;

impl<N: BoundsNode<W>, const W: usize> ImportanceModel<N, W> for Cycles {
    const UNIFORM_HALVINGS: u32 = 0;

    #[inline(always)]
    fn weights(node: &N, point: &ShadingPoint) -> [f32; W] {
        let mut scaled = [Scaled {
            significand: 0.0,
            exponent: -1024,
        }; W];
        let (mut greatest, mut least, mut alive) = ([0.0; W], [0.0; W], [0.0; W]);
        for slot in 0..W {
            let cluster = node.cluster(slot);
            let sight = Sight::of_corners(&cluster, point);
            let (most, fewest) = sight.extremes(&cluster, point.normal());
            let quarter = 0.25 * cluster.radius_squared;
            scaled[slot] = over_distance(cluster.phi, exact::max(sight.d_squared, quarter), 1.0);
            greatest[slot] = exact::max(most, FLOOR);
            least[slot] = fewest;
            alive[slot] = if (most > 0.0) & (scaled[slot].significand > 0.0) {
                1.0
            } else {
                0.0
            };
        }
        averaged(&on_one_scale(&scaled), &greatest, &least, &alive)
    }
}

/// The sum of both probabilities of each child, from Φ/d² and what it is multiplied by.
#[inline(always)]
fn averaged<const W: usize>(
    flux: &[f32; W],
    greatest: &[f32; W],
    least: &[f32; W],
    alive: &[f32; W],
) -> [f32; W] {
    let (mut all_greatest, mut all_least, mut count) = (0.0, 0.0, 0.0);
    for slot in 0..W {
        all_greatest += flux[slot] * greatest[slot];
        all_least += flux[slot] * least[slot];
        count += alive[slot];
    }
    let over_greatest = recip(exact::max(all_greatest, LEAST_SUM));
    let over_least = recip(exact::max(all_least, LEAST_SUM));
    let over_count = recip(exact::max(count, 1.0));
    let mut weights = [0.0; W];
    for slot in 0..W {
        let share = if all_least > 0.0 {
            flux[slot] * least[slot] * over_least
        } else {
            alive[slot] * over_count
        };
        weights[slot] = flux[slot] * greatest[slot] * over_greatest + share;
    }
    weights
}

impl Sight {
    /// With the cone around the box's corners as seen from the point, about the direction of its centre
    /// (`light_tree_cos_bounding_box_angle`).
    #[inline(always)]
    pub fn of_corners(cluster: &Cluster, point: &ShadingPoint) -> Self {
        let v = offset(cluster.center, point);
        let e = cluster.extent;
        let d_squared = exact::max(length_squared(v), MIN_DISTANCE_SQUARED);
        let inverse = rsqrt_rough(d_squared);
        let direction = v * inverse;
        // Of the corner that is the farthest off: its lengths along and across the direction. Opposite ones are as far across.
        let (mut cosine, mut sine) = (d_squared * inverse, 0.0);
        for k in 0..8 {
            let first = if k & 2 == 0 { e.x } else { -e.x };
            let second = if k & 4 == 0 { e.y } else { -e.y };
            let corner = Vec3::new(first, second, e.z);
            let aside = flush3(cross(direction, corner), LEAST_OFFSET);
            let across = root(length_squared(aside) + TINY_SQUARED);
            let to_corner = if k & 1 == 0 { v + corner } else { v - corner };
            let along = exact::flush(dot(direction, to_corner), LEAST_ALONG);
            // The sine of the difference of both angles.
            let farther = across * cosine > sine * along;
            cosine = if farther { along } else { cosine };
            sine = if farther { across } else { sine };
        }
        let to_distance = rsqrt_rough(exact::max(cosine * cosine + sine * sine, MIN_DISTANCE_SQUARED))
            * (d_squared * inverse);
        Self {
            v,
            d_squared,
            inverse,
            sine: exact::flush(sine * to_distance, LEAST_ALONG),
            cosine: exact::flush(cosine * to_distance, LEAST_ALONG),
            inside: (exact::abs(v.x) < e.x) & (exact::abs(v.y) < e.y) & (exact::abs(v.z) < e.z),
        }
    }

    /// The products of both cosines, greatest and least, zero as published.
    #[inline(always)]
    pub fn extremes(&self, cluster: &Cluster, n: Vec3) -> (f32, f32) {
        let volume = in_volume(n);
        let over_square = self.inverse * self.inverse;
        let height = exact::flush(dot(n, self.v), LEAST_ALONG);
        let reach_up = (exact::abs(n.x) * cluster.extent.x + exact::abs(n.y) * cluster.extent.y)
            + exact::abs(n.z) * cluster.extent.z;
        let nearest = if volume { 1.0 } else { self.nearest(height) };
        let visible = volume | (exact::flush(height + reach_up, LEAST_ALONG) > 0.0);
        let emitted = self.emitted(cluster);
        let reaches = emitted > cluster.cos_theta_e;
        let most = if visible & reaches & (nearest > 0.0) {
            exact::flush(nearest * exact::abs(emitted), LEAST_SUM)
        } else {
            0.0
        };

        // cos(θ_i + θ_u).
        let across = root(self.d_squared - height * height);
        let lowest = (height * self.cosine - across * self.sine) * over_square;
        let farthest = if volume { 1.0 } else { exact::max(lowest, 0.0) };
        // cos and sin (θ + θ_u) d², then cos(θ + θ_u + θ_o).
        let along = -exact::flush(dot(cluster.axis, self.v), LEAST_ALONG);
        let aside = root(self.d_squared - along * along);
        let cos_sum = (along * self.cosine - aside * self.sine) * over_square;
        let sin_sum = (aside * self.cosine + along * self.sine) * over_square;
        let turned = cos_sum * cluster.cos_theta_o - sin_sum * cluster.sin_theta_o;
        // θ + θ_u is at most 180°: it is within θ_e − θ_o just where the whole sum is within θ_e and θ_o is less.
        let within = (cluster.cos_theta_o > cluster.cos_theta_e)
            & (along > 0.0)
            & (self.cosine > 0.0)
            & !self.inside
            & (turned > cluster.cos_theta_e);
        let product = farthest * exact::abs(turned);
        let least = if within & (most > 0.0) & (product > LEAST) {
            product
        } else {
            0.0
        };
        (most, least)
    }
}

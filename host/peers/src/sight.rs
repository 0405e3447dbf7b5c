//! A child's box as a point sees it, for the importances that bound cosines by cones.

use glam::Vec3;

use lightbvh::ShadingPoint;
use lightbvh::exact::{self, exponent, pow2, recip_rough, rsqrt_rough, significand};
use lightbvh::importance::{Cluster, Scaled};

/// Least product of the cosines, 2^-10, as that of [`Eq4`](lightbvh::importance::Eq4): where a published bound is zero, or less, the lights
/// keep this share of Φ/d², for a rounded bound is no proof.
pub const FLOOR: f32 = pow2(-10);

/// Squared distances count as at least this, m²: 2^-100.
const MIN_DISTANCE_SQUARED: f32 = pow2(-100);

/// Lengths along an axis count as zero below this, metres: their squares are then normal numbers.
const LEAST_OFFSET: f32 = pow2(-62);
/// Lengths along a direction count as zero below this, metres: 2^-25 of the least distance. No product of two lengths is then subnormal that a
/// sum shows: where both are short, both across are about the distance.
const LEAST_ALONG: f32 = pow2(-75);

/// The direction of a box's centre, and a cone around the box: its angle is θ_u.
///
/// Sines and cosines are kept as lengths, times the distance d of the centre: lengths by Pythagoras are precise where 1 − cos² of
/// a rough cosine is not, and no root waits for another.
#[derive(Clone, Copy, Debug)]
pub struct Sight {
    /// From the point to the centre, metres.
    pub v: Vec3,
    /// d², at least [`MIN_DISTANCE_SQUARED`].
    pub d_squared: f32,
    /// About 1/d.
    pub inverse: f32,
    /// d sin θ_u.
    pub sine: f32,
    /// d cos θ_u.
    pub cosine: f32,
    /// Whether the cone is every direction.
    pub inside: bool,
}

impl Sight {
    /// With the cone around the sphere around the box.
    #[inline(always)]
    pub fn of_sphere(cluster: &Cluster, point: &ShadingPoint) -> Self {
        let v = offset(cluster.center, point);
        let d_squared = exact::max(dot(v, v), MIN_DISTANCE_SQUARED);
        Self {
            v,
            d_squared,
            inverse: rsqrt_rough(d_squared),
            sine: root(cluster.radius_squared),
            cosine: root(d_squared - cluster.radius_squared),
            inside: cluster.radius_squared >= d_squared,
        }
    }

    /// cos θ' = cos max(0, θ − θ_o − θ_u) of the emitters: θ lies between the axis of their normals and the way back to the point.
    #[inline(always)]
    pub fn emitted(&self, cluster: &Cluster) -> f32 {
        let along = -exact::flush(dot(cluster.axis, self.v), LEAST_ALONG);
        let across = root(self.d_squared - along * along);
        // α = θ_o + θ_u; an α above π shows in its negative sine.
        let cos_alpha = cluster.cos_theta_o * self.cosine - cluster.sin_theta_o * self.sine;
        let sin_alpha = cluster.sin_theta_o * self.cosine + cluster.cos_theta_o * self.sine;
        let (cos_alpha, sin_alpha) = (
            exact::flush(cos_alpha, LEAST_ALONG),
            exact::flush(sin_alpha, LEAST_ALONG),
        );
        let facing = (along * cos_alpha + across * sin_alpha) * (self.inverse * self.inverse);
        let surrounded = self.inside | (sin_alpha < 0.0) | (along >= cos_alpha);
        if surrounded { 1.0 } else { facing }
    }

    /// cos max(0, θ_i − θ_u), where the length `along` is d cos θ_i.
    #[inline(always)]
    pub fn nearest(&self, along: f32) -> f32 {
        let along = exact::flush(along, LEAST_ALONG);
        let across = root(self.d_squared - along * along);
        let turned = (along * self.cosine + across * self.sine) * (self.inverse * self.inverse);
        if self.inside | (along >= self.cosine) {
            1.0
        } else {
            turned
        }
    }
}

/// `(ax bx + ay by) + az bz`.
#[inline(always)]
pub fn dot(a: Vec3, b: Vec3) -> f32 {
    (a.x * b.x + a.y * b.y) + a.z * b.z
}

/// From the point to `center`, metres.
#[inline(always)]
fn offset(center: Vec3, point: &ShadingPoint) -> Vec3 {
    let v = center - point.position();
    let flush = |x| exact::flush(x, LEAST_OFFSET);
    Vec3::new(flush(v.x), flush(v.y), flush(v.z))
}

/// Whether the point lies in a volume: its normal is zero.
#[inline(always)]
pub fn in_volume(n: Vec3) -> bool {
    (n.x == 0.0) & (n.y == 0.0) & (n.z == 0.0)
}

/// Φ · `factor` / `squared`, exponents apart.
#[inline(always)]
pub fn over_distance(phi: f32, squared: f32, factor: f32) -> Scaled {
    let bounded = exact::max(squared, MIN_DISTANCE_SQUARED);
    let value = significand(phi) * recip_rough(significand(bounded)) * factor;
    // The comparison also turns the NaN of hostile words into "no importance".
    let shines = phi > 0.0;
    if shines & (value > 0.0) {
        Scaled {
            significand: value,
            exponent: exponent(phi) - exponent(bounded),
        }
    } else {
        Scaled::ZERO
    }
}

/// Square root by the rough reciprocal root; 2^-62 for anything below 2^-124.
#[inline(always)]
pub fn root(x: f32) -> f32 {
    const LEAST: f32 = pow2(-124);
    let bounded = exact::max(x, LEAST);
    bounded * rsqrt_rough(bounded)
}

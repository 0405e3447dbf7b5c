//! A child's box as a point sees it, for the importances that bound cosines by cones.

use glam::Vec3;

use lightbvh::ShadingPoint;
use lightbvh::device::sight::{LEAST_ALONG, MIN_DISTANCE_SQUARED, offset, root};
use lightbvh::device::vector::dot;
use lightbvh::exact::{self, pow2, rsqrt_rough};
use lightbvh::importance::Cluster;

/// Least product of the cosines, 2^-10, as that of [`Eq4`](lightbvh::importance::Eq4): where a published bound is zero, or less, the lights
/// keep this share of Φ/d², for a rounded bound is no proof.
pub const FLOOR: f32 = pow2(-10);

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

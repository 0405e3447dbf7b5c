//! The importances of pbrt-v4 and Falcor in `f64`, as their sources have them.

use core::f64::consts::PI;

use lightbvh::ShadingPoint;
use lightbvh::importance::Cluster;

use super::{Wide, dot, minus, wide};

/// A child as stored: its axis is as long as it is.
#[derive(Clone, Copy, Debug)]
pub struct Seen {
    /// From the point to the centre of the box.
    pub v: Wide,
    pub half: Wide,
    pub axis: Wide,
    pub theta_o: f64,
    /// Zero in a volume.
    pub n: Wide,
}

fn cos_sub(a: f64, b: f64) -> f64 {
    (a - b).max(0.0).cos()
}

impl Seen {
    pub fn of(cluster: &Cluster, point: &ShadingPoint) -> Self {
        Self {
            v: minus(wide(cluster.center), wide(point.position())),
            half: wide(cluster.extent),
            axis: wide(cluster.axis),
            theta_o: f64::from(cluster.cos_theta_o).clamp(-1.0, 1.0).acos(),
            n: wide(point.normal()),
        }
    }

    pub fn d(&self) -> f64 {
        dot(self.v, self.v).sqrt()
    }

    pub fn r(&self) -> f64 {
        dot(self.half, self.half).sqrt()
    }

    pub fn volume(&self) -> bool {
        self.n == [0.0; 3]
    }

    /// θ_b, θ_u: of the sphere around the box.
    pub fn sphere(&self) -> f64 {
        if self.d() < self.r() {
            PI
        } else {
            (self.r() / self.d()).asin()
        }
    }

    /// Angle between the axis of the normals and the way to the point.
    pub fn theta(&self) -> f64 {
        (-dot(self.axis, self.v) / self.d()).clamp(-1.0, 1.0).acos()
    }

    pub fn cos_theta_i(&self) -> f64 {
        (dot(self.n, self.v) / self.d()).clamp(-1.0, 1.0)
    }

    /// pbrt's cosines, of the emitters and of the receiver; the first is zero from 90° on.
    pub fn pbrt(&self) -> [f64; 2] {
        let theta_b = self.sphere();
        let emitted = cos_sub((self.theta() - self.theta_o).max(0.0), theta_b);
        let incident = if self.volume() {
            1.0
        } else {
            cos_sub(self.cos_theta_i().abs().acos(), theta_b)
        };
        [if emitted <= 0.0 { 0.0 } else { emitted }, incident]
    }

    /// max(d², half the diagonal).
    pub fn pbrt_squared(&self) -> f64 {
        self.d().powi(2).max(self.r())
    }

    /// Falcor's cosines.
    pub fn falcor(&self) -> [f64; 2] {
        let theta_u = self.sphere();
        let orientation = if self.theta_o.cos() > 0.0 {
            cos_sub((self.theta() - self.theta_o).max(0.0), theta_u).max(0.0)
        } else {
            1.0
        };
        let incident = if self.volume() {
            1.0
        } else {
            cos_sub(self.cos_theta_i().acos(), theta_u).clamp(0.0, 1.0)
        };
        [orientation, incident]
    }

    pub fn falcor_squared(&self) -> f64 {
        let half = self.half.iter().fold(0.0, |a: f64, &b| a.max(b));
        self.d().max(half).powi(2)
    }
}

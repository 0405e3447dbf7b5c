//! The importances of pbrt-v4, Falcor and Cycles in `f64`, as their sources have them.

use core::f64::consts::PI;

use super::super::{Wide, dot, minus, normalize, times, wide};
use crate::importance::Cluster;
use crate::point::ShadingPoint;

/// A child as stored: its axis is as long as it is.
#[derive(Clone, Copy, Debug)]
pub struct Seen {
    /// From the point to the centre of the box.
    pub v: Wide,
    pub half: Wide,
    pub axis: Wide,
    pub theta_o: f64,
    pub cos_theta_e: f64,
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
            cos_theta_e: cluster.cos_theta_e.into(),
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

    /// pbrt's cosines, of the emitters and of the receiver; the first is zero from θ_e on.
    pub fn pbrt(&self) -> [f64; 2] {
        let theta_b = self.sphere();
        let emitted = cos_sub((self.theta() - self.theta_o).max(0.0), theta_b);
        let incident = if self.volume() {
            1.0
        } else {
            cos_sub(self.cos_theta_i().abs().acos(), theta_b)
        };
        [if emitted <= self.cos_theta_e { 0.0 } else { emitted }, incident]
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

    pub fn corners(&self) -> [Wide; 8] {
        [0, 1, 2, 3, 4, 5, 6, 7].map(|i: u32| {
            [0, 1, 2].map(|k| {
                self.v[k]
                    + if i >> k & 1 == 0 {
                        self.half[k]
                    } else {
                        -self.half[k]
                    }
            })
        })
    }

    /// Cycles' θ_u.
    pub fn cycles_theta_u(&self) -> f64 {
        if (0..3).all(|k| self.v[k].abs() < self.half[k]) {
            return PI;
        }
        let to_centroid = times(self.v, 1.0 / self.d());
        let cosine = |corner: &Wide| dot(to_centroid, normalize(*corner));
        let least = self.corners().iter().map(cosine).fold(1.0, f64::min);
        least.clamp(-1.0, 1.0).acos()
    }

    /// Height of the box's highest corner, over the distance.
    pub fn height(&self) -> f64 {
        let top = self
            .corners()
            .iter()
            .map(|&c| dot(self.n, c))
            .fold(f64::NEG_INFINITY, f64::max);
        top / self.d()
    }

    /// Cycles' products of cosines, greatest and least, of a theta_u.
    pub fn cycles(&self, theta_u: f64) -> [f64; 2] {
        let theta_i = self.cos_theta_i().acos();
        let (theta, theta_o, theta_e) = (self.theta(), self.theta_o, self.cos_theta_e.acos());
        let (mut nearest, mut farthest) = (1.0, 1.0);
        if !self.volume() {
            nearest = cos_sub(theta_i, theta_u);
            farthest = (theta_i + theta_u).cos().max(0.0);
            if self.height() <= 0.0 || nearest < 0.0 {
                return [0.0; 2];
            }
        }
        let turned = (theta - theta_o - theta_u).max(0.0);
        if turned >= theta_e {
            return [0.0; 2];
        }
        let invisible = theta_e < theta_o
            || theta.cos() < 0.0
            || theta_u.cos() < 0.0
            || theta + theta_u > theta_e - theta_o;
        let least = if invisible {
            0.0
        } else {
            farthest * (theta + theta_u + theta_o).cos().abs()
        };
        [nearest * turned.cos().abs(), least]
    }
}

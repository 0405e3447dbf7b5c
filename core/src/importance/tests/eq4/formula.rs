//! Eq. 4 in `f64`, by angles.

use core::f64::consts::PI;

use super::super::{Wide, dot, minus, normalize, times, top, wide};
use crate::LightBounds;
use crate::point::ShadingPoint;

/// The least that either cosine counts as where it is not zero.
pub const SLACK: f64 = 1.0 / 256.0;
/// The least factor.
pub const FLOOR: f64 = 1.0 / 1024.0;
/// Cosine by which a box may lie below the horizon.
pub const HORIZON: f64 = 1.0 / 1_048_576.0;

/// A set of lights as the formula sees it.
#[derive(Clone, Copy, Debug)]
pub struct Lights {
    pub phi: f64,
    /// From the point to the box's centre.
    pub v: Wide,
    pub half: Wide,
    pub axis: Wide,
    pub theta_o: f64,
}

impl Lights {
    pub fn of(b: &LightBounds, point: &ShadingPoint) -> Self {
        let (min, max) = (wide(b.min), wide(b.max));
        let center = [0, 1, 2].map(|k| (min[k] + max[k]) / 2.0);
        Self {
            phi: b.phi.into(),
            v: minus(center, wide(point.position())),
            half: times(minus(max, min), 0.5),
            axis: normalize(wide(b.axis)),
            theta_o: f64::from(b.cos_theta_o).clamp(-1.0, 1.0).acos(),
        }
    }

    pub fn d(&self) -> f64 {
        dot(self.v, self.v).sqrt()
    }

    pub fn r(&self) -> f64 {
        dot(self.half, self.half).sqrt()
    }

    /// Φ / (d² + r²/12).
    pub fn over_distance(&self) -> f64 {
        self.phi / (self.d().powi(2) + self.r().powi(2) / 12.0)
    }

    /// Cosine of the incident angle of the box's highest corner, at the centre's distance.
    pub fn height(&self, n: Wide) -> f64 {
        (dot(n, self.v) + top(self.half, n)) / self.d()
    }

    /// The receiver's factor: at least 2^-8 above the horizon, zero below it, one in a volume.
    pub fn incident(&self, n: Wide) -> f64 {
        if n == [0.0; 3] {
            1.0
        } else if self.height(n) < -HORIZON {
            0.0
        } else {
            self.height(n).clamp(SLACK, 1.0)
        }
    }

    /// cos θ', θ' = max(0, θ − θ_o − θ_u), and the slack.
    pub fn emitted(&self) -> f64 {
        let theta = (-dot(self.axis, self.v) / self.d()).clamp(-1.0, 1.0).acos();
        let theta_u = if self.r() < self.d() {
            (self.r() / self.d()).asin()
        } else {
            PI
        };
        (theta - self.theta_o - theta_u).max(0.0).cos() + SLACK
    }

    /// Both cosines' factor, where the emitters' cosine is off by `error`.
    pub fn factor(&self, n: Wide, error: f64) -> f64 {
        let emitted = (self.emitted() + error).clamp(0.0, 1.0 + SLACK);
        let reaches = self.emitted() > 0.0;
        (self.incident(n) * if reaches { emitted } else { 0.0 }).max(FLOOR)
    }

    /// Whether rounding decides: at the horizon, at 90° from the cone, and on the sphere around the box.
    pub fn at_a_step(&self, n: Wide, margin: f64) -> bool {
        let horizon = n != [0.0; 3] && (self.height(n) + HORIZON).abs() < 1e-5;
        horizon || self.emitted().abs() < margin || (self.d() / self.r() - 1.0).abs() < margin
    }
}

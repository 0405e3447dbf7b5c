//! Bounds of a set of lights: box, cone of normals, flux.

use glam::Vec3;

use crate::cone::Cone;
use crate::emission::MAX_SUM;
pub use crate::emission::{MAX_PHI, MIN_PHI};
use crate::exact;
use crate::vector::{max3, min3};

/// Bounds of the emission of a set of lights (Conty Estevez & Kulla 2018, section 4.1; pbrt-v4 `LightBounds`).
///
/// A set whose flux is zero cannot contribute: its box and cone mean nothing and are ignored by [`merge`](Self::merge).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightBounds {
    /// Least corner of the axis-aligned box, metres.
    pub min: Vec3,
    /// Greatest corner of the axis-aligned box, metres.
    pub max: Vec3,
    /// Unit axis of the cone that holds the normals.
    pub axis: Vec3,
    /// cos θ_o: the normals lie within θ_o of the axis; −1..=1.
    pub cos_theta_o: f32,
    /// Radiant flux Φ, W, weighted by luminance; zero, or from 2^-100 up to 2^126.
    pub phi: f32,
}

impl LightBounds {
    /// The bounds of no light at all.
    pub const EMPTY: Self = Self {
        min: Vec3::new(0.0, 0.0, 0.0),
        max: Vec3::new(0.0, 0.0, 0.0),
        axis: Cone::SPHERE.axis,
        cos_theta_o: 1.0,
        phi: 0.0,
    };

    /// Bounds of both sets: the union of the boxes, the smallest cone around the cones, the sum of the flux. The order
    /// of the arguments is part of the result's bits.
    #[inline]
    #[must_use]
    pub fn merge(&self, other: &Self) -> Self {
        let kept = if other.phi == 0.0 { *self } else { *other };
        let both = self.phi != 0.0 && other.phi != 0.0;
        let mut cone = self.cone();
        if both {
            cone = cone.union(other.cone());
        }
        Self {
            min: select3(both, min3(self.min, other.min), kept.min),
            max: select3(both, max3(self.max, other.max), kept.max),
            axis: select3(both, cone.axis, kept.axis),
            cos_theta_o: if both { cone.cos_theta_o } else { kept.cos_theta_o },
            phi: if both {
                exact::min(self.phi + other.phi, MAX_SUM)
            } else {
                kept.phi
            },
        }
    }

    /// The orientation cone.
    #[inline]
    #[must_use]
    pub fn cone(&self) -> Cone {
        Cone {
            axis: self.axis,
            cos_theta_o: self.cos_theta_o,
        }
    }
}

#[inline(always)]
fn select3(first: bool, a: Vec3, b: Vec3) -> Vec3 {
    Vec3::new(
        if first { a.x } else { b.x },
        if first { a.y } else { b.y },
        if first { a.z } else { b.z },
    )
}

/// Moments of the emission of a set of lights.
///
/// Standard deviations, not variances: the squares of the accepted lengths (2^-100 m to 2^41 m) leave the range of `f32`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightMoments {
    /// Radiant flux Φ, W, weighted by luminance; zero, or in 2^-100..=2^126.
    pub phi: f32,
    /// Flux-weighted centre, metres.
    pub c: Vec3,
    /// Standard deviation of position across the mean normal, per axis, metres.
    pub across: f32,
    /// Standard deviation of position along the mean normal, metres; equal to `across` where there is no such direction.
    pub along: f32,
    /// Flux-weighted mean of the unit normals; zero for lights that shine from both sides.
    pub m: Vec3,
    /// Half extents, about the centre, of a box around the lights, metres.
    pub h: Vec3,
}

impl LightMoments {
    /// No light at all.
    pub const EMPTY: Self = Self {
        phi: 0.0,
        c: Vec3::new(0.0, 0.0, 0.0),
        across: 0.0,
        along: 0.0,
        m: Vec3::new(0.0, 0.0, 0.0),
        h: Vec3::new(0.0, 0.0, 0.0),
    };
}

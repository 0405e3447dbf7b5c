//! What is known of a set of lights: where they are, which way they face, how much they emit.

use glam::Vec3;

use crate::cone::{Cone, normalized};
pub use crate::emission::{MAX_PHI, MIN_PHI};
use crate::emission::{MAX_SUM, flux};
use crate::exact::{self, pow2};
use crate::light::EmissiveTriangle;
use crate::vector::{dot, greatest_exponent, max3, min3};

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

    /// Bounds of one emissive triangle: its box, its normal, and Φ = π · area · luminance, twice that for two sides
    /// (a diffuse emitter: pbrt-v4 `DiffuseAreaLight::Phi`).
    ///
    /// The triangle has no flux when its luminance is zero, or when the `f32` cross product of its edges is below about 2^-100
    /// of its longest edge squared: that of every area so small is, and rounding can make it so from 2^-22 on.
    #[inline(always)]
    #[must_use]
    pub fn of_triangle(triangle: &EmissiveTriangle) -> Self {
        let (p0, p1, p2) = (triangle.vertex(0), triangle.vertex(1), triangle.vertex(2));
        let (e1, e2) = (p1 - p0, p2 - p0);

        // Scale the edges, then their cross product, to about 1 by powers of two, so that no product leaves the range.
        let (e1_scale, e2_scale) = (greatest_exponent(e1, -127), greatest_exponent(e2, -127));
        let edge_scale = if e1_scale > e2_scale { e1_scale } else { e2_scale };
        let to_one = pow2(-edge_scale);
        let emission = flux(e1 * to_one, e2 * to_one, edge_scale, triangle);
        let (n, across_scale) = (emission.normal, emission.exponent);

        // Rounding turns the normal by up to 2^-21 |e1||e2| / |e1 × e2| rad: 2^-24 for each edge, as much again for
        // products and difference, and some for safety. In a needle that may be any angle, so its cone is opened.
        let (a, b) = (e1 * pow2(-e1_scale), e2 * pow2(-e2_scale));
        let excess = e1_scale + e2_scale - (across_scale + edge_scale + edge_scale);
        let bounded = if excess < 40 { excess } else { 40 };
        let turn_squared = dot(a, a) * dot(b, b) * exact::recip(dot(n, n)) * pow2(bounded + bounded - 42);
        let any_normal = triangle.is_two_sided() || turn_squared > 0.015_625;

        Self {
            min: min3(p0, min3(p1, p2)),
            max: max3(p0, max3(p1, p2)),
            axis: normalized(n),
            cos_theta_o: if any_normal { -1.0 } else { 1.0 - turn_squared },
            phi: emission.phi,
        }
    }

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

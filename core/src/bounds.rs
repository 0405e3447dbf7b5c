//! What is known of a set of lights: where they are, which way they face, how much they emit.

use glam::Vec3;

use crate::cone::{Cone, normalized};
pub use crate::emission::{MAX_PHI, MIN_PHI};
use crate::emission::{MAX_SUM, flux};
use crate::exact::{self, pow2};
use crate::instance::Instance;
use crate::light::EmissiveTriangle;
use crate::summary::{Lanes, SUMMARY_WORDS, Summary, Triangles};
use crate::vector::{dot, greatest_exponent, length_squared, max3, min3};

/// A constant of its own: rust-gpu does not fold an expression of literals.
const TWELFTH: f32 = 1.0 / 12.0;

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
    /// cos θ_e: emission reaches up to θ_e from a normal; 0 for the diffuse emitters of this crate.
    pub cos_theta_e: f32,
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
        cos_theta_e: 0.0,
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
            cos_theta_e: 0.0,
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
            cos_theta_e: if both {
                exact::min(self.cos_theta_e, other.cos_theta_e)
            } else {
                kept.cos_theta_e
            },
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

impl Summary for LightBounds {
    const EMPTY: Self = Self::EMPTY;
    const NAMES: [&'static str; SUMMARY_WORDS] = [
        "least x",
        "least y",
        "least z",
        "greatest x",
        "greatest y",
        "greatest z",
        "axis x",
        "axis y",
        "axis z",
        "cos θ_o",
        "cos θ_e",
        "flux",
    ];

    #[inline(always)]
    fn of_triangle(triangle: &EmissiveTriangle) -> Self {
        Self::of_triangle(triangle)
    }

    #[inline(always)]
    fn of_triangles<const W: usize>(triangles: &Triangles<W>, summaries: &mut Lanes<W>) {
        for slot in 0..W {
            if triangles.present(slot) != 0 {
                summaries.set(slot, &Self::of_triangle(&triangles.get(slot)));
            } else {
                summaries.set(slot, &Self::EMPTY);
            }
        }
    }

    /// In slot order: the cone around cones depends on the order.
    #[inline(always)]
    fn merged<const W: usize>(children: &Lanes<W>) -> Self {
        let mut merged = Self::EMPTY;
        for slot in 0..W {
            merged = merged.merge(&children.get(slot));
        }
        merged
    }

    #[inline(always)]
    fn to_world(&self, instance: &Instance) -> Self {
        instance.bounds_to_world(self)
    }

    #[inline(always)]
    fn phi(&self) -> f32 {
        self.phi
    }

    #[inline(always)]
    fn center(&self) -> Vec3 {
        (self.min + self.max) * 0.5
    }

    /// That of points spread evenly over the box.
    #[inline(always)]
    fn spread(&self) -> f32 {
        let extent = self.max - self.min;
        length_squared(extent) * TWELFTH
    }

    #[inline(always)]
    fn bounds(&self) -> LightBounds {
        *self
    }

    fn uncontained(&self, child: &Self) -> Option<usize> {
        // Without flux a box and a cone mean nothing.
        if child.phi == 0.0 {
            return None;
        }
        let (outer, inner) = (self.to_words(), child.to_words());
        for k in 0..3 {
            if inner[k] < outer[k] {
                return Some(k);
            }
            if inner[3 + k] > outer[3 + k] {
                return Some(3 + k);
            }
        }
        if !self.cone().contains(child.cone()) {
            return Some(9);
        }
        if child.cos_theta_e < self.cos_theta_e {
            return Some(10);
        }
        (child.phi > self.phi).then_some(11)
    }

    #[inline(always)]
    fn to_words(&self) -> [f32; SUMMARY_WORDS] {
        let (lo, hi, a) = (self.min, self.max, self.axis);
        [
            lo.x,
            lo.y,
            lo.z,
            hi.x,
            hi.y,
            hi.z,
            a.x,
            a.y,
            a.z,
            self.cos_theta_o,
            self.cos_theta_e,
            self.phi,
        ]
    }

    #[inline(always)]
    fn from_words(words: &[f32; SUMMARY_WORDS]) -> Self {
        Self {
            min: Vec3::new(words[0], words[1], words[2]),
            max: Vec3::new(words[3], words[4], words[5]),
            axis: Vec3::new(words[6], words[7], words[8]),
            cos_theta_o: words[9],
            cos_theta_e: words[10],
            phi: words[11],
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

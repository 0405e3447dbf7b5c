//! Spheres that shine from their surface.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;

use super::record::{Each, Light, bounds, greatest, of_mesh_at_place, shining};
use super::round::circle;
use super::{INVALID, LightPoint};
use crate::bounds::{LightBounds, LightMoments};
use crate::cone::Cone;
use crate::domain::{DomainError, checked_emission, checked_place};
use crate::emission::{bounded_phi, luminance_of};
use crate::exact::{self, exponent, flush, pow2, significand};
use crate::instance::Instance;
use crate::vector::{flush3, greatest_exponent, length_squared, vector};

/// A sphere whose surface emits the same radiance in every direction outward.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct SphereLight {
    /// Its centre, metres, in the space of its mesh.
    pub p: [f32; 3],
    /// Its radius, metres: 2^-60 to 2^40. An instance that scales unevenly makes of it the sphere of the mean area.
    pub radius: f32,
    /// Radiance, W/(m² sr), linear RGB; zero or from 2^-100 to 2^100.
    pub radiance: [f32; 3],
    /// Index of the mesh light that owns it.
    pub mesh: u32,
}

/// Least and greatest radius, metres.
const RADII: [f32; 2] = [pow2(-60), pow2(40)];
/// Flux over luminance and squared radius: π of a unit of area, of which there are 4π.
const PER_SQUARE: f32 = 4.0 * core::f32::consts::PI * core::f32::consts::PI;
/// A constant of its own: rust-gpu does not fold an expression of literals.
const INV_TWO_PI: f32 = 1.0 / (2.0 * core::f32::consts::PI);
/// √(1/3): points of a sphere have a third of its squared radius as their variance along each axis.
const ROOT_THIRD: f32 = 0.577_350_26;

impl SphereLight {
    #[inline(always)]
    fn phi(&self) -> f32 {
        let luminance = luminance_of(&self.radiance);
        let r = significand(self.radius);
        let e = exponent(self.radius);
        let phi = bounded_phi(
            significand(luminance) * (r * r * PER_SQUARE),
            exponent(luminance) + e + e,
        );
        if luminance > 0.0 { phi } else { 0.0 }
    }
}

impl Light for SphereLight {
    const NAME: &'static str = "sphere";
    const DARK: Self = Self {
        p: [0.0; 3],
        radius: 1.0,
        radiance: [0.0; 3],
        mesh: INVALID,
    };

    of_mesh_at_place!();
    type Slots<const W: usize> = Each<Self, W>;

    fn checked(mut self) -> Result<Self, DomainError> {
        self.p = checked_place("centre of a sphere", self.p)?;
        self.radiance = checked_emission("radiance of a sphere", self.radiance)?;
        // NaN is in no range.
        if !(RADII[0]..=RADII[1]).contains(&self.radius) {
            let expected = "2^-60 to 2^40 m; make it a point light, or leave it out";
            return Err(DomainError::number(
                "the radius of a sphere",
                self.radius,
                expected,
            ));
        }
        Ok(self)
    }

    fn reach(&self) -> f32 {
        exact::min(greatest(&self.p) + self.radius, super::MAX_COORDINATE)
    }

    #[inline(always)]
    fn has_flux(&self) -> bool {
        luminance_of(&self.radiance) > 0.0
    }

    #[inline(always)]
    fn bounds(&self) -> LightBounds {
        let r = self.radius;
        bounds(&self.p, Vec3::new(r, r, r), Cone::SPHERE, self.phi())
    }

    #[inline(always)]
    fn moments(&self) -> LightMoments {
        let r = self.radius;
        let deviation = r * ROOT_THIRD;
        LightMoments {
            phi: self.phi(),
            c: vector(&self.p),
            across: deviation,
            along: deviation,
            m: Vec3::new(0.0, 0.0, 0.0),
            h: Vec3::new(r, r, r),
        }
    }

    #[inline(always)]
    fn in_world(&self, instance: &Instance, index: u32) -> Self {
        Self {
            p: instance.vertex(self.p),
            radius: exact::clamp(self.radius * instance.scale(), RADII[0], RADII[1]),
            radiance: shining(&self.radiance, &instance.radiance, self.has_flux()),
            mesh: index,
        }
    }

    /// Evenly over the cap that the receiver sees: from within the sphere there is none.
    #[inline(always)]
    fn point_for(&self, from: Vec3, uv: [f32; 2]) -> LightPoint {
        let away = from - vector(&self.p);
        let e = greatest_exponent(away, exponent(self.radius));
        let d = flush3(away * pow2(-e), pow2(-60));
        let r = flush(self.radius * pow2(-e), pow2(-60));
        let squared = exact::max(length_squared(d), pow2(-60));
        let distance = exact::sqrt(squared);
        // 1 less the cosine r / d of the cap, which a difference of cosines close to 1 would lose.
        let gap = exact::div(squared - r * r, distance * (distance + r));
        let sees = gap > pow2(-24);
        let gap = if sees { gap } else { 1.0 };
        let axis = d * exact::div(1.0, distance);
        let below = flush(uv[0] * gap, pow2(-60));
        let ring = exact::sqrt(below * (2.0 - below));
        let [cos, sin] = circle(uv[1]);
        let [s, t] = basis(axis);
        let n = flush3(
            (s * (ring * cos) + t * (ring * sin)) + axis * (1.0 - below),
            pow2(-60),
        );
        let p = vector(&self.p) + n * self.radius;
        let own = significand(self.radius);
        let exponent = exponent(self.radius);
        let density = exact::div(INV_TWO_PI, own * own * gap) * pow2(-(exponent + exponent));
        LightPoint::on_surface((p, n), sees, density, 0, self.radiance)
    }

    #[inline(always)]
    fn point_at(&self, from: Vec3, p: Vec3) -> LightPoint {
        let away = p - vector(&self.p);
        let e = greatest_exponent(away, exponent(self.radius));
        let d = flush3(away * pow2(-e), pow2(-60));
        let n = d * exact::rsqrt(exact::max(length_squared(d), pow2(-60)));
        LightPoint {
            p: [p.x, p.y, p.z],
            normal: [n.x, n.y, n.z],
            ..self.point_for(from, [0.5; 2])
        }
    }
}

/// Two unit vectors across a unit vector (T. Duff et al., "Building an orthonormal basis, revisited", JCGT 6(1), 2017).
#[inline(always)]
fn basis(n: Vec3) -> [Vec3; 2] {
    let sign = if n.z < 0.0 { -1.0 } else { 1.0 };
    let a = -exact::div(1.0, sign + n.z);
    let b = flush(n.x * n.y, pow2(-60)) * a;
    [
        Vec3::new(
            1.0 + sign * (flush(n.x * n.x, pow2(-60)) * a),
            sign * b,
            -(sign * n.x),
        ),
        Vec3::new(b, sign + flush(n.y * n.y, pow2(-60)) * a, -n.y),
    ]
}

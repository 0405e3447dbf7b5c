//! Boxes that shine from within.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;

use super::punctual::FOUR_PI;
use super::record::{Each, Light, bounds, greatest, of_mesh_at_place, shining};
use super::{INVALID, LightPoint, MIN_OFFSET};
use crate::bounds::{LightBounds, LightMoments};
use crate::cone::Cone;
use crate::domain::{DomainError, checked_emission, checked_place};
use crate::emission::{bounded_phi, luminance_of};
use crate::exact::{self, exponent, hash, pow2, significand, unit_f32};
use crate::instance::Instance;
use crate::vector::{abs3, cross, dot, flush3, greatest_exponent, max3, vector};

/// A box of glowing matter, which sends the same light from every place within it in every direction: fire, plasma. A parallelepiped
/// where its half axes are not square to each other. Volume 0 has no flux.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct BoxLight {
    /// Its centre, metres, in the space of its mesh.
    pub p: [f32; 3],
    /// From the centre to the middles of three sides that meet, metres.
    pub half: [[f32; 3]; 3],
    /// Radiance that a metre of it adds, W/(m³ sr), linear RGB; zero or from 2^-100 to 2^100.
    pub radiance: [f32; 3],
    /// Index of the mesh light that owns it.
    pub mesh: u32,
}

/// Volume over the determinant of the half axes, and its inverse.
const EIGHT: f32 = 8.0;
const EIGHTH: f32 = 0.125;
/// Constants of their own: rust-gpu does not fold an expression of literals.
const NINTH: f32 = 1.0 / 9.0;
/// The least determinant of axes of about 1: below it a box has no volume.
const FLAT: f32 = pow2(-60);

/// The axes by a power of two, and their determinant.
struct Scaled {
    axes: [Vec3; 3],
    e: i32,
    determinant: f32,
}

impl BoxLight {
    #[inline(always)]
    fn axes(&self) -> [Vec3; 3] {
        [
            vector(&self.half[0]),
            vector(&self.half[1]),
            vector(&self.half[2]),
        ]
    }

    #[inline(always)]
    fn half(&self) -> Vec3 {
        let [a, b, c] = self.axes();
        (abs3(a) + abs3(b)) + abs3(c)
    }

    #[inline(always)]
    fn scaled(&self) -> Scaled {
        let [a, b, c] = self.axes();
        let e = greatest_exponent(max3(abs3(a), max3(abs3(b), abs3(c))), -100);
        let to_one = exact::power(-e);
        let (a, b, c) = (
            flush3(a * to_one, pow2(-60)),
            flush3(b * to_one, pow2(-60)),
            flush3(c * to_one, pow2(-60)),
        );
        let across = flush3(cross(a, b), pow2(-60));
        Scaled {
            axes: [a, b, c],
            e,
            determinant: exact::abs(dot(across, c)),
        }
    }

    #[inline(always)]
    fn phi(&self) -> f32 {
        let own = self.scaled();
        let luminance = luminance_of(&self.radiance);
        let some = exact::max(own.determinant, FLAT);
        let shine = significand(luminance) * (significand(some) * (EIGHT * FOUR_PI));
        let phi = bounded_phi(shine, exponent(luminance) + exponent(some) + 3 * own.e);
        if (luminance > 0.0) & (own.determinant > FLAT) {
            phi
        } else {
            0.0
        }
    }
}

impl Light for BoxLight {
    const NAME: &'static str = "box";
    const DARK: Self = Self {
        p: [0.0; 3],
        half: [[0.0; 3]; 3],
        radiance: [0.0; 3],
        mesh: INVALID,
    };

    of_mesh_at_place!();
    const FLUX_POWER: u32 = 3;
    type Slots<const W: usize> = Each<Self, W>;

    fn checked(mut self) -> Result<Self, DomainError> {
        self.p = checked_place("centre of a box", self.p)?;
        for k in 0..3 {
            self.half[k] = checked_place("half axis of a box", self.half[k])?;
        }
        self.radiance = checked_emission("radiance of a box", self.radiance)?;
        Ok(self)
    }

    fn reach(&self) -> f32 {
        let edges = (greatest(&self.half[0]) + greatest(&self.half[1])) + greatest(&self.half[2]);
        exact::min(greatest(&self.p) + edges, super::MAX_COORDINATE)
    }

    #[inline(always)]
    fn has_flux(&self) -> bool {
        (luminance_of(&self.radiance) > 0.0) & (self.scaled().determinant > FLAT)
    }

    #[inline(always)]
    fn bounds(&self) -> LightBounds {
        bounds(&self.p, self.half(), Cone::SPHERE, self.phi())
    }

    #[inline(always)]
    fn moments(&self) -> LightMoments {
        let own = self.scaled();
        let [a, b, c] = own.axes;
        let sum = (dot(a, a) + dot(b, b)) + dot(c, c);
        let deviation = exact::sqrt(sum * NINTH) * exact::power(own.e);
        LightMoments {
            phi: self.phi(),
            c: vector(&self.p),
            across: deviation,
            along: deviation,
            m: Vec3::new(0.0, 0.0, 0.0),
            h: self.half(),
        }
    }

    #[inline(always)]
    fn in_world(&self, instance: &Instance, index: u32) -> Self {
        let edge = |axis: Vec3| {
            let v = instance.edge_to_world(axis);
            [v.x, v.y, v.z]
        };
        let [a, b, c] = self.axes();
        Self {
            p: instance.vertex(self.p),
            half: [edge(a), edge(b), edge(c)],
            radiance: shining(&self.radiance, &instance.radiance, self.has_flux()),
            mesh: index,
        }
    }

    /// Evenly over the volume: a hash of both numbers gives the third coordinate, so that both stay stratified.
    #[inline(always)]
    fn point_for(&self, _from: Vec3, uv: [f32; 2]) -> LightPoint {
        let own = self.scaled();
        let has_volume = own.determinant > FLAT;
        let some = exact::max(own.determinant, FLAT);
        let density = exact::div(EIGHTH, significand(some));
        let e = -(exponent(some) + 3 * own.e);
        let e = if e > 120 {
            120
        } else if e < -120 {
            -120
        } else {
            e
        };
        let third = unit_f32(hash(uv[0].to_bits() ^ hash(uv[1].to_bits())));
        let along = |axis: Vec3, u: f32| flush3(axis * (2.0 * u - 1.0), MIN_OFFSET);
        let [a, b, c] = self.axes();
        let p = vector(&self.p) + ((along(a, uv[0]) + along(b, uv[1])) + along(c, third));
        let (n, flags) = (Vec3::ZERO, LightPoint::IS_VOLUME);
        LightPoint::on_surface((p, n), has_volume, density * pow2(e), flags, self.radiance)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thin_boxes_have_flux_as_long_as_they_have_volume() {
        let thin = |k: i32| BoxLight {
            p: [0.0; 3],
            half: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, pow2(-k)]],
            radiance: [1.0; 3],
            mesh: 0,
        };
        for k in [0, 10, 30, 59] {
            let expected = 32.0 * core::f64::consts::PI * 2.0_f64.powi(-k);
            let phi = f64::from(thin(k).moments().phi);
            assert!(
                (phi / expected - 1.0).abs() < 1e-6,
                "2^-{k}: {phi:e}, expected {expected:e}"
            );
        }
        assert!(!thin(61).has_flux());
        assert_eq!(thin(61).moments().phi, 0.0);
    }
}

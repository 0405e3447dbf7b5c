//! Points whose intensity is measured, direction by direction.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;

use super::punctual::{PER_MEAN_DIRECTION, TWO_PI, at, moments, phi, phi_per_intensity, within_cone};
use super::record::{Each, Light, bounds, checked_axis, of_mesh_at_place, shining, towards};
use super::{INVALID, LightPoint};
use crate::beam::Beam;
use crate::bounds::{LightBounds, LightMoments};
use crate::cone::Cone;
use crate::domain::{DomainError, NORMAL_TOLERANCE, checked_emission, checked_place};
use crate::emission::luminance_of;
use crate::exact::{self, pow2};
use crate::instance::Instance;
use crate::vector::{cross, dot, flush3, length_squared, vector};

/// A point with a photometric profile: what it sends in each direction is its greatest intensity times what a table says there, as IES files
/// (ANSI/IES LM-63) have one. The table is the engine's; a tree needs three numbers of it, its integral, its mean cosine, and its cone.
///
/// [`point_for`](Light::point_for) has the greatest intensity wherever the cone reaches. What arrives is that times the table at
/// [`coordinates`](Self::coordinates), by which the reference renderer reads it from a picture.
///
/// An instance turns its axes, and leaves its table as it is; one that mirrors mirrors it.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct ProfileLight {
    /// Where it is, metres.
    pub p: [f32; 3],
    /// Greatest radiant intensity, W/sr, linear RGB; zero or from 2^-100 to 2^100.
    pub intensity: [f32; 3],
    /// Unit direction of the table's axis: vertical angle 0.
    pub axis: [f32; 3],
    /// Unit direction across it at which the table's horizontal angle is 0. From there the angle grows towards `across × axis`.
    pub across: [f32; 3],
    /// Cosine of the angle from the axis beyond which the table is zero; −1 up to 1 − 2^-20.
    pub cos_outer: f32,
    /// Integral of the table, relative to its greatest number, over all directions, over 2π: 0, or from 2^-40 up to 2, which is a table of ones.
    pub whole: f32,
    /// Mean of the cosine to the axis over that: `cos_outer` up to 1.
    pub mean_cosine: f32,
    /// Index of the mesh light that owns it.
    pub mesh: u32,
    /// [`MIRRORED`](Self::MIRRORED) or 0.
    pub flags: u32,
}

const _: () = assert!(size_of::<ProfileLight>() == 68);

/// Squared length below which a direction across an axis is none.
const LEAST_ACROSS: f32 = pow2(-20);

impl ProfileLight {
    /// Bit of [`flags`](Self::flags): the horizontal angle grows the other way.
    pub const MIRRORED: u32 = 2;

    /// Where a picture of the table, an unfolded octahedron with the axis in the middle ([`place_of`], halved and moved to 0..=1), has the
    /// direction from the light to `from`.
    #[inline(always)]
    #[must_use]
    pub fn coordinates(&self, from: Vec3) -> [f32; 2] {
        let d = towards(vector(&self.p), from);
        let third = cross(vector(&self.across), vector(&self.axis));
        let along = dot(d, third);
        let turned = if self.flags & Self::MIRRORED != 0 {
            -along
        } else {
            along
        };
        let local = flush3(
            Vec3::new(dot(d, vector(&self.across)), dot(d, vector(&self.axis)), turned),
            pow2(-30),
        );
        // Where the light is, no direction is better than another.
        let is_there = length_squared(local) < 0.25;
        let [u, v] = place_of([local.x, if is_there { 1.0 } else { local.y }, local.z]);
        [u * 0.5 + 0.5, v * 0.5 + 0.5]
    }
}

impl Light for ProfileLight {
    const NAME: &'static str = "light with a profile";
    const DARK: Self = Self {
        p: [0.0; 3],
        intensity: [0.0; 3],
        axis: [0.0, 0.0, 1.0],
        across: [1.0, 0.0, 0.0],
        cos_outer: -1.0,
        whole: 0.0,
        mean_cosine: 0.0,
        mesh: INVALID,
        flags: 0,
    };

    of_mesh_at_place!();
    const FLUX_POWER: u32 = 0;
    type Slots<const W: usize> = Each<Self, W>;

    fn checked(mut self) -> Result<Self, DomainError> {
        self.p = checked_place("light with a profile", self.p)?;
        self.intensity = checked_emission("intensity of a light with a profile", self.intensity)?;
        self.axis = checked_axis(self.axis)?;
        self.across = checked_axis(self.across)?;
        if exact::abs(dot(vector(&self.axis), vector(&self.across))) > NORMAL_TOLERANCE {
            let expected = "a direction at right angles to the axis; subtract its part along the axis";
            return Err(DomainError::vector(
                "the direction across a profile",
                self.across,
                expected,
            ));
        }
        let (outer, whole, mean) = (self.cos_outer, self.whole, self.mean_cosine);
        let refused = |what, found, expected| Err(DomainError::number(what, found, expected));
        if !(-1.0..=1.0 - pow2(-20)).contains(&outer) {
            let expected = "-1 up to 1 - 2^-20; compute it from the table";
            return refused("the cosine of a profile's cone", outer, expected);
        }
        if whole != 0.0 && !(pow2(-40)..=2.0).contains(&whole) {
            let expected = "0 or a number from 2^-40 to 2; compute it from the table";
            return refused("the integral of a profile", whole, expected);
        }
        if !(-1.0..=1.0).contains(&mean) || (mean < outer && whole != 0.0) {
            let expected = "the cosine of its cone up to 1; compute it from the table";
            return refused("the mean cosine of a profile", mean, expected);
        }
        if self.flags & !Self::MIRRORED != 0 {
            return Err(DomainError::bits(
                "the word of flags",
                self.flags,
                "0 or MIRRORED (2); clear the other bits",
            ));
        }
        Ok(self)
    }

    fn reach(&self) -> f32 {
        super::record::greatest(&self.p)
    }

    #[inline(always)]
    fn has_flux(&self) -> bool {
        luminance_of(&self.intensity) > 0.0 && self.whole > 0.0
    }

    #[inline(always)]
    fn beam(&self) -> Beam {
        Beam::of_cone(vector(&self.p), vector(&self.axis), self.cos_outer)
    }

    #[inline(always)]
    fn bounds(&self) -> LightBounds {
        let cone = Cone {
            axis: vector(&self.axis),
            cos_theta_o: 1.0,
        };
        let within = self.cos_outer >= 0.0;
        bounds(
            &self.p,
            Vec3::ZERO,
            if within { cone } else { Cone::SPHERE },
            self.moments().phi,
        )
    }

    /// As of a [`SpotLight`](super::SpotLight).
    #[inline(always)]
    fn moments(&self) -> LightMoments {
        let shines = self.whole > 0.0;
        let per_intensity = phi_per_intensity(TWO_PI * if shines { self.whole } else { 1.0 });
        let own = phi(&self.intensity, per_intensity);
        let length = exact::clamp(PER_MEAN_DIRECTION * self.mean_cosine, -1.0, 1.0);
        let m = flush3(vector(&self.axis) * exact::flush(length, pow2(-30)), pow2(-60));
        moments(&self.p, if shines { own } else { 0.0 }, m)
    }

    #[inline(always)]
    fn in_world(&self, instance: &Instance, index: u32) -> Self {
        let axis = instance.direction_to_world(vector(&self.axis));
        let turned = instance.direction_to_world(vector(&self.across));
        // Across again, which a map that shears does not leave it.
        let off = flush3(turned - axis * dot(turned, axis), pow2(-30));
        let squared = length_squared(off);
        let across = off * exact::rsqrt(exact::max(squared, LEAST_ACROSS));
        let other = if exact::abs(axis.x) < 0.5 {
            Vec3::new(1.0, 0.0, 0.0)
        } else {
            Vec3::new(0.0, 1.0, 0.0)
        };
        let any = flush3(cross(axis, other), pow2(-30));
        let any = any * exact::rsqrt(exact::max(length_squared(any), LEAST_ACROSS));
        let is_kept = squared > LEAST_ACROSS;
        Self {
            p: instance.vertex(self.p),
            intensity: shining(&self.intensity, &instance.radiance, self.has_flux()),
            axis: [axis.x, axis.y, axis.z],
            across: [
                if is_kept { across.x } else { any.x },
                if is_kept { across.y } else { any.y },
                if is_kept { across.z } else { any.z },
            ],
            mesh: index,
            flags: if instance.mirrors() {
                self.flags ^ Self::MIRRORED
            } else {
                self.flags
            },
            ..*self
        }
    }

    #[inline(always)]
    fn point_for(&self, from: Vec3, _uv: [f32; 2]) -> LightPoint {
        let within = within_cone(vector(&self.axis), self.cos_outer, towards(vector(&self.p), from));
        let [r, g, b] = self.intensity;
        at(&self.p, if within { [r, g, b] } else { [0.0; 3] })
    }
}

/// `a` with the sign of `b`, + of zero.
#[inline(always)]
fn signed(a: f32, b: f32) -> f32 {
    if b < 0.0 { -a } else { a }
}

/// The point of the octahedron at a place, each coordinate from −1 to 1: the sphere projected onto an octahedron and unfolded, its pole y
/// in the middle (Engelhardt and Dachsbacher, *Octahedron environment maps*, 2008).
#[inline(always)]
fn on_octahedron(u: f32, v: f32) -> Vec3 {
    let (a, b) = (exact::abs(u), exact::abs(v));
    let y = 1.0 - (a + b);
    if y < 0.0 {
        Vec3::new(signed(1.0 - b, u), y, signed(1.0 - a, v))
    } else {
        Vec3::new(u, y, v)
    }
}

/// The unit direction at a place, each coordinate from −1 to 1.
#[inline]
#[must_use]
pub fn direction_at(place: [f32; 2]) -> [f32; 3] {
    let p = on_octahedron(place[0], place[1]);
    // Rounded correctly: the length is 1 as nearly as words tell.
    let length = exact::sqrt(length_squared(p));
    [
        exact::div(p.x, length),
        exact::div(p.y, length),
        exact::div(p.z, length),
    ]
}

/// The place of a direction, which need not be of length 1: any but zero, of magnitudes from 2^-40 to 2^40. Undoes
/// [`direction_at`] up to rounding.
#[inline]
#[must_use]
pub fn place_of(direction: [f32; 3]) -> [f32; 2] {
    let [x, y, z] = direction;
    let sum = (exact::abs(x) + exact::abs(z)) + exact::abs(y);
    let (u, v) = (exact::div(x, sum), exact::div(z, sum));
    if y < 0.0 {
        [signed(1.0 - exact::abs(v), u), signed(1.0 - exact::abs(u), v)]
    } else {
        [u, v]
    }
}

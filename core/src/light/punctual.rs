//! Lights without size: points, and spots with a cone.

use bytemuck::{Pod, Zeroable};
#[cfg(feature = "alloc")]
use glam::Vec2;
use glam::Vec3;

use super::record::{Each, Light, bounds, checked_axis, of_mesh_at_place, shining, towards};
use super::{INVALID, LightPoint, MAX_COORDINATE, MIN_RADIANCE};
use crate::beam::{Beam, Limits};
use crate::bounds::{LightBounds, LightMoments};
use crate::cone::Cone;
use crate::domain::{DomainError, checked_emission, checked_place};
use crate::emission::{bounded_phi, luminance_of};
use crate::exact::{self, exponent, pow2, significand};
use crate::instance::Instance;
use crate::vector::{flush3, length_squared, vector};

/// A point that sends the same intensity in every direction. An instance that scales leaves it as it is, and its range.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct PointLight {
    /// Where it is, metres, in the space of its mesh; as a vertex of an [`EmissiveTriangle`](super::EmissiveTriangle).
    pub p: [f32; 3],
    /// Radiant intensity, W/sr, linear RGB; zero or from 2^-100 to 2^100.
    pub intensity: [f32; 3],
    /// Metres from which on nothing arrives, 2^-20 to 2^40: on the way intensity falls by 1 − (d / range)⁴ (glTF 2.0, `KHR_lights_punctual`, "Range Property"). 0 for a
    /// light that arrives everywhere. Nodes with beams know it ([`SpotMomentNode`](crate::node::SpotMomentNode)).
    pub range: f32,
    /// Index of the mesh light that owns it.
    pub mesh: u32,
}

/// A point that sends light into a cone: all its intensity up to an inner angle, none from an outer one on, between them the square of
/// what is linear in the cosine (glTF 2.0, `KHR_lights_punctual`, "Inner and Outer Cone Angles"). An instance turns the axis and keeps the cone. Trees weight narrow spots above their flux, by what points in
/// the cone receive.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct SpotLight {
    /// Where it is, metres.
    pub p: [f32; 3],
    /// Radiant intensity along the axis, W/sr, linear RGB; zero or from 2^-100 to 2^100.
    pub intensity: [f32; 3],
    /// Unit direction in which it shines.
    pub axis: [f32; 3],
    /// Cosine of the angle up to which it has its intensity; −1 to 1, not below `cos_outer`.
    pub cos_inner: f32,
    /// Cosine of the angle from which on it has none; −1 up to 1 − 2^-20.
    pub cos_outer: f32,
    /// Metres from which on nothing arrives, or 0; as of a [`PointLight`].
    pub range: f32,
    /// Index of the mesh light that owns it.
    pub mesh: u32,
}

/// Least difference of the two cosines that the intensity falls over: a sharp edge is one as wide.
const LEAST_FALL: f32 = pow2(-20);
/// Full solid angle over the greatest power of two in it, and its exponent.
const FOUR_PI: f32 = 4.0 * core::f32::consts::PI;
const TWO_PI: f32 = 2.0 * core::f32::consts::PI;
/// Constants of their own: rust-gpu does not fold an expression of literals.
const THIRD: f32 = 1.0 / 3.0;
/// The length of the mean direction of a diffuse emitter is 2/3; a mean normal is that over it.
const PER_MEAN_DIRECTION: f32 = 1.5;

/// Moments of a light without size.
#[inline(always)]
fn moments(p: &[f32; 3], phi: f32, m: Vec3) -> LightMoments {
    LightMoments {
        phi,
        c: vector(p),
        across: 0.0,
        along: 0.0,
        m,
        h: Vec3::new(0.0, 0.0, 0.0),
    }
}

/// `per_intensity` times the luminance of an intensity, W.
#[inline(always)]
fn phi(intensity: &[f32; 3], per_intensity: f32) -> f32 {
    let luminance = luminance_of(intensity);
    let phi = bounded_phi(significand(luminance) * per_intensity, exponent(luminance));
    if luminance > 0.0 { phi } else { 0.0 }
}

/// The part of its intensity that a light at `p` with this range has at `from`.
#[inline(always)]
fn window(p: &[f32; 3], range: f32, from: Vec3) -> f32 {
    let has_range = range > 0.0;
    let per_range = exact::div(1.0, if has_range { range } else { 1.0 });
    let near = |x: f32| exact::clamp(x * per_range, -2.0, 2.0);
    let (x, y, z) = (near(from.x - p[0]), near(from.y - p[1]), near(from.z - p[2]));
    let squared = length_squared(flush3(Vec3::new(x, y, z), pow2(-30)));
    let left = exact::max(1.0 - squared * squared, 0.0);
    if has_range { left } else { 1.0 }
}

/// The [`Light::end`] of a light with this range.
#[inline(always)]
fn end(range: f32) -> f32 {
    if range > 0.0 { range } else { Limits::ENDLESS }
}

/// A range that is one, 0 among them.
fn checked_range(range: f32) -> Result<f32, DomainError> {
    // NaN is in no range.
    if range == 0.0 || (pow2(-20)..=MAX_COORDINATE).contains(&range) {
        // Of the two zeros the positive one.
        Ok(if range == 0.0 { 0.0 } else { range })
    } else {
        let expected = "0 for none, or 2^-20 to 2^40 metres; leave it out, or turn the light off";
        Err(DomainError::number("the range of a light", range, expected))
    }
}

#[inline(always)]
fn at(p: &[f32; 3], intensity: [f32; 3]) -> LightPoint {
    LightPoint {
        p: *p,
        density: 1.0,
        normal: [0.0; 3],
        flags: LightPoint::IS_POINT,
        radiance: intensity,
    }
}

impl Light for PointLight {
    const NAME: &'static str = "point light";
    const DARK: Self = Self {
        p: [0.0; 3],
        intensity: [0.0; 3],
        range: 0.0,
        mesh: INVALID,
    };

    of_mesh_at_place!();
    type Slots<const W: usize> = Each<Self, W>;

    fn checked(mut self) -> Result<Self, DomainError> {
        self.p = checked_place("point light", self.p)?;
        self.intensity = checked_emission("intensity of a point light", self.intensity)?;
        self.range = checked_range(self.range)?;
        Ok(self)
    }

    fn reach(&self) -> f32 {
        super::record::greatest(&self.p)
    }

    #[inline(always)]
    fn has_flux(&self) -> bool {
        luminance_of(&self.intensity) > 0.0
    }

    #[inline(always)]
    fn is_surface(&self) -> bool {
        false
    }

    #[inline(always)]
    fn end(&self) -> f32 {
        end(self.range)
    }

    #[inline(always)]
    fn bounds(&self) -> LightBounds {
        bounds(&self.p, Vec3::ZERO, Cone::SPHERE, phi(&self.intensity, FOUR_PI))
    }

    #[inline(always)]
    fn moments(&self) -> LightMoments {
        moments(&self.p, phi(&self.intensity, FOUR_PI), Vec3::new(0.0, 0.0, 0.0))
    }

    #[inline(always)]
    fn in_world(&self, instance: &Instance, index: u32) -> Self {
        Self {
            p: instance.vertex(self.p),
            intensity: shining(&self.intensity, &instance.radiance, self.has_flux()),
            mesh: index,
            ..*self
        }
    }

    #[inline(always)]
    fn point_for(&self, from: Vec3, _uv: [f32; 2]) -> LightPoint {
        let left = window(&self.p, self.range, from);
        let [r, g, b] = self.intensity;
        at(&self.p, [r * left, g * left, b * left])
    }
}

impl SpotLight {
    /// The same with all its intensity up to `inner` from its axis, and none from `outer` on: angles in radians, 0 ≤ `inner` ≤ `outer` ≤ π.
    /// A light with others, such as degrees, is refused where it is added.
    #[cfg(feature = "alloc")]
    #[must_use]
    pub fn with_cone(self, inner: f32, outer: f32) -> Self {
        // NaN is no cosine.
        let cosine = |angle: f32| match (0.0..=core::f32::consts::PI).contains(&angle) {
            true => Vec2::from_angle(angle).x,
            false => f32::NAN,
        };
        let outer_cosine = cosine(outer);
        let cos_outer = if outer_cosine > 1.0 - LEAST_FALL {
            1.0 - LEAST_FALL
        } else {
            outer_cosine
        };
        Self {
            // Angles that hardly differ may have cosines in the other order.
            cos_inner: if inner == outer { cos_outer } else { cosine(inner) },
            cos_outer,
            ..self
        }
    }

    /// Intensity in a direction, of length 1 up to 2^-16, over that along the axis.
    #[inline(always)]
    #[must_use]
    fn falloff(&self, direction: Vec3) -> f32 {
        // 1 less the cosine: cosines of a narrow cone have no digits for it, nor lengths that are nearly 1.
        let gap = 0.5 * length_squared(flush3(direction - vector(&self.axis), pow2(-40)));
        let linear = exact::clamp(exact::div((1.0 - self.cos_outer) - gap, self.fall()), 0.0, 1.0);
        // What a device flushes is cut here.
        exact::flush(linear * linear, pow2(-60))
    }

    /// Cosines that the intensity falls over.
    #[inline(always)]
    fn fall(&self) -> f32 {
        exact::max(self.cos_inner - self.cos_outer, LEAST_FALL)
    }

    /// Integrals of the falloff over all directions, and of the falloff times the cosine, both over 2π.
    #[inline(always)]
    fn integrals(&self) -> [f32; 2] {
        let (outer, fall) = (self.cos_outer, self.fall());
        let inner = outer + fall;
        let whole = (1.0 - inner) + fall * THIRD;
        let first = 0.5 * ((1.0 - inner) * (1.0 + inner)) + fall * (outer * THIRD + 0.25 * fall);
        [whole, first]
    }

    /// What a tree takes for its flux, W. Most nodes know no narrow cone, so whether a point lies in it cannot be told; the choice with the
    /// least variance over all points is then by the root mean square of what they get. That is the geometric mean of the flux and of that
    /// of a diffuse emitter as bright along its axis, π times the intensity, where the flux is less. Nodes with beams take it from there.
    #[inline(always)]
    fn phi(&self) -> f32 {
        let flux = TWO_PI * self.integrals()[0];
        phi(
            &self.intensity,
            exact::max(flux, exact::sqrt(flux * core::f32::consts::PI)),
        )
    }
}

impl Light for SpotLight {
    const NAME: &'static str = "spot";
    const DARK: Self = Self {
        p: [0.0; 3],
        intensity: [0.0; 3],
        axis: [0.0, 0.0, 1.0],
        cos_inner: 1.0,
        cos_outer: -1.0,
        range: 0.0,
        mesh: INVALID,
    };

    of_mesh_at_place!();
    type Slots<const W: usize> = Each<Self, W>;

    fn checked(mut self) -> Result<Self, DomainError> {
        self.p = checked_place("spot", self.p)?;
        self.intensity = checked_emission("intensity of a spot", self.intensity)?;
        self.range = checked_range(self.range)?;
        self.axis = checked_axis(self.axis)?;
        let (inner, outer) = (self.cos_inner, self.cos_outer);
        // NaN is in no range.
        if !(-1.0..=1.0 - pow2(-20)).contains(&outer) {
            let expected = "-1 up to 1 - 2^-20, the cosine of an angle of at most pi radians";
            return Err(DomainError::number("the outer cosine of a spot", outer, expected));
        }
        if !(-1.0..=1.0).contains(&inner) {
            let expected = "-1 to 1, the cosine of an angle of at most pi radians";
            return Err(DomainError::number("the inner cosine of a spot", inner, expected));
        }
        if inner < outer {
            let expected = "the outer cosine or more; swap the angles";
            return Err(DomainError::number("the inner cosine of a spot", inner, expected));
        }
        Ok(self)
    }

    fn reach(&self) -> f32 {
        super::record::greatest(&self.p)
    }

    #[inline(always)]
    fn has_flux(&self) -> bool {
        luminance_of(&self.intensity) > 0.0
    }

    #[inline(always)]
    fn is_surface(&self) -> bool {
        false
    }

    #[inline(always)]
    fn end(&self) -> f32 {
        end(self.range)
    }

    /// Anywhere from 90° on.
    #[inline(always)]
    fn beam(&self) -> Beam {
        if self.cos_outer > 0.0 {
            Beam {
                axis: vector(&self.axis),
                cos_theta_e: self.cos_outer,
                c: vector(&self.p),
                radius: 0.0,
            }
        } else {
            Beam::ANYWHERE
        }
    }

    /// A cone of normals that is one direction, where half the sphere about it holds all that the spot sends.
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
            self.phi(),
        )
    }

    /// A diffuse emitter's mean direction is 2/3 of its normal: the mean normal is 3/2 of the spot's mean direction, at most of length 1.
    #[inline(always)]
    fn moments(&self) -> LightMoments {
        let [whole, first] = self.integrals();
        let length = exact::min(PER_MEAN_DIRECTION * exact::div(first, whole), 1.0);
        let length = exact::flush(exact::max(length, 0.0), pow2(-30));
        moments(&self.p, self.phi(), vector(&self.axis) * length)
    }

    #[inline(always)]
    fn in_world(&self, instance: &Instance, index: u32) -> Self {
        let axis = instance.direction_to_world(vector(&self.axis));
        Self {
            p: instance.vertex(self.p),
            intensity: shining(&self.intensity, &instance.radiance, self.has_flux()),
            axis: [axis.x, axis.y, axis.z],
            mesh: index,
            ..*self
        }
    }

    #[inline(always)]
    fn point_for(&self, from: Vec3, _uv: [f32; 2]) -> LightPoint {
        let direction = towards(vector(&self.p), from);
        let left = window(&self.p, self.range, from);
        let falloff = exact::flush(self.falloff(direction) * left, pow2(-60));
        let [r, g, b] = self.intensity;
        // Devices flush subnormal products of the least intensities and the least parts of them.
        let least = |x: f32| exact::flush(x * falloff, MIN_RADIANCE);
        at(&self.p, [least(r), least(g), least(b)])
    }
}

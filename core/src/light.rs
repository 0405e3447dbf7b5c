//! The lights that this crate samples, and the domain in which they are accepted.
//!
//! A [`Bvh`](crate::Bvh) is over lights of one type, which its nodes name: [`EmissiveTriangle`], or where they are
//! [`Lit`](crate::node::Lit) another [`Light`].
//!
//! | | emits |
//! |---|---|
//! | [`EmissiveTriangle`] | from its front, or from both sides |
//! | [`RectangleLight`], [`DiscLight`] | as that; parallelograms and ellipses too |
//! | [`SphereLight`] | from its surface outward |
//! | [`PointLight`], [`SpotLight`] | from a place without size, in every direction or into a cone |
//! | [`ProfileLight`] | from a place without size, in each direction what a table says: IES profiles |
//! | [`BoxLight`] | from every place within it in every direction |
//! | [`AnyLight`] | as the one of these that it is, for trees over several kinds |
//! | [`LinkedTriangle`], [`LinkedAny`] | as that, to the receivers that its mask allows: [`Linked`](crate::importance::Linked) |
//!
//! [`Light::point_for`] gives a [`LightPoint`] on each of them, [`LightPoint::irradiance`] what that sends. Builders, refits, samples, pmfs,
//! instances, edits, rebuilds and files are the same for all; so are mirrors on devices:
//! `lightbvh_gpu::KernelSet::ANY` are the kernels over [`AnyLight`], and the reference renderer shows all of them.
//! Environment maps and suns stand beside the tree: [`infinite`].
//!
//! **Instances scale.** The top level knows how flux grows with an instance's scale: with area where lights are surfaces, with volume where
//! they are boxes, not at all where they are points and spots ([`Light::FLUX_POWER`]). It takes one rule for all lights of a mesh. A mesh of
//! [`AnyLight`]s that differ in it goes by area: its scaled instances have too much or too little weight, which costs variance, and
//! biases nothing.

mod any;
mod flat;
pub mod infinite;
mod linked;
mod point;
mod profile;
mod punctual;
mod record;
mod round;
mod sphere;
#[cfg(test)]
mod tests;
mod volume;

use bytemuck::{Pod, Zeroable};
use glam::Vec3;

pub use any::AnyLight;
pub use flat::{DiscLight, RectangleLight};
pub use linked::{LinkedAny, LinkedTriangle};
pub use point::{LightPoint, uniform_point};
pub use profile::ProfileLight;
pub use punctual::{PointLight, SpotLight};
pub(crate) use record::shining;
pub use record::{Light, LightSlots};
use record::{checked_emission, checked_place};
pub use sphere::SphereLight;
pub use volume::BoxLight;

use crate::emission::luminance_of;
use crate::error::Number;
use crate::exact;
use crate::vector::vector;

/// "No such index."
pub const INVALID: u32 = u32::MAX;

/// [`EmissiveTriangle::flags`] bit: the triangle emits from both faces.
pub const TWO_SIDED: u32 = 1;

/// Largest magnitude of a coordinate, metres: 2^40.
pub const MAX_COORDINATE: f32 = exact::pow2(40);
/// Smallest magnitude of a coordinate that is not zero, metres: 2^-100. The difference of two coordinates is then zero
/// or a normal number, which a device that flushes subnormal numbers keeps.
pub const MIN_COORDINATE: f32 = exact::pow2(MIN_COORDINATE_EXPONENT);
pub(crate) const MIN_COORDINATE_EXPONENT: i32 = -100;
/// Offsets from coordinates count as zero below this, metres: 2^-103. The last place of all others is a normal number, and so is every sum.
pub(crate) const MIN_OFFSET: f32 = exact::pow2(-103);
/// Smallest radiance that is not zero, W/(m² sr): 2^-100.
pub const MIN_RADIANCE: f32 = exact::pow2(-100);
/// Largest radiance, W/(m² sr): 2^100.
pub const MAX_RADIANCE: f32 = exact::pow2(100);

/// A triangle that emits the same radiance in every direction of its front side (or of both sides).
///
/// The front side is the one from which the vertices run counter-clockwise; `(p1 − p0) × (p2 − p0)` points to it.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct EmissiveTriangle {
    /// Vertices, metres, in the space of the mesh (for `Lights`, of the world); magnitude zero or in [`MIN_COORDINATE`]`..=`[`MAX_COORDINATE`].
    pub p: [[f32; 3]; 3],
    /// Radiance, W/(m² sr), linear RGB; zero or in [`MIN_RADIANCE`]`..=`[`MAX_RADIANCE`].
    pub radiance: [f32; 3],
    /// Index of the mesh light that owns the triangle: what [`Lights`](crate::Lights) takes, and what a light in the world has. Not looked
    /// at where a mesh is given to a [`Bvh`](crate::Bvh).
    pub mesh: u32,
    /// [`TWO_SIDED`](Self::TWO_SIDED) or 0.
    pub flags: u32,
}

const _: () = assert!(size_of::<EmissiveTriangle>() == 56);

impl EmissiveTriangle {
    /// Bit of [`flags`](Self::flags): the triangle emits from both faces.
    pub const TWO_SIDED: u32 = TWO_SIDED;

    /// Vertex `k` in 0..3; the last one for any other.
    #[inline]
    #[must_use]
    pub fn vertex(&self, k: usize) -> Vec3 {
        // By a choice: rust-gpu inlines whatever has an index that might be out of bounds.
        let p = if k == 0 {
            self.p[0]
        } else if k == 1 {
            self.p[1]
        } else {
            self.p[2]
        };
        vector(&p)
    }

    /// Whether both faces emit.
    #[inline]
    #[must_use]
    pub fn is_two_sided(&self) -> bool {
        self.flags & TWO_SIDED != 0
    }

    /// Luminance of the radiance (Rec. ITU-R BT.709-6, section 3: the weights of linear R, G, B).
    #[inline]
    #[must_use]
    pub fn luminance(&self) -> f32 {
        luminance_of(&self.radiance)
    }

    /// Brings the triangle into the domain of this crate, or says why it cannot be.
    ///
    /// Coordinates smaller than [`MIN_COORDINATE`] become zero (with the sign of zero dropped); nothing else changes.
    ///
    /// # Errors
    /// [`LightError`] for a coordinate or radiance that is not finite or out of range, for negative radiance, and for flags that mean
    /// nothing.
    pub fn checked(mut self) -> Result<Self, LightError> {
        self.p[0] = checked_place("first vertex of a triangle", self.p[0])?;
        self.p[1] = checked_place("second vertex of a triangle", self.p[1])?;
        self.p[2] = checked_place("third vertex of a triangle", self.p[2])?;
        self.radiance = checked_emission("radiance of a triangle", self.radiance)?;
        if self.flags & !TWO_SIDED != 0 {
            return Err(LightError::Flags { flags: self.flags });
        }
        Ok(self)
    }
}

/// Why a light is refused.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum LightError {
    /// A bit of [`flags`](EmissiveTriangle::flags) that means nothing.
    Flags {
        /// What was found.
        flags: u32,
    },
    /// A coordinate of a vertex, a place, an edge or an axis is NaN, infinite or beyond [`MAX_COORDINATE`].
    Place {
        /// Of what.
        what: &'static str,
        /// Which coordinate: x, y, z as 0, 1, 2.
        axis: usize,
        /// What was found.
        value: f32,
    },
    /// A radiance, an intensity, or a radiance per metre is NaN, infinite, negative, above [`MAX_RADIANCE`], or positive and below [`MIN_RADIANCE`].
    Emission {
        /// Of what.
        what: &'static str,
        /// Which channel: R, G, B as 0, 1, 2.
        channel: usize,
        /// What was found.
        value: f32,
    },
    /// The axis of a spot or a profile, or the direction of a sun, is not of length 1, or what is to be across an axis is not, up to [`NORMAL_TOLERANCE`](crate::error::NORMAL_TOLERANCE).
    Axis {
        /// What was found.
        axis: [f32; 3],
    },
    /// The cone of a spot is none: cosines out of −1..=1, the inner one below the outer one, or the outer one within 2^-20 of 1.
    Cone {
        /// Cosine of the angle up to which the spot has its intensity.
        cos_inner: f32,
        /// Cosine of the angle from which on it has none.
        cos_outer: f32,
    },
    /// The range of a point light or a spot is not 0, nor from 2^-20 to 2^40.
    Range {
        /// What was found, metres.
        range: f32,
    },
    /// The numbers of a profile are none: a cosine out of −1..=1, the cone's within 2^-20 of 1 or above the mean one, or an integral that is not
    /// 0, nor from 2^-40 to 2.
    Profile {
        /// Cosine of the angle from which on there is no light.
        cos_outer: f32,
        /// Integral over all directions, over 2π.
        whole: f32,
        /// Mean cosine.
        mean_cosine: f32,
    },
    /// A kind that is none of [`AnyLight`]'s.
    Kind {
        /// What was found.
        kind: u32,
    },
    /// The radius of a sphere is not from 2^-60 to 2^40 m.
    Radius {
        /// What was found.
        value: f32,
    },
}

impl core::fmt::Display for LightError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match *self {
            Self::Flags { flags } => write!(
                f,
                "flags are {flags:#x}, expected 0 or TWO_SIDED ({TWO_SIDED}); clear the other bits"
            ),
            Self::Place { what, axis, value } => write!(
                f,
                "coordinate {} of the {what} is {}, expected a finite number of magnitude at most 2^40 (1.1e12); scale the scene or \
                 repair it",
                ['x', 'y', 'z'][axis],
                Number(value)
            ),
            Self::Emission { what, channel, value } => write!(
                f,
                "{} of the {what} is {}, expected 0 or a number from 2^-100 to 2^100 (7.9e-31 to 1.3e30); repair the light",
                ["red", "green", "blue"][channel],
                Number(value)
            ),
            Self::Axis { axis: [x, y, z] } => write!(
                f,
                "the axis of a spot or a profile, or the direction of a sun, is ({x}, {y}, {z}), expected length 1, and across at right angles; normalize it"
            ),
            Self::Cone { cos_inner, cos_outer } => write!(
                f,
                "a spot from an inner cosine of {} to an outer one of {}, expected -1 <= outer <= inner <= 1 and outer < 1; swap the \
                 angles, or widen the cone",
                Number(cos_inner),
                Number(cos_outer)
            ),
            Self::Range { range } => write!(
                f,
                "the range of a light is {} metres, expected 0 for none, or 2^-20 to 2^40; leave it out, or turn the light off",
                Number(range)
            ),
            Self::Profile {
                cos_outer,
                whole,
                mean_cosine,
            } => write!(
                f,
                "a profile of integral {}, mean cosine {}, and cone from cosine {} on, expected an integral of 0 or from 2^-40 to 2 and \
                 -1 <= cone <= mean <= 1; compute them from the table",
                Number(whole),
                Number(mean_cosine),
                Number(cos_outer)
            ),
            Self::Kind { kind } => write!(
                f,
                "a light of kind {kind}, expected one of AnyLight's; make it by `AnyLight::from`"
            ),
            Self::Radius { value } => write!(
                f,
                "the radius of a sphere is {}, expected 2^-60 to 2^40 m; make it a point light, or leave it out",
                Number(value)
            ),
        }
    }
}

impl core::error::Error for LightError {}

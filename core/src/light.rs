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
mod triangle;
mod volume;

pub use any::AnyLight;
pub use flat::{DiscLight, RectangleLight};
pub use linked::{LinkedAny, LinkedTriangle};
pub use point::{LightPoint, uniform_point};
pub use profile::ProfileLight;
pub use punctual::{PointLight, SpotLight};
pub use record::{Light, LightSlots, world_light};
pub use sphere::SphereLight;
pub use triangle::EmissiveTriangle;
pub use volume::BoxLight;

#[doc(inline)]
pub use crate::domain::{MAX_COORDINATE, MAX_RADIANCE, MIN_COORDINATE, MIN_RADIANCE};
pub(crate) use crate::domain::{MIN_COORDINATE_EXPONENT, MIN_OFFSET};
use crate::number::Number;

/// "No such index."
pub const INVALID: u32 = u32::MAX;

/// [`EmissiveTriangle::flags`] bit: the triangle emits from both faces.
pub const TWO_SIDED: u32 = 1;

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

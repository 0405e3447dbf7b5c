//! The lights that this crate samples, and the domain in which they are accepted.
//!
//! A [`Bvh`](crate::Bvh) is over lights of one type, which its nodes name: [`EmissiveTriangle`], or another [`Light`] where their type
//! says so.
//!
//! | | emits |
//! |---|---|
//! | [`EmissiveTriangle`] | from its front, or from both sides |
//! | [`RectangleLight`], [`DiscLight`] | as that; parallelograms and ellipses too |
//! | [`SphereLight`] | from its surface outward |
//! | [`PointLight`], [`SpotLight`] | from a place without size, in every direction or into a cone |
//! | [`AnyLight`] | as the one of these that it is, for trees over several kinds |
//!
//! [`Light::point_for`] gives a [`LightPoint`] on each of them, [`LightPoint::irradiance`] what that sends. Builders, refits, samples, pmfs,
//! instances, edits, rebuilds and files are the same for all; so are mirrors on devices:
//! `lightbvh_gpu::KernelSet::ANY` are the kernels over [`AnyLight`], and the reference renderer shows all of them.
//!
//! **Instances scale.** Flux grows with area if a light is a surface, not at all if it is a point or spot ([`Light::is_surface`]). A mesh that
//! mixes both goes by area: weights of its scaled instances are too large or too small, which costs variance and adds no bias.

mod any;
mod flat;
mod point;
mod punctual;
mod record;
mod round;
mod sphere;
#[cfg(test)]
mod tests;
mod triangle;

pub use any::AnyLight;
pub use flat::{DiscLight, RectangleLight};
pub use point::{LightPoint, mis_weight, uniform_point};
pub use punctual::{PointLight, SpotLight};
pub use record::{Light, LightSlots, world_light};
pub use sphere::SphereLight;
pub use triangle::EmissiveTriangle;

#[doc(inline)]
pub use crate::domain::{MAX_COORDINATE, MAX_RADIANCE, MIN_COORDINATE, MIN_RADIANCE};
pub(crate) use crate::domain::{MIN_COORDINATE_EXPONENT, MIN_OFFSET};

/// "No such index."
pub const INVALID: u32 = u32::MAX;

/// [`EmissiveTriangle::flags`] bit: the triangle emits from both faces.
pub const TWO_SIDED: u32 = 1;

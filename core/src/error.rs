//! Why input is refused: what is wrong, where, and what to do about it; and the limits of what is accepted.

#[cfg(feature = "std")]
pub use crate::bvh::RebuildError;
#[cfg(feature = "alloc")]
pub use crate::bvh::{EditError, EditReason, FollowError, ReadError, Violation};
#[doc(inline)]
pub use crate::domain::{
    DomainError, MAX_COORDINATE, MAX_RADIANCE, MIN_COORDINATE, MIN_RADIANCE, NORMAL_TOLERANCE,
};
#[cfg(feature = "alloc")]
#[doc(inline)]
pub use crate::lights::{LightsError, MAX_LIGHTS};

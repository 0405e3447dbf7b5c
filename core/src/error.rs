//! Why input is refused: what is wrong, where, and what to do about it; and the limits of what is accepted.

#[cfg(feature = "std")]
pub use crate::bvh::RebuildError;
#[cfg(feature = "alloc")]
pub use crate::bvh::{EditError, EditReason, FollowError, ReadError};
#[doc(inline)]
pub use crate::light::{LightError, MAX_COORDINATE, MAX_RADIANCE, MIN_COORDINATE, MIN_RADIANCE};
#[cfg(feature = "alloc")]
#[doc(inline)]
pub use crate::lights::{LightsError, MAX_LIGHTS};
#[doc(inline)]
pub use crate::point::{NORMAL_TOLERANCE, PointError};
#[cfg(feature = "alloc")]
pub use crate::transform::TransformError;
#[cfg(feature = "alloc")]
pub use crate::validate::Violation;

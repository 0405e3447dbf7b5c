//! Why input is refused: what is wrong, where, and what to do about it.

#[cfg(feature = "alloc")]
pub use crate::bvh::{EditError, EditReason, Foreign, ReadError};
pub use crate::light::LightError;
#[cfg(feature = "alloc")]
pub use crate::lights::LightsError;
pub use crate::point::PointError;
#[cfg(feature = "std")]
pub use crate::rebuilder::RebuildError;
#[cfg(feature = "alloc")]
pub use crate::transform::TransformError;
#[cfg(feature = "alloc")]
pub use crate::validate::{Violation, What};

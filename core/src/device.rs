//! What the kernels, the host and the tests of this workspace share with the tree. **Unstable**: any of it may change in any
//! version, without an entry in the changelog.

/// Bounds of lights: boxes, cones and flux.
pub mod bounds {
    pub use crate::bounds::*;
}
/// A BVH that follows its lights: all are moved or changed at once.
#[cfg(feature = "alloc")]
pub mod bvh {
    pub use crate::bvh::follow;
}
/// Cones of directions.
pub mod cone {
    pub use crate::cone::*;
}
/// Luminance of colours.
pub mod emission {
    pub use crate::emission::luminance_of;
}
/// The levels of a tree, in the order of a refit.
#[cfg(feature = "alloc")]
pub mod levels {
    pub use crate::levels::*;
}
/// Moments of lights: flux, mean, deviations and mean normal.
pub mod moments {
    pub use crate::moments::*;
}
/// Receivers.
pub mod point {
    pub use crate::point::*;
}
/// Distances of children's centres, for importances.
pub mod sight {
    pub use crate::importance::sight::*;
}
/// Summaries of lights.
pub mod summary {
    pub use crate::summary::*;
}
/// Trails: the path to a light as bits.
pub mod trail {
    pub use crate::trail::*;
}
/// Products of vectors in a fixed order.
pub mod vector {
    pub use crate::vector::*;
}
/// Functions compiled for the widest vectors of the processor.
pub mod widest {
    pub use crate::widest::*;
}

//! Builders: binned top-down splitting by SAH (paper Eq. 2) or SAOH (Eq. 3), for either level and any width.
//!
//! A builder decides the topology only; bounds come from [refit](crate::refit), so that a built tree and a refitted one
//! are the same to the bit. Builders run on the CPU alone, but keep to the same exact arithmetic: every platform builds
//! the same tree.

mod binary;
mod collapse;
mod cost;
mod primitive;
mod split;
mod topology;

pub use cost::Heuristic;
pub(crate) use cost::drift;
pub(crate) use primitive::Primitive;
pub(crate) use topology::{Topology, build};

/// What the builder may be told.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BuildParams {
    /// Cost of a split.
    pub heuristic: Heuristic,
    /// Buckets per axis, 2..=[`MAX_BUCKETS`]; others are brought into that range. More find better splits and take longer.
    pub buckets: u32,
}

/// Most buckets per axis.
pub const MAX_BUCKETS: u32 = 32;

impl Default for BuildParams {
    /// SAOH with 16 buckets.
    fn default() -> Self {
        Self {
            heuristic: Heuristic::Saoh,
            buckets: 16,
        }
    }
}

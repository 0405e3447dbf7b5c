//! The importances of pbrt-v4 and Falcor, to compare with: lightbvh's own are in [`lightbvh::importance`].
//!
//! They are written as an importance of your own is: implement [`ImportanceModel`](lightbvh::importance::ImportanceModel), keep exponents
//! apart in [`Scaled`](lightbvh::importance::Scaled), and use the operations of [`lightbvh::exact`].

mod falcor;
mod pbrt;
mod sight;
#[cfg(test)]
mod tests;

// For the numbers that the tests share with core's.
#[cfg(test)]
use lightbvh::exact;

pub use falcor::Falcor;
pub use pbrt::Pbrt;

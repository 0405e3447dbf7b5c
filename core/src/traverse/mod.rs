//! Sampling one light with its exact probability, and the probability of any light.
//!
//! At each node a child is chosen with a probability in proportion to its weight (paper section 3.6). Weights are positive
//! wherever there is flux, so every walk ends at a light after at most as many steps as the tree is deep; nothing is searched.
//!
//! One number drives the whole walk. It is a fixed-point number whose leading bits choose among the children of the root; what
//! remains of it, stretched to the whole range again, chooses at the next node. The order of numbers is thereby the order of
//! lights in the tree: stratified numbers give stratified lights. Ranges are integers, and the probability returned is the very
//! share of numbers that lead to the light.

mod batch;
mod choose;
mod random;
mod sample;
#[cfg(test)]
mod tests;
mod walk;
#[cfg(feature = "alloc")]
pub(crate) mod widest;

pub use batch::sample_batch;
pub use random::Random64;
pub use sample::{SampledLight, pmf, sample};

//! Sampling one light with its exact probability, and the probability of any light.
//!
//! At each node a child is chosen with probability importance / sum of importances (paper section 3.6). Importances are
//! bounds, so a child may be worth entering while none of *its* children is: a dead branch. Peers lose such samples.
//! Here a dead child's probability passes to its sibling: to the nearest light of the sibling that can be reached.
//! [`sample`](fn@sample) then returns a light whenever one can be reached, and the returned `pmf` is still exact, because the
//! probability that a light takes over from dead neighbours is found again by looking at just those neighbours
//! (`dead.rs`). No light loses probability by this, so the variance is never above that of losing the sample.

mod beside;
mod choose;
mod dead;
mod descend;
mod neighbor;
mod sample;
mod search;

pub use sample::{SampledLight, pmf, sample};

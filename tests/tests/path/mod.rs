//! Paths: two ways to find each light that share it exactly, and sums known in closed form.

mod sums;
mod weights;

//! Runs lightbvh on the CPU and on Vulkan devices and compares the results bit for bit.
#![deny(unsafe_code)]

pub mod backend;
pub mod cli;
pub mod error;
pub mod method;
pub mod metrics;
pub mod render;
// Written by `build-kernels`.
#[rustfmt::skip]
mod renderer;
pub mod stability;
mod tally;
pub mod vulkan;
pub mod words;
pub mod workload;

pub use lightbvh_scenes as scene;
pub(crate) use lightbvh_scenes::vector;

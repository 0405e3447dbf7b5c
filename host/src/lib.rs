//! Runs lightbvh on the CPU and on Vulkan devices and compares the results bit for bit.
#![deny(unsafe_code)]

pub mod backend;
pub mod cli;
pub mod error;
pub mod method;
pub mod metrics;
pub mod plot;
pub mod render;
pub mod scene;
pub mod stability;
mod vector;
pub mod vulkan;
pub mod words;
pub mod workload;

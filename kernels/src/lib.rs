//! SPIR-V entry points of lightbvh, one per pass.
//!
//! Every kernel is a plain Rust function. Compiled for `target_arch = "spirv"` it becomes an entry point; on the CPU
//! the `#[spirv(..)]` attributes vanish and the host and the tests call the very same body.
//!
//! Conventions that all kernels keep, and the host relies on:
//! - the entry point is named as the function;
//! - buffers are storage buffers in descriptor set 0, with bindings 0, 1, .. in the order of the parameters;
//! - scalars arrive as one push-constant structure, and the number of items is among them: invocations beyond it do
//!   nothing, because a dispatch is a whole number of workgroups;
//! - a kernel that reads or writes nodes exists once for each model, its name ending in the model's suffix;
//! - the workgroup is [`WORKGROUP`] × 1 × 1 invocations, and [`invocation`] numbers them.
#![cfg_attr(target_arch = "spirv", no_std)]
// A kernel has as many parameters as bindings.
#![allow(clippy::too_many_arguments)]

#[macro_use]
mod passes;

pub mod bvh;
pub mod kinds;
pub mod query;
pub mod receivers;
pub mod refit;
pub mod render;
pub mod scatter;
pub mod self_test;
pub mod shading;

pub use passes::{ROW_GROUPS, WORKGROUP, invocation};

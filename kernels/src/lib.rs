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
//! - a kernel that reads or writes nodes exists once for each [`Compiled`](bvh::Compiled), its name ending in the choice's suffix;
//! - the workgroup is [`WORKGROUP`] × 1 × 1 invocations, and [`invocation`] numbers them.
#![cfg_attr(target_arch = "spirv", no_std)]
// A kernel has as many parameters as bindings.
#![allow(clippy::too_many_arguments)]

pub mod bvh;
pub mod kinds;
pub mod query;
pub mod receivers;
pub mod refit;
pub mod render;
pub mod scatter;
pub mod self_test;
pub mod shading;

use glam::UVec3;

/// Invocations in one workgroup of every kernel. `#[spirv(compute(threads(64)))]` takes only a literal, so a test
/// compares this constant with the `LocalSize` of each shipped module.
pub const WORKGROUP: u32 = 64;

/// Workgroups in one row of a dispatch: what every Vulkan device accepts in each dimension
/// (`maxComputeWorkGroupCount` is at least 65535).
pub const ROW_GROUPS: u32 = 65_535;

/// The number of an invocation, counted over the rows of a dispatch of at most [`ROW_GROUPS`] workgroups each.
///
/// `id` is the built-in `global_invocation_id`; its `y` counts rows, because a workgroup is one invocation high.
#[must_use]
#[inline]
pub fn invocation(id: UVec3) -> u32 {
    id.y.wrapping_mul(ROW_GROUPS * WORKGROUP).wrapping_add(id.x)
}

#[cfg(test)]
mod tests {
    use super::{ROW_GROUPS, WORKGROUP, invocation};
    use glam::UVec3;

    #[test]
    fn invocations_of_the_next_row_follow_the_last_of_the_row_before() {
        let last = UVec3::new(ROW_GROUPS * WORKGROUP - 1, 0, 0);
        assert_eq!(invocation(UVec3::ZERO), 0);
        assert_eq!(invocation(last) + 1, invocation(UVec3::new(0, 1, 0)));
        assert_eq!(invocation(UVec3::new(5, 2, 0)), 2 * 65_535 * 64 + 5);
    }
}

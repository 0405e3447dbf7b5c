//! A compute shader of one's own that samples a light BVH: direct light on points, without shadows.
//!
//! This file is the entry point, `direct.rs` what it computes; the CPU's side is the example `embed_ash` of `lightbvh-gpu`. It is built
//! by lightbvh's builder, which keeps the arithmetic exact, and run by that example:
//!
//! ```sh
//! cargo run --release -p lightbvh-kernels-builder --features prebuilt-backend -- \
//!     --crate kernels/examples/embed_shader --out target/embed_shader
//! cargo run --release -p lightbvh-gpu --example embed_ash -- target/embed_shader/direct.spv
//! ```
#![cfg_attr(target_arch = "spirv", no_std)]
// An entry point has as many parameters as bindings.
#![allow(clippy::too_many_arguments)]

#[path = "../../../gpu/examples/common/direct.rs"]
mod direct;

use bytemuck::{Pod, Zeroable};
use direct::direct_light;
use lightbvh::node::DefaultNode;
use lightbvh::{EmissiveTriangle, Instance, ShadingPoint, TreeWords};
use spirv_std::glam::UVec3;
use spirv_std::spirv;

/// Push constants.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct Push {
    /// Number of points.
    pub count: u32,
    /// Light samples for each point.
    pub samples: u32,
    pub tree: TreeWords,
}

/// One invocation lights one point: W/m² of red, green and blue that arrive there, without shadows.
#[spirv(compute(threads(64)))]
pub fn direct(
    #[spirv(global_invocation_id)] id: UVec3,
    #[spirv(push_constant)] push: &Push,
    #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] nodes: &[DefaultNode],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] instances: &[Instance],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 2)] trails: &[u32],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 3)] lights: &[EmissiveTriangle],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 4)] points: &[ShadingPoint],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 5)] results: &mut [[f32; 3]],
) {
    if id.x < push.count {
        let tree = push.tree.tree(nodes, instances, trails);
        let i = id.x as usize;
        results[i] = direct_light(&tree, lights, &points[i], push.samples, id.x);
    }
}

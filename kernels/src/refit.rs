//! Passes `refit_bottom`, `refit_roots`, `refit_top`: new summaries bottom-up (paper section 3.4) of the nodes listed, so that
//! only what changed costs anything. One invocation writes one node or root; a barrier stands between dispatches, of which
//! there is one for each level.

use bytemuck::{Pod, Zeroable};
use glam::UVec3;
use lightbvh::refit::{self, BlasRoot};
use lightbvh::{EmissiveTriangle, Instance};
use spirv_std::spirv;

use crate::bvh::{NodeOf, Paper, Standard};
use crate::invocation;

/// Push constants of the refit passes.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct RefitPush {
    /// First entry of the list.
    pub first: u32,
    /// Number of entries.
    pub count: u32,
}

/// The pass over bottom levels of one type of node and of light.
macro_rules! bottom_pass {
    ($node:ty, $light:ty, $pass:ident, $name:tt) => {
        /// Nodes `list[first + i]` of bottom levels, all of one level, take the summaries of their triangles and of the nodes
        /// below them.
        #[spirv(compute(threads(64), entry_point_name = $name))]
        pub fn $pass(
            #[spirv(global_invocation_id)] id: UVec3,
            #[spirv(push_constant)] push: &RefitPush,
            #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] list: &[u32],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] triangles: &[$light],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 2)] nodes: &mut [$node],
        ) {
            let i = invocation(id);
            let entry = push.first.wrapping_add(i);
            if i < push.count && entry < list.len() as u32 {
                let node = list[entry as usize];
                if node < nodes.len() as u32 {
                    nodes[node as usize] = refit::bottom(nodes, triangles, node);
                }
            }
        }
    };
}

/// The pass over their roots.
macro_rules! roots_pass {
    ($node:ty, $pass:ident, $name:tt) => {
        /// The summaries of bottom levels `list[first + i]` from their root nodes.
        #[spirv(compute(threads(64), entry_point_name = $name))]
        pub fn $pass(
            #[spirv(global_invocation_id)] id: UVec3,
            #[spirv(push_constant)] push: &RefitPush,
            #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] list: &[u32],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] nodes: &[$node],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 2)] roots: &mut [BlasRoot],
        ) {
            let i = invocation(id);
            let entry = push.first.wrapping_add(i);
            if i < push.count && entry < list.len() as u32 {
                let blas = list[entry as usize];
                if blas < roots.len() as u32 {
                    roots[blas as usize] = refit::root(nodes, roots[blas as usize].node);
                }
            }
        }
    };
}

/// The pass over the top level.
macro_rules! top_pass {
    ($node:ty, $pass:ident, $name:tt) => {
        /// Top-level nodes `list[first + i]`, all of one level, take the summaries of their instances, from the bottom levels'
        /// roots, and of the nodes below them.
        #[spirv(compute(threads(64), entry_point_name = $name))]
        pub fn $pass(
            #[spirv(global_invocation_id)] id: UVec3,
            #[spirv(push_constant)] push: &RefitPush,
            #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] list: &[u32],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] instances: &[Instance],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 2)] roots: &[BlasRoot],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 3)] nodes: &mut [$node],
        ) {
            let i = invocation(id);
            let entry = push.first.wrapping_add(i);
            if i < push.count && entry < list.len() as u32 {
                let node = list[entry as usize];
                if node < nodes.len() as u32 {
                    nodes[node as usize] = refit::top(nodes, instances, roots, node);
                }
            }
        }
    };
}

pub(crate) use {bottom_pass, roots_pass, top_pass};

bottom_pass!(NodeOf<Standard>, EmissiveTriangle, refit_bottom, "refit_bottom");
roots_pass!(NodeOf<Standard>, refit_roots, "refit_roots");
top_pass!(NodeOf<Standard>, refit_top, "refit_top");
bottom_pass!(
    NodeOf<Paper>,
    EmissiveTriangle,
    refit_bottom_eq4,
    "refit_bottom_eq4"
);
roots_pass!(NodeOf<Paper>, refit_roots_eq4, "refit_roots_eq4");
top_pass!(NodeOf<Paper>, refit_top_eq4, "refit_top_eq4");

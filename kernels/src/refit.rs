//! Passes `refit_leaves`, `refit_level`, `refit_roots`, `refit_instances`, `refit_level` again: new bounds bottom-up (paper
//! section 3.4) of the nodes listed, so that only what changed costs anything. One invocation writes one node or root; a
//! barrier stands between dispatches.

mod climb;

pub use climb::{refit_climb, refit_climb_top};

use bytemuck::{Pod, Zeroable};
use glam::UVec3;
use lightbvh::refit::{self, BlasRoot};
use lightbvh::{EmissiveTriangle, Instance};
use spirv_std::spirv;

use crate::bvh::{Node, WIDTH};
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

/// Pass 1: nodes `list[first + i]` take the bounds of their triangles.
#[spirv(compute(threads(64), entry_point_name = "refit_leaves"))]
pub fn refit_leaves(
    #[spirv(global_invocation_id)] id: UVec3,
    #[spirv(push_constant)] push: &RefitPush,
    #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] list: &[u32],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] triangles: &[EmissiveTriangle],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 2)] nodes: &mut [Node],
) {
    let i = invocation(id);
    let entry = push.first.wrapping_add(i);
    if i < push.count && entry < list.len() as u32 {
        let node = list[entry as usize];
        if node < nodes.len() as u32 {
            nodes[node as usize] = refit::leaves::<Node, WIDTH>(nodes, triangles, node);
        }
    }
}

/// Passes 2 and 5: the nodes `list[first + i]` of one level take the bounds of the level below. One dispatch per level,
/// of all bottom levels together.
#[spirv(compute(threads(64), entry_point_name = "refit_level"))]
pub fn refit_level(
    #[spirv(global_invocation_id)] id: UVec3,
    #[spirv(push_constant)] push: &RefitPush,
    #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] list: &[u32],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] nodes: &mut [Node],
) {
    let i = invocation(id);
    let entry = push.first.wrapping_add(i);
    if i < push.count && entry < list.len() as u32 {
        let node = list[entry as usize];
        if node < nodes.len() as u32 {
            nodes[node as usize] = refit::level::<Node, WIDTH>(nodes, node);
        }
    }
}

/// Pass 3: the bounds of bottom levels `list[first + i]` from their root nodes.
#[spirv(compute(threads(64), entry_point_name = "refit_roots"))]
pub fn refit_roots(
    #[spirv(global_invocation_id)] id: UVec3,
    #[spirv(push_constant)] push: &RefitPush,
    #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] list: &[u32],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] nodes: &[Node],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 2)] roots: &mut [BlasRoot],
) {
    let i = invocation(id);
    let entry = push.first.wrapping_add(i);
    if i < push.count && entry < list.len() as u32 {
        let blas = list[entry as usize];
        if blas < roots.len() as u32 {
            roots[blas as usize] = refit::root::<Node, WIDTH>(nodes, roots[blas as usize].node);
        }
    }
}

/// Pass 4: top-level nodes `list[first + i]` take the bounds of their instances from the bottom levels' roots.
#[spirv(compute(threads(64), entry_point_name = "refit_instances"))]
pub fn refit_instances(
    #[spirv(global_invocation_id)] id: UVec3,
    #[spirv(push_constant)] push: &RefitPush,
    #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] list: &[u32],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] instances: &[Instance],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 2)] roots: &[BlasRoot],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 3)] nodes: &mut [Node],
) {
    let i = invocation(id);
    let entry = push.first.wrapping_add(i);
    if i < push.count && entry < list.len() as u32 {
        let node = list[entry as usize];
        if node < nodes.len() as u32 {
            nodes[node as usize] = refit::mesh_leaves::<Node, Instance, WIDTH>(nodes, instances, roots, node);
        }
    }
}

//! Passes `refit_leaves`, `refit_level`, `refit_mesh_leaves`, `refit_level` again: new bounds bottom-up (paper section
//! 3.4). One invocation writes one node; a barrier stands between dispatches.

use bytemuck::{Pod, Zeroable};
use glam::UVec3;
use lightbvh::{EmissiveTriangle, MeshLight, refit};
use spirv_std::spirv;

use crate::bvh::{Node, WIDTH};
use crate::invocation;

/// Push constants of the refit passes.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct RefitPush {
    /// First node, or first entry of the list of nodes.
    pub first: u32,
    /// Number of nodes.
    pub count: u32,
}

/// Pass 1: node `first + i` takes the bounds of its triangles. Reads triangles, writes nodes.
#[spirv(compute(threads(64), entry_point_name = "refit_leaves"))]
pub fn refit_leaves(
    #[spirv(global_invocation_id)] id: UVec3,
    #[spirv(push_constant)] push: &RefitPush,
    #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] triangles: &[EmissiveTriangle],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] nodes: &mut [Node],
) {
    let i = invocation(id);
    let node = push.first.wrapping_add(i);
    if i < push.count && node < nodes.len() as u32 {
        nodes[node as usize] = refit::leaves::<Node, WIDTH>(nodes, triangles, node);
    }
}

/// Passes 2 and 4: the nodes `list[first + i]` of one level take the bounds of the level below. One dispatch per level,
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

/// Pass 3: top-level node `first + i` takes the bounds of its mesh lights from the roots of their bottom levels.
#[spirv(compute(threads(64), entry_point_name = "refit_mesh_leaves"))]
pub fn refit_mesh_leaves(
    #[spirv(global_invocation_id)] id: UVec3,
    #[spirv(push_constant)] push: &RefitPush,
    #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] meshes: &[MeshLight],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] nodes: &mut [Node],
) {
    let i = invocation(id);
    let node = push.first.wrapping_add(i);
    if i < push.count && node < nodes.len() as u32 {
        nodes[node as usize] = refit::mesh_leaves::<Node, WIDTH>(nodes, meshes, node);
    }
}

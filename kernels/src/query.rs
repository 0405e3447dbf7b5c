//! Passes `sample` and `pmf`: one invocation answers one query.

use bytemuck::{Pod, Zeroable};
use glam::UVec3;
use lightbvh::{EmissiveTriangle, INVALID, Instance, ShadingPoint, traverse};
use spirv_std::spirv;

use crate::bvh::{Importance, Node, TreePush, WIDTH};
use crate::invocation;

/// A point and 32 random bits; for `pmf` the light asked about takes the place of the random bits.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Query {
    /// The point to be lit.
    pub point: ShadingPoint,
    /// Random bits (`sample`), or the index of an emissive triangle (`pmf`).
    pub random_or_light: u32,
}

/// What `sample` writes.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Sampled {
    /// Index of the emissive triangle, or [`INVALID`].
    pub light: u32,
    /// Its probability.
    pub pmf: f32,
}

/// Push constants of both passes.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct QueryPush {
    /// Number of queries.
    pub count: u32,
    /// The tree.
    pub tree: TreePush,
}

/// Chooses a light for each query's point.
#[spirv(compute(threads(64), entry_point_name = "sample"))]
pub fn sample(
    #[spirv(global_invocation_id)] id: UVec3,
    #[spirv(push_constant)] push: &QueryPush,
    #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] nodes: &[Node],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] meshes: &[Instance],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 2)] trails: &[u32],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 3)] queries: &[Query],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 4)] results: &mut [Sampled],
) {
    let i = invocation(id);
    if i < push.count && i < queries.len() as u32 {
        let tree = push.tree.tree(nodes, meshes, trails);
        let query = queries[i as usize];
        let sampled =
            traverse::sample::<Node, Importance, Instance, WIDTH>(&tree, &query.point, query.random_or_light);
        results[i as usize] = Sampled {
            light: sampled.light,
            pmf: sampled.pmf,
        };
    }
}

/// Evaluates the probability of each query's light at its point.
#[spirv(compute(threads(64), entry_point_name = "pmf"))]
pub fn pmf(
    #[spirv(global_invocation_id)] id: UVec3,
    #[spirv(push_constant)] push: &QueryPush,
    #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] nodes: &[Node],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] meshes: &[Instance],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 2)] trails: &[u32],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 3)] triangles: &[EmissiveTriangle],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 4)] queries: &[Query],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 5)] results: &mut [f32],
) {
    let i = invocation(id);
    if i < push.count && i < queries.len() as u32 {
        let tree = push.tree.tree(nodes, meshes, trails);
        let query = queries[i as usize];
        let light = query.random_or_light;
        let mut result = 0.0;
        if light < triangles.len() as u32 {
            let mesh = if push.tree.two_level != 0 {
                triangles[light as usize].mesh
            } else {
                INVALID
            };
            result = traverse::pmf::<Node, Importance, Instance, WIDTH>(&tree, &query.point, light, mesh);
        }
        results[i as usize] = result;
    }
}

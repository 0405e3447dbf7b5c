//! Passes `sample` and `pmf`: one invocation answers one query.

use bytemuck::{Pod, Zeroable};
use glam::UVec3;
use lightbvh::{EmissiveTriangle, INVALID, Instance, LightTree, Random64, ShadingPoint, traverse};
use spirv_std::spirv;

use crate::bvh::{Choice, NodeOf, Paper, Standard, TreePush};
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

/// The answer to a query of pass `sample`.
#[inline]
#[must_use]
pub fn sample_query<C: Choice<W>, const W: usize>(tree: &LightTree<'_, C::Node>, query: &Query) -> Sampled {
    let random = Random64::from(query.random_or_light);
    let sampled = traverse::sample::<C::Node, C::Importance, W>(tree, &query.point, random);
    Sampled {
        light: sampled.light,
        pmf: sampled.pmf,
    }
}

/// The answer to a query of pass `pmf`.
#[inline]
#[must_use]
pub fn pmf_query<C: Choice<W>, const W: usize>(
    tree: &LightTree<'_, C::Node>,
    triangles: &[EmissiveTriangle],
    query: &Query,
) -> f32 {
    let light = query.random_or_light;
    let mut result = 0.0;
    if light < triangles.len() as u32 {
        let instance = if tree.live > 0 {
            triangles[light as usize].mesh
        } else {
            INVALID
        };
        result = traverse::pmf::<C::Node, C::Importance, W>(tree, &query.point, light, instance);
    }
    result
}

/// The passes for one choice: `$sample` chooses a light for each query's point, `$pmf` evaluates the probability of each
/// query's light at its point.
macro_rules! query_passes {
    ($choice:ty, $sample:ident, $sample_name:tt, $pmf:ident, $pmf_name:tt) => {
        /// Chooses a light for each query's point.
        #[spirv(compute(threads(64), entry_point_name = $sample_name))]
        pub fn $sample(
            #[spirv(global_invocation_id)] id: UVec3,
            #[spirv(push_constant)] push: &QueryPush,
            #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] nodes: &[NodeOf<$choice>],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] instances: &[Instance],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 2)] trails: &[u32],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 3)] queries: &[Query],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 4)] results: &mut [Sampled],
        ) {
            let i = invocation(id);
            if i < push.count && i < queries.len() as u32 {
                let tree = push.tree.tree(nodes, instances, trails);
                results[i as usize] = sample_query::<$choice, _>(&tree, &queries[i as usize]);
            }
        }

        /// Evaluates the probability of each query's light at its point.
        #[spirv(compute(threads(64), entry_point_name = $pmf_name))]
        pub fn $pmf(
            #[spirv(global_invocation_id)] id: UVec3,
            #[spirv(push_constant)] push: &QueryPush,
            #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] nodes: &[NodeOf<$choice>],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] instances: &[Instance],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 2)] trails: &[u32],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 3)] triangles: &[EmissiveTriangle],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 4)] queries: &[Query],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 5)] results: &mut [f32],
        ) {
            let i = invocation(id);
            if i < push.count && i < queries.len() as u32 {
                let tree = push.tree.tree(nodes, instances, trails);
                results[i as usize] = pmf_query::<$choice, _>(&tree, triangles, &queries[i as usize]);
            }
        }
    };
}

query_passes!(Standard, sample, "sample", pmf, "pmf");
query_passes!(Paper, sample_eq4, "sample_eq4", pmf_eq4, "pmf_eq4");

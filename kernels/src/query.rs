//! Passes `sample` and `pmf`: one invocation answers one query.

use bytemuck::{Pod, Zeroable};
use glam::UVec3;
use lightbvh::{Instance, Random64, SampledLight, ShadingPoint};
use spirv_std::spirv;

use crate::bvh::{Choice, NodeOf, Paper, Standard, TreeOf, TreePush};
use crate::invocation;

/// A point, and what is asked: 32 bytes.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Query {
    /// The point to be lit.
    pub point: ShadingPoint,
    /// For `sample` the number of the walk, its high word first; for `pmf` the light and its instance (`u32::MAX` in a
    /// single-level tree).
    pub words: [u32; 2],
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
pub fn sample_query<C: Choice<W>, const W: usize>(tree: &TreeOf<'_, C, W>, query: &Query) -> SampledLight {
    let number = Random64 {
        high: query.words[0],
        low: query.words[1],
    };
    tree.sample(&query.point, number)
}

/// The answer to a query of pass `pmf`.
#[inline]
#[must_use]
pub fn pmf_query<C: Choice<W>, const W: usize>(tree: &TreeOf<'_, C, W>, query: &Query) -> f32 {
    tree.pmf(&query.point, query.words[0], query.words[1])
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
            #[spirv(storage_buffer, descriptor_set = 0, binding = 4)] results: &mut [SampledLight],
        ) {
            let i = invocation(id);
            if i < push.count && i < queries.len() as u32 {
                let tree: TreeOf<'_, $choice, _> = push.tree.tree(nodes, instances, trails);
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
            #[spirv(storage_buffer, descriptor_set = 0, binding = 3)] queries: &[Query],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 4)] results: &mut [f32],
        ) {
            let i = invocation(id);
            if i < push.count && i < queries.len() as u32 {
                let tree = push.tree.tree(nodes, instances, trails);
                results[i as usize] = pmf_query::<$choice, _>(&tree, &queries[i as usize]);
            }
        }
    };
}

query_passes!(Standard, sample, "sample", pmf, "pmf");
query_passes!(Paper, sample_eq4, "sample_eq4", pmf_eq4, "pmf_eq4");

//! What the passes of every model share, which crates written by `build-kernels --model` have, too.

use bytemuck::{Pod, Zeroable};
use glam::UVec3;
use lightbvh::TreeWords;

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

/// Push constants of both passes.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct QueryPush {
    /// Number of queries.
    pub count: u32,
    /// The tree.
    pub tree: TreeWords,
}

/// Push constants of the refit passes.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct RefitPush {
    /// First entry of the list.
    pub first: u32,
    /// Number of invocations: of entries, times the nodes' width where each child has one.
    pub count: u32,
    /// Index of the top level's first node.
    pub top: u32,
}

/// The passes for one type of query and of tree: `$sample` chooses a light for each query's receiver, `$pmf` evaluates the
/// probability of each query's light.
macro_rules! query_passes {
    ($query:ty, $node:ty, $tree:ident, $sample:ident = $sample_name:tt, $pmf:ident = $pmf_name:tt) => {
        /// Chooses a light for each query's receiver.
        #[spirv(compute(threads(64), entry_point_name = $sample_name))]
        pub fn $sample(
            #[spirv(global_invocation_id)] id: UVec3,
            #[spirv(push_constant)] push: &QueryPush,
            #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] nodes: &[$node],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] instances: &[Instance],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 2)] trails: &[u32],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 3)] queries: &[$query],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 4)] results: &mut [SampledLight],
        ) {
            let i = invocation(id);
            if i < push.count && i < queries.len() as u32 {
                let tree: $tree<'_> = push.tree.tree(nodes, instances, trails);
                let query = queries[i as usize];
                let number = Random64 {
                    high: query.words[0],
                    low: query.words[1],
                };
                results[i as usize] = tree.sample(&query.receiver(), number);
            }
        }

        /// Evaluates the probability of each query's light for its receiver.
        #[spirv(compute(threads(64), entry_point_name = $pmf_name))]
        pub fn $pmf(
            #[spirv(global_invocation_id)] id: UVec3,
            #[spirv(push_constant)] push: &QueryPush,
            #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] nodes: &[$node],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] instances: &[Instance],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 2)] trails: &[u32],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 3)] queries: &[$query],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 4)] results: &mut [f32],
        ) {
            let i = invocation(id);
            if i < push.count && i < queries.len() as u32 {
                let tree: $tree<'_> = push.tree.tree(nodes, instances, trails);
                let query = queries[i as usize];
                results[i as usize] = tree.pmf(&query.receiver(), query.words[0], query.words[1]);
            }
        }
    };
}

/// The three passes over one type of node, its width and its rows of [`Children`], and of light.
macro_rules! refit_passes {
    (
        $node:ty,
        $width:expr,
        $rows:expr,
        $light:ty,
        $bottom:ident = $bottom_name:tt,
        $top:ident = $top_name:tt,
        $nodes:ident = $nodes_name:tt
    ) => {
        /// Writes the summary of each child of the nodes `list[first + k]`, all of one level of bottom levels, into `children` for
        /// `refit_nodes`: of its light, or of the node below. Invocation `i` computes child `i % width` of node `k = i / width`.
        #[spirv(compute(threads(64), entry_point_name = $bottom_name))]
        pub fn $bottom(
            #[spirv(global_invocation_id)] id: UVec3,
            #[spirv(push_constant)] push: &RefitPush,
            #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] list: &[u32],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] lights: &[$light],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 2)] nodes: &[$node],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 3)] children: &mut [Children<
                { $width },
                { $rows },
            >],
        ) {
            let i = invocation(id);
            let (place, slot) = (i / $width as u32, i as usize % $width);
            let entry = push.first.wrapping_add(place);
            if i < push.count && entry < list.len() as u32 {
                let node = list[entry as usize];
                if node < nodes.len() as u32 {
                    let child = refit::bottom_child(nodes, lights, node, slot);
                    child.put(children, place, slot);
                }
            }
        }

        /// Writes the summary of each child of the top-level nodes `list[first + k]`, all of one level, into `children` for `refit_nodes`:
        /// of its instance, or of the node below. Invocations as of the pass over bottom levels.
        #[spirv(compute(threads(64), entry_point_name = $top_name))]
        pub fn $top(
            #[spirv(global_invocation_id)] id: UVec3,
            #[spirv(push_constant)] push: &RefitPush,
            #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] list: &[u32],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] lights: &[$light],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 2)] instances: &[Instance],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 3)] nodes: &[$node],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 4)] children: &mut [Children<
                { $width },
                { $rows },
            >],
        ) {
            let i = invocation(id);
            let (place, slot) = (i / $width as u32, i as usize % $width);
            let entry = push.first.wrapping_add(place);
            if i < push.count && entry < list.len() as u32 {
                let node = list[entry as usize];
                if node < nodes.len() as u32 {
                    let child = refit::top_child(nodes, push.top, lights, instances, node, slot);
                    child.put(children, place, slot);
                }
            }
        }

        /// Nodes `list[first + k]` take the summaries of the children that the pass before wrote into `children` as those of node `k`.
        #[spirv(compute(threads(64), entry_point_name = $nodes_name))]
        pub fn $nodes(
            #[spirv(global_invocation_id)] id: UVec3,
            #[spirv(push_constant)] push: &RefitPush,
            #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] list: &[u32],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] children: &[Children<
                { $width },
                { $rows },
            >],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 2)] nodes: &mut [$node],
        ) {
            let i = invocation(id);
            let entry = push.first.wrapping_add(i);
            if i < push.count && entry < list.len() as u32 {
                let node = list[entry as usize];
                if node < nodes.len() as u32 {
                    nodes[node as usize] = refit::assembled(nodes, node, children, i);
                }
            }
        }
    };
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

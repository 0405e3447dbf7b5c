//! Passes `refit_bottom`, `refit_top`, `refit_nodes`, `refit_roots`: new summaries bottom-up (paper section 3.4) of the nodes listed, so
//! that only what changed costs anything. A level is two dispatches: one invocation for each child of its nodes, then one for each node. A
//! barrier stands between dispatches.

use bytemuck::{Pod, Zeroable};
use glam::UVec3;
use lightbvh::refit::{self, BlasRoot, Children, PLAIN_ROWS};
use lightbvh::{EmissiveTriangle, Instance};
use spirv_std::spirv;

use crate::bvh::{Node, PaperNode, WIDTH};
use crate::invocation;

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

/// The pass over roots of bottom levels.
macro_rules! roots_pass {
    ($node:ty, $roots:ident = $roots_name:tt) => {
        /// The summaries of bottom levels `list[first + i]` from their root nodes.
        #[spirv(compute(threads(64), entry_point_name = $roots_name))]
        pub fn $roots(
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

/// The four passes over one type of node, its width and its rows of [`Children`], and of light; without the last where another
/// type's does.
macro_rules! refit_passes {
    (
        $node:ty,
        $width:expr,
        $rows:expr,
        $light:ty,
        $bottom:ident = $bottom_name:tt,
        $top:ident = $top_name:tt,
        $nodes:ident = $nodes_name:tt
        $(, $roots:ident = $roots_name:tt)?
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
        /// of its instance, from the bottom level's root or its one light, or of the node below. Invocations as of the pass over bottom levels.
        #[spirv(compute(threads(64), entry_point_name = $top_name))]
        pub fn $top(
            #[spirv(global_invocation_id)] id: UVec3,
            #[spirv(push_constant)] push: &RefitPush,
            #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] list: &[u32],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] lights: &[$light],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 2)] instances: &[Instance],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 3)] roots: &[BlasRoot],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 4)] nodes: &[$node],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 5)] children: &mut [Children<
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
                    let child = refit::top_child(nodes, push.top, lights, instances, roots, node, slot);
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
        $($crate::refit::roots_pass!($node, $roots = $roots_name);)?
    };
}

pub(crate) use {refit_passes, roots_pass};

refit_passes!(
    Node,
    WIDTH,
    PLAIN_ROWS,
    EmissiveTriangle,
    refit_bottom = "refit_bottom",
    refit_top = "refit_top",
    refit_nodes = "refit_nodes",
    refit_roots = "refit_roots"
);
refit_passes!(
    PaperNode,
    4,
    PLAIN_ROWS,
    EmissiveTriangle,
    refit_bottom_eq4 = "refit_bottom_eq4",
    refit_top_eq4 = "refit_top_eq4",
    refit_nodes_eq4 = "refit_nodes_eq4",
    refit_roots_eq4 = "refit_roots_eq4"
);

#[cfg(test)]
mod tests {
    use super::*;
    use lightbvh::light::TWO_SIDED;
    use lightbvh::node::Node as _;
    use lightbvh::node::kind;

    /// Index of the top level's first node.
    const TOP: u32 = 3;

    /// Two leaves and their parent, then a top level of two instances and a node without children.
    fn arrays() -> (Vec<Node>, Vec<EmissiveTriangle>, Vec<Instance>) {
        let lights = (0..9_u8).map(|i| EmissiveTriangle {
            p: [
                [f32::from(i), 0.0, 0.0],
                [f32::from(i), 1.0, 0.0],
                [0.0, f32::from(i), 1.0],
            ],
            radiance: [1.0; 3],
            mesh: 0,
            flags: if i % 2 == 0 { TWO_SIDED } else { 0 },
        });
        let mut nodes = vec![Node::EMPTY; 5];
        nodes[0].set_child(0, kind::INNER, 1);
        nodes[0].set_child(5, kind::INNER, 2);
        for i in 0..8 {
            nodes[1].set_child(i, kind::LIGHT, i as u32);
        }
        nodes[2].set_child(3, kind::LIGHT, 8);
        // What is not there.
        nodes[2].set_child(4, kind::LIGHT, 9);
        nodes[2].set_child(6, kind::INNER, u32::MAX);
        nodes[3].set_child(7, kind::MESH, 0);
        nodes[3].set_child(2, kind::MESH, 1);
        nodes[3].set_child(3, kind::MESH, 2);
        nodes[3].set_child(1, kind::INNER, 4 - TOP);
        let mut instance = Instance::IDENTITY;
        (instance.root, instance.blas) = (0, 0);
        // Of one light.
        let mut alone = Instance::IDENTITY;
        alone.first_light = 4;
        (nodes, lights.collect(), vec![instance, alone])
    }

    /// Dispatches over a list of which some entries are no nodes, with more invocations than it has entries.
    #[test]
    fn passes_over_children_and_nodes_are_the_refit() {
        let (mut nodes, lights, instances) = arrays();
        let mut expected = nodes.clone();
        for i in [1, 2, 0] {
            expected[i as usize] = refit::bottom(&expected, &lights, i);
        }
        let roots = [refit::root(&expected, 0)];
        for i in [4, 3] {
            expected[i as usize] = refit::top(&expected, TOP, &lights, &instances, &roots, i);
        }

        let list = [77, 1, 5, 2, 0, u32::MAX, 4, 3];
        let mut children = vec![[[0; WIDTH]; PLAIN_ROWS]; 3];
        let id = |i: u32| UVec3::new(i, 0, 0);
        let mut found = vec![BlasRoot::new(0, &lightbvh::device::moments::LightMoments::EMPTY)];
        for (first, count, is_top) in [(1, 3, false), (4, 1, false), (5, 2, true), (7, 1, true)] {
            if first == 5 {
                let push = RefitPush {
                    first: 4,
                    count: 1,
                    top: TOP,
                };
                (0..64).for_each(|i| refit_roots(id(i), &push, &list, &nodes, &mut found));
                assert_eq!(found, roots);
            }
            let width = WIDTH as u32;
            let push = RefitPush {
                first,
                count: count * width,
                top: TOP,
            };
            for i in 0..64 {
                if is_top {
                    refit_top(
                        id(i),
                        &push,
                        &list,
                        &lights,
                        &instances,
                        &found,
                        &nodes,
                        &mut children,
                    );
                } else {
                    refit_bottom(id(i), &push, &list, &lights, &nodes, &mut children);
                }
            }
            let push = RefitPush {
                first,
                count,
                top: TOP,
            };
            (0..64).for_each(|i| refit_nodes(id(i), &push, &list, &children, &mut nodes));
        }
        assert_eq!(nodes, expected);
    }

    /// A buffer of children with one place too few, a count beyond the list: nothing else is written.
    #[test]
    fn what_has_no_room_is_left_out() {
        let (mut nodes, lights, _) = arrays();
        let before = nodes.clone();
        let mut children = vec![[[7; WIDTH]; PLAIN_ROWS]; 1];
        let push = RefitPush {
            first: 0,
            count: u32::MAX,
            top: TOP,
        };
        for i in 0..64 {
            let id = UVec3::new(i, 0, 0);
            refit_bottom(id, &push, &[2, 1], &lights, &nodes, &mut children);
        }
        for i in 0..64 {
            refit_nodes(UVec3::new(i, 0, 0), &push, &[2, 1], &children, &mut nodes);
        }
        assert_eq!(nodes[2], refit::bottom(&before, &lights, 2));
        assert_ne!(nodes[2], before[2]);
        assert_eq!((nodes[0], nodes[1]), (before[0], before[1]));
    }
}

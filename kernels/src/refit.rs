//! Passes `refit_bottom`, `refit_top`, `refit_nodes`: new summaries bottom-up (paper section 3.4) of the nodes listed, so
//! that only what changed costs anything. A level is two dispatches: one invocation for each child of its nodes, then one for each node. A
//! barrier stands between dispatches.

use glam::UVec3;
use lightbvh::refit::{self, Children, PLAIN_ROWS};
use lightbvh::{EmissiveTriangle, Instance};
use spirv_std::spirv;

use crate::bvh::{Node, PaperNode, WIDTH};
use crate::invocation;
pub use crate::passes::RefitPush;

refit_passes!(
    Node,
    WIDTH,
    PLAIN_ROWS,
    EmissiveTriangle,
    refit_bottom = "refit_bottom",
    refit_top = "refit_top",
    refit_nodes = "refit_nodes"
);
refit_passes!(
    PaperNode,
    4,
    PLAIN_ROWS,
    EmissiveTriangle,
    refit_bottom_eq4 = "refit_bottom_eq4",
    refit_top_eq4 = "refit_top_eq4",
    refit_nodes_eq4 = "refit_nodes_eq4"
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
        for i in [4, 3] {
            expected[i as usize] = refit::top(&expected, TOP, &lights, &instances, i);
        }

        let list = [77, 1, 5, 2, 0, u32::MAX, 4, 3];
        let mut children = vec![[[0; WIDTH]; PLAIN_ROWS]; 3];
        let id = |i: u32| UVec3::new(i, 0, 0);
        for (first, count, is_top) in [(1, 3, false), (4, 1, false), (5, 2, true), (7, 1, true)] {
            let width = WIDTH as u32;
            let push = RefitPush {
                first,
                count: count * width,
                top: TOP,
            };
            for i in 0..64 {
                if is_top {
                    refit_top(id(i), &push, &list, &lights, &instances, &nodes, &mut children);
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

//! The arrays of a built tree, without the bounds that a refit computes.

use bytemuck::Zeroable;
use lightbvh::refit::BlasRoot;
use lightbvh::{LightNode, Lights};
use lightbvh_host::backend::Bvh;
use lightbvh_kernels::bvh::{Node, TreePush, WIDTH};

use super::passes::passes_of;
use crate::known::tree::Tree;

/// The arrays of a built tree, without bounds.
pub(super) fn of_bvh(bvh: &Bvh, lights: &Lights) -> Tree {
    let tree = bvh.tree();
    let roots = without_root_bounds(bvh.roots());
    Tree {
        nodes: without_bounds(tree.nodes),
        triangles: lights.triangles().to_vec(),
        meshes_of_lights: lights.triangles().iter().map(|t| t.mesh).collect(),
        instances: tree.meshes.to_vec(),
        passes: passes_of(tree.nodes, &roots, tree.root, bvh.is_two_level()),
        roots,
        trails: tree.trails.to_vec(),
        push: TreePush {
            root: tree.root,
            trail_words: tree.trail_words,
            two_level: u32::from(bvh.is_two_level()),
        },
        samples: Vec::new(),
        pmfs: Vec::new(),
    }
}

/// The nodes with kinds and links alone.
pub(super) fn without_bounds(nodes: &[Node]) -> Vec<Node> {
    let mut out = nodes.to_vec();
    for node in &mut out {
        for slot in 0..WIDTH {
            node.set_child(slot, node.kind(slot), node.link(slot));
        }
    }
    out
}

pub(super) fn without_root_bounds(roots: &[BlasRoot]) -> Vec<BlasRoot> {
    let without = |root: &BlasRoot| BlasRoot {
        node: root.node,
        ..BlasRoot::zeroed()
    };
    roots.iter().map(without).collect()
}

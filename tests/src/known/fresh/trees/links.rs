//! The arrays of a built tree, without the summaries that a refit computes.

use bytemuck::Zeroable;
use lightbvh::TreeWords;
use lightbvh::refit::BlasRoot;
use lightbvh::{Bvh, LightNode, Lights};

use super::passes::passes_of;
use crate::known::tree::Tree;

/// The arrays of a built tree, without summaries.
pub(super) fn of_bvh<N: LightNode<W>, const W: usize>(bvh: &Bvh<N, (), W>, lights: &Lights) -> Tree<N, W> {
    let tree = bvh.tree();
    let roots = links_of_roots(bvh.roots());
    Tree {
        nodes: links_of_nodes(tree.nodes),
        triangles: lights.triangles().to_vec(),
        meshes_of_lights: lights.triangles().iter().map(|t| t.mesh).collect(),
        instances: tree.instances.to_vec(),
        passes: passes_of(tree.nodes, &roots, tree.root, !bvh.is_single_level()),
        roots,
        trails: tree.trails.to_vec(),
        push: TreeWords::of(&tree),
        samples: Vec::new(),
        pmfs: Vec::new(),
    }
}

/// The nodes with kinds and links alone.
pub(super) fn links_of_nodes<N: LightNode<W>, const W: usize>(nodes: &[N]) -> Vec<N> {
    let links = |node: &N| {
        let mut out = N::EMPTY;
        for slot in 0..W {
            out.set_child(slot, node.kind(slot), node.link(slot));
        }
        out
    };
    nodes.iter().map(links).collect()
}

/// The roots with their nodes alone.
pub(super) fn links_of_roots(roots: &[BlasRoot]) -> Vec<BlasRoot> {
    let without = |root: &BlasRoot| BlasRoot {
        node: root.node,
        ..BlasRoot::zeroed()
    };
    roots.iter().map(without).collect()
}

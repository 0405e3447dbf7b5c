//! Refit: new bounds on an unchanged topology, bottom-up (paper section 3.4).
//!
//! Every function takes the nodes as they are and returns one node anew, so that the CPU and the kernels run the same
//! body and each node is written by one invocation. The order of passes: [`leaves`] over all nodes of the bottom
//! levels; [`level`] from the deepest level to the roots; [`mesh_leaves`] over all nodes of the top level; [`level`] again
//! over the top level. Children are merged in slot order, so no order of execution shows in the bits.

use crate::bounds::LightBounds;
use crate::light::EmissiveTriangle;
use crate::node::{LightNode, kind};
use crate::tree::MeshLight;

/// Node `index` with the bounds of its triangle children taken from the triangles.
#[must_use]
pub fn leaves<N: LightNode<W>, const W: usize>(nodes: &[N], triangles: &[EmissiveTriangle], index: u32) -> N {
    let mut node = nodes[index as usize];
    for slot in 0..W {
        let link = node.link(slot);
        if node.kind(slot) == kind::LIGHT && link < triangles.len() as u32 {
            node.set_bounds(slot, &LightBounds::of_triangle(&triangles[link as usize]));
        }
    }
    node
}

/// Node `index` with the bounds of its inner children merged from the children's own children.
#[must_use]
pub fn level<N: LightNode<W>, const W: usize>(nodes: &[N], index: u32) -> N {
    let mut node = nodes[index as usize];
    for slot in 0..W {
        let link = node.link(slot);
        if node.kind(slot) == kind::INNER && link < nodes.len() as u32 {
            let merged = nodes[link as usize].merged();
            node.set_bounds(slot, &merged);
        }
    }
    node
}

/// Top-level node `index` with the bounds of its mesh children taken from the roots of their bottom levels.
#[must_use]
pub fn mesh_leaves<N: LightNode<W>, const W: usize>(nodes: &[N], meshes: &[MeshLight], index: u32) -> N {
    let mut node = nodes[index as usize];
    for slot in 0..W {
        let link = node.link(slot);
        if node.kind(slot) == kind::MESH && link < meshes.len() as u32 {
            let root = meshes[link as usize].root;
            if root < nodes.len() as u32 {
                let merged = nodes[root as usize].merged();
                node.set_bounds(slot, &merged);
            }
        }
    }
    node
}

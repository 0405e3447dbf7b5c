//! Refit without levels: from each lowest node upward, each node by whoever comes to it last.
//!
//! An invocation computes a node and goes on to the node above, where it counts as arrived; all but the last to arrive end
//! there (Karras, "Maximizing parallelism in the construction of BVHs, octrees, and k-d trees", HPG 2012, section 4). A tree
//! is then refitted by one dispatch. Who is last differs from run to run, what is computed does not: children are merged
//! in slot order, as in [`refit::level`](crate::refit::level).

#[cfg(feature = "alloc")]
use alloc::vec::Vec;

use bytemuck::{Pod, Zeroable};

use crate::bounds::LightBounds;
use crate::light::EmissiveTriangle;
use crate::node::{LightNode, kind};
use crate::refit::BlasRoot;
#[cfg(feature = "alloc")]
use crate::tree::INVALID;
use crate::tree::MeshLeaf;

/// A node to be refitted.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
pub struct Step {
    /// Its index.
    pub node: u32,
    /// Index of the step of the node above it, or [`INVALID`](crate::INVALID).
    pub parent: u32,
    /// How many steps have this one as their parent: the arrivals that it waits for.
    pub children: u32,
}

/// Node `index` of a bottom level with all its bounds anew: what [`refit::leaves`](crate::refit::leaves) and then
/// [`refit::level`](crate::refit::level) make of it.
#[must_use]
pub fn bottom<N: LightNode<W>, const W: usize>(nodes: &[N], triangles: &[EmissiveTriangle], index: u32) -> N {
    let mut node = nodes[index as usize];
    for slot in 0..W {
        let (to, link) = (node.kind(slot), node.link(slot));
        let mut bounds = LightBounds::EMPTY;
        let mut known = false;
        if to == kind::LIGHT && link < triangles.len() as u32 {
            bounds = LightBounds::of_triangle(&triangles[link as usize]);
            known = true;
        }
        if to == kind::INNER && link < nodes.len() as u32 {
            bounds = nodes[link as usize].merged();
            known = true;
        }
        if known {
            node.set_bounds(slot, &bounds);
        }
    }
    node
}

/// Node `index` of the top level with all its bounds anew: what [`refit::mesh_leaves`](crate::refit::mesh_leaves) and then
/// [`refit::level`](crate::refit::level) make of it.
#[must_use]
pub fn top<N: LightNode<W>, L: MeshLeaf, const W: usize>(
    nodes: &[N],
    meshes: &[L],
    roots: &[BlasRoot],
    index: u32,
) -> N {
    let mut node = nodes[index as usize];
    for slot in 0..W {
        let (to, link) = (node.kind(slot), node.link(slot));
        let mut bounds = LightBounds::EMPTY;
        let mut known = false;
        if to == kind::MESH && link < meshes.len() as u32 {
            let blas = meshes[link as usize].blas();
            if blas < roots.len() as u32 {
                bounds = meshes[link as usize].to_world(&roots[blas as usize].bounds());
                known = true;
            }
        }
        if to == kind::INNER && link < nodes.len() as u32 {
            bounds = nodes[link as usize].merged();
            known = true;
        }
        if known {
            node.set_bounds(slot, &bounds);
        }
    }
    node
}

/// By node: the node above it in the same tree, or [`INVALID`]. Links out of range are left out.
#[cfg(feature = "alloc")]
#[must_use]
pub fn parents<N: LightNode<W>, const W: usize>(nodes: &[N]) -> Vec<u32> {
    let mut parents = alloc::vec![INVALID; nodes.len()];
    for (i, node) in (0..).zip(nodes) {
        for slot in (0..W).filter(|&slot| node.kind(slot) == kind::INNER) {
            if let Some(parent) = parents.get_mut(node.link(slot) as usize) {
                *parent = i;
            }
        }
    }
    parents
}

/// Appends the steps that refit `nodes` to `steps`, those that wait for no other first, and returns their number: where a
/// climb starts. `nodes` may be in any order and repeat; the nodes above them that are not among them are left as they are.
/// `parents` is as [`parents`] makes it.
#[cfg(feature = "alloc")]
pub fn plan(parents: &[u32], mut nodes: Vec<u32>, steps: &mut Vec<Step>) -> u32 {
    nodes.sort_unstable();
    nodes.dedup();
    let place = |node: u32| nodes.binary_search(&node).ok();
    let above: Vec<Option<usize>> = nodes
        .iter()
        .map(|&node| parents.get(node as usize).and_then(|&parent| place(parent)))
        .collect();
    let mut children = alloc::vec![0; nodes.len()];
    for &parent in above.iter().flatten() {
        children[parent] += 1;
    }
    let first = steps.len() as u32;
    let starts = children.iter().filter(|&&count| count == 0).count() as u32;
    let (mut start, mut inner) = (first, first + starts);
    let at: Vec<u32> = children
        .iter()
        .map(|&count| {
            let next = if count == 0 { &mut start } else { &mut inner };
            *next += 1;
            *next - 1
        })
        .collect();
    let filler = Step {
        node: INVALID,
        parent: INVALID,
        children: 0,
    };
    steps.resize(first as usize + nodes.len(), filler);
    for (i, &node) in nodes.iter().enumerate() {
        steps[at[i] as usize] = Step {
            node,
            parent: above[i].map_or(INVALID, |parent| at[parent]),
            children: children[i],
        };
    }
    starts
}

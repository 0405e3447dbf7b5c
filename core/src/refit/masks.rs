//! The masks of a node's children: unions over the lights below that have flux.
//!
//! A union is exact, so a child has a bit just where a light below it with flux has that bit. A walk that keeps to children with a common bit
//! comes to no dead end.

use super::BlasRoot;
use crate::instance::Instance;
use crate::light::Light;
use crate::node::{Node, kind};

/// The masks of the children of a bottom level's `node`, for [`Node::set_masks`]. Node `first` and those after it stand in `nodes`.
#[inline(always)]
pub(crate) fn masks_below<N: Node<W>, const W: usize>(
    nodes: &[N],
    first: u32,
    triangles: &[N::Light],
    node: &N,
) -> [u32; W] {
    let mut masks = [0; W];
    if N::HAS_MASKS {
        for slot in 0..W {
            let (to, link) = (node.kind(slot), node.link(slot));
            let below = link.wrapping_sub(first);
            if to == kind::LIGHT && link < triangles.len() as u32 {
                masks[slot] = triangles[link as usize].mask();
            } else if to == kind::INNER && below < nodes.len() as u32 {
                masks[slot] = nodes[below as usize].merged_mask();
            }
        }
    }
    masks
}

/// The masks of the children of the top level's `node`.
#[inline(always)]
pub(super) fn masks_of_top<N: Node<W>, const W: usize>(
    nodes: &[N],
    instances: &[Instance],
    roots: &[BlasRoot],
    node: &N,
) -> [u32; W] {
    let mut masks = [0; W];
    if N::HAS_MASKS {
        for slot in 0..W {
            let (to, link) = (node.kind(slot), node.link(slot));
            if to == kind::MESH && link < instances.len() as u32 {
                let blas = instances[link as usize].blas;
                if blas < roots.len() as u32 {
                    masks[slot] = mask_of_root(nodes, &roots[blas as usize]);
                }
            } else if to == kind::INNER && link < nodes.len() as u32 {
                masks[slot] = nodes[link as usize].merged_mask();
            }
        }
    }
    masks
}

/// The union of the masks below the root of a bottom level. It stands in the node alone, so that the records of roots are the same without masks.
#[inline(always)]
pub(crate) fn mask_of_root<N: Node<W>, const W: usize>(nodes: &[N], root: &BlasRoot) -> u32 {
    if root.node < nodes.len() as u32 {
        nodes[root.node as usize].merged_mask()
    } else {
        0
    }
}

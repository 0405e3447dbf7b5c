//! Refit on the CPU: whole trees in one sweep, lists node by node, long ones on several threads.
//!
//! The shared functions of [`refit`](crate::refit) are the definition, and give every word. Neither the order nor the threads
//! show in any bit.

#[cfg(feature = "rayon")]
use alloc::vec::Vec;
use core::ops::Range;

use crate::instance::Instance;
use crate::light::EmissiveTriangle;
use crate::node::LightNode;
use crate::refit::{self, BlasRoot, Room};

/// Shorter lists run on one thread.
#[cfg(feature = "rayon")]
const PARALLEL: usize = 2048;
/// Nodes that the threads compute before they are put in place: few enough to stay in a cache.
#[cfg(feature = "rayon")]
const BLOCK: usize = 1 << 14;
/// Nodes of one thread's piece of work.
#[cfg(feature = "rayon")]
const PIECE: usize = 256;

/// [`refit::bottom`] over `list`, whose nodes are all of one level.
pub fn bottom<N: LightNode<W>, const W: usize>(
    nodes: &mut [N],
    triangles: &[EmissiveTriangle],
    list: &[u32],
) {
    each(nodes, list, |nodes, index| refit::bottom(nodes, triangles, index));
}

/// [`refit::top`] over `list`, whose nodes are all of one level.
pub fn top<N: LightNode<W>, const W: usize>(
    nodes: &mut [N],
    instances: &[Instance],
    roots: &[BlasRoot],
    list: &[u32],
) {
    each(nodes, list, |nodes, index| {
        refit::top(nodes, instances, roots, index)
    });
}

/// [`refit::bottom`] over all nodes of a bottom level that stand in depth-first order: children before parents, from the last
/// to the first, so that memory is read in one direction.
pub fn bottom_sweep<N: LightNode<W>, const W: usize>(
    nodes: &mut [N],
    triangles: &[EmissiveTriangle],
    range: Range<u32>,
) {
    let mut room = Room::new();
    for index in range.rev() {
        refit::below(nodes, triangles, &nodes[index as usize], &mut room);
        nodes[index as usize].set_lanes(&room.children);
    }
}

fn each<N: Copy + Send + Sync>(nodes: &mut [N], list: &[u32], refitted: impl Fn(&[N], u32) -> N + Sync) {
    #[cfg(feature = "rayon")]
    if list.len() >= PARALLEL && rayon::current_num_threads() > 1 {
        return each_parallel(nodes, list, refitted);
    }
    for &index in list {
        nodes[index as usize] = refitted(nodes, index);
    }
}

#[cfg(feature = "rayon")]
fn each_parallel<N: Copy + Send + Sync>(
    nodes: &mut [N],
    list: &[u32],
    refitted: impl Fn(&[N], u32) -> N + Sync,
) {
    use rayon::prelude::*;

    let mut computed: Vec<N> = Vec::with_capacity(BLOCK.min(list.len()));
    for block in list.chunks(BLOCK) {
        let all = &*nodes;
        let new = block
            .par_iter()
            .with_min_len(PIECE)
            .map(|&index| refitted(all, index));
        new.collect_into_vec(&mut computed);
        for (&index, new) in block.iter().zip(&computed) {
            nodes[index as usize] = *new;
        }
    }
}

//! Refit on the CPU: whole trees in one sweep, large ones on several threads; lists node by node.
//!
//! The shared functions of [`refit`] are the definition, and give every word. Neither the order nor the threads
//! show in any bit.

#[cfg(feature = "rayon")]
use alloc::vec::Vec;

use crate::node::{Node, kind};
use crate::prefetch::fetch;
use crate::refit::{self, Room};
use crate::widest::widest;

/// Smaller trees run on one thread.
#[cfg(feature = "rayon")]
const PARALLEL: usize = 2048;

/// [`refit::bottom`] over all `nodes`, a tree in depth-first order whose root is node `first`. Children come before parents, from
/// the last node to the first, so that memory is read in one direction; subtrees go to several threads.
pub fn bottom_sweep<N: Node<W>, const W: usize>(nodes: &mut [N], first: u32, lights: &[N::Light]) {
    #[cfg(feature = "rayon")]
    if nodes.len() >= PARALLEL && rayon::current_num_threads() > 1 {
        return subtrees(nodes, first, lights, alloc::vec![first]);
    }
    one_by_one(nodes, nodes.len(), first, lights);
}

/// Nodes between the one computed and the one whose lights are asked for.
const AHEAD: usize = 4;

/// Asks for the lights that a node's refit will read.
#[inline(always)]
fn fetch_lights<N: Node<W>, const W: usize>(node: &N, lights: &[N::Light]) {
    if cfg!(feature = "std") {
        for slot in 0..W {
            if node.kind(slot) == kind::LIGHT {
                fetch(lights, node.link(slot));
            }
        }
    }
}

/// The first `count` nodes, from the last to the first; node `first` stands first.
fn one_by_one<N: Node<W>, const W: usize>(nodes: &mut [N], count: usize, first: u32, lights: &[N::Light]) {
    widest(
        #[inline(always)]
        || {
            let mut room = Room::<N::Light, W>::new();
            for index in (0..count).rev() {
                if let Some(soon) = index.checked_sub(AHEAD) {
                    fetch_lights(&nodes[soon], lights);
                }
                refit::below(nodes, first, lights, &nodes[index], &mut room);
                let limits = refit::limits_below(nodes, first, lights, &nodes[index], &room.children);
                nodes[index].set_lanes(&room.children);
                nodes[index].set_limits(&limits, &room.children);
            }
        },
    );
}

/// The subtrees that begin at nodes `starts` on several threads, then the nodes before them.
#[cfg(feature = "rayon")]
fn subtrees<N: Node<W>, const W: usize>(
    nodes: &mut [N],
    first: u32,
    lights: &[N::Light],
    mut starts: Vec<u32>,
) {
    use rayon::prelude::*;

    let end = first + nodes.len() as u32;
    starts.retain(|&start| first <= start && start < end);
    starts.sort_unstable();
    starts.dedup();
    let own = starts
        .first()
        .map_or(nodes.len(), |&start| (start - first) as usize);
    let mut rest = &mut nodes[own..];
    let mut pieces = Vec::with_capacity(starts.len());
    for (k, &start) in starts.iter().enumerate() {
        let next = starts.get(k + 1).map_or(end, |&next| next);
        let (piece, after) = rest.split_at_mut((next - start) as usize);
        pieces.push((start, piece));
        rest = after;
    }
    pieces.into_par_iter().for_each(|(start, piece)| {
        if piece.len() < PARALLEL {
            return one_by_one(piece, piece.len(), start, lights);
        }
        let root = piece[0];
        let links = (0..W).filter(|&slot| root.kind(slot) == kind::INNER);
        let links = links.map(|slot| root.link(slot)).filter(|&link| link > start);
        subtrees(piece, start, lights, links.collect());
    });
    one_by_one(nodes, own, first, lights);
}

#[cfg(all(test, feature = "rayon"))]
mod tests {
    use super::*;
    use crate::bvh::Cursor;
    use crate::kit::scenes::bare;
    use crate::light::EmissiveTriangle;
    use crate::{BuildParams, LightBvh, Lights, MomentNode};

    /// Subtrees in subtrees, each on the thread that is free.
    #[test]
    fn several_threads_write_the_words_of_one() {
        let light = |k: u32| {
            let [x, y, z] = [7, 31, 101].map(|by| (k * by % 499) as f32);
            EmissiveTriangle {
                p: [[x, y, z], [x + 1.0, y, z], [x, y + 1.0, z]],
                radiance: [1.0 + (k % 5) as f32; 3],
                mesh: 0,
                flags: 0,
            }
        };
        let lights = Lights::new((0..60_000).map(light).collect()).expect("in the domain");
        let bvh = LightBvh::single_level(&lights, &BuildParams::BALANCED);
        let nodes = &bvh.view().nodes()[..Cursor::default().plan(&bvh).bottom.nodes().len()];
        assert!(nodes.len() > 2 * PARALLEL);
        let bare: Vec<MomentNode<8>> = nodes.iter().map(bare).collect();
        for threads in 1..=3 {
            let pool = rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()
                .expect("threads");
            let mut swept = bare.clone();
            pool.install(|| bottom_sweep(&mut swept, 0, bvh.view().lights()));
            let words: [&[u32]; 2] = [bytemuck::cast_slice(&swept), bytemuck::cast_slice(nodes)];
            assert!(words[0] == words[1], "{threads} threads");
        }
    }
}

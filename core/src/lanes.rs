//! Refit on the CPU: as many children side by side as a node has slots, and long lists on several threads.
//!
//! The shared functions are the definition; here they are called in loops over arrays, each lane by itself, so that the
//! compiler can run the lanes in the processor's wide registers. Neither the grouping nor the threads show in any bit:
//! `tests/tests/lanes.rs` and every [`validate`](crate::Scene::validate) hold the words against [`refit`](crate::refit).

mod passes;
mod wide;

pub use passes::{leaves, level, mesh_leaves};

use self::passes::Pass;
use crate::node::LightNode;

/// Nodes of a list from which on threads are worth their start.
#[cfg(feature = "rayon")]
const PARALLEL: usize = 4096;
/// Nodes that the threads compute before they are put in place: few enough to stay in a cache.
#[cfg(feature = "rayon")]
const BLOCK: usize = 1 << 14;
/// Nodes of one thread's piece of work.
#[cfg(feature = "rayon")]
const PIECE: usize = 512;

/// Runs a pass over `list`, whose nodes do not depend on each other.
fn run<N: LightNode<W>, P: Pass<N, W>, const W: usize>(pass: &P, nodes: &mut [N], list: &[u32]) {
    #[cfg(feature = "rayon")]
    if list.len() >= PARALLEL && rayon::current_num_threads() > 1 {
        return run_parallel(pass, nodes, list);
    }
    passes::run(pass, &mut InPlace(nodes), list);
}

#[cfg(feature = "rayon")]
fn run_parallel<N: LightNode<W>, P: Pass<N, W>, const W: usize>(pass: &P, nodes: &mut [N], list: &[u32]) {
    use rayon::prelude::*;

    let mut computed = alloc::vec![N::EMPTY; BLOCK.min(list.len())];
    for block in list.chunks(BLOCK) {
        let all = &*nodes;
        let computed = &mut computed[..block.len()];
        computed
            .par_chunks_mut(PIECE)
            .zip(block.par_chunks(PIECE))
            .for_each(|(out, list)| {
                for (own, &i) in out.iter_mut().zip(list) {
                    *own = all[i as usize];
                }
                passes::run(pass, &mut Apart { all, out }, list);
            });
        for (&i, new) in block.iter().zip(computed) {
            nodes[i as usize] = *new;
        }
    }
}

/// Where the nodes of a list are read and written.
trait Target<N> {
    /// All nodes as they were before the pass; those of the list may be as they are now.
    fn all(&self) -> &[N];
    /// The node of the list's entry `entry`, which is node `node`.
    fn own(&mut self, entry: usize, node: u32) -> &mut N;
}

/// Each node where it is.
struct InPlace<'a, N>(&'a mut [N]);

impl<N> Target<N> for InPlace<'_, N> {
    #[inline(always)]
    fn all(&self) -> &[N] {
        self.0
    }

    #[inline(always)]
    fn own(&mut self, _entry: usize, node: u32) -> &mut N {
        &mut self.0[node as usize]
    }
}

/// Copies of the nodes, one by entry.
#[cfg(feature = "rayon")]
struct Apart<'a, N> {
    all: &'a [N],
    out: &'a mut [N],
}

#[cfg(feature = "rayon")]
impl<N> Target<N> for Apart<'_, N> {
    #[inline(always)]
    fn all(&self) -> &[N] {
        self.all
    }

    #[inline(always)]
    fn own(&mut self, entry: usize, _node: u32) -> &mut N {
        &mut self.out[entry]
    }
}

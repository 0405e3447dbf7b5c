//! Several walks at once.

use super::sample::{SampledLight, Started, begin};
use crate::importance::ImportanceModel;
use crate::node::Node;
use crate::point::Receiver;
use crate::random::Random64;
use crate::tree::LightTree;

/// Walks that take turns: enough to hide the latency of memory behind the others' arithmetic, few enough to stay in the first
/// cache.
const TURNS: usize = 8;

/// Chooses a light for each point by its random number, to the same words as one at a time.
///
/// Walks take turns, a node each, so that one computes while the next node of the others is on its way from memory: in
/// trees larger than the caches that is where the time goes.
#[inline(always)]
pub(super) fn sample_batch<N: Node<W>, I: ImportanceModel<N, W, P>, P: Receiver, const W: usize>(
    tree: &LightTree<'_, N, I, W>,
    points: &[P],
    randoms: &[Random64],
    sampled: &mut [SampledLight],
) {
    let queries = points.chunks(TURNS).zip(randoms.chunks(TURNS));
    for ((points, randoms), out) in queries.zip(sampled.chunks_mut(TURNS)) {
        let count = points.len().min(randoms.len()).min(out.len());
        let nothing = begin(tree, &points[0], randoms[0]);
        let mut walks = [nothing; TURNS];
        for k in 1..count {
            walks[k] = begin(tree, &points[k], randoms[k]);
        }
        turns(tree, &points[..count], &mut walks);
        for k in 0..count {
            out[k] = walks[k].end(tree);
        }
    }
}

/// Brings the first walks, one for each point, to their ends.
#[inline(always)]
fn turns<'a, N: Node<W>, I: ImportanceModel<N, W, P>, P: Receiver, const W: usize>(
    tree: &LightTree<'a, N, I, W>,
    points: &[P],
    walks: &mut [Started<'a, N, P>; TURNS],
) {
    let mut left = true;
    while left {
        left = false;
        for (walk, point) in walks.iter_mut().zip(points) {
            if !walk.walk.done {
                walk.walk.step(tree, point);
                left |= !walk.walk.done;
                walk.walk.fetch_node();
            }
        }
    }
}

//! Several walks at once: for a point each, or for one point.

use super::sample::{SampledLight, Started, begin, sample};
use super::walk::leading;
use crate::choose::{Share, choose};
use crate::importance::ImportanceModel;
use crate::node::Node;
use crate::point::Receiver;
use crate::random::Random64;
use crate::tree::LightTree;

/// Walks in a batch: one for each lane of a register; their states fit the first-level cache.
const TOGETHER: usize = 8;
/// The same of one point: the more, the more nodes are shared.
const OF_POINT: usize = 32;

/// Chooses a light for each point by its random number, to the same words as one at a time.
#[inline(always)]
pub(super) fn sample_batch<N: Node<W>, I: ImportanceModel<N, W, P>, P: Receiver, const W: usize>(
    tree: &LightTree<'_, N, I, W>,
    points: &[P],
    randoms: &[Random64],
    sampled: &mut [SampledLight],
) {
    let queries = points.chunks(TOGETHER).zip(randoms.chunks(TOGETHER));
    for ((points, randoms), out) in queries.zip(sampled.chunks_mut(TOGETHER)) {
        let count = points.len().min(randoms.len()).min(out.len());
        let query = |k: usize| (&points[k], randoms[k]);
        together::<N, I, P, _, W, TOGETHER, false>(tree, query, &mut out[..count]);
    }
}

/// See [`LightTree::sample_spaced`].
#[inline(always)]
pub(super) fn sample_spaced<N: Node<W>, I: ImportanceModel<N, W, P>, P: Receiver, const W: usize>(
    tree: &LightTree<'_, N, I, W>,
    point: &P,
    random: Random64,
    first: u32,
    count: u32,
    sampled: &mut [SampledLight],
) {
    let mut first = first;
    for out in sampled.chunks_mut(OF_POINT) {
        let query = |k: usize| (point, random.spaced(first.wrapping_add(k as u32), count));
        match out {
            [one] => *one = sample(tree, point, query(0).1),
            few if few.len() <= TOGETHER => together::<N, I, P, _, W, TOGETHER, true>(tree, query, few),
            _ => together::<N, I, P, _, W, OF_POINT, true>(tree, query, out),
        }
        first = first.wrapping_add(OF_POINT as u32);
    }
}

/// A light for each of at most `K` queries, one for each place of `sampled`. All walks go down a level before any goes on, phase by
/// phase: a processor overlaps the walks within each, chooses for all at once, and fetches their next nodes meanwhile. With
/// `SHARES` all points are one, and neighbours at one node evaluate it once.
#[inline(always)]
fn together<
    'q,
    N: Node<W>,
    I: ImportanceModel<N, W, P>,
    P: Receiver + 'q,
    Q: Fn(usize) -> (&'q P, Random64),
    const W: usize,
    const K: usize,
    const SHARES: bool,
>(
    tree: &LightTree<'_, N, I, W>,
    query: Q,
    sampled: &mut [SampledLight],
) {
    let count = sampled.len().min(K);
    if count == 0 {
        return;
    }
    // Start at the first number that wrapped past 1: in ascending order, walks at one node are neighbours.
    let passed = |k: &usize| SHARES && query(*k).1.high < query(0).1.high;
    let least = (1..count).find(passed).unwrap_or(0);
    let query = |k: usize| {
        query(if k + least < count {
            k + least
        } else {
            k + least - count
        })
    };
    let (point, random) = query(0);
    let mut walks = [begin(tree, point, random); K];
    for k in 1..count {
        let (point, random) = query(k);
        walks[k] = begin(tree, point, random);
    }
    let mut left = true;
    while left {
        left = false;
        // By child, then by walk.
        let mut weights = [[0.0; K]; W];
        let (mut ranges, mut numbers, mut follow, mut wanted) = ([0; K], [0; K], [false; K], [0; K]);
        for k in 0..count {
            let walk = &walks[k].walk;
            if walk.done {
                continue;
            }
            if SHARES && k > 0 && walk.is_with(&walks[k - 1].walk) {
                for of_child in &mut weights {
                    of_child[k] = of_child[k - 1];
                }
            } else {
                let own = I::weights_in(walk.node(tree), &walk.point, walk.space);
                for slot in 0..W {
                    weights[slot][k] = own[slot];
                }
            }
            (ranges[k], numbers[k]) = (walk.range, leading(walk.number));
            (follow[k], wanted[k]) = (walk.follow, walk.wanted::<W>());
        }
        let (mut slots, mut firsts, mut counts) = ([0; K], [0; K], [0; K]);
        for k in 0..K {
            let weight = |slot: usize| weights[slot][k];
            let share = choose::<W>(weight, ranges[k], numbers[k], follow[k], wanted[k]);
            (slots[k], firsts[k], counts[k]) = (share.slot, share.first, share.count);
        }
        for k in 0..count {
            let walk = &mut walks[k].walk;
            if !walk.done {
                let share = Share {
                    slot: slots[k],
                    first: firsts[k],
                    count: counts[k],
                };
                walk.descend(tree, query(k).0, walk.node(tree), share);
                walk.fetch_node();
                left |= !walk.done;
            }
        }
    }
    for (walk, out) in walks.iter().zip(&mut *sampled) {
        *out = Started::end(walk, tree);
    }
    sampled[..count].rotate_right(least);
}

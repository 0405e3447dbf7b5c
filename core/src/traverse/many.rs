//! Several lights for one point, by numbers at equal distances and one descent: nodes that the walks share are evaluated once.

use super::sample::{SampledLight, Started, begin, sample};
use super::walk::{leading, narrowed};
use crate::choose::Shares;
use crate::importance::ImportanceModel;
use crate::node::Node;
use crate::point::Receiver;
use crate::random::Random64;
use crate::tree::LightTree;

/// Walks that have come the same way.
#[derive(Clone, Copy)]
struct Group<'a, N, P> {
    /// Any of them.
    started: Started<'a, N, P>,
    /// The first of them; the numbers of all are in order, so others follow it.
    first: usize,
    count: usize,
}

/// Most walks that [`sample_spaced`] brings down together.
const TOGETHER: usize = 32;

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
    for together in sampled.chunks_mut(TOGETHER) {
        // Few walks are not worth writing the stack.
        match together {
            [one] => *one = sample(tree, point, random.spaced(first, count)),
            few if few.len() <= 8 => by_rows::<N, I, P, W, 8>(tree, point, random, first, count, few),
            _ => by_rows::<N, I, P, W, TOGETHER>(tree, point, random, first, count, together),
        }
        first = first.wrapping_add(TOGETHER as u32);
    }
}

/// At most `MOST` of them, with as few rows of four as the children need.
#[inline(always)]
pub(super) fn by_rows<
    N: Node<W>,
    I: ImportanceModel<N, W, P>,
    P: Receiver,
    const W: usize,
    const MOST: usize,
>(
    tree: &LightTree<'_, N, I, W>,
    point: &P,
    random: Random64,
    first: u32,
    count: u32,
    out: &mut [SampledLight],
) {
    let mut numbers = [random; MOST];
    for k in 0..out.len() {
        numbers[k] = random.spaced(first.wrapping_add(k as u32), count);
    }
    if W <= 4 {
        in_rows::<N, I, P, W, MOST, 1>(tree, point, &mut numbers, out);
    } else if W <= 8 {
        in_rows::<N, I, P, W, MOST, 2>(tree, point, &mut numbers, out);
    } else {
        in_rows::<N, I, P, W, MOST, 4>(tree, point, &mut numbers, out);
    }
}

/// A light for each of the first `numbers`, one for each place of `out`, with the children in `ROWS` rows of four.
#[inline(always)]
fn in_rows<
    N: Node<W>,
    I: ImportanceModel<N, W, P>,
    P: Receiver,
    const W: usize,
    const MOST: usize,
    const ROWS: usize,
>(
    tree: &LightTree<'_, N, I, W>,
    point: &P,
    numbers: &mut [Random64; MOST],
    out: &mut [SampledLight],
) {
    let count = out.len().min(MOST);
    // In ascending order: from the first on that has passed 1. Whatever the order, each walk gets its light; in this one those
    // that share nodes are neighbours.
    let passed = |k: &usize| numbers[*k].high < numbers[0].high;
    let least = (1..count).find(passed).unwrap_or(0);
    numbers[..count].rotate_left(least);
    let mut groups = [Group {
        started: begin(tree, point, numbers[0]),
        first: 0,
        count: 0,
    }; MOST];
    let mut open = 0;
    for k in 0..count {
        let started = begin(tree, point, numbers[k]);
        numbers[k] = started.walk.number;
        if started.walk.done {
            out[k] = started.end(tree);
        } else if open > 0 && !started.walk.follow && !groups[open - 1].started.walk.follow {
            groups[open - 1].count += 1;
        } else {
            groups[open] = Group {
                started,
                first: k,
                count: 1,
            };
            open += 1;
        }
    }
    // All groups go one level down before any goes on, so that their nodes are fetched meanwhile.
    let mut next = groups;
    while open > 0 {
        let mut left = 0;
        for group in &groups[..open] {
            let walk = &group.started.walk;
            let node = walk.node(tree);
            let shares = Shares::<ROWS>::of(&I::weights_in(node, &walk.point, walk.space), walk.range);
            let end = group.first + group.count;
            let mut k = group.first;
            let of = |number| shares.of_child::<W>(leading(number), walk.follow, walk.wanted::<W>());
            let mut share = of(numbers[k]);
            while k < end {
                let (slot, first) = (share.slot, share.first);
                let mut child = Group { first: k, ..*group };
                child.started.walk.number = numbers[k];
                let doublings = child.started.walk.descend(tree, point, node, share);
                numbers[k] = child.started.walk.number;
                k += 1;
                while k < end {
                    share = of(numbers[k]);
                    if share.slot != slot {
                        break;
                    }
                    numbers[k] = narrowed(numbers[k], first, doublings);
                    k += 1;
                }
                child.count = k - child.first;
                if child.started.walk.done {
                    let sampled = child.started.end(tree);
                    out[child.first..k].fill(sampled);
                } else {
                    child.started.walk.fetch_node();
                    next[left] = child;
                    left += 1;
                }
            }
        }
        core::mem::swap(&mut groups, &mut next);
        open = left;
    }
    out[..count].rotate_right(least);
}

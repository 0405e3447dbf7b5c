//! Several lights for one point, by numbers at equal distances and one descent: nodes that the walks share are evaluated once.

use super::choose::Shares;
use super::random::Random64;
use super::sample::{SampledLight, Started, begin};
use super::walk::{leading, narrowed};
use crate::importance::ImportanceModel;
use crate::node::LightNode;
use crate::point::ShadingPoint;
use crate::prefetch::fetch;
use crate::tree::LightTree;

/// Walks that have come the same way.
#[derive(Clone, Copy)]
struct Group {
    /// Any of them.
    started: Started,
    /// The first of them; the numbers of all are in order, so others follow it.
    first: usize,
    count: usize,
}

/// See [`LightTree::sample_many`].
#[inline(always)]
pub(super) fn sample_many<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize, const COUNT: usize>(
    tree: &LightTree<'_, N, I, W>,
    point: &ShadingPoint,
    random: Random64,
) -> [SampledLight; COUNT] {
    if W <= 4 {
        in_rows::<N, I, W, COUNT, 1>(tree, point, random)
    } else if W <= 8 {
        in_rows::<N, I, W, COUNT, 2>(tree, point, random)
    } else {
        in_rows::<N, I, W, COUNT, 4>(tree, point, random)
    }
}

/// [`sample_many`] with the children in `ROWS` rows of four.
#[inline(always)]
fn in_rows<
    N: LightNode<W>,
    I: ImportanceModel<N, W>,
    const W: usize,
    const COUNT: usize,
    const ROWS: usize,
>(
    tree: &LightTree<'_, N, I, W>,
    point: &ShadingPoint,
    random: Random64,
) -> [SampledLight; COUNT] {
    let mut out = [SampledLight::NONE; COUNT];
    let mut numbers = [random; COUNT];
    // In ascending order: from the first on that has passed 1.
    let mut least = 0;
    for k in 1..COUNT {
        numbers[k] = random.spaced(k as u32, COUNT as u32);
        if least == 0 && numbers[k].high < random.high {
            least = k;
        }
    }
    numbers.rotate_left(least);
    let mut groups = [Group {
        started: begin(tree, point, random),
        first: 0,
        count: 0,
    }; COUNT];
    let mut open = 0;
    for k in 0..COUNT {
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
            let shares = Shares::<ROWS>::of(&I::weights(node, &walk.point), walk.range);
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
                    fetch(tree.nodes, child.started.walk.index);
                    next[left] = child;
                    left += 1;
                }
            }
        }
        core::mem::swap(&mut groups, &mut next);
        open = left;
    }
    out.rotate_right(least);
    out
}

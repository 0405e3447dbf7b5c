//! Several lights for one point by adaptive splitting: the other way to [`sample_many`](crate::LightTree::sample_many)'s.

use super::choose::{FULL, Share};
use super::random::Random64;
use super::sample::{SampledLight, light_of};
use super::walk::Walk;
use crate::exact::{self, pow2};
use crate::importance::ImportanceModel;
use crate::node::Node;
use crate::point::ShadingPoint;
use crate::summary::Summary;
use crate::trail::Path;
use crate::tree::{INVALID, LightTree};
use crate::vector::{flush3, length_squared};

/// Parts of the weight, gains and variances count as zero below this: 2^-120.
const LEAST_GAIN: f32 = pow2(-120);

/// A subtree that gets a light of its own.
#[derive(Clone, Copy)]
struct Subtree {
    /// At its root, or at the one light that it is.
    walk: Walk,
    /// Its part of the weight at the root of the tree.
    part: f32,
    /// How much there is to be gained by splitting it; 0 where that cannot be.
    gain: f32,
}

/// See [`LightTree::sample_split`].
#[inline(always)]
pub(super) fn sample_split<N: Node<W>, I: ImportanceModel<N, W>, const W: usize, const MOST: usize>(
    tree: &LightTree<'_, N, I, W>,
    point: &ShadingPoint,
    random: Random64,
) -> ([SampledLight; MOST], usize) {
    let root = Walk::start(tree, point, random, 0, false, Path::default());
    let mut subtrees = [Subtree {
        walk: root,
        part: 1.0,
        gain: if root.done { 0.0 } else { 1.0 },
    }; MOST];
    let mut count = 1;
    while let Some(k) = greatest(&subtrees[..count]) {
        let parent = subtrees[k];
        subtrees[k].gain = 0.0;
        let node = parent.walk.node(tree);
        let weights = I::weights_in(node, &parent.walk.point, parent.walk.slack);
        let (mut sum, mut children) = (0.0, 0);
        for slot in 0..W {
            sum += exact::max(weights[slot], 0.0);
            children += usize::from(weights[slot] > 0.0);
        }
        if children == 0 || count + children - 1 > MOST {
            continue;
        }
        // The first child takes its parent's place.
        let mut place = k;
        for slot in 0..W {
            if weights[slot] > 0.0 {
                let part = exact::flush(parent.part * exact::div(weights[slot], sum), LEAST_GAIN);
                let mut walk = parent.walk;
                // All numbers lead to each child.
                let share = Share {
                    slot: slot as u32,
                    first: 0,
                    count: FULL,
                };
                walk.descend(tree, point, node, share);
                let spread = relative_spread(&node.summary(slot), &parent.walk.point);
                subtrees[place] = Subtree {
                    walk,
                    part,
                    gain: if walk.done {
                        0.0
                    } else {
                        exact::flush(part * spread, LEAST_GAIN)
                    },
                };
                place = count;
                count += 1;
            }
        }
        count -= 1;
    }
    let mut sampled = [SampledLight::NONE; MOST];
    let mut found = 0;
    for k in 0..count {
        let mut walk = subtrees[k].walk;
        walk.number = random.spaced(k as u32, count as u32);
        while !walk.done {
            walk.step(tree, point);
        }
        if walk.triangle != INVALID {
            sampled[found] = SampledLight {
                light: light_of(tree, walk.triangle, walk.instance),
                instance: tree.instance_of(walk.instance),
                pmf: walk.probability(),
            };
            found += 1;
        }
    }
    (sampled, found)
}

/// The subtree with the greatest gain, where any has one.
#[inline(always)]
fn greatest(subtrees: &[Subtree]) -> Option<usize> {
    let mut found = None;
    let mut most = 0.0;
    for (k, subtree) in subtrees.iter().enumerate() {
        if subtree.gain > most {
            most = subtree.gain;
            found = Some(k);
        }
    }
    found
}

/// Variance of the lights' positions against their squared distance, 0 to 1: how much a weight that is a mean may be off.
#[inline(always)]
fn relative_spread<S: Summary>(summary: &S, point: &ShadingPoint) -> f32 {
    // No square is subnormal.
    let away = flush3(summary.center() - point.position(), pow2(-62));
    let spread = exact::flush(summary.spread(), LEAST_GAIN);
    let squared = length_squared(away) + spread;
    if squared > 0.0 { spread / squared } else { 1.0 }
}

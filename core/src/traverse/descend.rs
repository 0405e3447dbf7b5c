//! One way down, chosen at random or followed.

use super::dead::Neighbor;
use crate::exact::{self, hash};
use crate::importance::ImportanceModel;
use crate::node::{LightNode, kind};
use crate::point::ShadingPoint;
use crate::trail::{Path, max_levels};
use crate::tree::{INVALID, LightTree};

/// How a descent chooses.
#[derive(Clone, Copy)]
pub(super) struct Guide {
    /// Follow `path` (else choose at random).
    pub follow: bool,
    /// The way to follow.
    pub path: Path,
    /// Random bits for choosing.
    pub random: u32,
}

/// Where a descent ended, and what it saw on its way.
#[derive(Clone, Copy)]
pub(super) struct Descent {
    /// The triangle reached, or [`INVALID`].
    pub light: u32,
    /// The mesh light passed, or [`INVALID`].
    pub mesh: u32,
    /// Position of the node that links to that mesh light.
    pub mesh_position: u32,
    /// Product of the probabilities of the choices; zero once a followed way has none.
    pub pmf: f32,
    /// The way taken.
    pub path: Path,
    /// Deepest child left of the way that has importance.
    pub left: Neighbor,
    /// Deepest child right of the way that has importance.
    pub right: Neighbor,
}

/// A pmf never falls below 2^-120: a light less probable than that is never drawn, and must not seem impossible.
const MIN_PMF: f32 = exact::pow2(-120);

pub(super) fn descend<N: LightNode<W>, I: ImportanceModel, const W: usize>(
    tree: &LightTree<'_, N>,
    point: &ShadingPoint,
    guide: &Guide,
) -> Descent {
    let mut out = Descent {
        light: INVALID,
        mesh: INVALID,
        mesh_position: 0,
        pmf: 1.0,
        path: guide.path,
        left: Neighbor::NONE,
        right: Neighbor::NONE,
    };
    let mut index = tree.root;
    let mut position = 0;
    let mut done = false;
    // A single exit at the head, no early return: rust-gpu miscompiles some of the others (spirt issue 31).
    let mut steps = 2 * max_levels(W);
    while !done && steps > 0 {
        steps -= 1;
        // An index out of range (hostile words) reads node 0 and ends the descent.
        let valid = index < tree.nodes.len() as u32;
        let node = &tree.nodes[if valid { index as usize } else { 0 }];
        let (weights, sum) = node.weights::<I>(point);
        let alive = valid && sum > 0.0;
        let chosen = if guide.follow {
            guide.path.slot::<W>(position)
        } else {
            choose(&weights, guide.random, position)
        };

        let mut weight = 0.0;
        let mut to = kind::EMPTY;
        let mut link = 0;
        for slot in 0..W {
            let w = weights[slot];
            if slot as u32 == chosen {
                weight = w;
                to = node.kind(slot);
                link = node.link(slot);
            } else if alive && w > 0.0 {
                // Slots come in order: the last before the chosen is nearest on the left, the first after it on
                // the right.
                let before = (slot as u32) < chosen;
                let nearer = before || out.right.position != position || out.right.is_none();
                if nearer {
                    let neighbor = Neighbor {
                        kind: node.kind(slot),
                        link: node.link(slot),
                        mesh: out.mesh,
                        position,
                        slot: slot as u32,
                        before: out.pmf,
                        weight: w,
                        sum,
                    };
                    if before {
                        out.left = neighbor;
                    } else {
                        out.right = neighbor;
                    }
                }
            }
        }

        let passes = alive && weight > 0.0;
        if passes {
            out.pmf = exact::max(out.pmf * exact::div(weight, sum), MIN_PMF);
            out.path = out.path.with::<W>(position, chosen);
        } else {
            out.pmf = 0.0;
        }
        done = !passes;
        if passes && to == kind::LIGHT {
            out.light = link;
            done = true;
        }
        let (next, next_position, mesh) = enter::<N, W>(tree, to, link, position, out.mesh);
        out.mesh_position = if mesh != out.mesh {
            position
        } else {
            out.mesh_position
        };
        out.mesh = mesh;
        index = next;
        position = next_position;
    }
    out
}

/// The node behind a child, its position, and the mesh light passed on the way.
#[inline(always)]
pub(super) fn enter<N: LightNode<W>, const W: usize>(
    tree: &LightTree<'_, N>,
    to: u32,
    link: u32,
    position: u32,
    mesh: u32,
) -> (u32, u32, u32) {
    let levels = max_levels(W);
    // Running off the end of a tree's levels (hostile words only) must not look like the next tree's first level.
    let last_of_tree = position + 1 == levels || position + 1 == 2 * levels;
    if to == kind::MESH && position < levels && link < tree.meshes.len() as u32 {
        (tree.meshes[link as usize].root, levels, link)
    } else if to == kind::INNER && !last_of_tree {
        (link, position + 1, mesh)
    } else {
        (INVALID, position, mesh)
    }
}

/// A slot with probability weight / sum, by one two-way choice per slot: each weight against all before it.
///
/// The smaller side of a choice is taken when `u · both < smaller`, with a `u` that resolves 2^-64: so a side of tiny
/// probability is neither starved nor favoured. Every choice takes fresh bits, so they do not run dry in deep trees.
#[inline(always)]
fn choose<const W: usize>(weights: &[f32; W], random: u32, position: u32) -> u32 {
    let mut chosen = 0;
    let mut before = weights[0];
    for slot in 1..W {
        let w = weights[slot];
        let both = before + w;
        let u =
            dense_unit(random.wrapping_add((position * W as u32 + slot as u32).wrapping_mul(0x9e37_79b9)));
        let later = if w <= before {
            u * both < w
        } else {
            u * both >= before
        };
        chosen = if later { slot as u32 } else { chosen };
        before = both;
    }
    chosen
}

/// A uniform number in `[0, 1)` with 24 significant bits at any magnitude down to 2^-64; truncated, so below 1.
#[inline(always)]
fn dense_unit(seed: u32) -> f32 {
    let high = hash(seed);
    // The first 24 bits suffice unless they start with zeros; then bits of a second hash follow them.
    let low = if high < 0x0100_0000 {
        hash(seed ^ 0x5bd1_e995)
    } else {
        0
    };
    let zeros = if high == 0 {
        32 + low.leading_zeros()
    } else {
        high.leading_zeros()
    };
    // The 24 bits from the first one on.
    let shift = zeros & 31;
    let (first, second) = if zeros < 32 { (high, low) } else { (low, 0) };
    let window = if shift == 0 {
        first
    } else {
        (first << shift) | (second >> (32 - shift))
    };
    let value = (window >> 8) as i32 as f32;
    // window/2^32 in [1/2, 1) times 2^-zeros.
    if zeros >= 64 {
        0.0
    } else {
        value * exact::pow2(-24 - zeros as i32)
    }
}

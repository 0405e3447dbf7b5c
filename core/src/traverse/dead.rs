//! Dead branches: children of positive importance below which no light can be reached.
//!
//! Let a child be *live* at a point when its importance is positive and it is a light, or a child of its node is live.
//! The probability of a maximal dead child (one whose node is live) passes on whole, to one light: the first reachable
//! light of the next live slot to its right, or, if there is none, the last reachable light of the next live slot to
//! its left. Seen from a light: it takes over its dead neighbours, leftwards up to the first live one, and rightwards
//! too where no live one follows among the siblings. Neighbours are mostly live and near, so one look on each side is
//! the usual cost.

use super::descend::{Descent, MIN_PMF, Start, enter};
use super::neighbor::Neighbor;
use super::search::{Found, find_live};
use crate::exact;
use crate::importance::ImportanceModel;
use crate::node::LightNode;
use crate::point::ShadingPoint;
use crate::trail::{Path, max_levels};
use crate::tree::{INVALID, LightTree, MeshLeaf};

/// The neighbour after `neighbor` on the same side of the way of `d`: the same node's next slot, or further up.
///
/// Nodes above are found by following links alone, which costs far less than importances. Their probabilities follow
/// from the neighbour's by undoing one choice per level, so that a walk from the root is not needed; the rounding is
/// the same whoever asks. Only where the least pmf has swallowed factors, so that nothing can be undone, the way is walked
/// again.
fn next_neighbor<N: LightNode<W>, I: ImportanceModel, L: MeshLeaf, const W: usize>(
    tree: &LightTree<'_, N, L>,
    point: &ShadingPoint,
    d: &Descent<W>,
    neighbor: &Neighbor<W>,
    right: bool,
) -> Neighbor<W> {
    let mut next = Neighbor::NONE;
    let mut position = neighbor.position;
    let mut slot = neighbor.slot;
    let mut before = neighbor.before;
    let mut mesh = neighbor.mesh;
    // The first node looked at is the neighbour's own; its probability and weights are known.
    let mut undo = false;
    let mut steps = 2 * max_levels(W);
    let mut done = neighbor.is_none();
    while !done && steps > 0 {
        steps -= 1;
        let swallowed = before <= MIN_PMF;
        let (mut index, mut reached) = (neighbor.index, 0.0);
        if undo {
            (index, reached) = node_at::<N, I, L, W>(tree, point, d.path, position, swallowed);
        }
        let node = &tree.nodes[index as usize];
        let (mut weights, mut sum) = (neighbor.weights, neighbor.sum);
        if undo {
            (weights, sum) = node.weights::<I, L::Local>(&tree.receiver(point, mesh));
            let mut taken = 0.0;
            for s in 0..W {
                taken = if s as u32 == slot { weights[s] } else { taken };
            }
            let undone = before * exact::div(sum, taken);
            before = if swallowed { reached } else { undone };
        }
        for i in 0..W {
            let s = if right { i } else { W - 1 - i };
            let beyond = if right { s as u32 > slot } else { (s as u32) < slot };
            if beyond && weights[s] > 0.0 && !done {
                next = Neighbor {
                    index,
                    kind: node.kind(s),
                    link: node.link(s),
                    mesh,
                    position,
                    slot: s as u32,
                    before,
                    weights,
                    sum,
                };
                done = true;
            }
        }
        done = done || position == 0;
        if !done {
            let at_bottom_root = position == max_levels(W);
            position = if at_bottom_root {
                d.mesh_position
            } else {
                position - 1
            };
            mesh = if at_bottom_root { INVALID } else { mesh };
            slot = d.path.slot::<W>(position);
            undo = true;
        }
    }
    next
}

/// Index of the node at `position` of a way that was taken before, and with `measure` the probability of reaching it.
fn node_at<N: LightNode<W>, I: ImportanceModel, L: MeshLeaf, const W: usize>(
    tree: &LightTree<'_, N, L>,
    point: &ShadingPoint,
    path: Path,
    position: u32,
    measure: bool,
) -> (u32, f32) {
    let (mut index, mut at) = (tree.root, 0);
    let (mut mesh, mut pmf) = (INVALID, 1.0);
    let mut steps = 2 * max_levels(W);
    while at != position && index < tree.nodes.len() as u32 && steps > 0 {
        steps -= 1;
        let slot = path.slot::<W>(at);
        let node = &tree.nodes[index as usize];
        let slot = if slot < W as u32 { slot as usize } else { 0 };
        if measure {
            let (weights, sum) = node.weights::<I, L::Local>(&tree.receiver(point, mesh));
            let mut weight = 0.0;
            for s in 0..W {
                weight = if s == slot { weights[s] } else { weight };
            }
            let alive = if sum > 0.0 { sum } else { 1.0 };
            pmf = exact::max(pmf * exact::div(weight, alive), MIN_PMF);
        }
        let (to, link) = (node.kind(slot), node.link(slot));
        let (next, next_position, next_mesh) = enter::<N, L, W>(tree, to, link, at, mesh);
        index = next;
        at = next_position;
        mesh = next_mesh;
    }
    // A way that was taken does not lead out of the nodes, unless another invocation changed them meanwhile.
    let within = index < tree.nodes.len() as u32;
    (if within { index } else { 0 }, pmf)
}

/// Slots of one node that are known to be dead or of no importance.
#[derive(Clone, Copy)]
pub(super) struct Dead {
    /// Position of the node.
    pub position: u32,
    /// The first of them.
    pub first: u32,
    /// The one after the last.
    pub end: u32,
}

impl Dead {
    /// Nothing is known.
    pub const UNKNOWN: Self = Self {
        position: 0,
        first: 0,
        end: 0,
    };

    #[inline(always)]
    fn holds<const W: usize>(&self, neighbor: &Neighbor<W>) -> bool {
        (neighbor.position == self.position) & (neighbor.slot >= self.first) & (neighbor.slot < self.end)
    }
}

/// The probability that the light at the end of `d` takes over from dead neighbours; `dead` saves searches.
pub(super) fn adopted<N: LightNode<W>, I: ImportanceModel, L: MeshLeaf, const W: usize>(
    tree: &LightTree<'_, N, L>,
    point: &ShadingPoint,
    d: &Descent<W>,
    dead: &Dead,
) -> f32 {
    let mut total = 0.0;
    // Left side first, then right, in one loop so that the kernel holds the search once.
    let mut right = false;
    let mut neighbor = d.left;
    // Dead slots to the right count once their node turns out to have no live one after them.
    let mut pending = 0.0;
    let mut pending_position = INVALID;
    let mut done = false;
    let mut steps = 4 * W as u32 * max_levels(W);
    while !done && steps > 0 {
        steps -= 1;
        let none = neighbor.is_none();
        let live = !none
            && !dead.holds(&neighbor)
            && find_live::<N, I, L, true, W>(tree, point, &neighbor, true).light != INVALID;
        if none || live {
            if right {
                total += if live && neighbor.position == pending_position {
                    0.0
                } else {
                    pending
                };
                done = true;
            } else {
                right = true;
                neighbor = d.right;
            }
        } else {
            if right {
                if neighbor.position != pending_position {
                    total += pending;
                    pending = 0.0;
                    pending_position = neighbor.position;
                }
                pending += neighbor.mass();
            } else {
                total += neighbor.mass();
            }
            neighbor = next_neighbor::<N, I, L, W>(tree, point, d, &neighbor, right);
        }
    }
    total
}

/// The light that takes over from the dead end of `d`, the slots that the search found dead beside it, and where to start
/// on the way to it.
pub(super) fn heir<N: LightNode<W>, I: ImportanceModel, L: MeshLeaf, const W: usize>(
    tree: &LightTree<'_, N, L>,
    point: &ShadingPoint,
    d: &Descent<W>,
) -> (Found, Dead, Start<W>) {
    let mut found = Found {
        light: INVALID,
        mesh: INVALID,
    };
    let mut dead = Dead::UNKNOWN;
    let mut neighbor = Neighbor::NONE;
    let (mut left, mut right) = (d.left, d.right);
    let mut done = false;
    let mut steps = 4 * W as u32 * max_levels(W);
    while !done && steps > 0 {
        steps -= 1;
        // The deeper neighbour is the nearer; of one node's slots, the right ones come first.
        let to_right = !right.is_none() && (left.is_none() || right.position >= left.position);
        neighbor = if to_right { right } else { left };
        found = find_live::<N, I, L, false, W>(tree, point, &neighbor, to_right);
        done = neighbor.is_none() || found.light != INVALID;
        // What was tried before in this node: from the way's own slot up to this one; or, coming back from the right,
        // all beyond this one.
        dead = Dead {
            position: neighbor.position,
            first: if to_right {
                d.path.slot::<W>(neighbor.position)
            } else {
                neighbor.slot.wrapping_add(1)
            },
            end: if to_right { neighbor.slot } else { W as u32 },
        };
        if !done {
            let next = next_neighbor::<N, I, L, W>(tree, point, d, &neighbor, to_right);
            if to_right {
                right = next;
            } else {
                left = next;
            }
        }
    }
    (found, dead, Start::beside(tree, d, &neighbor))
}

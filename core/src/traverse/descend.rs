//! One way down, chosen at random or followed.

use super::beside::Beside;
use super::choose::choose;
use super::neighbor::Neighbor;
use crate::exact;
use crate::importance::ImportanceModel;
use crate::node::{LightNode, kind};
use crate::point::ShadingPoint;
use crate::trail::{Path, max_levels};
use crate::tree::{INVALID, LightTree, MeshLeaf};

/// How a descent chooses.
#[derive(Clone, Copy)]
pub(super) struct Guide {
    /// The way to follow, with `FOLLOW`.
    pub path: Path,
    /// Random bits for choosing, without.
    pub random: u32,
}

/// Where a descent ended, and what it saw on its way.
#[derive(Clone, Copy)]
pub(super) struct Descent<const W: usize> {
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
    pub left: Neighbor<W>,
    /// Deepest child right of the way that has importance.
    pub right: Neighbor<W>,
}

/// A pmf never falls below 2^-120: a light less probable than that is never drawn, and must not seem impossible.
pub(super) const MIN_PMF: f32 = exact::pow2(-120);

/// Where a descent starts, and what lies beside the way so far.
#[derive(Clone, Copy)]
pub(super) struct Start<const W: usize> {
    index: u32,
    position: u32,
    mesh: u32,
    mesh_position: u32,
    pmf: f32,
    left: Beside<W>,
    right: Beside<W>,
}

impl<const W: usize> Start<W> {
    /// The root.
    #[inline(always)]
    pub fn root<N: LightNode<W>, L: MeshLeaf>(tree: &LightTree<'_, N, L>) -> Self {
        Self {
            index: tree.root,
            position: 0,
            mesh: INVALID,
            mesh_position: 0,
            pmf: 1.0,
            left: Beside::NONE,
            right: Beside::NONE,
        }
    }

    /// The node of `neighbor`, a child beside the way of `d`, for a way through that child: a descent from there ends as
    /// one from the root does, to the bit. The root where `d` does not know enough of that node or of what will lie beside
    /// the new way.
    #[inline(always)]
    pub fn beside<N: LightNode<W>, L: MeshLeaf>(
        tree: &LightTree<'_, N, L>,
        d: &Descent<W>,
        neighbor: &Neighbor<W>,
    ) -> Self {
        let (mut open_left, mut open_right) = (false, false);
        for slot in 0..W {
            let open = neighbor.weights[slot] > 0.0;
            open_left |= open & ((slot as u32) < neighbor.slot);
            open_right |= open & (slot as u32 > neighbor.slot);
        }
        // What `d` saw beside its way above that node, it saw beside the new way too; in the node itself it will be seen.
        let left_known = open_left | d.left.is_none() | (d.left.position < neighbor.position);
        let right_known = open_right | d.right.is_none() | (d.right.position < neighbor.position);
        // A neighbour further up may have had its probability reckoned backwards, rounded otherwise than on a descent; what
        // `d` has kept of the nodes that it passed is as it was then.
        let at_left = !d.left.is_none() & (d.left.position == neighbor.position);
        let at_right = !d.right.is_none() & (d.right.position == neighbor.position);
        if left_known & right_known & (at_left | at_right) {
            let in_mesh = neighbor.position >= max_levels(W);
            Self {
                index: neighbor.index,
                position: neighbor.position,
                mesh: if in_mesh { d.mesh } else { INVALID },
                mesh_position: if in_mesh { d.mesh_position } else { 0 },
                pmf: if at_left { d.left.before } else { d.right.before },
                left: Beside::of(&d.left),
                right: Beside::of(&d.right),
            }
        } else {
            Self::root(tree)
        }
    }
}

/// A way down from `start`, chosen at random or, with `FOLLOW`, followed.
pub(super) fn descend<
    N: LightNode<W>,
    I: ImportanceModel,
    L: MeshLeaf,
    const FOLLOW: bool,
    const W: usize,
>(
    tree: &LightTree<'_, N, L>,
    point: &ShadingPoint,
    guide: &Guide,
    start: &Start<W>,
) -> Descent<W> {
    let mut out = Descent {
        light: INVALID,
        mesh: start.mesh,
        mesh_position: start.mesh_position,
        pmf: start.pmf,
        path: guide.path,
        left: Neighbor::NONE,
        right: Neighbor::NONE,
    };
    let (mut left, mut right) = (start.left, start.right);
    let (mut index, mut position) = (start.index, start.position);
    let mut receiver = tree.receiver(point, start.mesh);
    let mut done = false;
    // A single exit at the head, no early return: rust-gpu miscompiles some of the others (spirt issue 31).
    let mut steps = 2 * max_levels(W);
    while !done && steps > 0 {
        steps -= 1;
        // An index out of range (hostile words) reads node 0 and ends the descent.
        let valid = index < tree.nodes.len() as u32;
        let node = &tree.nodes[if valid { index as usize } else { 0 }];
        let (weights, sum) = node.weights::<I, L::Local>(&receiver);
        let wanted = if FOLLOW {
            guide.path.slot::<W>(position)
        } else {
            choose(&weights, guide.random, position)
        };
        // A followed way may be hostile too.
        let within = wanted < W as u32;
        let chosen = if within { wanted } else { 0 };
        let alive = valid & within & (sum > 0.0);
        let (to, link) = (node.kind(chosen as usize), node.link(chosen as usize));

        // The slot chosen, and which side of it has importance, are random: masks, for selects would become branches.
        let mut weight = 0.0;
        let mut some = 0;
        for slot in 0..W {
            let w = weights[slot];
            weight = exact::masked(!exact::mask(slot as u32 ^ chosen), w, weight);
            some |= u32::from(w > 0.0) << slot;
        }
        let some = if alive { some } else { 0 };
        let here = Beside {
            index,
            position,
            before: out.pmf,
            weights,
            sum,
        };
        left.replace(some & ((1 << chosen) - 1), &here);
        right.replace(some >> chosen >> 1, &here);

        let passes = alive & (weight > 0.0);
        let product = exact::max(
            out.pmf * exact::div(weight, if alive { sum } else { 1.0 }),
            MIN_PMF,
        );
        out.pmf = if passes { product } else { 0.0 };
        if !FOLLOW {
            out.path = out.path.with::<W>(position, chosen);
        }
        let at_light = passes & (to == kind::LIGHT);
        out.light = if at_light { link } else { INVALID };
        done = at_light | !passes;
        let (next, next_position, mesh) = enter::<N, L, W>(tree, to, link, position, out.mesh);
        if mesh != out.mesh {
            out.mesh_position = position;
            receiver = tree.receiver(point, mesh);
        }
        out.mesh = mesh;
        index = next;
        position = next_position;
    }
    out.light = if out.light == INVALID {
        INVALID
    } else {
        tree.light_of(out.light, out.mesh)
    };
    out.left = left.nearest(tree, &out, false);
    out.right = right.nearest(tree, &out, true);
    out
}

/// The node behind a child, its position, and the mesh light passed on the way.
#[inline(always)]
pub(super) fn enter<N: LightNode<W>, L: MeshLeaf, const W: usize>(
    tree: &LightTree<'_, N, L>,
    to: u32,
    link: u32,
    position: u32,
    mesh: u32,
) -> (u32, u32, u32) {
    let levels = max_levels(W);
    // Running off the end of a tree's levels (hostile words only) must not look like the next tree's first level.
    let last_of_tree = position + 1 == levels || position + 1 == 2 * levels;
    if to == kind::MESH && position < levels && link < tree.meshes.len() as u32 {
        (tree.meshes[link as usize].root(), levels, link)
    } else if to == kind::INNER && !last_of_tree {
        (link, position + 1, mesh)
    } else {
        (INVALID, position, mesh)
    }
}

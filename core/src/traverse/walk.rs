//! One walk from the root to a light, chosen by a number or along a known path.

use crate::beam::Space;
use crate::choose::{FULL, FULL_BITS, Share, choose};
use crate::exact;
use crate::importance::ImportanceModel;
use crate::node::{Node, kind};
use crate::point::{Receiver, ShadingPoint};
use crate::random::Random64;
use crate::trail::{Path, leaf_parts, max_levels};
use crate::tree::{INVALID, LightTree};

/// Number of halvings after which a probability falls no further: it is never below 2^-99 where it is positive. Such a light
/// is never drawn, and must not seem impossible.
const MOST_HALVINGS: u32 = 98;

/// What a walk keeps of the nodes that it is among.
pub(super) trait Among<'a> {
    /// A device has one buffer and keeps no pointer; a word, for naga refuses empty structures.
    type Nodes: Copy;
}

impl<'a, N: 'a> Among<'a> for N {
    #[cfg(not(target_arch = "spirv"))]
    type Nodes = &'a [N];
    #[cfg(target_arch = "spirv")]
    type Nodes = u32;
}

/// The state of a walk.
///
/// The numbers that lead here are a range of integers, `0..range`, of which one is the number of this walk; `range` lies in
/// (2^21, 2^22]. Each choice cuts the range down to the child's share and doubles it until it is that long again, bits of
/// the number following in from below. So the range and the count of doublings are the probability, exactly.
#[derive(Clone, Copy)]
pub(super) struct Walk<'a, N: 'a, P = ShadingPoint> {
    /// The nodes of the current tree, kept to save a selection at each step.
    nodes: <N as Among<'a>>::Nodes,
    /// The node to look at.
    pub index: u32,
    /// The triangle reached, or [`INVALID`].
    pub triangle: u32,
    /// The instance passed, or [`INVALID`].
    pub instance: u32,
    /// Whether the walk has ended.
    pub done: bool,
    position: u32,
    /// The path to follow, with `follow`.
    path: Path,
    pub follow: bool,
    /// Its upper 22 bits are the number within the range.
    pub number: Random64,
    pub range: u32,
    halvings: u32,
    /// The point in the space of the node.
    pub point: P,
    /// The space of the node.
    pub space: Space,
    steps: u32,
}

impl<'a, N: 'a, P: Receiver> Walk<'a, N, P> {
    /// At the root, with the numbers from `taken` on; the others chose another way to a light. With `follow` along `path`.
    #[inline(always)]
    pub fn start<I, const W: usize>(
        tree: &LightTree<'a, N, I, W>,
        point: &P,
        number: Random64,
        taken: u32,
        follow: bool,
        path: Path,
    ) -> Self {
        let mut walk = Self {
            #[cfg(not(target_arch = "spirv"))]
            nodes: tree.top,
            #[cfg(target_arch = "spirv")]
            nodes: 0,
            index: tree.root.wrapping_add(tree.first),
            triangle: INVALID,
            instance: INVALID,
            done: tree.depth == 0,
            position: 0,
            path,
            follow,
            number,
            range: FULL,
            halvings: 0,
            point: *point,
            space: Space::WORLD,
            steps: tree.depth,
        };
        walk.narrow(taken, FULL - taken);
        walk
    }

    /// Goes one node down. `world` is the point in the world.
    #[inline(always)]
    pub fn step<I: ImportanceModel<N, W, P>, const W: usize>(
        &mut self,
        tree: &LightTree<'a, N, I, W>,
        world: &P,
    ) where
        N: Node<W>,
    {
        let node = self.node(tree);
        let weights = I::weights_in(node, &self.point, self.space);
        let share = choose::<W>(
            |slot| weights[slot],
            self.range,
            leading(self.number),
            self.follow,
            self.wanted::<W>(),
        );
        self.descend(tree, world, node, share);
    }

    /// The node to look at. An index out of range (malformed words) reads node 0.
    #[inline(always)]
    pub fn node<I, const W: usize>(&self, tree: &LightTree<'a, N, I, W>) -> &'a N {
        let nodes = self.nodes(tree);
        let valid = self.index < nodes.len() as u32;
        &nodes[if valid { self.index as usize } else { 0 }]
    }

    /// The nodes of the tree that it is in; on a device those of all trees.
    #[inline(always)]
    fn nodes<I, const W: usize>(&self, _tree: &LightTree<'a, N, I, W>) -> &'a [N] {
        #[cfg(target_arch = "spirv")]
        return _tree.nodes;
        #[cfg(not(target_arch = "spirv"))]
        self.nodes
    }

    /// Whether it is in the tree that it started in.
    #[inline(always)]
    pub fn is_above<const W: usize>(&self) -> bool {
        self.position < max_levels(W)
    }

    /// Whether another walk for the same point looks at the same node.
    #[inline(always)]
    pub fn is_with(&self, other: &Self) -> bool {
        (self.index == other.index) & (self.instance == other.instance) & !other.done
    }

    /// Asks for the node to look at early.
    #[inline(always)]
    pub fn fetch_node(&self)
    where
        N: bytemuck::Pod,
    {
        #[cfg(not(target_arch = "spirv"))]
        crate::prefetch::fetch(self.nodes, self.index);
    }

    /// The child that the path to follow takes.
    #[inline(always)]
    pub fn wanted<const W: usize>(&self) -> u32 {
        self.path.slot::<W>(self.position)
    }

    /// Goes to the child of `node` that has `share`. An index out of range ends the walk. Returns how often the range was doubled.
    #[inline(always)]
    pub fn descend<I, const W: usize>(
        &mut self,
        tree: &LightTree<'a, N, I, W>,
        world: &P,
        node: &N,
        share: Share,
    ) -> u32
    where
        N: Node<W>,
    {
        let is_above = self.is_above::<W>();
        let valid = self.index < self.nodes(tree).len() as u32;
        let slot = share.slot as usize;
        let (to, link) = (node.kind(slot), node.link(slot));
        let passes = valid & (share.count > 0) & (share.count <= self.range);
        let count = if passes { share.count } else { 1 };
        let doublings = self.narrow(share.first, count);

        let levels = max_levels(W);
        // Running off the end of a tree's levels (malformed words only) must not look like the next tree's first level.
        let last_of_tree = self.position + 1 == levels || self.position + 1 == 2 * levels;
        let (leaf, part) = leaf_parts(link);
        let enters = passes & (to == kind::MESH) & is_above & (leaf < tree.instances.len() as u32);
        let descends = passes & (to == kind::INNER) & !last_of_tree;
        let at_light = passes & (to == kind::LIGHT);
        self.triangle = if at_light { link } else { INVALID };
        self.steps = self.steps.wrapping_sub(1);
        self.done = !(enters | descends) | (self.steps == 0);
        if enters {
            let instance = &tree.instances[leaf as usize];
            self.instance = leaf;
            self.index = instance.root;
            #[cfg(not(target_arch = "spirv"))]
            {
                self.nodes = tree.nodes;
            }
            // Its mesh is one light.
            let is_alone = instance.root == INVALID;
            self.triangle = if is_alone { instance.first_light } else { INVALID };
            self.done |= is_alone;
            self.position = levels;
            if part > 0 {
                // A part is a child of the root: a node, or a light.
                let (root, slot) = (self.node(tree), (part as usize - 1) % W);
                let (to, link) = (root.kind(slot), root.link(slot));
                self.index = link;
                self.triangle = if to == kind::LIGHT { link } else { INVALID };
                self.done |= to != kind::INNER;
                self.position += 1;
            }
            self.point = world.to_local(instance);
            if N::HAS_BEAMS {
                self.space = instance.space();
            }
        } else {
            let below = link.wrapping_add(if is_above { tree.first } else { 0 });
            self.index = if descends { below } else { self.index };
            self.position += u32::from(descends);
        }
        doublings
    }

    /// Cuts the range down to `count` numbers from `first` on, and doubles it to its usual length. Returns how often.
    #[inline(always)]
    fn narrow(&mut self, first: u32, count: u32) -> u32 {
        // As many doublings as make the greatest number, `count` − 1, one of 22 bits.
        let greatest = count.wrapping_sub(1) & (FULL - 1);
        let unused = greatest.leading_zeros() - (32 - FULL_BITS);
        let missing = if unused < FULL_BITS { unused } else { FULL_BITS };
        self.number = narrowed(self.number, first, missing);
        self.range = count << missing;
        self.halvings += missing;
        missing
    }

    /// The probability of having come here, by the tree: the share of all numbers that lead here.
    #[inline(always)]
    pub fn probability(&self) -> f32 {
        let halvings = if self.halvings < MOST_HALVINGS {
            self.halvings
        } else {
            MOST_HALVINGS
        };
        (self.range as i32 as f32) * exact::pow2(-((FULL_BITS + halvings) as i32))
    }
}

/// The part of a number that chooses at the node to look at, one of the range there.
#[inline(always)]
pub(super) fn leading(number: Random64) -> u32 {
    number.high >> (32 - FULL_BITS)
}

/// A number within the numbers from `first` on, which are doubled `doublings` times.
#[inline(always)]
pub(super) fn narrowed(number: Random64, first: u32, doublings: u32) -> Random64 {
    let rest = Random64 {
        high: number.high.wrapping_sub(first << (32 - FULL_BITS)),
        low: number.low,
    };
    rest.shifted(doublings)
}

/// Numbers below this choose among all lights alike, out of [`FULL`].
#[inline(always)]
pub(super) fn uniform_numbers<N, I: ImportanceModel<N, W, P>, P, const W: usize>() -> u32 {
    if I::UNIFORM_HALVINGS > 0 {
        FULL >> I::UNIFORM_HALVINGS
    } else {
        0
    }
}

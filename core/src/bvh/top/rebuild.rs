//! The top level, or a part of it, built anew beside the frame.
//!
//! A part is a [cut](super::cut): a node of the top level, and below it at most [`PART`] leaves, instances or subtrees that
//! stay as they are. So taking a copy and putting the tree in place take a frame a small and bounded time, however many
//! instances there are.

use alloc::vec::Vec;

use super::cut::{Cut, Part};
use super::strayed::OFF;
use crate::beam::Limits;
use crate::build::{BuildParams, Topology, build_top};
use crate::bvh::opened::Openable;
use crate::bvh::quality::Spread;
use crate::bvh::{Bvh, Trails, opened};
use crate::instance::Instance;
use crate::levels::Levels;
use crate::node::{Node, kind};
use crate::refit::{self, BlasRoot};
use crate::summary::{Lanes, Summary};

/// Most leaves of a part: copied in 0.1 ms, put in place in 0.2 ms (measured: `docs/dynamics.md`).
pub(in crate::bvh) const PART: u32 = 1024;
/// Most leaves of one that keeps subtrees, each of which is looked at, and its number told where it hangs.
#[cfg(feature = "std")]
const ABOVE: u32 = 768;
/// A tree that nothing else asks for comes in where its nodes cost at most so much of what those cost that it replaces.
#[cfg(feature = "std")]
pub(super) const PAYS: f64 = 0.985;

/// A copy of what a part of the top level is built from.
#[derive(Clone, Debug)]
pub(crate) struct TopCopy<N> {
    /// Its root; `None` for all of it, down to the instances.
    pub(super) root: Option<Part>,
    /// The tree comes in where it costs at most so much of what is there.
    pub(super) pays: f64,
    /// Indices of the instances, in order.
    names: Vec<u32>,
    /// The same, and the roots of their bottom levels.
    instances: Vec<Instance>,
    roots: Vec<BlasRoot>,
    /// Their masks and beams, where nodes store any.
    limits: Vec<Limits>,
    /// Subtrees without flux, by their index among the leaves: an instance of each, for they are nowhere themselves.
    shapes: Vec<(u32, Instance, BlasRoot)>,
    /// The subtrees that stay, with the variance of their lights' centers, and the nodes that are to be replaced, from the root
    /// down.
    kept: Vec<(Part, N, f32)>,
    inner: Vec<Part>,
    /// What those cost but for the root: flux times the variance of the centers of their lights, W m². Lights' own extents are
    /// in it on neither side: large lamps would hide what small ones gain.
    cost: f64,
    /// The instances that are opened or could be.
    openable: Vec<Openable>,
    /// What all lights cost together, where it is more than those of the copy.
    whole: Option<f64>,
}

/// A tree as it was built: every word of its nodes is what refit makes of the copy.
#[derive(Debug)]
pub(in crate::bvh) struct TopTree<N> {
    pub(super) root: Option<Part>,
    /// Whether it is to be put in place: it costs less than what is there.
    pub(super) pays: bool,
    /// What it costs over what it replaces.
    cost: f64,
    /// In depth-first order; links of nodes count from the first, the root.
    pub(super) nodes: Vec<N>,
    /// Levels above each node.
    pub(super) levels: Vec<u32>,
    pub(super) depth: u32,
    /// By node: the slots that hold subtrees that stay, as bits; their links count those in `kept`.
    pub(super) keeps: Vec<u32>,
    /// The instances that it was built over, the subtrees, and the nodes that it replaces.
    pub(super) names: Vec<u32>,
    pub(super) kept: Vec<Part>,
    pub(super) inner: Vec<Part>,
    /// Those of the instances that had no flux.
    pub(super) dark: Vec<u32>,
    /// Instances to be opened, and to be closed.
    pub(super) open: Vec<u32>,
    pub(super) close: Vec<u32>,
}

#[cfg(feature = "std")]
impl<N> TopTree<N> {
    /// What it costs over what it replaces, where it keeps subtrees.
    pub fn gain_above(&self) -> Option<f64> {
        (!self.kept.is_empty()).then_some(self.cost)
    }
}

impl<N> TopCopy<N> {
    /// Number of its instances, and their bottom levels.
    #[cfg(feature = "std")]
    pub(super) fn len(&self) -> usize {
        self.instances.len()
    }

    #[cfg(feature = "std")]
    pub(super) fn names(&self) -> impl Iterator<Item = u32> + '_ {
        self.names.iter().copied()
    }

    #[cfg(feature = "std")]
    pub(super) fn blases(&self) -> impl Iterator<Item = u32> + '_ {
        self.instances.iter().map(|own| own.blas)
    }

    /// A tree over the copy, refitted.
    pub(in crate::bvh) fn build<const W: usize>(self, params: &BuildParams) -> TopTree<N>
    where
        N: Node<W>,
    {
        let mut tree = TopTree {
            root: self.root,
            pays: false,
            cost: 1.0,
            nodes: Vec::new(),
            levels: Vec::new(),
            depth: 0,
            keeps: Vec::new(),
            names: self.names,
            kept: self.kept.iter().map(|&(part, ..)| part).collect(),
            inner: self.inner,
            dark: Vec::new(),
            open: Vec::new(),
            close: Vec::new(),
        };
        let leaves = self.instances.iter().zip(&self.roots);
        let leaves =
            leaves.map(|(instance, root)| root.summary::<N::Summary>().to_world::<N::Light>(instance));
        let leaves: Vec<N::Summary> = leaves
            .chain(self.kept.iter().map(|(_, node, _)| node.merged()))
            .collect();
        if leaves.is_empty() {
            return tree;
        }
        let dark = tree.names.iter().zip(&leaves).filter(|(_, own)| own.phi() <= OFF);
        tree.dark = dark.map(|(&name, _)| name).collect();
        let whole = self.whole.unwrap_or_else(|| opened::cost_of(&leaves));
        [tree.open, tree.close] = opened::wanted::<N, W>(whole, &self.openable);
        let mut shapes = leaves.clone();
        for (index, instance, root) in &self.shapes {
            shapes[*index as usize] = root.summary::<N::Summary>().to_world::<N::Light>(instance);
        }
        let mut topology: Topology<N> = build_top::<N, W>((0..).zip(shapes), &super::in_full(params));
        tree.keeps = alloc::vec![0; topology.nodes.len()];
        let mut cost = 0.0;
        let mut apart = alloc::vec![0.0; topology.nodes.len()];
        for &index in Levels::gather(topology.leveled(0)).nodes() {
            let mut node = topology.nodes[index as usize];
            let mut lanes = Lanes::<W>::all(&N::Summary::EMPTY);
            let mut limits = [Limits::NONE; W];
            let mut below = [0.0; W];
            for slot in 0..W {
                let (to, link) = (node.kind(slot), node.link(slot));
                if to == kind::INNER {
                    let child = topology.nodes[link as usize].merged();
                    below[slot] = apart[link as usize];
                    lanes.set(slot, &child);
                    limits[slot] = topology.nodes[link as usize].merged_limits(&child);
                } else if to == kind::MESH {
                    lanes.set(slot, &leaves[link as usize]);
                    limits[slot] = self.limits.get(link as usize).copied().unwrap_or(Limits::NONE);
                    if let Some(&name) = tree.names.get(link as usize) {
                        node.relink(slot, name);
                    } else {
                        let stays = link - tree.names.len() as u32;
                        node.set_child(slot, kind::INNER, stays);
                        below[slot] = self.kept[stays as usize].2;
                        limits[slot] = self.kept[stays as usize].1.merged_limits(&leaves[link as usize]);
                        tree.keeps[index as usize] |= 1 << slot;
                    }
                }
            }
            node.set_lanes(&lanes);
            node.set_limits(&limits);
            topology.nodes[index as usize] = node;
            let spread = Spread::of(&node, |slot| below[slot]);
            apart[index as usize] = (spread.apart() / spread.phi().max(f64::MIN_POSITIVE)) as f32;
            cost += if index > 0 { spread.apart() } else { 0.0 };
        }
        tree.cost = if self.cost > 0.0 { cost / self.cost } else { 1.0 };
        tree.pays = tree.cost <= self.pays;
        tree.nodes = topology.nodes;
        tree.levels = topology.levels;
        tree.depth = topology.depth;
        tree
    }
}

impl<N: Node<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// What the top level is built from as a whole.
    pub(in crate::bvh) fn copy_top(&self) -> TopCopy<N> {
        let mut cut = Cut {
            names: self.leaves_of_all(&self.live),
            ..Cut::default()
        };
        cut.names.sort_unstable();
        TopCopy {
            root: None,
            pays: f64::INFINITY,
            openable: self.openable(self.live.iter().copied()),
            whole: None,
            ..self.copy_of(cut)
        }
    }

    /// What the top level is built from as a whole where it is no larger than a part: as a part it comes in within the time
    /// that a frame has.
    #[cfg(feature = "std")]
    pub(super) fn copy_whole_part(&self) -> TopCopy<N> {
        TopCopy {
            root: Some(self.part(self.top.root)),
            ..self.copy_top()
        }
    }

    /// What a part is built from.
    #[cfg(feature = "std")]
    pub(super) fn copy_part(&self, root: u32, pays: f64) -> TopCopy<N> {
        let is_part = self.top.counts[self.top.number(root) as usize] <= PART;
        let cut = self.cut(root, if is_part { PART } else { ABOVE } as usize);
        let whole = opened::cost(&self.nodes[self.top.root as usize].merged());
        let openable = match self.params.opens {
            true => self.openable(self.owners(&cut.names).into_iter()),
            false => Vec::new(),
        };
        TopCopy {
            root: Some(self.part(root)),
            pays,
            openable,
            whole: Some(whole),
            ..self.copy_of(cut)
        }
    }

    /// The instances that leaves belong to, each once.
    #[cfg(feature = "std")]
    fn owners(&self, leaves: &[u32]) -> Vec<u32> {
        let owner = |&leaf: &u32| match self.placed[leaf as usize].part_of {
            crate::tree::INVALID => leaf,
            instance => instance,
        };
        let mut owners: Vec<u32> = leaves.iter().map(owner).collect();
        owners.sort_unstable();
        owners.dedup();
        owners
    }

    fn copy_of(&self, cut: Cut) -> TopCopy<N> {
        let mut copy = TopCopy {
            root: None,
            pays: f64::INFINITY,
            instances: Vec::with_capacity(cut.names.len()),
            roots: Vec::with_capacity(cut.names.len()),
            limits: Vec::new(),
            shapes: Vec::new(),
            names: Vec::new(),
            kept: Vec::with_capacity(cut.kept.len()),
            inner: Vec::with_capacity(cut.inner.len()),
            cost: cut.cost,
            openable: Vec::new(),
            whole: None,
        };
        for &name in &cut.names {
            let own = self.instances[name as usize];
            let root = self.roots[own.blas as usize];
            copy.roots.push(root);
            if refit::has_limits::<N, W>() {
                copy.limits
                    .push(refit::limits_of_instance(&self.nodes, &root, &own));
            }
            copy.instances.push(own);
        }
        for &node in &cut.kept {
            let is_dark = self.nodes[node as usize].merged().phi() <= 0.0;
            if let Some(leaf) = is_dark.then(|| self.some_leaf(kind::INNER, node)).flatten() {
                let own = self.instances[leaf as usize];
                let index = cut.names.len() + copy.kept.len();
                copy.shapes
                    .push((index as u32, own, self.roots[own.blas as usize]));
            }
            copy.kept.push((
                self.part(node),
                self.nodes[node as usize],
                self.quality(node).apart(),
            ));
        }
        for &node in &cut.inner {
            copy.inner.push(self.part(node));
        }
        copy.names = cut.names;
        copy
    }
}

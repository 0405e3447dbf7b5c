//! The top level, or a part of it, built anew beside the frame, and put in place of what it was built from.
//!
//! A part is a subtree of at most [`PART`] instances, so that taking a copy and putting the tree in place take a frame a small and
//! bounded time, however many instances there are. Levels above parts are kept in order by insertion alone.

use alloc::vec::Vec;

use crate::build::{BuildParams, Topology, build_top};
use crate::bvh::{Bvh, Trails, opened};
use crate::instance::Instance;
use crate::levels::Levels;
use crate::node::{LightNode, kind};
use crate::refit::{self, BlasRoot};
use crate::summary::Summary;
use crate::trail::max_levels;
use crate::tree::INVALID;

/// Most instances of a part: copied in 0.1 ms, put in place in 0.2 ms (measured: `docs/dynamics.md`).
#[cfg(feature = "std")]
pub(in crate::bvh) const PART: u32 = 1536;
/// A top level of at most so many instances that has lost [`MUCH`] is built as a whole: parts do not put the levels above them in order.
/// Its copy and its coming take some ten frames' bounds of 0.3 ms, once.
#[cfg(feature = "std")]
const WHOLE: u32 = 16_384;
/// How many times worse such a top level is than when its nodes were built.
#[cfg(feature = "std")]
const MUCH: f64 = 1.1;
/// Nodes that one search for a part looks at.
#[cfg(feature = "std")]
const LOOKED_AT: usize = 4096;

/// Which subtree: its root's number, and when that node came into the tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::bvh) struct Part {
    number: u32,
    born: u64,
}

/// How far the top level's nodes have been looked at.
#[cfg(feature = "std")]
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Search {
    /// The next number.
    next: u32,
    /// How many are to be looked at before all have been since the last change.
    left: u32,
}

#[cfg(feature = "std")]
impl Search {
    /// Whether all have been.
    pub fn is_done(&self) -> bool {
        self.left == 0
    }
}

/// A copy of what a part of the top level is built from.
#[derive(Clone, Debug)]
pub(crate) struct TopCopy {
    /// `None` for all of it.
    part: Option<Part>,
    /// Indices of the instances, in order.
    names: Vec<u32>,
    /// The same, each with the root of that place below.
    instances: Vec<Instance>,
    roots: Vec<BlasRoot>,
    /// Of all of it: the instances that are opened or could be.
    openable: Vec<(u32, Instance, BlasRoot)>,
}

/// A tree as it was built: every word of its nodes is what refit makes of the copy.
#[derive(Debug)]
pub(in crate::bvh) struct TopTree<N> {
    part: Option<Part>,
    /// In depth-first order; links of nodes count from the first, the root.
    nodes: Vec<N>,
    depth: u32,
    /// The instances that it was built over.
    names: Vec<u32>,
    /// Instances to be opened, and to be closed.
    open: Vec<u32>,
    close: Vec<u32>,
}

impl TopCopy {
    /// A tree over the copy, refitted.
    pub(in crate::bvh) fn build<N: LightNode<W>, const W: usize>(self, params: &BuildParams) -> TopTree<N> {
        let mut tree = TopTree {
            part: self.part,
            nodes: Vec::new(),
            depth: 0,
            names: self.names,
            open: Vec::new(),
            close: Vec::new(),
        };
        if self.instances.is_empty() {
            return tree;
        }
        let leaves = self.instances.iter().zip(&self.roots);
        let leaves = leaves.map(|(instance, root)| root.summary::<N::Summary>().to_world(instance));
        [tree.open, tree.close] = opened::wanted(leaves, &self.openable);
        let copies = (0..).zip(self.instances.iter().zip(&self.roots));
        let summaries =
            copies.map(|(k, (instance, root))| (k, root.summary::<N::Summary>().to_world(instance)));
        let mut topology: Topology<N> = build_top::<N, W>(summaries, &super::in_full(params));
        for &node in Levels::gather(topology.leveled(0)).nodes() {
            topology.nodes[node as usize] = refit::top(&topology.nodes, &self.instances, &self.roots, node);
        }
        for node in &mut topology.nodes {
            for slot in 0..W {
                if node.kind(slot) == kind::MESH {
                    node.relink(slot, tree.names[node.link(slot) as usize]);
                }
            }
        }
        tree.nodes = topology.nodes;
        tree.depth = topology.depth;
        tree
    }
}

impl<N: LightNode<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// What the top level is built from.
    pub(in crate::bvh) fn copy_top(&self) -> TopCopy {
        TopCopy {
            openable: self.openable(),
            ..self.copy_of(None, self.leaves_of_all(&self.live))
        }
    }

    /// What the next part is built from that is worse than when it was built by the factor `worse` or more; all of the top level, where
    /// that is no more than a part. Time in proportion to [`PART`].
    #[cfg(feature = "std")]
    pub(crate) fn copy_worn_part(&self, worse: f64, search: &mut Search) -> Option<TopCopy> {
        let drift = |node: u32| self.quality(node).drift();
        let root = self.top.number(self.top.root) as usize;
        let (count, whole) = (self.top.counts[root], drift(self.top.root));
        if count <= PART || (count <= WHOLE && whole >= MUCH && whole >= worse) {
            search.left = 0;
            return (whole >= worse).then(|| self.copy_top());
        }
        for _ in 0..LOOKED_AT.min(search.left as usize) {
            search.left -= 1;
            let number = search.next as usize % self.top.nodes.len();
            search.next = number as u32 + 1;
            let node = self.top.nodes[number];
            if node == INVALID || self.top.counts[number] > PART || self.top.heights[number] < 2 {
                continue;
            }
            let above = self.top.number(self.parents[node as usize]);
            // As built, there is nothing to gain.
            if self.top.counts[above as usize] > PART && drift(node) > 1.0 && drift(node) >= worse {
                let part = Part {
                    number: number as u32,
                    born: self.top.born[number],
                };
                let names = self.below(node).1.into_iter().map(|(name, _)| name);
                return Some(self.copy_of(Some(part), names.collect()));
            }
        }
        None
    }

    /// All nodes are to be looked at again.
    #[cfg(feature = "std")]
    pub(crate) fn search_again(&self, search: &mut Search) {
        search.left = self.top.nodes.len() as u32;
    }

    fn copy_of(&self, part: Option<Part>, mut names: Vec<u32>) -> TopCopy {
        names.sort_unstable();
        let mut copy = TopCopy {
            part,
            instances: Vec::with_capacity(names.len()),
            roots: Vec::with_capacity(names.len()),
            names: Vec::new(),
            openable: Vec::new(),
        };
        for (k, &name) in (0..).zip(&names) {
            let own = self.instances[name as usize];
            copy.roots.push(self.roots[own.blas as usize]);
            copy.instances.push(Instance { blas: k, ..own });
        }
        copy.names = names;
        copy
    }

    /// Puts a tree in place of the part of the top level that it was built from, of which it does not know what became of it since the
    /// epoch stood at `since`: instances that have gone or were put elsewhere are taken out of it, others are put in. Nothing
    /// is done where the part is no more.
    pub(in crate::bvh) fn install_top(&mut self, tree: &TopTree<N>, since: u64) {
        let root = match tree.part {
            None => self.top.root,
            Some(Part { number, born }) => match self.top.nodes.get(number as usize) {
                Some(&node) if node != INVALID && self.top.born[number as usize] == born => node,
                _ => return,
            },
        };
        let level = self.level(root);
        if tree.nodes.is_empty() || level + tree.depth > max_levels(W) {
            return;
        }
        let (interior, newcomers, found) = self.sort_out(root, &tree.names, since);
        let above = (root != self.top.root).then(|| (self.parents[root as usize], self.slot_above(root)));
        for node in interior {
            self.free_top_node(node);
        }
        let nodes: Vec<u32> = tree.nodes.iter().map(|_| self.new_top_node()).collect();
        let mut lost = Vec::new();
        for (&node, words) in nodes.iter().zip(&tree.nodes) {
            let mut words = *words;
            let mut is_whole = true;
            for slot in 0..W {
                let (to, link) = (words.kind(slot), words.link(slot));
                if to == kind::INNER {
                    words.relink(slot, nodes[link as usize]);
                } else if to == kind::MESH && !self.is_marked(link, found) {
                    words.set_child(slot, kind::EMPTY, 0);
                    is_whole = false;
                }
            }
            self.nodes[node as usize] = words;
            if !is_whole {
                lost.push(node);
            }
            for slot in 0..W {
                self.link_up(node, slot);
            }
            self.changes.new.written_nodes.push(node..node + 1);
        }
        for &node in nodes.iter().rev() {
            self.measure(node);
            self.judge_new(node);
        }
        match above {
            None => self.set_root(nodes[0]),
            Some((node, slot)) => {
                self.hang(node, slot, kind::INNER, nodes[0]);
                self.update_path(node);
            }
        }
        // Where a device refits in place of the CPU, the copy was of roots that are not those of the device.
        if !self.changes.unrefitted.is_empty() {
            self.changes.new.top_nodes.extend(&nodes);
        }
        // Its words are those of the copy.
        for &name in &tree.names {
            if !self.is_marked(name, found) {
                continue;
            }
            let placed = &self.placed[name as usize];
            let blas = self.blas_of(placed);
            if placed.changed.max(blas.changed).max(blas.created) > since {
                self.changes.new.instances.push(name);
            }
        }
        // From the lowest: what is above may go with them.
        for node in lost.into_iter().rev() {
            if self.top.number(node) != INVALID {
                let changed = self.fill(node);
                self.update_path(changed);
            }
        }
        self.insert_instances(&newcomers);
        self.reopen(&tree.open, &tree.close);
        self.settle();
    }

    /// Walks the tree below `root`: its nodes, and the instances that are not among `names` or were put there after `since`, in order.
    /// The others are marked, by the last number returned.
    fn sort_out(&mut self, root: u32, names: &[u32], since: u64) -> (Vec<u32>, Vec<u32>, u32) {
        self.top.mark += 2;
        let (listed, found) = (self.top.mark - 1, self.top.mark);
        for &name in names {
            let there = self.placed.get_mut(name as usize);
            if let Some(placed) = there.filter(|placed| placed.node != INVALID && placed.hung <= since) {
                placed.mark = listed;
            }
        }
        let (nodes, leaves) = self.below(root);
        let mut newcomers = Vec::new();
        for (link, _) in leaves {
            let placed = &mut self.placed[link as usize];
            if placed.mark == listed {
                placed.mark = found;
                placed.settle();
            } else {
                placed.node = INVALID;
                newcomers.push(link);
            }
        }
        newcomers.sort_unstable();
        (nodes, newcomers, found)
    }

    fn is_marked(&self, instance: u32, mark: u32) -> bool {
        self.placed
            .get(instance as usize)
            .is_some_and(|placed| placed.mark == mark)
    }
}

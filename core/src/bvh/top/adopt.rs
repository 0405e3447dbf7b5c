//! What was built of the top level, put in place of what it was built from.

use alloc::vec::Vec;

use super::come::{MOST, Quota};
use super::rebuild::TopTree;
use super::tried::bounded_sum;
use crate::bvh::{Bvh, Trails};
use crate::node::{Node, kind};
use crate::trail::max_levels;
use crate::tree::INVALID;

/// What is below the root of a part now, of what a tree was built over.
#[derive(Debug, Default)]
struct Found {
    /// Nodes that are to be replaced.
    nodes: Vec<u32>,
    /// Instances and subtrees that have come.
    instances: Vec<u32>,
    subtrees: Vec<u32>,
    /// By what those are marked that stay.
    mark: u64,
}

impl<N: Node<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// Puts a tree in place of the part of the top level that it was built from, of which it does not know what became of it
    /// since the epoch stood at `since`: what has gone or was put elsewhere is taken out of it, what has come is put in.
    /// Nothing is done where the part is no more. Returns the instances that are then to be opened, and those to be closed.
    pub(in crate::bvh) fn install_top(
        &mut self,
        tree: &TopTree<N>,
        since: u64,
        room: &mut Quota,
    ) -> [Vec<u32>; 2] {
        let none = [const { Vec::new() }; 2];
        let root = match tree.root {
            None => self.top.root,
            Some(part) => match self.node_of(part) {
                Some(node) => node,
                None => return none,
            },
        };
        if tree.nodes.is_empty() {
            return none;
        }
        if !tree.pays || self.level(root) + self.depth_with(tree) > max_levels(W) {
            self.note_tried(root, tree, since);
            return none;
        }
        let count = self.top.counts[self.top.number(root) as usize];
        // All that is below is looked at where no subtree stays.
        if tree.root.is_some() && tree.kept.is_empty() && count as usize > tree.names.len() + room.come {
            return none;
        }
        let found = self.sort_out(root, tree, since);
        if tree.root.is_some() && !self.is_like(tree, &found, room) {
            return none;
        }
        let above = (root != self.top.root).then(|| (self.parents[root as usize], self.slot_above(root)));
        for &name in &tree.names {
            if self.is_marked(name, found.mark) {
                if above.is_none() {
                    self.settle_placed(name);
                }
                let placed = &mut self.placed[name as usize];
                placed.hung_radiance = placed.bright();
            }
        }
        for &name in &tree.dark {
            if self.is_marked(name, found.mark) {
                self.note_nowhere(name);
            }
        }
        for &name in &found.instances {
            self.placed[name as usize].node = INVALID;
        }
        let new = &mut self.changes.new;
        new.written_instances
            .reserve(tree.names.len() + 2 * tree.nodes.len());
        new.written_nodes.reserve(2 * tree.nodes.len());
        let nodes = self.renewed(found.nodes, tree.nodes.len());
        let lost = self.link_in(tree, &nodes, found.mark);
        for &node in &nodes {
            let number = self.top.number(node) as usize;
            self.top.moved[number] = 0;
            self.top.seen[number] = 0;
            self.top.note_tried(number, since);
        }
        match above {
            None => self.set_root(nodes[0]),
            Some((node, slot)) => {
                self.hang(node, slot, kind::INNER, nodes[0]);
                self.update_path(node);
                self.stir(node, count);
            }
        }
        // Where a device refits in place of the CPU, the copy was of roots that are not those of the device.
        let is_old = !tree.kept.is_empty() && self.epoch > since;
        if is_old || !self.changes.unrefitted.is_empty() {
            self.changes.new.top_nodes.extend(&nodes);
        }
        // Its words are those of the copy.
        for &name in &tree.names {
            if !self.is_marked(name, found.mark) {
                continue;
            }
            let placed = &self.placed[name as usize];
            let blas = self.blas_of(placed);
            if placed.changed.max(blas.changed).max(blas.created) > since {
                self.changes.new.instances.push(name);
            }
        }
        self.fill_all(lost);
        if found.instances.len() <= MOST {
            self.insert_come(&found.instances, found.subtrees);
        } else {
            // Whole top levels alone come in beside so many, and they leave no subtree.
            debug_assert!(found.subtrees.is_empty());
            self.insert_instances(&found.instances);
        }
        [tree.open.clone(), tree.close.clone()]
    }

    /// Whether a part is nearly what its tree was built over, and the tree's nodes, of which some are given back once they are
    /// found to miss children, have a number each: there are as many as records of instances.
    fn is_like(&self, tree: &TopTree<N>, found: &Found, room: &mut Quota) -> bool {
        let names = tree
            .names
            .iter()
            .filter(|&&name| self.is_marked(name, found.mark));
        let kept = tree.kept.iter();
        let kept = kept.filter(|part| self.top.marks.get(part.number as usize) == Some(&found.mark));
        let gone = tree.names.len() + tree.kept.len() - names.count() - kept.count();
        let come = found.instances.len() + found.subtrees.len();
        let used = self.top.used + tree.nodes.len() - found.nodes.len();
        let fits = come <= room.come && gone <= room.gone && used <= self.instances.len();
        if fits {
            room.come -= come;
            room.gone -= gone;
        }
        fits
    }

    /// Levels of a tree with the subtrees that it keeps.
    fn depth_with(&self, tree: &TopTree<N>) -> u32 {
        let mut depth = tree.depth;
        for ((node, &keeps), &level) in tree.nodes.iter().zip(&tree.keeps).zip(&tree.levels) {
            for slot in (0..W).filter(|slot| keeps & 1 << slot != 0) {
                let part = tree.kept[node.link(slot) as usize];
                if self.node_of(part).is_some() {
                    depth = depth.max(level + 1 + self.top.heights[part.number as usize]);
                }
            }
        }
        depth
    }

    /// Walks what is below `root` and to be replaced. What was put there after `since` has come, and so has whatever `tree` was
    /// not built over.
    fn sort_out(&mut self, root: u32, tree: &TopTree<N>, since: u64) -> Found {
        self.top.mark += 3;
        let [listed, inner, mark] = [2, 1, 0].map(|before| self.top.mark - before);
        for &name in &tree.names {
            let there = self.placed.get_mut(name as usize);
            if let Some(placed) = there.filter(|placed| placed.node != INVALID && placed.hung <= since) {
                placed.mark = listed;
            }
        }
        for (parts, own) in [(&tree.kept, listed), (&tree.inner, inner)] {
            for &part in parts {
                if self.node_of(part).is_some() {
                    self.top.marks[part.number as usize] = own;
                }
            }
        }
        let mut found = Found {
            nodes: alloc::vec![root],
            mark,
            ..Found::default()
        };
        let mut next = 0;
        while let Some(&node) = found.nodes.get(next) {
            next += 1;
            for slot in 0..W {
                let own = &self.nodes[node as usize];
                let (to, link) = (own.kind(slot), own.link(slot));
                if to == kind::MESH {
                    let placed = &mut self.placed[link as usize];
                    if placed.mark == listed {
                        placed.mark = mark;
                    } else {
                        found.instances.push(link);
                    }
                } else if to == kind::INNER {
                    let number = self.top.number(link) as usize;
                    let own = &mut self.top.marks[number];
                    if *own == listed {
                        *own = mark;
                    } else if tree.kept.is_empty() || *own == inner {
                        found.nodes.push(link);
                    } else {
                        found.subtrees.push(link);
                    }
                }
            }
        }
        found.instances.sort_unstable();
        found
    }

    fn is_marked(&self, instance: u32, mark: u64) -> bool {
        self.placed
            .get(instance as usize)
            .is_some_and(|placed| placed.mark == mark)
    }

    /// So many nodes of the top level, the old ones among them, which hang nowhere. To give their places and numbers back and
    /// take others would be half of the work.
    pub(super) fn renewed(&mut self, mut nodes: Vec<u32>, count: usize) -> Vec<u32> {
        // In order, so that what a mirror copies is in few pieces.
        nodes.sort_unstable();
        for node in nodes.drain(count.min(nodes.len())..) {
            self.free_top_node(node);
        }
        for &node in &nodes {
            let number = self.top.number(node) as usize;
            self.top.edits[number] = 0;
            self.top.stirred[number] = 0;
            self.note_birth(node);
        }
        while nodes.len() < count {
            nodes.push(self.new_top_node());
        }
        self.top.levels = None;
        nodes
    }

    /// Makes `nodes` those of a tree, and hangs below them what is marked. Returns those of them that miss a child.
    fn link_in(&mut self, tree: &TopTree<N>, nodes: &[u32], mark: u64) -> Vec<u32> {
        let mut lost = Vec::new();
        for ((&node, words), keeps) in nodes.iter().zip(&tree.nodes).zip(&tree.keeps) {
            let mut words = *words;
            let mut is_whole = true;
            for slot in 0..W {
                let (to, link) = (words.kind(slot), words.link(slot));
                let stays = if keeps & 1 << slot != 0 {
                    let number = tree.kept[link as usize].number as usize;
                    let stays = self.top.marks[number] == mark;
                    if stays {
                        words.relink(slot, self.top.nodes[number]);
                    }
                    stays
                } else if to == kind::INNER {
                    words.relink(slot, nodes[link as usize]);
                    true
                } else {
                    to != kind::MESH || self.is_marked(link, mark)
                };
                if !stays {
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
        for (&node, keeps) in nodes.iter().zip(&tree.keeps).rev() {
            self.measure(node);
            self.judge_new(node);
            // Below may be subtrees that overlap.
            let mut stirred = 0;
            for slot in 0..W {
                let own = &self.nodes[node as usize];
                if own.kind(slot) == kind::INNER {
                    let child = self.top.number(own.link(slot)) as usize;
                    let own = match keeps & 1 << slot {
                        0 => self.top.stirred[child],
                        _ => self.top.counts[child],
                    };
                    stirred = bounded_sum(stirred, own);
                }
            }
            let number = self.top.number(node) as usize;
            self.top.stirred[number] = stirred;
        }
        // It was tried just now.
        let number = self.top.number(nodes[0]) as usize;
        self.top.stirred[number] = 0;
        lost
    }
}

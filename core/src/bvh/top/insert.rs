//! Instances put into the top level one by one: down from the root to the place where they cost least.

use alloc::vec::Vec;

use super::cost::{Cluster, floor};
use crate::build::{Topology, build_top};
use crate::bvh::{Bvh, Trails};
use crate::node::{Node, kind};
use crate::summary::Summary;
use crate::trail::max_levels;

/// What is put into the top level: an instance, or a node with its children.
#[derive(Clone, Copy, Debug)]
pub(super) struct Item {
    pub kind: u32,
    pub link: u32,
    pub cluster: Cluster,
    /// Levels of the node; 0 of an instance.
    pub height: u32,
}

/// A child of a node, as an insertion sees it.
#[derive(Clone, Copy, Debug)]
struct Child {
    slot: usize,
    item: Item,
}

/// Where an item goes.
#[derive(Clone, Copy, Debug)]
pub(super) enum Step {
    /// Into an empty slot.
    Place(usize),
    /// To the node in this slot.
    Enter(usize),
    /// Into a new node, with the child that is in this slot.
    Pair(usize),
    /// Into the second slot; both children are put into a new node, in the first slot.
    Merge(usize, usize),
}

impl<N: Node<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// Puts `added` instances into the top level, which has none of them. A few go in one by one, each in time in proportion to
    /// the depth. Many are built into a tree of their own first, whose lowest nodes go in where their instances lie as close
    /// together as those around them, else one by one; as many as there are already, and everything is built anew. So time is
    /// in proportion to what is added, times the depth.
    pub(in crate::bvh) fn insert_instances(&mut self, added: &[u32]) {
        let root = self.top.number(self.top.root);
        let there = self.top.counts.get(root as usize).copied().unwrap_or(0) as usize;
        if added.is_empty() {
            return;
        }
        self.epoch += 1;
        for &index in added {
            self.placed[index as usize].hung = self.epoch;
            self.settle_placed(index);
        }
        if added.len() >= there {
            self.build_top();
            return;
        }
        if added.len() < 4 * W {
            for &index in added {
                self.insert_instance_leaf(index);
            }
            return;
        }
        let topology: Topology<N> =
            build_top::<N, W>(added.iter().map(|&i| (i, self.in_world(i))), &self.params);
        for node in &topology.nodes {
            let leaves = (0..W).filter(|&slot| node.kind(slot) == kind::MESH);
            let leaves: Vec<u32> = leaves.map(|slot| node.link(slot)).collect();
            if leaves.len() < 2 {
                leaves
                    .into_iter()
                    .for_each(|leaf| self.insert_instance_leaf(leaf));
                continue;
            }
            let own = self.new_top_node();
            for (slot, &leaf) in leaves.iter().enumerate() {
                self.hang(own, slot, kind::MESH, leaf);
            }
            self.measure(own);
            self.refit_node(own);
            self.judge_new(own);
            self.changes.new.top_nodes.push(own);
            let item = Item {
                kind: kind::INNER,
                link: own,
                cluster: Cluster::new(&self.nodes[own as usize].merged(), leaves.len() as u32),
                height: 1,
            };
            match self.place_of(&item) {
                Some((node, step)) if self.is_as_dense(own, node) => self.insert_at(node, step, &item),
                _ => {
                    self.free_top_node(own);
                    leaves
                        .into_iter()
                        .for_each(|leaf| self.insert_instance_leaf(leaf));
                }
            }
        }
    }

    /// Whether the instances below node `own` lie about as close together as those below `host`: so many of those, were they
    /// even in space, have a variance of position less by a factor of (n / N)^⅔. Lamps scattered over a scene are near none of
    /// each other, and a node of theirs would reach across all that lies between.
    fn is_as_dense(&self, own: u32, host: u32) -> bool {
        let of = |node: u32| {
            let count = self.top.counts[self.top.number(node) as usize];
            (f64::from(self.quality(node).apart()), f64::from(count))
        };
        let ((apart, few), (around, many)) = (of(own), of(host));
        let share = apart / around;
        // A node that has one place alone is no wider than any.
        apart == 0.0 || share * share * share * (many * many) <= few * few
    }

    /// Puts one instance into the top level, in time in proportion to the depth.
    pub(in crate::bvh) fn insert_instance_leaf(&mut self, index: u32) {
        let placed = self.insert(self.item_of(index));
        debug_assert!(placed, "an instance fits into any tree");
        self.changes.new.mark_instance(index);
    }

    /// An instance, as it is put in.
    pub(super) fn item_of(&self, index: u32) -> Item {
        Item {
            kind: kind::MESH,
            link: index,
            cluster: Cluster::new(&self.in_world(index), 1),
            height: 0,
        }
    }

    /// Puts an item where it costs least, as far as a walk from the root tells that looks at one node of each level. False
    /// where the tree would get deeper than places may be; an instance always fits.
    pub(super) fn insert(&mut self, item: Item) -> bool {
        let Some((node, step)) = self.place_of(&item) else {
            return false;
        };
        self.insert_at(node, step, &item);
        true
    }

    fn insert_at(&mut self, node: u32, step: Step, item: &Item) {
        self.put_at(node, step, item);
        self.update_path(node);
        self.top.touched.push(node);
    }

    /// The same as [`insert`](Self::insert), but that nothing is computed of the node whose children change, which is returned,
    /// and those above it.
    pub(super) fn put(&mut self, item: Item) -> Option<u32> {
        let (node, step) = self.place_of(&item)?;
        self.put_at(node, step, &item);
        Some(node)
    }

    /// The node whose children an item changes, and how.
    fn place_of(&self, item: &Item) -> Option<(u32, Step)> {
        let mut node = self.top.root;
        let mut level = 0;
        loop {
            match self.step(node, level, item)? {
                Step::Enter(slot) => node = self.nodes[node as usize].link(slot),
                step => return Some((node, step)),
            }
            level += 1;
        }
    }

    fn put_at(&mut self, node: u32, step: Step, item: &Item) {
        let own = &self.nodes[node as usize];
        let child = |slot: usize| (own.kind(slot), own.link(slot));
        match step {
            Step::Place(slot) => self.hang(node, slot, item.kind, item.link),
            Step::Pair(slot) => {
                let there = child(slot);
                self.pair(node, slot, there, (item.kind, item.link));
            }
            Step::Merge(a, b) => {
                let (one, other) = (child(a), child(b));
                self.pair(node, a, one, other);
                self.hang(node, b, item.kind, item.link);
            }
            // That is no place yet.
            Step::Enter(_) => {}
        }
    }

    /// Puts a new node over two children, each kind and link, into `slot` of `node`.
    fn pair(&mut self, node: u32, slot: usize, one: (u32, u32), other: (u32, u32)) {
        let own = self.new_top_node();
        self.hang(own, 0, one.0, one.1);
        self.hang(own, 1, other.0, other.1);
        self.dissolve(own);
        self.measure(own);
        self.refit_node(own);
        self.judge_new(own);
        self.changes.new.top_nodes.push(own);
        self.hang(node, slot, kind::INNER, own);
    }

    /// The children of a node of the top level.
    fn children(&self, node: u32) -> impl Iterator<Item = Child> + '_ {
        let own = &self.nodes[node as usize];
        (0..W)
            .filter(|&slot| own.kind(slot) != kind::EMPTY)
            .map(move |slot| {
                let (to, link) = (own.kind(slot), own.link(slot));
                let (height, count) = self.measured(to, link);
                let known = own.summary(slot);
                let dark = (known.phi() <= 0.0).then(|| self.some_leaf(to, link)).flatten();
                let known = dark.map_or(known, |leaf| self.in_world(leaf));
                let cluster = Cluster::new(&known, count);
                let item = Item {
                    kind: to,
                    link,
                    cluster,
                    height,
                };
                Child { slot, item }
            })
    }

    /// Where an item goes from `node` at `level`: what costs least of all that keeps the tree within its levels. `None` where
    /// nothing does, never for an instance: a node with less than its levels hold has a child of which that is true, too.
    pub(super) fn step(&self, node: u32, level: u32, item: &Item) -> Option<Step> {
        let levels = max_levels(W);
        let own = &self.nodes[node as usize];
        if let Some(slot) = (0..W).find(|&slot| own.kind(slot) == kind::EMPTY) {
            return (level + 1 + item.height <= levels).then_some(Step::Place(slot));
        }
        let mut children: Vec<Child> = self.children(node).collect();
        let mut item = *item;
        let phi = children.iter().map(|child| child.item.cluster.phi).sum();
        let count = children.iter().map(|child| child.item.cluster.count).sum();
        let least = floor(phi, count);
        for own in children
            .iter_mut()
            .map(|child| &mut child.item)
            .chain([&mut item])
        {
            own.cluster.phi = own.cluster.phi.max(least * f64::from(own.cluster.count));
        }

        let mut best: Option<(f64, Step)> = None;
        let mut offer = |cost: f64, step: Step| {
            if best.is_none_or(|(least, _)| cost < least) {
                best = Some((cost, step));
            }
        };
        for (k, one) in children.iter().enumerate() {
            let fits = level + 2 + one.item.height.max(item.height) <= levels;
            if one.item.kind == kind::INNER {
                // Room for as many below as there will be.
                let below = levels - level - 1;
                let most = W.checked_pow(below).unwrap_or(usize::MAX);
                let count = one.item.cluster.count as usize + item.cluster.count as usize;
                if count <= most && level + 2 + item.height <= levels {
                    let cost = one.item.cluster.merging(&item.cluster) + item.cluster.cost();
                    offer(cost, Step::Enter(one.slot));
                }
            }
            if fits {
                offer(one.item.cluster.pairing(&item.cluster), Step::Pair(one.slot));
            }
            for other in &children[k + 1..] {
                if level + 2 + one.item.height.max(other.item.height) <= levels
                    && level + 1 + item.height <= levels
                {
                    let cost = one.item.cluster.pairing(&other.item.cluster);
                    offer(cost, Step::Merge(one.slot, other.slot));
                }
            }
        }
        best.map(|(_, step)| step)
    }
}

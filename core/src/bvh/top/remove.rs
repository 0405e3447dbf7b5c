//! Instances taken out of the top level, which leave no hole behind.

use super::cost::Cluster;
use crate::bvh::{Bvh, Trails};
use crate::node::{Node, kind};
use crate::tree::INVALID;

impl<N: Node<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// Takes the leaf of an instance out, in time in proportion to the depth.
    pub(in crate::bvh) fn remove_leaf(&mut self, index: u32) {
        let (node, slot) = {
            let placed = &mut self.placed[index as usize];
            (core::mem::replace(&mut placed.node, INVALID), placed.slot)
        };
        if node == INVALID {
            return;
        }
        self.instances[index as usize].place = INVALID;
        self.changes.new.written_instances.push(index);
        self.clear(node, slot as usize);
        let changed = self.fill(node);
        self.update_path(changed);
        self.top.touched.push(changed);
    }

    /// After `node` lost a child: a node with one child gives way to it; the place is filled from below otherwise, where there is
    /// a node below. What is left with empty slots has instances alone. Returns the lowest node whose children changed.
    pub(super) fn fill(&mut self, node: u32) -> u32 {
        let mut node = node;
        loop {
            let own = &self.nodes[node as usize];
            let mut used = (0..W).filter(|&slot| own.kind(slot) != kind::EMPTY);
            let (first, count) = (used.next(), 1 + used.count());
            let Some(slot) = first else {
                if node == self.top.root {
                    return node;
                }
                // All that were below have gone while the tree was built.
                let (above, slot) = (self.parents[node as usize], self.slot_above(node));
                self.free_top_node(node);
                self.clear(above, slot);
                node = above;
                continue;
            };
            if count == 1 {
                return self.give_way(node, slot);
            }
            // Where all of several instances have gone at once, what is dissolved may be empty, too.
            if self.dissolve(node) {
                continue;
            }
            let Some(below) = self.raise(node) else {
                return node;
            };
            node = below;
        }
    }

    /// Puts the one child of `node`, in `slot`, in the place of `node`. Returns the node whose children changed.
    fn give_way(&mut self, node: u32, slot: usize) -> u32 {
        let own = &self.nodes[node as usize];
        let (to, link) = (own.kind(slot), own.link(slot));
        if node != self.top.root {
            let (above, slot) = (self.parents[node as usize], self.slot_above(node));
            self.free_top_node(node);
            self.hang(above, slot, to, link);
            above
        } else if to == kind::INNER {
            self.free_top_node(node);
            self.set_root(link);
            link
        } else {
            node
        }
    }

    /// Puts the children of nodes below `node` in their place as long as there is room for them, those of the costliest first.
    /// Returns whether there were any.
    pub(super) fn dissolve(&mut self, node: u32) -> bool {
        let mut is_changed = false;
        loop {
            let free = W - self.children_of(node);
            let fits = |&slot: &usize| {
                let below = self.nodes[node as usize].link(slot);
                self.children_of(below) <= free + 1
            };
            let Some(slot) = self.costliest(node, fits) else {
                return is_changed;
            };
            is_changed = true;
            let below = self.nodes[node as usize].link(slot);
            let lower = self.nodes[below as usize];
            self.free_top_node(below);
            self.clear(node, slot);
            for child in (0..W).filter(|&slot| lower.kind(slot) != kind::EMPTY) {
                if let Some(slot) = self.empty_slot(node) {
                    self.hang(node, slot, lower.kind(child), lower.link(child));
                }
            }
        }
    }

    /// Fills an empty slot of `node` from the costliest node among its children, with the child of that which lies farthest off.
    /// Returns the node that lost a child; `None` where there is no empty slot, or no child is a node.
    fn raise(&mut self, node: u32) -> Option<u32> {
        let slot = self.empty_slot(node)?;
        let costliest = self.costliest(node, |_| true)?;
        let own = &self.nodes[node as usize];
        let whole = Cluster::new(&own.summary(costliest), 0);
        let below = own.link(costliest);
        let lower = &self.nodes[below as usize];
        let off = |slot: &usize| {
            let child = Cluster::new(&lower.summary(*slot), 0);
            let [x, y, z] = [0, 1, 2].map(|k| child.center[k] - whole.center[k]);
            child.phi * (child.spread + (x * x + y * y + z * z))
        };
        let children = (0..W).filter(|&slot| lower.kind(slot) != kind::EMPTY);
        let outer = children.reduce(|a, b| if off(&b) > off(&a) { b } else { a })?;
        let (to, link) = (lower.kind(outer), lower.link(outer));
        self.clear(below, outer);
        self.hang(node, slot, to, link);
        Some(below)
    }

    /// Number of children of a node.
    pub(super) fn children_of(&self, node: u32) -> usize {
        let own = &self.nodes[node as usize];
        (0..W).filter(|&slot| own.kind(slot) != kind::EMPTY).count()
    }

    fn empty_slot(&self, node: u32) -> Option<usize> {
        let own = &self.nodes[node as usize];
        (0..W).find(|&slot| own.kind(slot) == kind::EMPTY)
    }

    /// The slot of the node that costs most among the children of `node` that are `wanted`; the first of those that cost the same.
    fn costliest(&self, node: u32, wanted: impl Fn(&usize) -> bool) -> Option<usize> {
        let own = &self.nodes[node as usize];
        let inner = (0..W).filter(|&slot| own.kind(slot) == kind::INNER && wanted(&slot));
        let cost = |slot: usize| Cluster::new(&own.summary(slot), 0).cost();
        inner.reduce(|a, b| if cost(b) > cost(a) { b } else { a })
    }
}

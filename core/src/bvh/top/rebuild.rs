//! The top level built anew beside the frame, and put in place of what it was built from.

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

/// A copy of what the top level is built from.
#[derive(Clone, Debug)]
pub(in crate::bvh) struct TopCopy {
    /// By index, those not in use included.
    instances: Vec<Instance>,
    roots: Vec<BlasRoot>,
    /// Indices of the leaves, in order.
    live: Vec<u32>,
    /// Indices of the instances that are opened or could be.
    openable: Vec<u32>,
}

/// A top level as it was built: every word of its nodes is what refit makes of the copy.
#[derive(Debug)]
pub(in crate::bvh) struct TopTree<N> {
    /// In depth-first order; links of nodes count from the first, the root.
    nodes: Vec<N>,
    depth: u32,
    /// The leaves it was built over.
    live: Vec<u32>,
    /// Instances to be opened, and to be closed.
    open: Vec<u32>,
    close: Vec<u32>,
}

impl TopCopy {
    /// A tree over the copy, refitted.
    pub fn build<N: LightNode<W>, const W: usize>(self, params: &BuildParams) -> TopTree<N> {
        if self.live.is_empty() {
            return TopTree {
                nodes: Vec::new(),
                depth: 0,
                live: self.live,
                open: Vec::new(),
                close: Vec::new(),
            };
        }
        let in_world = |i: u32| {
            let instance = &self.instances[i as usize];
            let local = self.roots[instance.blas as usize].summary::<N::Summary>();
            local.to_world(instance)
        };
        let [open, close] = opened::wanted(&self.instances, &self.live, &self.openable, in_world);
        let summaries = self.live.iter().map(|&i| (i, in_world(i)));
        let mut topology: Topology<N> = build_top::<N, W>(summaries, &super::in_full(params));
        for &node in Levels::gather(topology.leveled(0)).nodes() {
            topology.nodes[node as usize] = refit::top(&topology.nodes, &self.instances, &self.roots, node);
        }
        TopTree {
            nodes: topology.nodes,
            depth: topology.depth,
            live: self.live,
            open,
            close,
        }
    }
}

impl<N: LightNode<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// What the top level is built from.
    pub(in crate::bvh) fn copy_top(&self) -> TopCopy {
        let mut live = self.leaves_of_all(&self.live);
        live.sort_unstable();
        TopCopy {
            openable: self.openable(),
            instances: self.instances.clone(),
            roots: self.roots.clone(),
            live,
        }
    }

    /// Puts a tree in place of the top level, which knows nothing of what became of its instances since the epoch stood at
    /// `since`: those that have gone or were put elsewhere are taken out of it, others are put in.
    pub(in crate::bvh) fn install_top(&mut self, tree: &TopTree<N>, since: u64) {
        if tree.nodes.is_empty() || tree.depth > max_levels(W) {
            return;
        }
        self.top.mark += 2;
        let (listed, found) = (self.top.mark - 1, self.top.mark);
        for &index in &tree.live {
            if let Some(placed) = self.placed.get_mut(index as usize)
                && placed.node != INVALID
                && placed.hung <= since
            {
                placed.mark = listed;
            }
        }
        let old = self.top.root;
        let mut interior = alloc::vec![old];
        let mut newcomers = Vec::new();
        let mut next = 0;
        while let Some(&node) = interior.get(next) {
            next += 1;
            for slot in 0..W {
                let own = &self.nodes[node as usize];
                let (to, link) = (own.kind(slot), own.link(slot));
                if to == kind::INNER {
                    interior.push(link);
                } else if to == kind::MESH {
                    let placed = &mut self.placed[link as usize];
                    if placed.mark == listed {
                        placed.mark = found;
                        placed.hung_radiance = placed.radiance;
                    } else {
                        placed.node = INVALID;
                        newcomers.push(link);
                    }
                }
            }
        }
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
                } else if to == kind::MESH && self.placed[link as usize].mark != found {
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
        }
        self.set_root(nodes[0]);
        // Where a device refits in place of the CPU, the copy was of roots that are not those of the device.
        self.changes.new.whole_top |= !self.changes.unrefitted.is_empty();
        // Its words are those of the copy.
        for &index in &tree.live {
            let placed = &self.placed[index as usize];
            if placed.mark != found {
                continue;
            }
            let placed = &self.placed[index as usize];
            let blas = self.blas_of(placed);
            if placed.changed.max(blas.changed).max(blas.created) > since {
                self.changes.new.instances.push(index);
            }
        }
        // From the lowest: what is above may go with them.
        for node in lost.into_iter().rev() {
            if self.top.number(node) != INVALID {
                let changed = self.fill(node);
                self.update_path(changed);
            }
        }
        newcomers.sort_unstable();
        self.insert_instances(&newcomers);
        self.reopen(&tree.open, &tree.close);
        self.settle();
    }
}

//! Nodes that edits have touched, built anew a few at a time.
//!
//! An insertion looks at one node of each level, so trees get worse by and by. After an edit the nodes above it are looked at from the
//! lowest up: one below which so many edits were made since it was built last that they may matter is built anew over at most
//! [`MOST`] subtrees, what is below these staying as it is. A node of `n` instances takes `n / OFTEN` edits: the lowest two levels are built at
//! every edit, each level above an eighth as often as that below, for `W` = 8.

use alloc::vec::Vec;

use super::cost::Cluster;
use super::insert::Item;
use crate::build::{BuildParams, Heuristic, Topology, build_top};
use crate::bvh::{Bvh, Trails};
use crate::node::{LightNode, kind};
use crate::trail::max_levels;
use crate::tree::INVALID;

/// Subtrees that a node is built anew over.
const MOST: usize = 64;
/// A node of so many instances is built anew at each edit below it.
const OFTEN: u32 = 64;

/// What a node is built anew over.
struct Treelet<S> {
    /// The nodes that make way: the node itself first.
    interior: Vec<u32>,
    items: Vec<(Item, S)>,
}

impl<N: LightNode<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// Builds anew what edits have touched, in time in proportion to the edits times the depth.
    pub(in crate::bvh) fn settle(&mut self) {
        for start in core::mem::take(&mut self.top.touched) {
            let mut node = start;
            // It may have gone since: then what took its place was built over it.
            while self.top.number(node) != INVALID {
                let number = self.top.number(node) as usize;
                if self.top.heights[number] > 1
                    && self.top.edits[number] * u64::from(OFTEN) >= u64::from(self.top.counts[number])
                {
                    self.build_anew(node);
                }
                node = self.parents[node as usize];
            }
        }
    }

    /// Builds `node` anew over a few subtrees below it.
    fn build_anew(&mut self, node: u32) {
        let number = self.top.number(node) as usize;
        self.top.edits[number] = 0;
        let treelet = self.treelet(node);
        let params = BuildParams {
            heuristic: match self.params.heuristic {
                Heuristic::Morton => Heuristic::Ward,
                other => other,
            },
            ..self.params
        };
        let summaries = (0..).zip(&treelet.items).map(|(k, &(_, summary))| (k, summary));
        let topology: Topology<N> = build_top::<N, W>(summaries, &params);
        let level = self.level(node);
        let deepest = (0..).zip(&topology.nodes).flat_map(|(k, own)| {
            let leaves = (0..W).filter(move |&slot| own.kind(slot) == kind::MESH);
            let below = topology.levels[k];
            leaves.map(move |slot| (below, own.link(slot)))
        });
        let deepest = deepest.map(|(below, item)| below + treelet.items[item as usize].0.height);
        if level + 1 + deepest.max().unwrap_or(0) > max_levels(W) {
            return;
        }
        for &old in &treelet.interior[1..] {
            self.free_top_node(old);
        }
        let mut nodes = alloc::vec![node];
        nodes.extend(topology.nodes[1..].iter().map(|_| self.new_top_node()));
        for (&own, words) in nodes.iter().zip(&topology.nodes) {
            self.nodes[own as usize] = N::EMPTY;
            for slot in 0..W {
                let link = words.link(slot) as usize;
                match words.kind(slot) {
                    kind::INNER => self.hang(own, slot, kind::INNER, nodes[link]),
                    kind::MESH => {
                        let item = &treelet.items[link].0;
                        self.hang(own, slot, item.kind, item.link);
                    }
                    _ => {}
                }
            }
            self.changes.new.written_nodes.push(own..own + 1);
            self.changes.new.top_nodes.push(own);
        }
        for &own in nodes.iter().rev() {
            self.measure(own);
            self.refit_node(own);
        }
        self.update_path(node);
    }

    /// The children of `node`, the costliest node among them opened again and again while there are no more than [`MOST`].
    fn treelet(&self, node: u32) -> Treelet<N::Summary> {
        let mut out = Treelet {
            interior: alloc::vec![node],
            items: self.items(node).collect(),
        };
        loop {
            let room = MOST + 1 - out.items.len();
            let mut best: Option<(f64, usize)> = None;
            for (k, (item, _)) in out.items.iter().enumerate() {
                let cost = item.cluster.cost();
                if item.kind == kind::INNER
                    && best.is_none_or(|(most, _)| cost > most)
                    && self.children_of(item.link) <= room
                {
                    best = Some((cost, k));
                }
            }
            let Some((_, k)) = best else { return out };
            let (opened, _) = out.items.swap_remove(k);
            out.interior.push(opened.link);
            out.items.extend(self.items(opened.link));
        }
    }

    /// Levels above a node of the top level.
    fn level(&self, node: u32) -> u32 {
        let mut above = self.parents[node as usize];
        let mut level = 0;
        while above != INVALID {
            above = self.parents[above as usize];
            level += 1;
        }
        level
    }

    /// The children of a node of the top level, with what is known of them.
    fn items(&self, node: u32) -> impl Iterator<Item = (Item, N::Summary)> + '_ {
        let own = &self.nodes[node as usize];
        let used = (0..W).filter(|&slot| own.kind(slot) != kind::EMPTY);
        used.map(move |slot| {
            let (height, count) = self.measured(own.kind(slot), own.link(slot));
            let summary = own.summary(slot);
            let item = Item {
                kind: own.kind(slot),
                link: own.link(slot),
                cluster: Cluster::new(&summary, count),
                height,
            };
            (item, summary)
        })
    }
}

//! A tree emitted in parts, by several threads.

use alloc::vec::Vec;

use rayon::prelude::*;

use super::emit::{Emitter, Leaves};
use super::range::Range;
use crate::build::topology::Topology;
use crate::node::{Node, kind};
use crate::trail::BitTrail;

/// Some nodes of a tree and the lights among them; the parts in order are the tree in depth-first order.
struct Part<N> {
    tree: Topology<N>,
    /// The part is one large node: its links count parts from here on. Else they count nodes of this part.
    is_upper: bool,
}

impl<L: Leaves, const W: usize> Emitter<'_, L, W> {
    /// The tree over `range`, of the same bits as [`node`](Self::node) emits.
    pub fn in_parallel<N: Node<W>>(&self, range: Range<'_>) -> Topology<N> {
        put_together::<N, W>(self.parts(range, 0, BitTrail::default()))
    }

    /// The parts of the subtree over `range`: a small one is one part, a large one its root and the parts of its children.
    fn parts<N: Node<W>>(&self, range: Range<'_>, level: u32, trail: BitTrail) -> Vec<Part<N>> {
        if range.len() < super::SUBTREE {
            let mut tree = self.room_for(range.len());
            self.node(range, level, trail, &mut tree);
            return alloc::vec![Part {
                tree,
                is_upper: false,
            }];
        }
        let mut slot = 0;
        let mut children = Vec::with_capacity(W);
        for (range, opened) in self.children(range, level).into_iter() {
            let leaf = self.leaf(&range, opened);
            children.push((range, leaf, slot));
            slot += leaf.map_or(1, |index| self.leaves.count(index));
        }
        let children: Vec<_> = children
            .into_par_iter()
            .with_max_len(1)
            .map(|(range, leaf, slot)| {
                let own = trail.with::<W>(level, slot as u32);
                let parts = leaf.is_none().then(|| self.parts(range, level + 1, own));
                (leaf, slot, parts)
            })
            .collect();

        let mut root = Topology::<N>::EMPTY;
        root.node(level);
        let mut all = alloc::vec![Part {
            tree: Topology::EMPTY,
            is_upper: true,
        }];
        for (leaf, mut slot, parts) in children {
            if let Some(parts) = parts {
                root.nodes[0].set_child(slot, kind::INNER, all.len() as u32);
                all.extend(parts);
            } else if let Some(index) = leaf {
                // Lights beside subtrees keep their place in the order of trails: a part without nodes.
                self.lights(index, 0, &mut slot, level, trail, &mut root);
                let trails = core::mem::take(&mut root.trails);
                all.push(Part {
                    tree: Topology {
                        trails,
                        ..Topology::EMPTY
                    },
                    is_upper: false,
                });
            }
        }
        all[0].tree = root;
        all
    }
}

fn put_together<N: Node<W>, const W: usize>(parts: Vec<Part<N>>) -> Topology<N> {
    let mut bases = Vec::with_capacity(parts.len());
    let (mut nodes, mut lights) = (0, 0);
    for part in &parts {
        bases.push(nodes);
        nodes += part.tree.nodes.len();
        lights += part.tree.trails.len();
    }
    let node = |i: usize| {
        // Of parts that begin at the same node, the last is the one that holds it.
        let at = bases.partition_point(|&base| base <= i) - 1;
        let mut node = parts[at].tree.nodes[i - bases[at]];
        for slot in 0..W {
            if node.kind(slot) == kind::INNER {
                let link = node.link(slot) as usize;
                let moved = if parts[at].is_upper {
                    bases[at + link]
                } else {
                    bases[at] + link
                };
                node.relink(slot, moved as u32);
            }
        }
        node
    };
    let (nodes, trails) = rayon::join(
        || (0..nodes).into_par_iter().with_min_len(1024).map(node).collect(),
        || {
            let mut trails = Vec::with_capacity(lights);
            parts
                .iter()
                .for_each(|part| trails.extend_from_slice(&part.tree.trails));
            trails
        },
    );
    Topology {
        nodes,
        trails,
        depth: parts.iter().map(|part| part.tree.depth).max().unwrap_or(0),
    }
}

impl<N> Topology<N> {
    const EMPTY: Self = Self {
        nodes: Vec::new(),
        trails: Vec::new(),
        depth: 0,
    };
}

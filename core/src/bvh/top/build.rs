//! The whole top level, built from its leaves.
//!
//! Only whole builds open instances (partial re-braiding, Benthin et al. 2017), edits never do. An instance is opened if its parts
//! lie among other leaves: by the variance of their positions ([`OPENS`]). So is one of which a beam holds
//! the light of some parts and not of others: no beam holds that of the whole.

use alloc::vec::Vec;

use super::{Cluster, Opened, Shape, Top, Written};
use crate::beam::Beam;
use crate::build::{BuildParams, build_top};
use crate::node::{Node, kind};
use crate::summary::Summary;
use crate::trail::{leaf, place_parts};
use crate::tree::{INVALID, OPENED};

/// An instance is opened if the variance of position between its parts, times this and the width of nodes, is more than that in the node
/// that it would be in. Families of scenes by `lightbvh variance`: at 4 parked cars of 16-wide nodes have 13 times the variance of one level, at
/// 8 no more than it; panels in ceilings, which gain nothing, stay closed.
const OPENS: f64 = 8.0;
/// The same for an instance that the next build may open.
const MAY_OPEN: f64 = 4.0 * OPENS;

/// In a build every leaf counts for at least this part of the mean flux, so a lamp of zero flux stays among its neighbours.
const FLOOR: f64 = 1.0 / 1024.0;

/// Whether some of the beams are narrow and others are not.
pub(crate) fn are_mixed<'a>(beams: impl Iterator<Item = &'a Beam>) -> bool {
    let mut found = [false; 2];
    beams.for_each(|beam| found[usize::from(beam.is_narrow())] = true);
    found == [true; 2]
}

impl Opened {
    /// The variance of position between the parts, m².
    fn between<S: Summary>(&self) -> f64 {
        let parts = || {
            self.parts
                .iter()
                .map(|(words, _)| Cluster::new(&S::from_words(words)))
        };
        let all = parts().fold(Cluster::default(), |all, part| all.and(&part));
        let within: f64 = parts().map(|part| part.cost()).sum();
        if all.phi > 0.0 {
            (all.cost() - within) / all.phi
        } else {
            0.0
        }
    }
}

impl<N> Top<N> {
    /// Whether the next build may open an instance: one that is new, or whose summary `own` nearly varies enough in its node.
    pub fn may_open<const W: usize>(&self, instance: u32, own: &N::Summary) -> bool
    where
        N: Node<W>,
    {
        match self.places.get(instance as usize) {
            None | Some(&INVALID) => true,
            Some(at) if at & OPENED != 0 => true,
            Some(&at) => {
                let shape = &self.shapes[place_parts::<W>(at).0 as usize];
                f64::from(own.spread()) * MAY_OPEN * W as f64
                    > f64::from(N::Summary::from_words(&shape.words).spread())
            }
        }
    }

    /// Builds the whole top level: links, then every node.
    pub fn build<const W: usize>(&mut self, params: &BuildParams)
    where
        N: Node<W>,
    {
        let there = (0u32..)
            .zip(&self.leaves)
            .filter_map(|(instance, words)| words.as_ref().map(|_| instance));
        let there: Vec<u32> = there.collect();
        let leaf = |&own: &u32| self.leaf(own).summary;
        let flux: f64 = there.iter().map(|own| f64::from(leaf(own).phi())).sum();
        let floor = match flux > 0.0 {
            true => (flux / there.len() as f64 * FLOOR) as f32,
            false => 1.0,
        };
        self.parts.clear();
        self.opened.values_mut().for_each(|own| own.first = INVALID);
        let mut nodes = self.topology::<W>(&there, floor, params);
        if params.opens && !self.opened.is_empty() && self.open(&nodes) {
            nodes = self.topology::<W>(&there, floor, params);
        }
        self.replace::<W>(nodes);
        (0..self.nodes.len() as u32)
            .rev()
            .for_each(|node| self.refit_node(node));
        self.written = Written {
            is_whole: true,
            ..Written::default()
        };
    }

    /// The nodes over the links of instances, still to be computed.
    fn topology<const W: usize>(&self, instances: &[u32], floor: f32, params: &BuildParams) -> Vec<N>
    where
        N: Node<W>,
    {
        let links = instances
            .iter()
            .flat_map(|&own| self.links_of(own).map(move |part| leaf(own, part)));
        let leaves: Vec<_> = links.map(|link| (link, self.leaf(link).summary)).collect();
        if leaves.is_empty() {
            return alloc::vec![N::EMPTY];
        }
        // If meshes may be opened, leaves are few and large: a split plane a little off costs more than in bottom levels.
        let buckets = if params.opens { 2 } else { 1 };
        let params = BuildParams {
            buckets: params.buckets.saturating_mul(buckets),
            ..*params
        };
        build_top::<N, W>(leaves.into_iter(), floor, &params).nodes
    }

    /// Opens instances by the nodes, in depth-first order, of a tree in which all are closed; forgets the parts of those that are far
    /// from that. Returns whether any is open.
    fn open<const W: usize>(&mut self, nodes: &[N]) -> bool
    where
        N: Node<W>,
    {
        let mut opened = core::mem::take(&mut self.opened);
        let mut clusters = alloc::vec![Cluster::default(); nodes.len()];
        for (index, node) in nodes.iter().enumerate().rev() {
            let of_child = |all: Cluster, slot: usize| match node.kind(slot) {
                kind::INNER => all.and(&clusters[node.link(slot) as usize]),
                kind::MESH => all.and(&Cluster::new(&self.leaf(node.link(slot)).summary)),
                _ => all,
            };
            let all = (0..W).fold(Cluster::default(), of_child);
            clusters[index] = all;
            for slot in (0..W).filter(|&slot| node.kind(slot) == kind::MESH) {
                let Some(own) = opened.get_mut(&node.link(slot)) else {
                    continue;
                };
                let between = own.between::<N::Summary>();
                let are_mixed = are_mixed(own.parts.iter().map(|(_, limits)| &limits.beam));
                if are_mixed || between * OPENS * W as f64 > all.spread {
                    own.first = self.parts.len() as u32;
                    self.parts.resize(self.parts.len() + W, INVALID);
                } else if between * MAY_OPEN * (W as f64) < all.spread {
                    own.parts.clear();
                }
            }
        }
        opened.retain(|_, own| !own.parts.is_empty());
        self.opened = opened;
        !self.parts.is_empty()
    }

    /// Replaces the nodes, by nodes in depth-first order, the root first. They are still to be computed.
    pub fn replace<const W: usize>(&mut self, nodes: Vec<N>)
    where
        N: Node<W>,
    {
        self.root = 0;
        self.above.clear();
        self.above.resize(nodes.len(), INVALID);
        self.shapes.clear();
        let new = Shape {
            height: 1,
            is_changed: true,
            from: [f32::NAN; 3],
            ..Shape::default()
        };
        self.shapes.resize(nodes.len(), new);
        self.free.clear();
        self.lost.clear();
        self.nodes = nodes;
        self.note_places::<W>();
    }

    /// Sets the places of all nodes and leaves from the links downward.
    pub fn note_places<const W: usize>(&mut self)
    where
        N: Node<W>,
    {
        self.places.fill(INVALID);
        for (&instance, own) in &self.opened {
            if own.first != INVALID {
                self.places[instance as usize] = OPENED | own.first;
            }
        }
        for node in 0..self.nodes.len() {
            if self.shapes[node].height == 0 {
                continue;
            }
            for slot in 0..W {
                let own = &self.nodes[node];
                let (to, link) = (own.kind(slot), own.link(slot));
                let at = crate::trail::place::<W>(node as u32, slot as u32);
                if to == kind::INNER {
                    self.above[link as usize] = at;
                } else if to == kind::MESH {
                    let (instance, part) = crate::trail::leaf_parts(link);
                    self.set_place(instance, part, at);
                }
            }
        }
    }
}

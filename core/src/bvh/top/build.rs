//! The whole top level, built from its leaves.
//!
//! Only whole builds open instances (partial re-braiding, Benthin et al. 2017), edits never do. They open those whose parts lie among
//! other leaves ([`OPENS`]), and those of which a beam holds the light of some parts and not of others: no beam holds that of the whole.

use alloc::vec::Vec;

use super::{Cluster, Opened, Shape, Top, Written};
use crate::beam::Beam;
use crate::build::{BuildParams, build_top};
use crate::node::{Node, kind};
use crate::summary::Summary;
use crate::trail::{leaf, place_parts};
use crate::tree::{INVALID, OPENED};

/// An instance is opened if this · `W` · variance of position between its parts is more than the variance in its node of the tree in
/// which all are closed. At 4, parked cars in a 16-wide tree have 15 times the variance of one level, at 8 no more than 1.3 times
/// (`lightbvh variance --seed 2`).
const OPENS: f64 = 8.0;

/// At most as many are opened for that, among those of most overlap: each takes up to `W` leaves, and as many edits when it moves.
const MOST: usize = 1024;

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
            let summaries = self.parts.iter().map(|(words, _)| S::from_words(words));
            summaries.map(|part| Cluster::new(&part))
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
    /// Builds the whole top level: links, then every node.
    pub fn build<const W: usize>(&mut self, params: &BuildParams)
    where
        N: Node<W>,
    {
        let there = (0u32..)
            .zip(&self.leaves)
            .filter_map(|(instance, words)| words.as_ref().map(|_| instance));
        let there: Vec<u32> = there.collect();
        self.parts.clear();
        self.opened.values_mut().for_each(|own| own.first = INVALID);
        self.build_over(&there, params);
        if params.opens && there.len() > 1 && self.open(&there) {
            self.build_over(&there, params);
        }
        self.written = Written {
            is_whole: true,
            ..Written::default()
        };
    }

    /// Builds over instances, opened as they are.
    fn build_over<const W: usize>(&mut self, instances: &[u32], params: &BuildParams)
    where
        N: Node<W>,
    {
        let links = instances
            .iter()
            .flat_map(|&own| self.links_of(own).map(move |part| leaf(own, part)));
        let leaves: Vec<_> = links.map(|link| (link, self.leaf(link).summary)).collect();
        let flux: f64 = leaves.iter().map(|(_, own)| f64::from(own.phi())).sum();
        let floor = match flux > 0.0 {
            true => (flux / instances.len() as f64 * FLOOR) as f32,
            false => 1.0,
        };
        // If meshes may be opened, leaves are few and large: a split plane a little off costs more than in bottom levels.
        let buckets = if params.opens { 2 } else { 1 };
        let params = BuildParams {
            buckets: params.buckets.saturating_mul(buckets),
            ..*params
        };
        let nodes = match leaves[..] {
            [] => alloc::vec![N::EMPTY],
            _ => build_top::<N, W>(leaves.into_iter(), floor, &params).nodes,
        };
        self.replace::<W>(nodes);
        (0..self.nodes.len() as u32)
            .rev()
            .for_each(|node| self.refit_node(node));
    }

    /// Opens instances by the tree in which all are closed, and lists those whose parts it would have to know. Returns whether any is
    /// open.
    fn open<const W: usize>(&mut self, instances: &[u32]) -> bool
    where
        N: Node<W>,
    {
        // By overlap, the most first: the ratio, the instance, and what its parts must exceed.
        let overlap = |&instance: &u32| {
            let (node, _) = place_parts::<W>(self.places[instance as usize]);
            let around = self.shapes[node as usize].cluster.spread / (OPENS * W as f64);
            let own = f64::from(self.leaf(leaf(instance, 0)).summary.spread());
            (own > around).then(|| (around / own, instance, around))
        };
        let mut chosen: Vec<_> = instances.iter().filter_map(overlap).collect();
        chosen.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        chosen.truncate(MOST);
        let mut opened = core::mem::take(&mut self.opened);
        self.wanted.clear();
        for (_, instance, around) in chosen {
            match opened.remove(&instance) {
                None => self.wanted.push(instance),
                Some(own) => {
                    let opens = own.between::<N::Summary>() > around;
                    self.put_parts::<W>(instance, own, opens);
                }
            }
        }
        for (instance, own) in opened {
            if are_mixed(own.parts.iter().map(|(_, limits)| &limits.beam)) {
                self.put_parts::<W>(instance, own, true);
            }
        }
        !self.parts.is_empty()
    }

    /// Keeps the parts of an instance, which is opened if it `opens` or is mixed.
    fn put_parts<const W: usize>(&mut self, instance: u32, own: Opened, opens: bool) {
        let mut own = own;
        if opens || are_mixed(own.parts.iter().map(|(_, limits)| &limits.beam)) {
            own.first = self.parts.len() as u32;
            self.parts.resize(self.parts.len() + W, INVALID);
        }
        self.opened.insert(instance, own);
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

//! The whole top level, built from its leaves.
//!
//! Only whole builds open instances (partial re-braiding, Benthin et al. 2017), edits never do. An instance is opened if its
//! lights cost more than [`OPENS`] of the cost of all lights by Ward's criterion, flux times variance of position, or if a beam holds the
//! light of some of its parts and not of others: no beam holds that of the whole.

use alloc::vec::Vec;

use super::{Cluster, Shape, Top, Written};
use crate::beam::Beam;
use crate::build::{BuildParams, Topology, build_top};
use crate::node::{Node, kind};
use crate::summary::Summary;
use crate::trail::leaf;
use crate::tree::{INVALID, OPENED};

/// An instance that costs more than this part of the whole is opened. At most as many as its inverse do.
const OPENS: f64 = 1.0 / 8192.0;

/// In a build every leaf counts for at least this part of the mean flux, so a lamp of zero flux stays among its neighbours.
const FLOOR: f64 = 1.0 / 1024.0;

/// Whether an instance of summary `own` may be opened if all lights cost about `whole`, which may count moved ones twice.
pub(crate) fn may_open<S: Summary>(own: &S, whole: f64) -> bool {
    f64::from(own.phi()) * f64::from(own.spread()) > whole * (OPENS / 16.0)
}

/// Whether some of the beams are narrow and others are not.
pub(crate) fn are_mixed<'a>(beams: impl Iterator<Item = &'a Beam>) -> bool {
    let mut found = [false; 2];
    beams.for_each(|beam| found[usize::from(beam.is_narrow())] = true);
    found == [true; 2]
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
        let whole = there.iter().fold(Cluster::default(), |whole, &own| {
            whole.and(&self.leaf(own).summary)
        });
        self.open_or_close::<W>(params.opens && there.len() > 1, whole.cost());
        let links = there
            .iter()
            .flat_map(|&own| self.links_of(own).map(move |part| leaf(own, part)));
        let leaves: Vec<_> = links.map(|link| (link, self.leaf(link).summary)).collect();
        let floor = match whole.phi > 0.0 {
            true => (whole.phi / there.len() as f64 * FLOOR) as f32,
            false => 1.0,
        };
        if leaves.is_empty() {
            self.replace::<W>(alloc::vec![N::EMPTY]);
        } else {
            // If meshes may be opened, leaves are few and large: a split plane a little off costs more than in bottom levels.
            let buckets = if params.opens { 2 } else { 1 };
            let params = BuildParams {
                buckets: params.buckets.saturating_mul(buckets),
                ..*params
            };
            let topology: Topology<N> = build_top::<N, W>(leaves.into_iter(), floor, &params);
            self.replace::<W>(topology.nodes);
        }
        (0..self.nodes.len() as u32)
            .rev()
            .for_each(|node| self.refit_node(node));
        self.written = Written {
            is_whole: true,
            ..Written::default()
        };
    }

    /// Opens instances that cost much of `whole` or are mixed, and closes the others.
    fn open_or_close<const W: usize>(&mut self, opens: bool, whole: f64)
    where
        N: Node<W>,
    {
        self.parts.clear();
        let mut opened = core::mem::take(&mut self.opened);
        opened.retain(|&instance, own| {
            let known = self.leaf(instance).summary;
            let cost = f64::from(known.phi()) * f64::from(known.spread());
            own.first = INVALID;
            let are_mixed = are_mixed(own.parts.iter().map(|(_, limits)| &limits.beam));
            if opens && own.parts.len() > 1 && (are_mixed || cost > whole * OPENS) {
                own.first = self.parts.len() as u32;
                self.parts.resize(self.parts.len() + W, INVALID);
            }
            are_mixed || may_open(&known, whole)
        });
        self.opened = opened;
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

//! A top level as it is built beside the frame.

use alloc::vec::Vec;

use crate::build::Topology;
use crate::levels::Levels;
use crate::node::{LightNode, kind};
use crate::summary::Summary;
use crate::trail::BitTrail;
use crate::tree::INVALID;

/// A top level with all that [`Top`] wants to know of it, made beside the frame. Nodes count from the first, the root.
#[derive(Debug)]
pub(in crate::bvh) struct TopTree<N> {
    pub nodes: Vec<N>,
    pub node_levels: Vec<u32>,
    pub levels: Levels,
    pub leaves: Vec<u32>,
    pub depth: u32,
    /// In the order of instances, so that putting them in place goes through memory in order.
    pub places: Vec<Place>,
}

/// Where an instance is a leaf.
#[derive(Clone, Copy, Debug)]
pub(in crate::bvh) struct Place {
    pub instance: u32,
    pub node: u32,
    pub slot: u32,
    pub trail: BitTrail,
}

impl<N> TopTree<N> {
    /// The tree of `topology`, whose leaves link to instances.
    pub fn new<const W: usize>(topology: Topology<N>, levels: Levels) -> Self
    where
        N: LightNode<W>,
    {
        let trails = topology.trails.iter();
        let mut places: Vec<Place> = trails
            .map(|&(instance, trail)| Place {
                instance,
                node: INVALID,
                slot: 0,
                trail,
            })
            .collect();
        places.sort_unstable_by_key(|place| place.instance);
        let mut leaves = Vec::new();
        for (index, node) in (0..).zip(&topology.nodes) {
            let mut leaf = false;
            for slot in (0..W).filter(|&slot| node.kind(slot) == kind::MESH) {
                leaf = true;
                if let Ok(at) = places.binary_search_by_key(&node.link(slot), |place| place.instance) {
                    places[at].node = index;
                    places[at].slot = slot as u32;
                }
            }
            if leaf {
                leaves.push(index);
            }
        }
        Self {
            nodes: topology.nodes,
            node_levels: topology.levels,
            levels,
            leaves,
            depth: topology.depth,
            places,
        }
    }

    /// A tree without instances.
    pub fn empty<const W: usize>() -> Self
    where
        N: LightNode<W>,
    {
        Self {
            nodes: alloc::vec![without_children::<N, W>()],
            node_levels: alloc::vec![0],
            levels: Levels::gather(alloc::vec![(0, 0)]),
            leaves: Vec::new(),
            depth: 1,
            places: Vec::new(),
        }
    }
}

/// A node without children, as refit leaves it.
pub(super) fn without_children<N: LightNode<W>, const W: usize>() -> N {
    let mut node = N::EMPTY;
    node.set_summaries(&[N::Summary::EMPTY; W]);
    node
}

//! What a thread builds, and what it gives.

use alloc::vec::Vec;
use core::marker::PhantomData;

use super::dirty::Dirty;
use super::fit::fit;
use crate::build::{BuildParams, build_over};
use crate::bvh::quality::Quality;
use crate::levels::Levels;
use crate::light::Light;
use crate::node::{Holds, Node, kind};
use crate::sweep;
use crate::trail::BitTrail;
use crate::tree::INVALID;

/// A bottom level's triangles as they were when they were copied.
#[derive(Clone, Debug)]
pub(crate) struct MeshJob<N: Holds> {
    params: BuildParams,
    pub(super) triangles: Vec<N::Light>,
    /// How many there will be, and how many are copied.
    count: usize,
    copied: usize,
    /// Of a part of a tree: which triangles of the mesh, in order, and where the part hangs.
    pub(super) places: Vec<u32>,
    place: Option<Place>,
    layout: PhantomData<N>,
}

/// Where a part of a tree hangs.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    /// How many nodes it is to have.
    pub nodes: u32,
    /// The nodes above it, and the slots taken there.
    pub level: u32,
    pub trail: BitTrail,
    /// Most levels of the part itself.
    pub levels: u32,
}

/// A bottom level as it is built beside the frames; nodes and triangles count from 0.
#[derive(Debug)]
pub(crate) struct MeshTree<N: Holds> {
    pub(super) nodes: Vec<N>,
    pub(super) parents: Vec<u32>,
    pub(super) quality: Vec<Quality>,
    pub(super) trails: Vec<BitTrail>,
    pub(super) levels: Levels,
    pub(super) depth: u32,
    /// How many nodes and trails are in place.
    pub(super) nodes_placed: usize,
    pub(super) trails_placed: usize,
    /// Of a part: its triangles, where in the mesh they are, and nodes that are to be computed. Its trails begin at the mesh's
    /// root, and it has no nodes where no tree of as many was found.
    pub(super) triangles: Vec<N::Light>,
    pub(super) places: Vec<u32>,
    pub(super) dirty: Dirty,
}

impl<N: Holds> Default for MeshTree<N> {
    fn default() -> Self {
        Self {
            nodes: Vec::new(),
            parents: Vec::new(),
            quality: Vec::new(),
            trails: Vec::new(),
            levels: Levels::default(),
            depth: 0,
            nodes_placed: 0,
            trails_placed: 0,
            triangles: Vec::new(),
            places: Vec::new(),
            dirty: Dirty::default(),
        }
    }
}

impl<N: Holds> MeshJob<N> {
    /// One of `count` triangles that are still to be copied.
    pub(super) fn new(params: &BuildParams, count: usize) -> Self {
        Self {
            params: *params,
            triangles: Vec::new(),
            count,
            copied: 0,
            places: Vec::new(),
            place: None,
            layout: PhantomData,
        }
    }

    /// One of a part of a tree.
    pub(super) fn of_part(params: &BuildParams, places: Vec<u32>, place: Place) -> Self {
        Self {
            place: Some(place),
            ..Self::new(params, places.len())
        }
        .with_places(places)
    }

    fn with_places(mut self, places: Vec<u32>) -> Self {
        self.places = places;
        self
    }

    /// How many are copied, and how many are not yet.
    pub(super) fn copied(&self) -> (usize, usize) {
        (self.copied, self.count - self.copied)
    }

    /// Has memory for all triangles that has been written before: where that is done on a thread, no frame pays for its pages.
    #[must_use]
    pub fn with_room(mut self) -> Self {
        self.triangles.resize(self.count, N::Light::DARK);
        self
    }

    /// Copies more of them.
    pub(super) fn copy(&mut self, some: &[N::Light]) {
        let from = self.copied;
        self.copied += some.len();
        match self.triangles.get_mut(from..self.copied) {
            Some(room) => room.copy_from_slice(some),
            None => {
                self.triangles.reserve_exact(self.count - from);
                self.triangles.extend_from_slice(some);
            }
        }
    }

    /// Builds and refits. The result depends on nothing but `self`.
    pub fn run<const W: usize>(self) -> MeshTree<N>
    where
        N: Node<W>,
    {
        let built = build_over::<N, W>(&self.triangles, &self.params);
        let topology = match &self.place {
            None => Some(built),
            Some(place) => fit::<N, W>(built, &self.triangles, place.nodes as usize, place.levels),
        };
        let Some(topology) = topology else {
            return MeshTree::default();
        };
        let levels = Levels::gather(topology.leveled(0));
        let mut nodes = topology.nodes;
        sweep::bottom_sweep(&mut nodes, 0, &self.triangles, &[0]);
        let mut parents = alloc::vec![INVALID; nodes.len()];
        for (index, node) in (0..).zip(&nodes) {
            for slot in (0..W).filter(|&slot| node.kind(slot) == kind::INNER) {
                parents[node.link(slot) as usize] = index;
            }
        }
        let mut trails = alloc::vec![BitTrail::default(); self.triangles.len()];
        for (triangle, mut trail) in topology.trails {
            if let Some(place) = &self.place {
                for level in (0..place.level).rev() {
                    trail = trail.behind::<W>(place.trail.slot::<W>(level));
                }
            }
            trails[triangle as usize] = trail;
        }
        let is_part = self.place.is_some();
        MeshTree {
            triangles: if is_part { self.triangles } else { Vec::new() },
            places: self.places,
            dirty: if is_part {
                Dirty::none(nodes.len())
            } else {
                Dirty::default()
            },
            quality: Quality::as_built(&nodes),
            nodes,
            parents,
            trails,
            levels,
            depth: topology.depth,
            nodes_placed: 0,
            trails_placed: 0,
        }
    }
}

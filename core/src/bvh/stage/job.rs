//! What a thread builds, and what it gives.

use alloc::vec::Vec;
use core::marker::PhantomData;

use crate::build::{BuildParams, build_over};
use crate::bvh::quality::Quality;
use crate::levels::Levels;
use crate::light::EmissiveTriangle;
use crate::node::{LightNode, kind};
use crate::sweep;
use crate::trail::BitTrail;
use crate::tree::INVALID;

/// What stands where no triangle has been copied to yet.
const DARK: EmissiveTriangle = EmissiveTriangle {
    p: [[0.0; 3]; 3],
    radiance: [0.0; 3],
    mesh: INVALID,
    flags: 0,
};

/// A bottom level's triangles as they were when they were copied.
#[derive(Clone, Debug)]
pub(crate) struct MeshJob<N> {
    params: BuildParams,
    pub(super) triangles: Vec<EmissiveTriangle>,
    /// How many there will be, and how many are copied.
    count: usize,
    copied: usize,
    layout: PhantomData<N>,
}

/// A bottom level as it is built beside the frames; nodes and triangles count from 0.
#[derive(Debug)]
pub(crate) struct MeshTree<N> {
    pub(super) nodes: Vec<N>,
    pub(super) parents: Vec<u32>,
    pub(super) quality: Vec<Quality>,
    pub(super) trails: Vec<BitTrail>,
    pub(super) levels: Levels,
    pub(super) depth: u32,
    /// How many nodes and trails are in place.
    pub(super) nodes_placed: usize,
    pub(super) trails_placed: usize,
}

impl<N> MeshJob<N> {
    /// One of `count` triangles that are still to be copied.
    pub(super) fn new(params: &BuildParams, count: usize) -> Self {
        Self {
            params: *params,
            triangles: Vec::new(),
            count,
            copied: 0,
            layout: PhantomData,
        }
    }

    /// Has memory for all triangles that has been written before: where that is done on a thread, no frame pays for its pages.
    #[must_use]
    pub fn with_room(mut self) -> Self {
        self.triangles.resize(self.count, DARK);
        self
    }

    /// Copies more of them.
    pub(super) fn copy(&mut self, some: &[EmissiveTriangle]) {
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
        N: LightNode<W>,
    {
        let topology = build_over::<N, W>(&self.triangles, &self.params);
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
        for (triangle, trail) in topology.trails {
            trails[triangle as usize] = trail;
        }
        MeshTree {
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

//! Building an owned light BVH: trees from the builder, bounds from refit.

use alloc::vec::Vec;

#[cfg(feature = "rayon")]
use rayon::prelude::*;

use super::LightBvh;
use crate::build::{BuildParams, Topology, build_over, build_top};
use crate::instance::Instance;
use crate::levels::Levels;
use crate::lights::Lights;
use crate::node::{LightNode, kind};
use crate::refit::BlasRoot;
use crate::summary::Summary;
use crate::trail::{BitTrail, trail_words};

impl<N: LightNode<W>, const W: usize> LightBvh<N, W> {
    /// One tree over all triangles: the paper's baseline.
    #[must_use]
    pub fn single_level(lights: &Lights, params: &BuildParams) -> Self {
        let all = 0..lights.triangles().len() as u32;
        let topology = build_over::<N, W>(lights.triangles(), all, params);
        let mut bvh = Self::empty(lights, topology.depth);
        bvh.bottom = Levels::gather(topology.leveled(0));
        bvh.append(&topology);
        bvh.refit(lights);
        bvh
    }

    /// A bottom level (BLAS) over the triangles of each mesh light, and a top level (TLAS) over the mesh lights (paper
    /// section 3.2).
    #[must_use]
    pub fn two_level(lights: &Lights, params: &BuildParams) -> Self {
        let bottom = |mesh| {
            let range = lights.mesh(mesh);
            build_over::<N, W>(lights.triangles(), range.start as u32..range.end as u32, params)
        };
        // Bottom levels do not depend on each other, so neither does the result on the number of threads.
        #[cfg(feature = "rayon")]
        let bottoms: Vec<Topology<N>> = (0..lights.mesh_count()).into_par_iter().map(bottom).collect();
        #[cfg(not(feature = "rayon"))]
        let bottoms: Vec<Topology<N>> = (0..lights.mesh_count()).map(bottom).collect();

        let bottom_depth = bottoms.iter().map(|topology| topology.depth).max().unwrap_or(0);
        let mut bvh = Self::empty(lights, bottom_depth);
        let mut pairs = Vec::new();
        for (mesh, topology) in bottoms.into_iter().enumerate() {
            let root = bvh.nodes.len() as u32;
            let range = lights.mesh(mesh);
            bvh.instances.push(Instance {
                root,
                blas: mesh as u32,
                first: range.start as u32,
                first_triangle: range.start as u32,
                count: range.len() as u32,
                listed: mesh as u32,
                ..Instance::IDENTITY
            });
            bvh.roots.push(BlasRoot::new(root, &N::Summary::EMPTY));
            pairs.extend(topology.leveled(root));
            bvh.append(&topology);
        }
        bvh.bottom = Levels::gather(pairs);
        bvh.root = bvh.nodes.len() as u32;
        bvh.build_top(lights, params);
        bvh
    }

    /// Builds the top level over the bottom levels.
    fn build_top(&mut self, lights: &Lights, params: &BuildParams) {
        self.refit(lights);
        let summaries = (0..)
            .zip(&self.roots)
            .map(|(i, root)| (i, root.summary::<N::Summary>()));
        let topology = build_top::<N, W>(summaries, params);
        self.top = Levels::gather(topology.leveled(self.root));
        self.depth += topology.depth;
        for &(mesh, trail) in &topology.trails {
            self.instances[mesh as usize].set_trail(trail);
        }
        self.extend(&topology.nodes);
        self.refit_top();
    }

    fn empty(lights: &Lights, depth: u32) -> Self {
        let trail_words = trail_words(W, depth);
        Self {
            nodes: Vec::new(),
            root: 0,
            instances: Vec::new(),
            roots: Vec::new(),
            trails: alloc::vec![0; lights.triangles().len() * trail_words as usize],
            trail_words,
            bottom: Levels::default(),
            top: Levels::default(),
            depth,
            lights: lights.triangles().len() as u32,
        }
    }

    /// Takes over a bottom level: its trails, and its nodes with their links moved to where they stand now.
    fn append(&mut self, topology: &Topology<N>) {
        let words = self.trail_words as usize;
        for &(light, BitTrail { low, high }) in &topology.trails {
            let at = light as usize * words;
            self.trails[at] = low;
            if words == 2 {
                self.trails[at + 1] = high;
            }
        }
        self.extend(&topology.nodes);
    }

    fn extend(&mut self, nodes: &[N]) {
        let base = self.nodes.len() as u32;
        self.nodes.extend_from_slice(nodes);
        for node in &mut self.nodes[base as usize..] {
            for slot in 0..W {
                if node.kind(slot) == kind::INNER {
                    node.relink(slot, base + node.link(slot));
                }
            }
        }
    }
}

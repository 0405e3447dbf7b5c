//! Building an owned light BVH: trees from the builder, bounds from refit.

use alloc::vec::Vec;
use core::ops::Range;

#[cfg(feature = "rayon")]
use rayon::prelude::*;

use super::LightBvh;
use crate::bounds::LightBounds;
use crate::build::{BuildParams, Primitive, Topology, build};
use crate::levels::Levels;
use crate::lights::Lights;
use crate::node::{LightNode, kind};
use crate::refit::BlasRoot;
use crate::trail::{BitTrail, trail_words};
use crate::tree::{MeshLeaf, MeshLight};

impl<N: LightNode<W>, const W: usize> LightBvh<N, W> {
    /// One tree over all triangles: the paper's baseline.
    #[must_use]
    pub fn single_level(lights: &Lights, params: &BuildParams) -> Self {
        let bounds = triangle_bounds(lights);
        let mut primitives = primitives(&bounds, 0..bounds.len());
        let topology = build::<N, W>(&mut primitives, kind::LIGHT, params);
        drop(primitives);
        let mut bvh = Self::empty(lights, topology.depth);
        let pairs = inner_nodes::<N, W>(&topology, 0);
        bvh.append(&topology);
        bvh.bottom = Levels::gather(pairs);
        bvh.set_leaves(&bounds);
        bvh.refit_inner();
        bvh
    }

    /// A bottom level (BLAS) over the triangles of each mesh light, and a top level (TLAS) over the mesh lights (paper
    /// section 3.2).
    #[must_use]
    pub fn two_level(lights: &Lights, params: &BuildParams) -> Self {
        let bounds = triangle_bounds(lights);
        let bottom = |mesh| {
            let mut primitives = primitives(&bounds, lights.mesh(mesh));
            build::<N, W>(&mut primitives, kind::LIGHT, params)
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
            bvh.meshes.push(MeshLight::world(root, mesh as u32));
            bvh.roots.push(BlasRoot::new(root, &LightBounds::EMPTY));
            pairs.extend(inner_nodes::<N, W>(&topology, root));
            bvh.append(&topology);
        }
        bvh.bottom = Levels::gather(pairs);
        bvh.root = bvh.nodes.len() as u32;
        bvh.set_leaves(&bounds);
        bvh.refit_inner();

        bvh.build_top(params);
        bvh
    }

    /// The same with other leaves of the top level: [`Instance`](crate::Instance)s of bottom levels in world space walk to
    /// the same lights with the same probabilities, and are what the kernels read.
    #[must_use]
    pub fn with_leaves<L: MeshLeaf>(self) -> LightBvh<N, W, L> {
        let leaf = |mesh: &MeshLight| {
            let mut leaf = L::world(mesh.root(), mesh.blas());
            leaf.set_trail(mesh.trail());
            leaf
        };
        LightBvh {
            nodes: self.nodes,
            root: self.root,
            meshes: self.meshes.iter().map(leaf).collect(),
            roots: self.roots,
            trails: self.trails,
            trail_words: self.trail_words,
            bottom: self.bottom,
            top: self.top,
            depth: self.depth,
        }
    }

    /// Builds the top level over the bottom levels as they are.
    fn build_top(&mut self, params: &BuildParams) {
        self.nodes.truncate(self.root as usize);
        let mut primitives: Vec<Primitive> = self
            .meshes
            .iter()
            .enumerate()
            .map(|(i, mesh)| Primitive::new(i as u32, &self.nodes[mesh.root() as usize].merged()))
            .collect();
        let topology = build::<N, W>(&mut primitives, kind::MESH, params);
        self.top = Levels::gather(inner_nodes::<N, W>(&topology, self.root));
        self.depth += topology.depth;
        for &(mesh, trail) in &topology.trails {
            self.meshes[mesh as usize].set_trail(trail);
        }
        self.extend(&topology.nodes);
        self.refit_top();
    }

    fn empty(lights: &Lights, depth: u32) -> Self {
        let trail_words = trail_words(W, depth);
        Self {
            nodes: Vec::new(),
            root: 0,
            meshes: Vec::new(),
            roots: Vec::new(),
            trails: alloc::vec![0; lights.triangles().len() * trail_words as usize],
            trail_words,
            bottom: Levels::default(),
            top: Levels::default(),
            depth,
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
                    node.set_child(slot, kind::INNER, base + node.link(slot));
                }
            }
        }
    }

    /// What `refit::leaves` does, from bounds that are known already.
    fn set_leaves(&mut self, bounds: &[LightBounds]) {
        for node in &mut self.nodes {
            for slot in 0..W {
                if node.kind(slot) == kind::LIGHT {
                    node.set_bounds(slot, &bounds[node.link(slot) as usize]);
                }
            }
        }
    }
}

fn triangle_bounds(lights: &Lights) -> Vec<LightBounds> {
    lights.triangles().iter().map(LightBounds::of_triangle).collect()
}

fn primitives(bounds: &[LightBounds], range: Range<usize>) -> Vec<Primitive> {
    range.map(|i| Primitive::new(i as u32, &bounds[i])).collect()
}

/// (level, index) of the nodes that have inner children.
fn inner_nodes<N: LightNode<W>, const W: usize>(topology: &Topology<N>, base: u32) -> Vec<(u32, u32)> {
    let has_inner = |node: &N| (0..W).any(|slot| node.kind(slot) == kind::INNER);
    topology
        .nodes
        .iter()
        .zip(&topology.levels)
        .enumerate()
        .filter(|(_, (node, _))| has_inner(node))
        .map(|(i, (_, &level))| (level, base + i as u32))
        .collect()
}

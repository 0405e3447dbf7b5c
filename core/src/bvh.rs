//! A light BVH that owns its arrays: built, refitted and sampled on the CPU, or uploaded as it is.

use alloc::vec::Vec;
use core::ops::Range;

use crate::bounds::LightBounds;
use crate::build::{BuildParams, Primitive, Topology, build};
use crate::importance::ImportanceModel;
use crate::lights::Lights;
use crate::node::{LightNode, kind};
use crate::point::ShadingPoint;
use crate::refit;
use crate::trail::{BitTrail, slot_bits};
use crate::traverse::{self, SampledLight};
use crate::tree::{INVALID, LightTree, MeshLight};

/// A light BVH over [`Lights`], of one or two levels, with nodes of layout `N` and width `W`.
#[derive(Clone, Debug)]
pub struct LightBvh<N, const W: usize> {
    nodes: Vec<N>,
    /// Index of the node that walks start at; the nodes of the top level stand from here to the end.
    root: u32,
    meshes: Vec<MeshLight>,
    trails: Vec<u32>,
    trail_words: u32,
    bottom: Levels,
    top: Levels,
    depth: u32,
}

/// The arrays of a [`LightBvh`], open to any change.
#[doc(hidden)]
#[derive(Debug)]
pub struct Parts<'a, N> {
    pub nodes: &'a mut [N],
    pub meshes: &'a mut [MeshLight],
    pub trails: &'a mut [u32],
    pub bottom: &'a mut [u32],
    pub top: &'a mut [u32],
}

/// The nodes with inner children, level by level, deepest first: what `refit::level` is to run over.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Levels {
    nodes: Vec<u32>,
    ends: Vec<u32>,
}

impl Levels {
    /// The node indices of all levels, deepest level first.
    #[must_use]
    pub fn nodes(&self) -> &[u32] {
        &self.nodes
    }

    /// The levels as ranges of [`nodes`](Self::nodes), in the order in which they must be refitted.
    pub fn ranges(&self) -> impl Iterator<Item = Range<usize>> + '_ {
        (0..self.ends.len()).map(|i| {
            let start = if i == 0 { 0 } else { self.ends[i - 1] };
            start as usize..self.ends[i] as usize
        })
    }

    /// Gathers (level, node) pairs.
    fn gather(mut pairs: Vec<(u32, u32)>) -> Self {
        pairs.sort_unstable_by_key(|&(level, node)| (core::cmp::Reverse(level), node));
        let mut levels = Self::default();
        for (i, &(level, node)) in pairs.iter().enumerate() {
            levels.nodes.push(node);
            if pairs.get(i + 1).is_none_or(|&(next, _)| next != level) {
                levels.ends.push(i as u32 + 1);
            }
        }
        levels
    }
}

impl<N: LightNode<W>, const W: usize> LightBvh<N, W> {
    /// One tree over all triangles: the paper's baseline.
    #[must_use]
    pub fn single_level(lights: &Lights, params: &BuildParams) -> Self {
        let bounds = triangle_bounds(lights);
        let mut primitives = primitives(&bounds, 0..bounds.len());
        let topology = build::<N, W>(&mut primitives, kind::LIGHT, 0, params);
        drop(primitives);
        let mut bvh = Self::empty(lights, topology.depth);
        let pairs = inner_nodes::<N, W>(&topology, 0);
        bvh.append(topology);
        bvh.bottom = Levels::gather(pairs);
        bvh.set_leaves(&bounds);
        bvh.refit_inner();
        bvh
    }

    /// A bottom level (BLAS) over the triangles of each mesh light, and a top level (TLAS) over the mesh lights (paper
    /// section 3.2).
    #[must_use]
    pub fn two_level(lights: &Lights, params: &BuildParams) -> Self {
        // Bottom levels, one after the other.
        let bounds = triangle_bounds(lights);
        let mut bottoms = Vec::with_capacity(lights.mesh_count());
        let mut next = 0;
        let mut bottom_depth = 0;
        for mesh in 0..lights.mesh_count() {
            let mut primitives = primitives(&bounds, lights.mesh(mesh));
            let topology = build::<N, W>(&mut primitives, kind::LIGHT, next, params);
            next += topology.nodes.len() as u32;
            bottom_depth = bottom_depth.max(topology.depth);
            bottoms.push(topology);
        }
        let mut bvh = Self::empty(lights, bottom_depth);
        let mut pairs = Vec::new();
        for (mesh, topology) in bottoms.into_iter().enumerate() {
            let root = bvh.nodes.len() as u32;
            let first = lights.mesh(mesh).start as u32;
            bvh.meshes.push(MeshLight {
                root,
                trail: [0; 2],
                first,
            });
            pairs.extend(inner_nodes::<N, W>(&topology, root));
            bvh.append(topology);
        }
        bvh.bottom = Levels::gather(pairs);
        bvh.root = bvh.nodes.len() as u32;
        bvh.set_leaves(&bounds);
        bvh.refit_inner();

        bvh.build_top(params);
        bvh
    }

    /// Builds the top level over the bottom levels as they are.
    fn build_top(&mut self, params: &BuildParams) {
        self.nodes.truncate(self.root as usize);
        let mut primitives: Vec<Primitive> = self
            .meshes
            .iter()
            .enumerate()
            .map(|(i, mesh)| Primitive::new(i as u32, &self.nodes[mesh.root as usize].merged()))
            .collect();
        let topology = build::<N, W>(&mut primitives, kind::MESH, self.root, params);
        self.top = Levels::gather(inner_nodes::<N, W>(&topology, self.root));
        self.depth += topology.depth;
        for &(mesh, trail) in &topology.trails {
            self.meshes[mesh as usize].trail = [trail.low, trail.high];
        }
        self.nodes.extend_from_slice(&topology.nodes);
        self.refit_top();
    }

    fn empty(lights: &Lights, depth: u32) -> Self {
        let trail_words = if depth * slot_bits(W) <= 32 { 1 } else { 2 };
        Self {
            nodes: Vec::new(),
            root: 0,
            meshes: Vec::new(),
            trails: alloc::vec![0; lights.triangles().len() * trail_words as usize],
            trail_words,
            bottom: Levels::default(),
            top: Levels::default(),
            depth,
        }
    }

    fn append(&mut self, topology: Topology<N>) {
        let words = self.trail_words as usize;
        for &(light, BitTrail { low, high }) in &topology.trails {
            let at = light as usize * words;
            self.trails[at] = low;
            if words == 2 {
                self.trails[at + 1] = high;
            }
        }
        self.nodes.extend_from_slice(&topology.nodes);
    }

    /// New bounds everywhere from `lights`, which must be those that the BVH was built over, moved or changed by
    /// [`Lights::update`].
    pub fn refit(&mut self, lights: &Lights) {
        let bottom_end = if self.is_two_level() {
            self.root as usize
        } else {
            self.nodes.len()
        };
        for i in 0..bottom_end {
            self.nodes[i] = refit::leaves(&self.nodes, lights.triangles(), i as u32);
        }
        self.refit_inner();
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

    /// The passes of refit after the first.
    fn refit_inner(&mut self) {
        for k in 0..self.bottom.nodes.len() {
            let i = self.bottom.nodes[k];
            self.nodes[i as usize] = refit::level(&self.nodes, i);
        }
        self.refit_top();
    }

    fn refit_top(&mut self) {
        if self.is_two_level() {
            for i in self.root as usize..self.nodes.len() {
                self.nodes[i] = refit::mesh_leaves(&self.nodes, &self.meshes, i as u32);
            }
            for k in 0..self.top.nodes.len() {
                let i = self.top.nodes[k];
                self.nodes[i as usize] = refit::level(&self.nodes, i);
            }
        }
    }

    /// Chooses a light for `point`; see [`traverse::sample`].
    #[must_use]
    pub fn sample<I: ImportanceModel>(&self, point: &ShadingPoint, random: u32) -> SampledLight {
        traverse::sample::<N, I, W>(&self.tree(), point, random)
    }

    /// Probability of triangle `light` of `lights` at `point`; see [`traverse::pmf`].
    #[must_use]
    pub fn pmf<I: ImportanceModel>(&self, lights: &Lights, point: &ShadingPoint, light: u32) -> f32 {
        let mesh = match lights.triangles().get(light as usize) {
            Some(triangle) if self.is_two_level() => triangle.mesh,
            Some(_) => INVALID,
            None => return 0.0,
        };
        traverse::pmf::<N, I, W>(&self.tree(), point, light, mesh)
    }

    /// The arrays as traversal takes them.
    #[must_use]
    pub fn tree(&self) -> LightTree<'_, N> {
        LightTree {
            nodes: &self.nodes,
            root: self.root,
            meshes: &self.meshes,
            trails: &self.trails,
            trail_words: self.trail_words,
        }
    }

    /// Whether there is a top level over mesh lights.
    #[must_use]
    pub fn is_two_level(&self) -> bool {
        !self.meshes.is_empty()
    }

    /// All nodes: those of the bottom levels, then those of the top level from [`LightTree::root`] on.
    #[must_use]
    pub fn nodes(&self) -> &[N] {
        &self.nodes
    }

    /// The nodes, to be refitted elsewhere (in parallel, or read back from a device).
    pub fn nodes_mut(&mut self) -> &mut [N] {
        &mut self.nodes
    }

    /// Every array that [`validate`](Self::validate) checks, for tests that put wrong words into them.
    #[doc(hidden)]
    pub fn parts_mut(&mut self) -> Parts<'_, N> {
        Parts {
            nodes: &mut self.nodes,
            meshes: &mut self.meshes,
            trails: &mut self.trails,
            bottom: &mut self.bottom.nodes,
            top: &mut self.top.nodes,
        }
    }

    /// The levels of the bottom trees (of the only tree in a single-level BVH).
    #[must_use]
    pub fn bottom_levels(&self) -> &Levels {
        &self.bottom
    }

    /// The levels of the top tree.
    #[must_use]
    pub fn top_levels(&self) -> &Levels {
        &self.top
    }

    /// Greatest number of nodes on a way from the root to a light.
    #[must_use]
    pub fn depth(&self) -> u32 {
        self.depth
    }

    /// Bounds of all lights.
    #[must_use]
    pub fn bounds(&self) -> LightBounds {
        self.nodes[self.root as usize].merged()
    }

    /// Bytes that sampling and pmf read: nodes of all levels, trails and mesh lights.
    #[must_use]
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.nodes) + size_of_val(&*self.meshes) + size_of_val(&*self.trails)
    }

    /// Bytes of the level lists, which only refit reads.
    #[must_use]
    pub fn refit_bytes(&self) -> usize {
        size_of_val(&*self.bottom.nodes) + size_of_val(&*self.top.nodes)
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

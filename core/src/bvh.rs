//! A light BVH that owns its arrays: built, refitted and sampled on the CPU, or uploaded as it is.

mod construct;

use alloc::vec::Vec;

use crate::importance::ImportanceModel;
use crate::instance::Instance;
use crate::levels::Levels;
use crate::lights::Lights;
use crate::node::LightNode;
use crate::point::ShadingPoint;
use crate::refit;
use crate::refit::BlasRoot;
use crate::sweep;
use crate::traverse::{self, Random64, SampledLight};
use crate::tree::{INVALID, LightTree};

/// A light BVH over [`Lights`], of one or two levels, with nodes of layout `N` and width `W`.
#[derive(Clone, Debug)]
pub struct LightBvh<N, const W: usize> {
    nodes: Vec<N>,
    /// Index of the node that walks start at; the nodes of the top level stand from here to the end.
    root: u32,
    instances: Vec<Instance>,
    roots: Vec<BlasRoot>,
    trails: Vec<u32>,
    trail_words: u32,
    bottom: Levels,
    top: Levels,
    depth: u32,
    lights: u32,
}

/// The arrays of a [`LightBvh`], open to any change.
#[doc(hidden)]
#[derive(Debug)]
pub struct Parts<'a, N> {
    pub nodes: &'a mut [N],
    pub instances: &'a mut [Instance],
    pub roots: &'a mut [BlasRoot],
    pub trails: &'a mut [u32],
    pub bottom: &'a mut [u32],
    pub top: &'a mut [u32],
}

impl<N: LightNode<W>, const W: usize> LightBvh<N, W> {
    /// New summaries everywhere from `lights`, which must be those that the BVH was built over, moved or changed by
    /// [`Lights::update`].
    pub fn refit(&mut self, lights: &Lights) {
        let bottom_end = if self.is_two_level() {
            self.root
        } else {
            self.nodes.len() as u32
        };
        let nodes = &mut self.nodes[..bottom_end as usize];
        if self.roots.is_empty() {
            sweep::bottom_sweep(nodes, 0, lights.triangles(), &[self.root]);
        } else {
            let roots: Vec<u32> = self.roots.iter().map(|root| root.node).collect();
            sweep::bottom_sweep(nodes, 0, lights.triangles(), &roots);
        }
        self.refit_top();
    }

    fn refit_top(&mut self) {
        if self.is_two_level() {
            for blas in &mut self.roots {
                *blas = refit::root(&self.nodes, blas.node);
            }
            for range in self.top.ranges() {
                sweep::top(
                    &mut self.nodes,
                    &self.instances,
                    &self.roots,
                    &self.top.nodes[range],
                );
            }
        }
    }

    /// Chooses a light for `point`, which is within the domain of [`ShadingPoint::checked`]; see [`traverse::sample`].
    #[must_use]
    pub fn sample<I: ImportanceModel<N, W>>(
        &self,
        point: &ShadingPoint,
        random: impl Into<Random64>,
    ) -> SampledLight {
        debug_assert!(point.is_within_reach(), "not a shading point: {point:?}");
        traverse::widest::sample::<N, I, W>(&self.tree(), point, random.into())
    }

    /// Chooses a light for each of `points`, points as for [`sample`](Self::sample); see [`traverse::sample_batch`].
    pub fn sample_batch<I: ImportanceModel<N, W>>(
        &self,
        points: &[ShadingPoint],
        randoms: &[Random64],
        sampled: &mut [SampledLight],
    ) {
        traverse::widest::sample_batch::<N, I, W>(&self.tree(), points, randoms, sampled);
    }

    /// Probability of triangle `light` of `lights` at `point`, a point as for [`sample`](Self::sample); see
    /// [`traverse::pmf`].
    #[must_use]
    pub fn pmf<I: ImportanceModel<N, W>>(&self, lights: &Lights, point: &ShadingPoint, light: u32) -> f32 {
        debug_assert!(point.is_within_reach(), "not a shading point: {point:?}");
        let instance = match lights.triangles().get(light as usize) {
            Some(triangle) if self.is_two_level() => triangle.mesh,
            Some(_) => INVALID,
            None => return 0.0,
        };
        traverse::widest::pmf::<N, I, W>(&self.tree(), point, light, instance)
    }

    /// The arrays as traversal takes them.
    #[must_use]
    pub fn tree(&self) -> LightTree<'_, N> {
        LightTree {
            nodes: &self.nodes,
            root: self.root,
            instances: &self.instances,
            trails: &self.trails,
            trail_words: self.trail_words,
            live: self.instances.len() as u32,
            lights: self.lights,
            depth: self.depth,
        }
    }

    /// Whether there is a top level over mesh lights.
    #[must_use]
    pub fn is_two_level(&self) -> bool {
        !self.instances.is_empty()
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
            instances: &mut self.instances,
            roots: &mut self.roots,
            trails: &mut self.trails,
            bottom: &mut self.bottom.nodes,
            top: &mut self.top.nodes,
        }
    }

    /// The roots of the bottom levels and what is known of them; empty in a single-level BVH.
    #[must_use]
    pub fn roots(&self) -> &[BlasRoot] {
        &self.roots
    }

    /// The roots, to be refitted elsewhere.
    pub fn roots_mut(&mut self) -> &mut [BlasRoot] {
        &mut self.roots
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

    /// Greatest number of nodes on a path from the root to a light.
    #[must_use]
    pub fn depth(&self) -> u32 {
        self.depth
    }

    /// What is known of all lights together.
    #[must_use]
    pub fn summary(&self) -> N::Summary {
        self.nodes[self.root as usize].merged()
    }

    /// Bytes that sampling and pmf read: nodes of all levels, trails and instances.
    #[must_use]
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.nodes) + size_of_val(&*self.instances) + size_of_val(&*self.trails)
    }

    /// Bytes of the level lists and the roots' summaries, which only refit reads.
    #[must_use]
    pub fn refit_bytes(&self) -> usize {
        size_of_val(&*self.bottom.nodes) + size_of_val(&*self.top.nodes) + size_of_val(&*self.roots)
    }
}

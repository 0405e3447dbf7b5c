//! A light BVH that changes no more.

use alloc::boxed::Box;
use alloc::vec::Vec;

use super::Bvh;
use crate::instance::Instance;
use crate::node::Node;
use crate::tree::{LightTree, Links};

/// The arrays of a [`Bvh`] that sampling reads, for lights that do not change: nodes, links, instances, trails.
/// It keeps no triangles and nothing that edits and refits need: the caller has the lights, and [`LightTree::triangle`] finds
/// one.
///
/// ```
/// # use lightbvh::{BuildParams, LightBvh, Lights, ShadingPoint, bvh::StaticBvh};
/// # let lights = Lights::new(Vec::new())?;
/// # let point = ShadingPoint { p: [0.0; 3], n: [0.0; 3] };
/// let lamps: StaticBvh<_, _, 8> = LightBvh::single_level(&lights, &BuildParams::default()).into_static();
/// let sampled = lamps.sample(&point, 7_u32);
/// # Ok::<(), lightbvh::error::LightsError>(())
/// ```
#[derive(Clone, Debug)]
pub struct StaticBvh<N, I, const W: usize> {
    nodes: Box<[N]>,
    /// Nodes and links of the top level, if there are two levels.
    top: Box<[N]>,
    above: Box<[u32]>,
    places: Box<[u32]>,
    parts: Box<[u32]>,
    instances: Box<[Instance]>,
    trails: Box<[u32]>,
    /// Root, words of a trail, instances in use, lights of a single level, depth.
    words: [u32; 5],
    chosen: core::marker::PhantomData<I>,
}

impl<N: Node<W>, I, const W: usize> Bvh<N, I, W> {
    /// Refits and keeps what sampling reads: an instance removed and still in the tree would take its share of samples for ever.
    #[must_use]
    pub fn into_static(mut self) -> StaticBvh<N, I, W> {
        self.refit();
        let tree = self.tree();
        let words = [tree.root, tree.trail_words, tree.live, tree.lights, tree.depth];
        let is_single = self.single && !self.roots.is_empty();
        let top = if is_single { Vec::new() } else { self.top.nodes };
        StaticBvh {
            nodes: self.nodes.into_boxed_slice(),
            top: top.into_boxed_slice(),
            above: self.top.above.into_boxed_slice(),
            places: self.top.places.into_boxed_slice(),
            parts: self.top.parts.into_boxed_slice(),
            instances: self.instances.into_boxed_slice(),
            trails: self.trails.into_boxed_slice(),
            words,
            chosen: core::marker::PhantomData,
        }
    }
}

impl<N: Node<W>, I, const W: usize> StaticBvh<N, I, W> {
    /// The arrays as traversal takes them.
    #[must_use]
    pub fn tree(&self) -> LightTree<'_, N, I, W> {
        let [root, trail_words, live, lights, depth] = self.words;
        LightTree {
            nodes: &self.nodes,
            top: if self.top.is_empty() {
                &self.nodes
            } else {
                &self.top
            },
            first: 0,
            root,
            instances: &self.instances,
            trails: &self.trails,
            links: Links {
                above: &self.above,
                places: &self.places,
                parts: &self.parts,
            },
            trail_words,
            live,
            lights,
            depth,
            importance: core::marker::PhantomData,
        }
    }

    /// All its bytes on the heap.
    #[must_use]
    pub fn bytes(&self) -> usize {
        let links = size_of_val(&*self.above) + size_of_val(&*self.places) + size_of_val(&*self.parts);
        size_of_val(&*self.nodes)
            + size_of_val(&*self.top)
            + links
            + size_of_val(&*self.instances)
            + size_of_val(&*self.trails)
    }
}

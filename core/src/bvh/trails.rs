//! Whether the probability of a given light can be asked of a light BVH.
//!
//! A bit trail leads from the root to each triangle. What needs it is [`Bvh::pmf`], which multiple importance sampling asks for a
//! light that a ray has hit, and a share of uniform choice, whose light is not found by a walk. Where neither is wanted, the trails
//! are 4 to 8 bytes of each light that nothing reads.

use alloc::vec::Vec;
use core::marker::PhantomData;

use super::Bvh;
use crate::importance::ImportanceModel;
use crate::node::Node;
use crate::point::ShadingPoint;

/// [`WithTrails`] or [`NoTrails`].
pub trait Trails: sealed::Sealed {
    /// Whether trails are kept.
    const KEPT: bool;
}

/// Trails are kept: `pmf` is there, and importances may choose uniformly.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WithTrails;

/// No trails: lights are sampled, with their probabilities, but there is no `pmf`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NoTrails;

impl Trails for WithTrails {
    const KEPT: bool = true;
}

impl Trails for NoTrails {
    const KEPT: bool = false;
}

mod sealed {
    pub trait Sealed {}
    impl Sealed for super::WithTrails {}
    impl Sealed for super::NoTrails {}
}

/// Refuses, when it is compiled, an importance that needs trails where there are none.
pub(super) struct Sampled<N, I, const W: usize, T, P = ShadingPoint>(PhantomData<(N, I, T, P)>);

impl<N, I: ImportanceModel<N, W, P>, const W: usize, T: Trails, P> Sampled<N, I, W, T, P> {
    pub const ALLOWED: () = assert!(
        T::KEPT || I::UNIFORM_HALVINGS == 0,
        "a share of uniform choice needs trails: take the importance without `Defensive`"
    );
}

impl<N: Node<W>, I, const W: usize> Bvh<N, I, W> {
    /// The same light BVH without bit trails, 4 to 8 bytes less for each triangle: for direct lighting that chooses lights and
    /// never asks what the probability of a given light would have been. Edits, refits and rebuilds go on as before and keep no
    /// trails.
    ///
    /// Samples and their probabilities are the same words. The importance must have no share of uniform choice
    /// ([`Defensive`](crate::Defensive)), whose lights are found by their trails; another does not compile:
    ///
    /// ```compile_fail
    /// # use lightbvh::{LightBvh, ShadingPoint};
    /// let point = ShadingPoint { p: [0.0; 3], n: [0.0; 3] };
    /// let sampled = LightBvh::default().without_trails().sample(&point, 1_u32); // 1/64 of uniform choice
    /// ```
    ///
    /// Nor does a question for a probability:
    ///
    /// ```compile_fail
    /// # use lightbvh::{Bvh, MomentNode, Moments, ShadingPoint};
    /// let point = ShadingPoint { p: [0.0; 3], n: [0.0; 3] };
    /// let bvh = Bvh::<MomentNode<8>, Moments, 8>::default().without_trails();
    /// let pmf = bvh.pmf(&point, 0, 0);
    /// ```
    ///
    /// ```
    /// # use lightbvh::{Bvh, MomentNode, Moments, ShadingPoint};
    /// let point = ShadingPoint { p: [0.0; 3], n: [0.0; 3] };
    /// let bvh = Bvh::<MomentNode<8>, Moments, 8>::default().without_trails();
    /// let sampled = bvh.sample(&point, 1_u32);
    /// ```
    ///
    /// It is another light BVH only by its type: its ids stay. Devices take light BVHs with trails.
    #[must_use]
    pub fn without_trails(self) -> Bvh<N, I, W, NoTrails> {
        Bvh {
            trails: Vec::new(),
            asked: PhantomData,
            id: self.id,
            params: self.params,
            nodes: self.nodes,
            node_ranges: self.node_ranges,
            triangles: self.triangles,
            triangle_ranges: self.triangle_ranges,
            trail_words: self.trail_words,
            roots: self.roots,
            meshes: self.meshes,
            mesh_ranges: self.mesh_ranges,
            placed: self.placed,
            placed_ranges: self.placed_ranges,
            instances: self.instances,
            live: self.live,
            lights: self.lights,
            top: self.top,
            stale: self.stale,
            dirty: self.dirty,
            reshaped: self.reshaped,
            unapplied: self.unapplied,
            outbox: self.outbox,
            log: self.log,
            removed_lights: self.removed_lights,
            waiting_lights: self.waiting_lights,
            forgotten: self.forgotten,
            light_count: self.light_count,
            bottom_depth: self.bottom_depth,
            single: self.single,
            importance: self.importance,
        }
    }
}

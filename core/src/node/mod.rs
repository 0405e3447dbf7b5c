//! Nodes: what is known of up to `W` children side by side, each with a link.
//!
//! A node holds its children's summaries, not its own: one fetch per level decides which child to enter. Width and layout
//! are type parameters, so a kernel holds the code of one layout only.

mod beam_row;
mod codes;
mod compact;
mod moment;

pub use compact::CompactNode;
pub use moment::{LinkedSpotMomentNode, MomentNode, PackedMomentNode, SpotMomentNode, TwoSidedMomentNode};

use core::fmt::Debug;

use bytemuck::Pod;
use glam::Vec3;

use crate::beam::Space;
#[doc(hidden)]
pub use crate::beam::{Beam, Limits};
pub use crate::bounds::LightBounds;
use crate::light::{EmissiveTriangle, Light};
pub use crate::moments::LightMoments;
use crate::summary::Lanes;
#[doc(hidden)]
pub use crate::summary::Summary;

/// The node of `LightBvh`.
pub type DefaultNode = MomentNode<8>;

/// Version of the node layouts' words; raised whenever a layout changes.
pub const NODE_FORMAT: u32 = 4;

/// Target of a child's link.
pub mod kind {
    /// No child in this slot.
    pub const EMPTY: u32 = 0;
    /// Another node of the same tree; the link is its index.
    pub const INNER: u32 = 1;
    /// A light; the link is its index.
    pub const LIGHT: u32 = 2;
    /// An instance (leaf of the top level); the link is its index, and the root of its bottom level follows.
    pub const MESH: u32 = 3;
}

/// The light type of a tree with such nodes.
pub trait Holds: Pod + Debug + Send + Sync {
    /// The lights that leaves are: emissive triangles, unless the node's type names others.
    type Light: Light;
}

/// A node of width `W`: plain words.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no layout of nodes of width {W}",
    note = "a light BVH is as wide as its layout: `Bvh<(CompactNode<4>, Eq4), 4>`"
)]
pub trait Node<const W: usize>: Holds {
    /// The summary that a node stores of each child.
    type Summary: Summary;

    /// A node without children.
    const EMPTY: Self;
    /// Name for tables.
    const NAME: &'static str;
    /// Whether it stores a mask of each child, as [`LinkedSpotMomentNode`] does.
    const HAS_MASKS: bool = false;
    /// Whether it stores a beam of each child, as [`SpotMomentNode`] does.
    const HAS_BEAMS: bool = false;

    /// One of [`kind`].
    fn kind(&self, slot: usize) -> u32;
    /// Index of what the child is; see [`kind`].
    fn link(&self, slot: usize) -> u32;
    /// The summary of the child, as stored.
    fn summary(&self, slot: usize) -> Self::Summary;
    /// Sets what the child is; refit computes its summary.
    fn set_child(&mut self, slot: usize, kind: u32, link: u32);
    /// Sets the child's link alone; kind and summary stay.
    fn relink(&mut self, slot: usize, link: u32);
    /// Sets the summaries of all children, since they may share a frame; kinds and links stay. Empty slots take
    /// [`Summary::EMPTY`].
    fn set_lanes(&mut self, summaries: &Lanes<W>);

    /// Union of the masks of the child's lights with flux; all bits if the layout stores none.
    #[inline(always)]
    fn mask(&self, _slot: usize) -> u32 {
        u32::MAX
    }

    /// The beam of the child; [`Beam::ANYWHERE`] if the layout stores none.
    #[inline(always)]
    fn beam(&self, _slot: usize) -> Beam {
        Beam::ANYWHERE
    }

    /// Sets the limits of all children, after their summaries, which are `summaries`: a child without flux has none. Does nothing where the
    /// layout stores none.
    #[inline(always)]
    fn set_limits(&mut self, _limits: &[Limits; W], _summaries: &Lanes<W>) {}

    /// The child's light ends at this distance from its stored box, metres; [`Limits::ENDLESS`] where there is
    /// none, or the layout stores no beams.
    #[inline(always)]
    fn end(&self, _slot: usize) -> f32 {
        Limits::ENDLESS
    }

    /// The limits of all children together; `whole` is their [`merged`](Self::merged) summary.
    #[inline(always)]
    fn merged_limits(&self, _whole: &Self::Summary) -> Limits {
        Limits::NONE
    }

    /// [`set_lanes`](Self::set_lanes), child by child.
    #[inline(always)]
    fn set_summaries(&mut self, summaries: &[Self::Summary; W]) {
        self.set_lanes(&Lanes::of(summaries));
    }

    /// The merged summary of all children.
    #[inline(always)]
    fn merged(&self) -> Self::Summary {
        let mut children = Lanes::<W>::all(&Self::Summary::EMPTY);
        for slot in 0..W {
            if self.kind(slot) != kind::EMPTY {
                children.set(slot, &self.summary(slot));
            }
        }
        Self::Summary::merged(&children)
    }
}

/// A node of a tree over emissive triangles.
pub trait LightNode<const W: usize>: Node<W> + Holds<Light = EmissiveTriangle> {}

impl<N: Node<W> + Holds<Light = EmissiveTriangle>, const W: usize> LightNode<W> for N {}

/// The input of [`Eq4`](crate::Eq4) for a child, decoded by a node layout.
#[doc(hidden)]
#[derive(Clone, Copy, Debug)]
pub struct Cluster {
    /// Centre C of the box, metres.
    pub center: Vec3,
    /// Half extents of the box, metres.
    pub extent: Vec3,
    /// Squared radius of a sphere around the box, m².
    pub radius_squared: f32,
    /// Axis of the normals' cone; of length 1, or shorter by at most 2^-8.
    pub axis: Vec3,
    /// cos θ_o.
    pub cos_theta_o: f32,
    /// sin θ_o.
    pub sin_theta_o: f32,
    /// Flux Φ, W.
    pub phi: f32,
}

/// A layout that stores [`LightBounds`].
#[doc(hidden)]
#[diagnostic::on_unimplemented(
    message = "`{Self}` stores no bounds of width {W}",
    note = "`Eq4` takes layouts of bounds, such as `CompactNode`; `Moments` takes `MomentNode` and its kin"
)]
pub trait BoundsNode<const W: usize>: Node<W, Summary = LightBounds> {
    /// The child's bounds as [`Eq4`](crate::Eq4) needs them.
    fn cluster(&self, slot: usize) -> Cluster;
}

/// A layout that stores [`LightMoments`].
#[doc(hidden)]
#[diagnostic::on_unimplemented(
    message = "`{Self}` stores no moments of width {W}",
    note = "`Moments` takes `MomentNode` and its kin; `Eq4` takes layouts of bounds, such as `CompactNode`"
)]
pub trait MomentLayout<const W: usize>: Node<W, Summary = LightMoments> {
    /// The weights of the children at the point `p` with the normal `n`, in the node's space; see
    /// [`ImportanceModel::weights`](crate::ImportanceModel::weights). `space` is [`Instance::space`](crate::Instance::space).
    fn moment_weights(&self, p: Vec3, n: Vec3, space: Space) -> [f32; W];

    /// The same over a box about `p` of half extents `half`, whose points have the mean normal `n`.
    fn cell_weights(&self, p: Vec3, n: Vec3, half: Vec3, space: Space) -> [f32; W];
}

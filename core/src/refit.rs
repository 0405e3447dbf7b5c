//! Refit: new summaries on an unchanged topology, bottom-up (paper section 3.4).
//!
//! Every function takes the nodes as they are and returns one node, so that the CPU and the kernels run the same
//! body and each node is written by one invocation. The order of passes: [`bottom`] from the deepest level of the bottom
//! levels to their roots, then [`top`] from the deepest level of the top level to its root.
//! Children are merged in an order of the slots, so no order of execution shows in the bits. Kernels compute a node in two passes, its
//! children one by one and then itself ([`bottom_child`], [`top_child`], [`assembled`]): the same words.

mod children;
mod limits;

use bytemuck::{Pod, Zeroable};

#[doc(hidden)]
pub use self::children::{
    Child, Children, LIMITED_ROWS, PLAIN_ROWS, assembled, bottom_child, child_rows, top_child,
};
use crate::beam::Limits;
pub use crate::instance::Instance;
pub use crate::light::world_light;
use crate::light::{Light, LightSlots};
use crate::node::{Node, kind};
use crate::summary::{Lanes, SUMMARY_WORDS, Summary};

#[cfg(feature = "alloc")]
pub(crate) use children::leaf_child;
#[cfg(feature = "alloc")]
pub(crate) use limits::has_limits;
pub(crate) use limits::limits_below;

/// Node `index` of a bottom level with the summaries of its lights and of the nodes below it.
#[inline]
#[must_use]
pub fn bottom<N: Node<W>, const W: usize>(nodes: &[N], lights: &[N::Light], index: u32) -> N {
    let mut node = nodes[index as usize];
    let mut room = Room::<N::Light, W>::new();
    below(nodes, 0, lights, &node, &mut room);
    node.set_lanes(&room.children);
    let limits = limits_below(nodes, 0, lights, &node, &room.children);
    node.set_limits(&limits, &room.children);
    node
}

/// Room for what a node's refit computes; a sweep takes the same for all nodes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Room<L: Light, const W: usize> {
    lights: L::Slots<W>,
    pub children: Lanes<W>,
}

impl<L: Light, const W: usize> Room<L, W> {
    #[inline(always)]
    pub fn new() -> Self {
        Self {
            lights: L::Slots::<W>::NONE,
            children: Lanes([[0.0; W]; SUMMARY_WORDS]),
        }
    }
}

/// The summaries of the children of a bottom level's `node`, put into `room`, whatever that holds. Node `first` and those after
/// it stand in `nodes`.
#[inline(always)]
pub(crate) fn below<N: Node<W>, const W: usize>(
    nodes: &[N],
    first: u32,
    lights: &[N::Light],
    node: &N,
    room: &mut Room<N::Light, W>,
) {
    // Steps over all slots, for processors compute several lights and several codes at a time.
    let (mut has_lights, mut inner) = (0, 0);
    for slot in 0..W {
        let (to, link) = (node.kind(slot), node.link(slot));
        room.lights.remove(slot);
        if to == kind::LIGHT && link < lights.len() as u32 {
            room.lights.set(slot, &lights[link as usize]);
            has_lights = 1;
        }
        inner |= u32::from(to == kind::INNER);
    }
    if has_lights != 0 {
        N::Summary::of_lights::<N::Light, W>(&room.lights, &mut room.children);
    } else {
        room.children.fill(&N::Summary::EMPTY);
    }
    if inner != 0 {
        for slot in 0..W {
            let link = node.link(slot).wrapping_sub(first);
            if node.kind(slot) == kind::INNER && link < nodes.len() as u32 {
                room.children.set(slot, &nodes[link as usize].merged());
            }
        }
    }
}

/// A node of the top level, with the summaries of its instances and of the nodes below it.
/// `nodes` holds the bottom levels and from `first` on the top level, as on a device; `index` counts in all of it. A
/// [plan's](crate::bvh::RefitPlan::top) list counts from `first`.
#[inline]
#[must_use]
pub fn top<N: Node<W>, const W: usize>(
    nodes: &[N],
    first: u32,
    lights: &[N::Light],
    instances: &[Instance],
    index: u32,
) -> N {
    let mut node = nodes[index as usize];
    let mut children = Lanes::<W>([[0.0; W]; SUMMARY_WORDS]);
    let mut limits = [Limits::NONE; W];
    for slot in 0..W {
        let child = top_child(nodes, first, lights, instances, index, slot);
        children.set(slot, &child.summary);
        limits[slot] = child.limits;
    }
    node.set_lanes(&children);
    node.set_limits(&limits, &children);
    node
}

/// The root of a bottom level and its summary in the bottom level's space, merged once for all instances; plain words.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct BlasRoot {
    /// Node index of the root.
    pub node: u32,
    /// The [`Summary`] in full.
    pub words: [f32; SUMMARY_WORDS],
}

const _: () = assert!(size_of::<BlasRoot>() == 52);

impl BlasRoot {
    /// The root `node` with `summary`.
    #[inline]
    #[must_use]
    pub fn new<S: Summary>(node: u32, summary: &S) -> Self {
        Self {
            node,
            words: summary.to_words(),
        }
    }

    /// Summary of the bottom level.
    #[inline]
    #[must_use]
    pub fn summary<S: Summary>(&self) -> S {
        S::from_words(&self.words)
    }
}

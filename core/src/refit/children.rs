//! A refit child by child, as devices compute it: [`bottom_child`] and [`top_child`] for each child of the nodes of a level, then
//! [`assembled`] for each node. The words are those of [`bottom`](super::bottom) and [`top`](super::top).
//!
//! A child that is a node is merged from its own children, which is most of a refit. A processor with more threads than a level has nodes
//! takes a thread for each child.

use glam::Vec3;

use super::limits::{has_limits, limits_of_instance};
use super::{BlasRoot, Instance};
use crate::beam::{Beam, Limits};
use crate::light::Light;
use crate::node::{Node, kind};
use crate::summary::{Lanes, SUMMARY_WORDS, Summary};

/// Words of [`Limits`]: the mask, then the beam.
const LIMIT_WORDS: usize = 9;

/// Words that [`Child::put`] writes for one child of a node of layout `N`.
#[inline(always)]
#[must_use]
pub const fn child_words<N: Node<W>, const W: usize>() -> usize {
    if has_limits::<N, W>() {
        SUMMARY_WORDS + LIMIT_WORDS
    } else {
        SUMMARY_WORDS
    }
}

/// What a refit computes of one child.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Child<S> {
    /// Of its lights.
    pub summary: S,
    /// Of their masks and beams; [`Limits::NONE`] where the layout stores neither.
    pub limits: Limits,
}

impl<S: Summary> Child<S> {
    /// No light at all.
    pub const EMPTY: Self = Self {
        summary: S::EMPTY,
        limits: Limits::NONE,
    };

    /// Writes it into `children` as child `slot` of the node of number `place` there, for [`assembled`]. Nodes stand one after another;
    /// in each stands a word of all its children beside the next word of all of them, so that neighbours write side by side. Does nothing
    /// where `children` is too short.
    #[inline(always)]
    pub fn put<N: Node<W, Summary = S>, const W: usize>(
        &self,
        children: &mut [u32],
        place: u32,
        slot: usize,
    ) {
        let words = child_words::<N, W>() * W;
        if slot < W && (place as usize) < children.len() / words {
            let first = place as usize * words + slot;
            let summary = self.summary.to_words();
            for k in 0..SUMMARY_WORDS {
                children[first + k * W] = summary[k].to_bits();
            }
            if has_limits::<N, W>() {
                let (first, beam) = (first + SUMMARY_WORDS * W, &self.limits.beam);
                children[first] = self.limits.mask;
                children[first + W] = beam.axis.x.to_bits();
                children[first + 2 * W] = beam.axis.y.to_bits();
                children[first + 3 * W] = beam.axis.z.to_bits();
                children[first + 4 * W] = beam.cos_theta_e.to_bits();
                children[first + 5 * W] = beam.c.x.to_bits();
                children[first + 6 * W] = beam.c.y.to_bits();
                children[first + 7 * W] = beam.c.z.to_bits();
                children[first + 8 * W] = beam.radius.to_bits();
            }
        }
    }
}

/// Child `slot` of node `index` of a bottom level: of its triangle, or of the node below.
#[inline(always)]
#[must_use]
pub fn bottom_child<N: Node<W>, const W: usize>(
    nodes: &[N],
    triangles: &[N::Light],
    index: u32,
    slot: usize,
) -> Child<N::Summary> {
    let (to, link) = (nodes[index as usize].kind(slot), nodes[index as usize].link(slot));
    let mut child = Child::EMPTY;
    if to == kind::LIGHT && link < triangles.len() as u32 {
        child.summary = N::Summary::of_light(&triangles[link as usize]);
        if has_limits::<N, W>() {
            child.limits = limits_of_light::<N, W>(&triangles[link as usize]);
        }
    } else if to == kind::INNER && link < nodes.len() as u32 {
        child = inner_child(nodes, link);
    }
    child
}

/// Child `slot` of node `index` of the top level: of its instance, or of the node below.
#[inline(always)]
#[must_use]
pub fn top_child<N: Node<W>, const W: usize>(
    nodes: &[N],
    instances: &[Instance],
    roots: &[BlasRoot],
    index: u32,
    slot: usize,
) -> Child<N::Summary> {
    let (to, link) = (nodes[index as usize].kind(slot), nodes[index as usize].link(slot));
    let mut child = Child::EMPTY;
    if to == kind::MESH && link < instances.len() as u32 {
        let instance = &instances[link as usize];
        let blas = instance.blas;
        if blas < roots.len() as u32 {
            let local = roots[blas as usize].summary::<N::Summary>();
            child.summary = local.to_world::<N::Light>(instance);
            if has_limits::<N, W>() {
                child.limits = limits_of_instance(nodes, &roots[blas as usize], instance);
            }
        }
    } else if to == kind::INNER && link < nodes.len() as u32 {
        child = inner_child(nodes, link);
    }
    child
}

/// What node `link` is to its parent.
#[inline(always)]
fn inner_child<N: Node<W>, const W: usize>(nodes: &[N], link: u32) -> Child<N::Summary> {
    let summary = nodes[link as usize].merged();
    let limits = if has_limits::<N, W>() {
        nodes[link as usize].merged_limits(&summary)
    } else {
        Limits::NONE
    };
    Child { summary, limits }
}

/// What `light` is to a node with limits.
#[inline(always)]
pub(super) fn limits_of_light<N: Node<W>, const W: usize>(light: &N::Light) -> Limits {
    Limits {
        mask: light.mask(),
        beam: if N::HAS_BEAMS {
            light.beam()
        } else {
            Beam::ANYWHERE
        },
    }
}

/// Node `index` with the children that stand in `children` as those of the node of number `place`. The node as it is where `children` is too
/// short.
#[inline(always)]
#[must_use]
pub fn assembled<N: Node<W>, const W: usize>(nodes: &[N], index: u32, children: &[u32], place: u32) -> N {
    let mut node = nodes[index as usize];
    let words = child_words::<N, W>() * W;
    if (place as usize) < children.len() / words {
        let first = place as usize * words;
        let mut lanes = Lanes([[0.0; W]; SUMMARY_WORDS]);
        for k in 0..SUMMARY_WORDS {
            for slot in 0..W {
                lanes.0[k][slot] = f32::from_bits(children[first + k * W + slot]);
            }
        }
        node.set_lanes(&lanes);
        if has_limits::<N, W>() {
            let mut limits = [Limits::NONE; W];
            for slot in 0..W {
                limits[slot] = limits_at::<W>(children, first + SUMMARY_WORDS * W + slot);
            }
            node.set_limits(&limits);
        }
    }
    node
}

/// The limits whose words begin at `first`, one in every `W` words.
#[inline(always)]
fn limits_at<const W: usize>(children: &[u32], first: usize) -> Limits {
    Limits {
        mask: children[first],
        beam: Beam {
            axis: vector_at(children, first + W, W),
            cos_theta_e: f32::from_bits(children[first + 4 * W]),
            c: vector_at(children, first + 5 * W, W),
            radius: f32::from_bits(children[first + 8 * W]),
        },
    }
}

#[inline(always)]
fn vector_at(children: &[u32], first: usize, step: usize) -> Vec3 {
    Vec3::new(
        f32::from_bits(children[first]),
        f32::from_bits(children[first + step]),
        f32::from_bits(children[first + 2 * step]),
    )
}

#[cfg(test)]
mod tests;

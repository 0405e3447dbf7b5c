//! A refit child by child, as devices compute it: [`bottom_child`] and [`top_child`] for each child of the nodes of a level, then
//! [`assembled`] for each node. The words are those of [`bottom`](super::bottom) and [`top`](super::top).
//!
//! A child that is a node is merged from its own children, which is most of a refit. A processor with more threads than a level has nodes
//! takes a thread for each child.

use glam::Vec3;

#[cfg(feature = "alloc")]
use super::BlasRoot;
use super::Instance;
use super::limits::{has_limits, in_world, limits_of_light};
use crate::beam::{Beam, Limits};
use crate::node::{Node, kind};
use crate::summary::{Lanes, SUMMARY_WORDS, Summary};
use crate::trail::leaf_parts;
use crate::tree::INVALID;
use crate::unroll::each;

/// Rows of [`Children`] of layouts without limits: those of a summary in full.
pub const PLAIN_ROWS: usize = SUMMARY_WORDS;
/// Rows of [`Children`] of layouts with masks or beams: those of a summary, the mask, the beam (axis, cos θ_e, centre, radius), the end.
pub const LIMITED_ROWS: usize = SUMMARY_WORDS + 10;

/// The children of one node, a row for each word and in it one for each child, so that neighbours write side by side. `ROWS` is
/// [`child_rows`] of the layout.
pub type Children<const W: usize, const ROWS: usize> = [[u32; W]; ROWS];

/// Rows of the [`Children`] of nodes of layout `N`.
#[inline(always)]
#[must_use]
pub const fn child_rows<N: Node<W>, const W: usize>() -> usize {
    if has_limits::<N, W>() {
        LIMITED_ROWS
    } else {
        PLAIN_ROWS
    }
}

/// Rows of limits.
const MASK: usize = SUMMARY_WORDS;
const AXIS: usize = MASK + 1;
const COS_THETA_E: usize = AXIS + 3;
const C: usize = COS_THETA_E + 1;
const RADIUS: usize = C + 3;
const END: usize = RADIUS + 1;

/// Summary and limits of one child.
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

    /// Writes it as child `slot` of the node of number `place` in `children`, for [`assembled`]; nothing where there is no such place.
    #[inline(always)]
    pub fn put<const W: usize, const ROWS: usize>(
        &self,
        children: &mut [Children<W, ROWS>],
        place: u32,
        slot: usize,
    ) {
        if slot < W && place < children.len() as u32 {
            let place = place as usize;
            let summary = self.summary.to_words();
            each!(k, SUMMARY_WORDS, {
                children[place][k][slot] = summary[k].to_bits();
            });
            if ROWS == LIMITED_ROWS {
                let beam = &self.limits.beam;
                children[place][MASK % ROWS][slot] = self.limits.mask;
                children[place][AXIS % ROWS][slot] = beam.axis.x.to_bits();
                children[place][(AXIS + 1) % ROWS][slot] = beam.axis.y.to_bits();
                children[place][(AXIS + 2) % ROWS][slot] = beam.axis.z.to_bits();
                children[place][COS_THETA_E % ROWS][slot] = beam.cos_theta_e.to_bits();
                children[place][C % ROWS][slot] = beam.c.x.to_bits();
                children[place][(C + 1) % ROWS][slot] = beam.c.y.to_bits();
                children[place][(C + 2) % ROWS][slot] = beam.c.z.to_bits();
                children[place][RADIUS % ROWS][slot] = beam.radius.to_bits();
                children[place][END % ROWS][slot] = self.limits.end.to_bits();
            }
        }
    }

    /// Maps a child in the space of a mesh into the world.
    #[inline(always)]
    fn to_world<N: Node<W, Summary = S>, const W: usize>(self, instance: &Instance) -> Self {
        let summary = self.summary.to_world(instance);
        let mut limits = self.limits;
        if has_limits::<N, W>() {
            limits = in_world::<N, W>(limits, instance, &summary);
        }
        Self { summary, limits }
    }
}

/// Child `slot` of node `index` of a bottom level: of its light, or of the node below.
#[inline(always)]
#[must_use]
pub fn bottom_child<N: Node<W>, const W: usize>(
    nodes: &[N],
    lights: &[N::Light],
    index: u32,
    slot: usize,
) -> Child<N::Summary> {
    let node = &nodes[index as usize];
    bottom_link(nodes, lights, node.kind(slot), node.link(slot)).0
}

/// Child `slot` of node `index` of the top level, whose nodes begin at `first`: of its instance, or of the node below.
#[inline(always)]
#[must_use]
pub fn top_child<N: Node<W>, const W: usize>(
    nodes: &[N],
    first: u32,
    lights: &[N::Light],
    instances: &[Instance],
    index: u32,
    slot: usize,
) -> Child<N::Summary> {
    let (to, mut link) = (nodes[index as usize].kind(slot), nodes[index as usize].link(slot));
    if to == kind::INNER {
        link = link.wrapping_add(first);
    }
    top_link(nodes, lights, instances, to, link)
}

/// The child of the top level with this kind and link. Links to nodes count from the first of `nodes`.
#[inline(always)]
fn top_link<N: Node<W>, const W: usize>(
    nodes: &[N],
    lights: &[N::Light],
    instances: &[Instance],
    kind: u32,
    link: u32,
) -> Child<N::Summary> {
    let (mut to, mut link, mut instance) = (kind, link, INVALID);
    if kind == kind::MESH {
        let (own, part) = leaf_parts(link);
        to = kind::EMPTY;
        if own < instances.len() as u32 {
            instance = own;
            let root = instances[own as usize].root;
            if root == INVALID {
                (to, link) = (kind::LIGHT, instances[own as usize].first_light);
            } else if part == 0 {
                (to, link) = (kind::INNER, root);
            } else if root < nodes.len() as u32 {
                let (root, slot) = (root as usize, (part as usize - 1) % W);
                (to, link) = (nodes[root].kind(slot), nodes[root].link(slot));
            }
        }
    }
    let (mut child, is_there) = bottom_link(nodes, lights, to, link);
    if is_there && instance < instances.len() as u32 {
        child = child.to_world::<N, W>(&instances[instance as usize]);
    }
    child
}

/// The light or node with this kind and link, and whether there is one.
#[inline(always)]
fn bottom_link<N: Node<W>, const W: usize>(
    nodes: &[N],
    lights: &[N::Light],
    kind: u32,
    link: u32,
) -> (Child<N::Summary>, bool) {
    let (mut child, mut is_there) = (Child::EMPTY, false);
    if kind == kind::LIGHT && link < lights.len() as u32 {
        (child, is_there) = (light_child::<N, W>(&lights[link as usize]), true);
    } else if kind == kind::INNER && link < nodes.len() as u32 {
        (child, is_there) = (inner_child(nodes, link), true);
    }
    (child, is_there)
}

/// The child at [leaf](crate::trail::leaf) `link` of the top level. It takes the summary of a whole mesh from `roots`, which spares the merge.
#[cfg(feature = "alloc")]
#[inline(always)]
pub(crate) fn leaf_child<N: Node<W>, const W: usize>(
    nodes: &[N],
    lights: &[N::Light],
    instances: &[Instance],
    roots: &[BlasRoot],
    link: u32,
) -> Child<N::Summary> {
    let (index, part) = leaf_parts(link);
    let instance = match instances.get(index as usize) {
        Some(own) if part == 0 && own.root != INVALID => own,
        _ => return top_link(nodes, lights, instances, kind::MESH, link),
    };
    let mut local = Child::EMPTY;
    local.summary = roots[instance.blas as usize].summary();
    if has_limits::<N, W>() {
        local.limits = nodes[instance.root as usize].merged_limits(&local.summary);
    }
    local.to_world::<N, W>(instance)
}

/// A light as a child.
#[inline(always)]
fn light_child<N: Node<W>, const W: usize>(light: &N::Light) -> Child<N::Summary> {
    Child {
        summary: N::Summary::of_light(light),
        limits: if has_limits::<N, W>() {
            limits_of_light::<N, W>(light)
        } else {
            Limits::NONE
        },
    }
}

/// Node `link` as a child.
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

/// Node `index` with the children of the node of number `place` in `children`; the node as it is where there is no such place.
#[inline(always)]
#[must_use]
pub fn assembled<N: Node<W>, const W: usize, const ROWS: usize>(
    nodes: &[N],
    index: u32,
    children: &[Children<W, ROWS>],
    place: u32,
) -> N {
    let mut node = nodes[index as usize];
    if place < children.len() as u32 {
        let words = &children[place as usize];
        let mut lanes = Lanes([[0.0; W]; SUMMARY_WORDS]);
        each!(k, SUMMARY_WORDS, {
            each!(slot, W, {
                lanes.0[k][slot] = f32::from_bits(words[k][slot]);
            });
        });
        node.set_lanes(&lanes);
        if ROWS == LIMITED_ROWS {
            let mut limits = [Limits::NONE; W];
            each!(slot, W, {
                limits[slot] = limits_at(words, slot);
            });
            node.set_limits(&limits, &lanes);
        }
    }
    node
}

#[inline(always)]
fn limits_at<const W: usize, const ROWS: usize>(words: &Children<W, ROWS>, slot: usize) -> Limits {
    Limits {
        mask: words[MASK % ROWS][slot],
        beam: Beam {
            axis: vector_at(words, AXIS, slot),
            cos_theta_e: f32::from_bits(words[COS_THETA_E % ROWS][slot]),
            c: vector_at(words, C, slot),
            radius: f32::from_bits(words[RADIUS % ROWS][slot]),
        },
        end: f32::from_bits(words[END % ROWS][slot]),
    }
}

#[inline(always)]
fn vector_at<const W: usize, const ROWS: usize>(
    words: &Children<W, ROWS>,
    first: usize,
    slot: usize,
) -> Vec3 {
    Vec3::new(
        f32::from_bits(words[first % ROWS][slot]),
        f32::from_bits(words[(first + 1) % ROWS][slot]),
        f32::from_bits(words[(first + 2) % ROWS][slot]),
    )
}

#[cfg(test)]
mod tests;

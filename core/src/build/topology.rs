//! From primitives to a tree: which node, which slot, which trail.

use alloc::vec::Vec;

use super::binary::{LEAF, binary_tree};
use super::collapse::{Collapse, binary_levels};
use super::primitive::Primitive;
use super::ward::{WardPrimitive, build_ward};
use super::{BuildParams, Heuristic, Topology};
use crate::light::Light;
use crate::node::{Node, kind};
use crate::summary::Summary;
use crate::trail::BitTrail;

/// Builds a tree over each mesh.
pub(crate) fn build_each<N: Node<W>, const W: usize>(
    meshes: &[&[N::Light]],
    params: &BuildParams,
) -> Vec<Topology<N>> {
    #[cfg(feature = "rayon")]
    {
        use rayon::prelude::*;
        meshes.par_iter().map(|mesh| build_over(mesh, params)).collect()
    }
    #[cfg(not(feature = "rayon"))]
    meshes.iter().map(|mesh| build_over(mesh, params)).collect()
}

/// Builds a tree over `lights`, at least one, numbered from 0.
pub(crate) fn build_over<N: Node<W>, const W: usize>(
    lights: &[N::Light],
    params: &BuildParams,
) -> Topology<N> {
    if params.heuristic != Heuristic::Ward {
        let bounds = |(i, light): (u32, &N::Light)| Primitive::new(i, &light.bounds());
        let mut primitives: Vec<Primitive> = (0..).zip(lights).map(bounds).collect();
        return build_binary::<N, W>(&mut primitives, kind::LIGHT, params);
    }
    let primitives = (0..).zip(lights);
    let mut primitives: Vec<_> = primitives
        .map(|(index, light)| WardPrimitive::of_light(index, light))
        .collect();
    build_ward::<N, W>(&mut primitives, kind::LIGHT, params)
}

/// Builds a tree over leaves of the top level, at least one, each a link and a summary. A leaf counts for a flux of at least
/// `floor`, W.
pub(crate) fn build_top<N: Node<W>, const W: usize>(
    instances: impl Iterator<Item = (u32, N::Summary)>,
    floor: f32,
    params: &BuildParams,
) -> Topology<N> {
    let at_least = |phi: f32| if phi > floor { phi } else { floor };
    if params.heuristic != Heuristic::Ward {
        let mut primitives: Vec<Primitive> = instances
            .map(|(index, summary)| {
                let mut bounds = summary.bounds();
                bounds.phi = at_least(bounds.phi);
                Primitive::new(index, &bounds)
            })
            .collect();
        return build_binary::<N, W>(&mut primitives, kind::MESH, params);
    }
    let mut primitives: Vec<WardPrimitive> = instances
        .map(|(index, summary)| {
            let c = summary.center();
            WardPrimitive {
                c: [c.x, c.y, c.z],
                phi: at_least(summary.phi()),
                index,
            }
        })
        .collect();
    build_ward::<N, W>(&mut primitives, kind::MESH, params)
}

/// Builds a binary tree by the paper's heuristics, and collapses it.
fn build_binary<N: Node<W>, const W: usize>(
    primitives: &mut [Primitive],
    leaf_kind: u32,
    params: &BuildParams,
) -> Topology<N> {
    let mut out = Topology {
        nodes: Vec::with_capacity(primitives.len()),
        trails: Vec::with_capacity(primitives.len()),
        depth: 0,
    };
    if let [only] = primitives {
        let root = |(), _| [Child::Leaf(only.index)];
        emit::<N, _, _, W>(&mut out, leaf_kind, &root, (), (0, BitTrail::default()));
    } else {
        let binary = binary_tree(primitives, binary_levels::<W>(), params);
        let collapse = Collapse::<W>::of(&binary);
        let children = |node, _| {
            let (children, count) = collapse.children(&binary.nodes, node);
            let child = |child| match child & LEAF {
                0 => Child::Node(child),
                _ => Child::Leaf(child & !LEAF),
            };
            children.into_iter().take(count).map(child)
        };
        emit::<N, _, _, W>(&mut out, leaf_kind, &children, 0, (0, BitTrail::default()));
    }
    out
}

/// Least primitives for building the root's children in parallel.
#[cfg(feature = "rayon")]
const PARALLEL: usize = 4096;

#[cfg(feature = "rayon")]
impl<N> Topology<N> {
    /// Appends a child of the root: its nodes, or the one leaf it is.
    fn append<const W: usize>(&mut self, root: usize, slot: usize, leaf_kind: u32, below: Self)
    where
        N: Node<W>,
    {
        let first = self.nodes.len() as u32;
        let (to, link) = match (&below.nodes[..], &below.trails[..]) {
            ([], &[(index, _)]) => (leaf_kind, index),
            _ => (kind::INNER, first),
        };
        self.nodes[root].set_child(slot, to, link);
        self.nodes.extend(below.nodes);
        for node in &mut self.nodes[first as usize..] {
            for slot in 0..W {
                if node.kind(slot) == kind::INNER {
                    node.relink(slot, first + node.link(slot));
                }
            }
        }
        self.trails.extend(below.trails);
        self.depth = self.depth.max(below.depth);
    }
}

/// A child of a wide node.
#[derive(Clone, Copy)]
pub(super) enum Child<T> {
    /// The index of a primitive.
    Leaf(u32),
    /// What becomes a node.
    Node(T),
}

/// Emits the node over `item` at a level and a trail, and those below it, whose children are found by `children` from the item and
/// its level; recursion is as deep as the tree, at most 64.
pub(super) fn emit<N: Node<W>, T: Send, C: IntoIterator<Item = Child<T>>, const W: usize>(
    out: &mut Topology<N>,
    leaf_kind: u32,
    children: &(impl Fn(T, u32) -> C + Sync),
    item: T,
    (level, trail): (u32, BitTrail),
) {
    let node = out.nodes.len();
    out.nodes.push(N::EMPTY);
    out.depth = out.depth.max(level + 1);
    #[cfg(feature = "rayon")]
    if level == 0 && out.trails.capacity() >= PARALLEL {
        use rayon::prelude::*;
        let all: Vec<_> = (0u32..).zip(children(item, level)).collect();
        let below = |(slot, child)| {
            let mut below = Topology {
                nodes: Vec::new(),
                trails: Vec::new(),
                depth: 0,
            };
            let own = trail.with::<W>(level, slot);
            match child {
                Child::Leaf(index) => below.trails.push((index, own)),
                Child::Node(item) => emit(&mut below, leaf_kind, children, item, (level + 1, own)),
            }
            (slot as usize, below)
        };
        let all: Vec<(usize, Topology<N>)> = all.into_par_iter().map(below).collect();
        for (slot, below) in all {
            out.append(node, slot, leaf_kind, below);
        }
        return;
    }
    for (slot, child) in children(item, level).into_iter().enumerate() {
        let own = trail.with::<W>(level, slot as u32);
        match child {
            Child::Leaf(index) => {
                out.nodes[node].set_child(slot, leaf_kind, index);
                out.trails.push((index, own));
            }
            Child::Node(item) => {
                let link = out.nodes.len() as u32;
                out.nodes[node].set_child(slot, kind::INNER, link);
                emit(out, leaf_kind, children, item, (level + 1, own));
            }
        }
    }
}

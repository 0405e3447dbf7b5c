//! From primitives to a tree: which node, which slot, which trail.

use alloc::vec::Vec;

use super::binary::{Binary, LEAF, binary_tree};
use super::collapse::{Collapse, binary_levels};
use super::primitive::Primitive;
use super::ward::{WardPrimitive, build_ward};
use super::{BuildParams, Topology};
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

/// Builds a tree over `triangles`, at least one, numbered from 0.
pub(crate) fn build_over<N: Node<W>, const W: usize>(
    triangles: &[N::Light],
    params: &BuildParams,
) -> Topology<N> {
    if params.heuristic.is_binary() {
        let bounds = |(i, light): (u32, &N::Light)| Primitive::new(i, &light.bounds());
        let mut primitives: Vec<Primitive> = (0..).zip(triangles).map(bounds).collect();
        return build_binary::<N, W>(&mut primitives, kind::LIGHT, params);
    }
    let primitives = (0..).zip(triangles);
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
    if params.heuristic.is_binary() {
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
        depth: 1,
    };
    if let [only] = primitives {
        let mut root = N::EMPTY;
        root.set_child(0, leaf_kind, only.index);
        out.nodes.push(root);
        out.trails.push((only.index, BitTrail::default()));
    } else {
        let binary = binary_tree(primitives, binary_levels::<W>(), params);
        let mut emitter = Emitter::<N, W> {
            leaf_kind,
            binary: &binary.nodes,
            collapse: Collapse::of(&binary),
            out: &mut out,
        };
        emitter.node(0, 0, BitTrail::default());
    }
    out
}

struct Emitter<'a, N, const W: usize> {
    leaf_kind: u32,
    binary: &'a [Binary],
    collapse: Collapse<W>,
    out: &'a mut Topology<N>,
}

impl<N: Node<W>, const W: usize> Emitter<'_, N, W> {
    /// Emits the wide node in place of a binary one at `level`; recursion is as deep as the tree, at most 64.
    fn node(&mut self, binary: u32, level: u32, trail: BitTrail) {
        let index = self.out.nodes.len();
        self.out.nodes.push(N::EMPTY);
        self.out.depth = self.out.depth.max(level + 1);

        let (children, count) = self.collapse.children(self.binary, binary);
        for (slot, &child) in children[..count].iter().enumerate() {
            let own_trail = trail.with::<W>(level, slot as u32);
            if child & LEAF != 0 {
                let primitive = child & !LEAF;
                self.out.nodes[index].set_child(slot, self.leaf_kind, primitive);
                self.out.trails.push((primitive, own_trail));
            } else {
                let link = self.out.nodes.len() as u32;
                self.out.nodes[index].set_child(slot, kind::INNER, link);
                self.node(child, level + 1, own_trail);
            }
        }
    }
}

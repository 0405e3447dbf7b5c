//! The nodes of bottom levels on the paths to triangles that changed.

use alloc::collections::BTreeMap;
use alloc::vec::Vec;
use core::ops::Range;

use super::changes::{Pending, merged};
use super::room::reserve;
use super::{Bvh, Trails};
use crate::levels::Levels;
use crate::light::Light;
use crate::node::{Node, kind};

/// Where more than this share of a bottom level's triangles changed, all of it is swept. Paths to a sixteenth take 0.65 to 0.76
/// of a sweep's time where the triangles lie anywhere in the mesh, to an eighth 0.9 to 1.15 (10^5 and 10^6 triangles).
const MOST: usize = 16;

/// By node: the last search that came by.
#[derive(Clone, Debug, Default)]
pub(super) struct Marks {
    by_node: Vec<u32>,
    search: u32,
}

impl Marks {
    /// A search among `nodes` nodes begins.
    fn begin(&mut self, nodes: usize) {
        self.search = self.search.wrapping_add(1);
        if self.search == 0 {
            // A mark of as many searches ago is none.
            self.by_node.fill(0);
            self.search = 1;
        }
        self.cover(nodes);
    }

    /// Whether the search has not come by before.
    fn is_first(&mut self, node: u32) -> bool {
        let mark = &mut self.by_node[node as usize];
        core::mem::replace(mark, self.search) != self.search
    }

    /// Makes room for marks of so many nodes.
    pub fn reserve(&mut self, nodes: usize) {
        reserve(&mut self.by_node, nodes);
    }

    /// Has marks for so many nodes.
    pub fn cover(&mut self, nodes: usize) {
        if self.by_node.len() < nodes {
            self.by_node.resize(nodes, 0);
        }
    }

    pub fn bytes(&self) -> usize {
        size_of_val(&*self.by_node)
    }
}

/// Bottom levels that changed in part, by index, with the triangles that did.
type Parts = BTreeMap<u32, Vec<Range<u32>>>;

impl<N: Node<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// The bottom levels that changed in part, and not as a whole.
    pub(super) fn parts(&self, pending: &Pending) -> Parts {
        let mut parts = Parts::new();
        for range in merged(pending.parts.clone()) {
            let mut at = range.start;
            while at < range.end {
                let blas = self.triangles[at as usize].mesh();
                let own = self.blases.get(blas as usize).map(|own| &own.triangles);
                // Those of a bottom level that is gone are of no account.
                let Some(own) = own.filter(|own| own.contains(&at)) else {
                    at += 1;
                    continue;
                };
                let end = range.end.min(own.end);
                if !pending.blases.contains(&blas) {
                    parts.entry(blas).or_default().push(at..end);
                }
                at = end;
            }
        }
        parts
    }

    /// Bottom levels that changed in part, and the nodes of each that are to be computed. Those that changed so much that a
    /// sweep is no more work become bottom levels that changed as a whole.
    pub(super) fn touched(&mut self, pending: &mut Pending) -> (Vec<u32>, Vec<Levels>) {
        let parts = self.parts(pending);
        pending.parts.clear();
        let (mut touched, mut levels) = (Vec::new(), Vec::new());
        for (blas, ranges) in parts {
            let changed: usize = ranges.iter().map(ExactSizeIterator::len).sum();
            if !T::KEPT || changed * MOST > self.blases[blas as usize].triangles.len() {
                pending.blases.insert(blas);
            } else {
                touched.push(blas);
                let (root, depth) = (self.roots[blas as usize].node, self.blases[blas as usize].depth);
                levels.push(self.paths(root, depth, ranges));
            }
        }
        (touched, levels)
    }

    /// The nodes on the paths from the root of a bottom level of `depth` levels to some of its triangles.
    pub(super) fn paths(&mut self, root: u32, depth: u32, triangles: Vec<Range<u32>>) -> Levels {
        self.marks.begin(self.nodes.len());
        let mut pairs = Vec::new();
        for triangle in triangles.into_iter().flatten() {
            let trail = self.trail_of(triangle);
            let mut node = root;
            for level in 0..depth {
                if self.marks.is_first(node) {
                    pairs.push((level, node));
                }
                let slot = trail.slot::<W>(level) as usize;
                let own = &self.nodes[node as usize];
                if own.kind(slot) != kind::INNER {
                    break;
                }
                node = own.link(slot);
            }
        }
        Levels::gather(pairs)
    }
}

#[cfg(test)]
mod tests;

//! What changed while a tree was built is computed in it, until it may take its place.

use alloc::vec::Vec;

use super::dirty::Dirty;
use super::{StageId, Staged};
use crate::bvh::changes::merged;
use crate::bvh::{Bvh, Trails};
use crate::node::{Node, kind};
use crate::sweep;

/// Bytes that take about the time of a node, of one that is computed after its neighbour, and of a path down to a triangle.
const NODE: usize = 2048;
const SWEPT: usize = 1024;
const PATH: usize = 4096;
/// Neighbours are so near.
const NEAR: u32 = 8;
/// Of a triangle that changed: its path, and the nodes there that no other shares.
const TRIANGLE: usize = PATH + 4 * NODE;
/// Where more than this share of the triangles changed, a refit sweeps all nodes.
const MOST: usize = 16;
/// Few enough nodes for one thread, which takes them in order.
pub(super) const IN_ORDER: usize = 1024;

impl Staged {
    /// Its nodes and trails are there. So much may have changed meanwhile that paths down are no less work than all nodes.
    pub(super) fn place(&mut self) {
        self.is_placed = true;
        self.fresh = 0;
        self.dirty = Dirty::none(self.nodes.len());
        if self.changed.count() as usize * TRIANGLE > self.nodes.len() * SWEPT {
            self.mark_all();
        }
    }

    /// The next nodes to be computed: `own`, and those that the bytes are for, one at least.
    fn take_dirty(&mut self, own: u32, bytes: &mut usize) -> Vec<u32> {
        let mut list = self.dirty.take_last(own + 1);
        let mut last = list.last().copied().unwrap_or(0);
        while *bytes >= NODE {
            let Some(node) = self.dirty.pop() else { break };
            *bytes -= if last - node < NEAR { SWEPT } else { NODE };
            list.push(node);
            last = node;
        }
        list
    }
}

impl<N: Node<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// Computes more of what changed since the triangles were copied, and lets the new tree take the place of the old where
    /// nothing is left; whether it has. `None` where the stage is gone.
    ///
    /// However much changes, and however often, it ends: beside the triangles that have changed since the last frame others are
    /// looked for, and beside the nodes that these mark others are computed, as many as the bytes are for. Those of the last
    /// frame are not of the bytes: the frame changed them itself.
    pub(crate) fn settle_stage(&mut self, id: StageId, bytes: &mut usize) -> Option<bool> {
        let staged = self.staged(id)?;
        let fresh = core::mem::take(&mut staged.fresh);
        let before = staged.dirty.count();
        if staged.changed.count() > 0 && !T::KEPT {
            staged.mark_all();
        } else {
            let some = staged.changed.take_last((fresh + (*bytes / PATH).max(1)) as u32);
            *bytes = bytes.saturating_sub(some.len().saturating_sub(fresh) * PATH);
            self.mark_paths(id, &some)?;
        }
        let staged = self.staged(id)?;
        let own = if fresh > 0 {
            staged.dirty.count() - before
        } else {
            0
        };
        let base = staged.nodes.start;
        let mut list = staged.take_dirty(own, bytes);
        list.iter_mut().for_each(|node| *node += base);
        for some in list.chunks(IN_ORDER) {
            sweep::bottom(&mut self.nodes, &self.triangles, some);
        }
        self.judge_list(&list);
        let written = list.iter().map(|&node| node..node + 1).collect();
        self.changes.new.written_nodes.extend(merged(written));
        let staged = self.staged(id)?;
        let is_settled = staged.dirty.count() == 0 && staged.changed.count() == 0;
        if is_settled && !self.fits_parts(id.blas) {
            self.await_closing(id.blas);
            return Some(false);
        }
        if is_settled {
            self.adopt_stage(id.blas);
        }
        Some(is_settled)
    }

    /// Marks the nodes on the ways to some triangles of a stage, which count from its first.
    fn mark_paths(&mut self, id: StageId, triangles: &[u32]) -> Option<()> {
        let staged = self.staged(id)?;
        let (root, first, depth) = (staged.nodes.start, staged.triangles.start, staged.depth);
        let mut dirty = core::mem::take(&mut staged.dirty);
        for triangle in triangles {
            let trail = self.trail_of(first + triangle);
            let mut node = root;
            for level in 0..depth {
                dirty.mark(node - root);
                let slot = trail.slot::<W>(level) as usize;
                let own = &self.nodes[node as usize];
                if own.kind(slot) != kind::INNER {
                    break;
                }
                node = own.link(slot);
            }
        }
        self.staged(id)?.dirty = dirty;
        Some(())
    }

    /// Whether the next refit sweeps all of a bottom level.
    fn is_swept(&self, blas: u32) -> bool {
        let new = &self.changes.new;
        let parts = self.parts(new).remove(&blas).unwrap_or_default();
        let changed: usize = parts.iter().map(ExactSizeIterator::len).sum();
        new.blases.contains(&blas) || (changed > 0 && !T::KEPT) || changed * MOST > self.blas_len(blas)
    }

    /// Before a refit or a plan: meshes that it sweeps anyway get the trees that wait for that.
    pub(in crate::bvh) fn adopt_swept(&mut self) {
        for blas in self.staging.clone() {
            let own = &self.blases[blas as usize];
            let is_ready = own.staged.as_ref().is_some_and(|staged| staged.is_placed);
            if !is_ready || !self.is_swept(blas) {
                continue;
            }
            if self.fits_parts(blas) {
                let new = self.adopt_stage(blas);
                self.changes.new.mark_blas(new);
            } else {
                self.await_closing(blas);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::Builder;
    use super::*;

    /// A row of a video wall has 9 to 15 % of the starts of frames beyond 0.3 ms where neighbours count half.
    #[test]
    fn a_frame_computes_as_many_nodes_as_its_bytes_take_time_for() {
        // From the last on; the first that is taken costs nothing, and the last may be begun while a node's bytes are left.
        for (apart, each) in [(1, SWEPT), (NEAR - 1, SWEPT), (NEAR, NODE), (50, NODE)] {
            for bytes in [1_usize << 14, 1 << 18] {
                let mut staged = Staged::new(0, 0, &Builder::default(), 1);
                staged.dirty = Dirty::none(1000 * apart as usize);
                (0..1000).for_each(|k| staged.dirty.mark(k * apart));
                let mut left = bytes;
                let list = staged.take_dirty(0, &mut left);
                assert_eq!((list.len() - 1) * each, bytes - left, "{apart}");
                assert!(left < NODE, "{apart}: {left}");
            }
        }
        assert_eq!((NODE, SWEPT), (2048, 1024), "measured: docs/dynamics-design.md");
    }
}

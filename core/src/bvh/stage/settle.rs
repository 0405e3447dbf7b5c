//! What changed while a tree was built is computed in it, until it may take its place.

use super::{MOST, StageId};
use crate::bvh::changes::merged;
use crate::bvh::{Bvh, Trails};
use crate::node::{Node, kind};
use crate::sweep;

/// Bytes that take about the time of a node, and of a way down to a triangle.
const NODE: usize = 2048;
const PATH: usize = 4096;
/// Few enough nodes for one thread, which takes them in order.
pub(super) const IN_ORDER: usize = 1024;

impl<N: Node<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// Computes more of what changed since the triangles were copied, and lets the new tree take the place of the old where nothing is
    /// left; whether it has. `None` where the stage is gone.
    ///
    /// However much changes, and however often, it ends: more triangles are looked for than have changed since the last frame, and more
    /// nodes are computed than those newly marked, by the bytes at least.
    pub(crate) fn settle_stage(&mut self, id: StageId, bytes: &mut usize) -> Option<bool> {
        let staged = self.staged(id)?;
        let fresh = core::mem::take(&mut staged.fresh);
        let before = staged.dirty.count();
        if staged.changed.count() > 0 && !T::KEPT {
            staged.mark_all();
        } else {
            let some = staged
                .changed
                .take_last((*bytes / PATH).max(2 * fresh).max(1) as u32);
            *bytes = bytes.saturating_sub(some.len() * PATH);
            self.mark_paths(id, &some)?;
        }
        let staged = self.staged(id)?;
        let marked = if fresh > 0 {
            staged.dirty.count() - before
        } else {
            0
        };
        let count = ((*bytes / NODE).max(1) as u32).max(2 * marked);
        let base = staged.nodes.start;
        let mut list = staged.dirty.take_last(count);
        *bytes = bytes.saturating_sub(list.len() * NODE);
        list.iter_mut().for_each(|node| *node += base);
        for some in list.chunks(IN_ORDER) {
            sweep::bottom(&mut self.nodes, &self.triangles, some);
        }
        self.judge_list(&list);
        let written = list.iter().map(|&node| node..node + 1).collect();
        self.changes.new.written_nodes.extend(merged(written));
        let staged = self.staged(id)?;
        let is_settled = staged.dirty.count() == 0 && staged.changed.count() == 0;
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
            if is_ready && self.is_swept(blas) {
                self.adopt_stage(blas);
                self.changes.new.mark_blas(blas);
            }
        }
    }
}

//! What changed while a tree was built is refitted in it, until it may take its place.

use alloc::vec::Vec;
use core::ops::Range;

use super::{MOST, StageId};
use crate::bvh::changes::merged;
use crate::bvh::{Bvh, Trails};
use crate::node::LightNode;
use crate::sweep;

/// Bytes that take about the time of a node in a sweep, and of a path to a triangle.
const NODE: usize = 2048;
const PATH: usize = 16384;

impl<N: LightNode<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// Refits more of what changed since the triangles were copied, and lets the new tree take the place of the old where nothing is
    /// left; whether it has. `None` where the stage is gone.
    pub(crate) fn settle_stage(&mut self, id: StageId, bytes: &mut usize) -> Option<bool> {
        let staged = self.staged(id)?;
        let fresh = core::mem::take(&mut staged.fresh);
        // Where more come from frame to frame, paths are sure to end.
        let is_worn = fresh == 0 && staged.is_worn();
        if !staged.is_whole && (is_worn || (!T::KEPT && !staged.changed.is_empty())) {
            staged.sweep_all();
        }
        if staged.is_whole {
            self.sweep_stage(id, bytes)?;
        }
        let staged = self.staged(id)?;
        if !staged.is_whole {
            // Never fewer than come, so that it ends.
            let paths = (*bytes / PATH).max(2 * fresh).max(1);
            *bytes = bytes.saturating_sub(paths * PATH);
            let some = first_of(&mut staged.changed, paths);
            let (root, depth) = (staged.nodes.start, staged.depth);
            if !some.is_empty() {
                let levels = self.paths(root, depth, some);
                for range in levels.ranges() {
                    sweep::bottom(&mut self.nodes, &self.triangles, &levels.nodes()[range]);
                }
                self.judge_list(levels.nodes());
                let written = levels.nodes().iter().map(|&node| node..node + 1);
                self.changes.new.written_nodes.extend(written);
            }
        }
        let staged = self.staged(id)?;
        let is_settled = !staged.is_whole && staged.changed.is_empty();
        if is_settled {
            self.adopt_stage(id.blas);
        }
        Some(is_settled)
    }

    /// Computes more of the nodes, from the last to the first.
    fn sweep_stage(&mut self, id: StageId, bytes: &mut usize) -> Option<()> {
        let staged = self.staged(id)?;
        // Few enough for one thread, which takes them in order.
        let count = ((*bytes / NODE).clamp(1, 1024) as u32).min(staged.swept);
        *bytes = bytes.saturating_sub(count as usize * NODE);
        let end = staged.nodes.start + staged.swept;
        staged.swept -= count;
        staged.is_whole = staged.swept > 0;
        let list: Vec<u32> = (end - count..end).rev().collect();
        sweep::bottom(&mut self.nodes, &self.triangles, &list);
        self.judge_list(&list);
        self.changes.new.written_nodes.push(end - count..end);
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

/// Takes the first `count` indices, or all there are.
pub(super) fn first_of(ranges: &mut Vec<Range<u32>>, count: usize) -> Vec<Range<u32>> {
    let mut all = merged(core::mem::take(ranges)).into_iter();
    let (mut some, mut left) = (Vec::new(), count as u32);
    for range in all.by_ref() {
        let end = range.end.min(range.start + left);
        left -= end - range.start;
        some.push(range.start..end);
        if left == 0 {
            if end < range.end {
                ranges.push(end..range.end);
            }
            break;
        }
    }
    ranges.extend(all);
    some
}

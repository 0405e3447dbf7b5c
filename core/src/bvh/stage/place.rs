//! Copies to the builder, and what it built put in place: each call as much as it is told.

use core::ops::Range;

use super::{MeshJob, MeshTree, StageId};
use crate::bvh::quality::Quality;
use crate::bvh::{Bvh, Trails};
use crate::node::{Node, kind};
use crate::tree::INVALID;

impl<N: Node<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// Makes more room for the triangles, by at most `bytes`, of which what it takes is subtracted; whether there is enough.
    /// `None` where the stage is gone.
    pub(crate) fn find_room(&mut self, id: StageId, bytes: &mut usize) -> Option<bool> {
        let staged = self.staged(id)?;
        if staged.triangles.is_empty() && staged.part.is_none() {
            let count = self.blas_len(id.blas) as u32;
            let Some(range) = self.take_triangles(count, bytes) else {
                return Some(false);
            };
            self.staged(id)?.triangles = range;
        }
        Some(true)
    }

    /// Copies more of the triangles, as [`find_room`](Self::find_room) does.
    pub(crate) fn copy_stage(
        &mut self,
        id: StageId,
        job: &mut MeshJob<N>,
        bytes: &mut usize,
    ) -> Option<bool> {
        if !self.find_room(id, bytes)? {
            return Some(false);
        }
        if self.staged(id)?.part.is_some() {
            return Some(self.copy_triangles_of_part(id, job, bytes));
        }
        let size = 2 * size_of::<N::Light>();
        let staged = self.staged(id)?;
        let from = staged.copied;
        let count = (staged.triangles.len() as u32 - from).min((*bytes / size) as u32);
        let to = staged.triangles.start + from;
        staged.copied += count;
        let is_done = staged.copied as usize == staged.triangles.len();
        if count > 0 {
            *bytes -= count as usize * size;
            let start = (self.blases[id.blas as usize].triangles.start + from) as usize;
            let own = start..start + count as usize;
            job.copy(&self.triangles[own]);
            let index = self.staged(id)?.index;
            self.copy_triangles(start as u32, to..to + count, index);
        }
        Some(is_done)
    }

    /// The same for a part, whose triangles stay where they are.
    fn copy_triangles_of_part(&self, id: StageId, job: &mut MeshJob<N>, bytes: &mut usize) -> bool {
        // They lie anywhere in the mesh.
        let size = 2 * size_of::<N::Light>();
        let (from, left) = job.copied();
        let count = left.min(*bytes / size);
        *bytes -= count * size;
        let start = self.blases[id.blas as usize].triangles.start;
        for k in from..from + count {
            let own = self.triangles[(start + job.places[k]) as usize];
            job.copy(&[own]);
        }
        count == left
    }

    /// Puts more of what was built in place, as [`copy_stage`](Self::copy_stage) copies.
    pub(crate) fn place_stage(
        &mut self,
        id: StageId,
        tree: &mut MeshTree<N>,
        bytes: &mut usize,
    ) -> Option<bool> {
        if self.staged(id)?.nodes.is_empty() {
            let Some(range) = self.take_nodes(tree.nodes.len() as u32, bytes) else {
                return Some(false);
            };
            self.staged(id)?.nodes = range;
        }
        let staged = self.staged(id)?;
        let (nodes, triangles) = (staged.nodes.clone(), staged.triangles.clone());
        self.place_nodes_of(tree, &nodes, &triangles, bytes);
        if T::KEPT {
            self.place_trails_of(tree, &triangles, bytes);
        }
        let is_done =
            tree.nodes_placed == tree.nodes.len() && (!T::KEPT || tree.trails_placed == tree.trails.len());
        if is_done {
            let (depth, levels) = (tree.depth, core::mem::take(&mut tree.levels));
            self.bottom_depth = self.bottom_depth.max(depth);
            let staged = self.staged(id)?;
            staged.depth = depth;
            staged.levels = levels;
            staged.place();
        }
        Some(is_done)
    }

    /// While a tree is built: makes room for about as many nodes as the old one has.
    pub(crate) fn expect_nodes(&mut self, id: StageId, bytes: &mut usize) {
        if self.staged(id).is_some_and(|staged| staged.part.is_none()) {
            let count = self.blases[id.blas as usize].nodes.len() as u32;
            if let Some(range) = self.take_nodes(count + count / 16, bytes) {
                self.node_ranges.give(range);
            }
        }
    }

    fn place_nodes_of(
        &mut self,
        tree: &mut MeshTree<N>,
        nodes: &Range<u32>,
        triangles: &Range<u32>,
        bytes: &mut usize,
    ) {
        let size = size_of::<N>() + size_of::<Quality>() + 2 * size_of::<u32>();
        let from = tree.nodes_placed;
        let to = (from + *bytes / size).min(tree.nodes.len());
        if from == to {
            return;
        }
        *bytes -= (to - from) * size;
        let base = nodes.start;
        for k in from..to {
            let mut node = tree.nodes[k];
            for slot in 0..W {
                match node.kind(slot) {
                    kind::INNER => node.relink(slot, node.link(slot) + base),
                    kind::LIGHT => node.relink(slot, node.link(slot) + triangles.start),
                    _ => {}
                }
            }
            let at = base as usize + k;
            self.nodes[at] = node;
            self.parents[at] = if k == 0 { INVALID } else { tree.parents[k] + base };
            self.quality[at] = tree.quality[k];
        }
        // As many entries in all.
        for node in &mut tree.levels.nodes[from..to] {
            *node += base;
        }
        tree.nodes_placed = to;
        self.changes
            .new
            .written_nodes
            .push(base + from as u32..base + to as u32);
    }

    fn place_trails_of(&mut self, tree: &mut MeshTree<N>, triangles: &Range<u32>, bytes: &mut usize) {
        // All trails are rewritten where this is the first tree too deep for one word, which files know by the depth.
        self.reserve_trails(tree.depth, triangles.start);
        self.bottom_depth = self.bottom_depth.max(tree.depth);
        let words = self.trail_words as usize;
        let from = tree.trails_placed;
        let to = (from + *bytes / (4 * words)).min(tree.trails.len());
        if from == to {
            return;
        }
        *bytes -= (to - from) * 4 * words;
        let start = triangles.start;
        for k in from..to {
            let at = (start as usize + k) * words;
            self.trails[at] = tree.trails[k].low;
            if words == 2 {
                self.trails[at + 1] = tree.trails[k].high;
            }
        }
        tree.trails_placed = to;
        self.changes
            .new
            .written_trails
            .push(start + from as u32..start + to as u32);
    }
}

//! Bottom levels built beside the frames and put in place piece by piece, so that no frame waits for a large mesh.
//!
//! A stage copies the triangles of a mesh a piece at a time, to where they will stand and for the builder; the builder, on a
//! thread of its own, gives a tree that is refitted; its nodes and trails are put in place a piece at a time, beside those that
//! are walked; what changed meanwhile is refitted there; then the instances are told of the new root and triangles, all at
//! once. The order of lights is a hint: what is exact comes from the refit. Edits meanwhile write both places.

mod dirty;
mod fit;
mod hand_over;
mod job;
mod part;
mod place;
mod reopen;
mod settle;

use alloc::boxed::Box;
use alloc::sync::{Arc, Weak};
use alloc::vec::Vec;
use core::ops::Range;

use self::dirty::Dirty;
#[cfg(feature = "std")]
pub(crate) use self::hand_over::HANDED;
pub(super) use self::hand_over::Outgoing;
pub(crate) use self::job::{MeshJob, MeshTree};
pub(super) use self::part::MISFITS;
use self::part::Part;
use super::{Bvh, Trails};
use crate::levels::Levels;
use crate::light::Light;
use crate::node::Node;
use crate::tree::INVALID;

/// Which stage, of which light BVH.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct StageId {
    tree: u32,
    blas: u32,
    number: u64,
}

/// What a light BVH knows of a tree that is to take the place of a bottom level's.
#[derive(Clone, Debug)]
pub(super) struct Staged {
    number: u64,
    /// Which light BVH it is of: a copy of one is another.
    tree: u32,
    /// Who builds it.
    builder: Weak<()>,
    /// The bottom level that it will be; none of a part.
    index: u32,
    /// Where the triangles will stand, empty until there is room; the first `copied` of them do.
    triangles: Range<u32>,
    copied: u32,
    /// Where the nodes will stand; empty until they are built.
    nodes: Range<u32>,
    /// Whether all nodes and trails are there.
    is_placed: bool,
    depth: u32,
    levels: Levels,
    /// Triangles, by their places in the mesh, that changed since they were copied, and whose nodes are not marked yet.
    changed: Dirty,
    /// How many changed since the last frame began.
    fresh: usize,
    /// Nodes, once they are there, that are to be computed.
    dirty: Dirty,
    /// The part that it is of, where it is not of all: its triangles stay, and its nodes are computed apart.
    part: Option<Part>,
    /// What was [unsettled](super::blas::Blas::unsettled) when it began.
    unsettled: u32,
    /// Where among the mesh's instances those that are to be closed first are looked for, while it waits for that.
    closes: Option<u32>,
}

/// Who builds beside the frames of a light BVH: what is under way ends with it.
#[derive(Debug, Default)]
pub(crate) struct Builder(Arc<()>);

impl Staged {
    /// One of `count` triangles.
    fn new(tree: u32, number: u64, builder: &Builder, count: usize) -> Self {
        Self {
            number,
            tree,
            builder: Arc::downgrade(&builder.0),
            index: INVALID,
            triangles: 0..0,
            copied: 0,
            nodes: 0..0,
            is_placed: false,
            depth: 0,
            levels: Levels::default(),
            changed: Dirty::none(count),
            fresh: 0,
            dirty: Dirty::default(),
            part: None,
            unsettled: 0,
            closes: None,
        }
    }

    /// Whether anyone will bring it to an end.
    fn is_built(&self, tree: u32) -> bool {
        self.tree == tree && self.builder.strong_count() > 0
    }

    fn is_by(&self, builder: &Builder) -> bool {
        self.builder.as_ptr() == Arc::as_ptr(&builder.0)
    }

    /// All nodes are to be computed.
    fn mark_all(&mut self) {
        self.changed = Dirty::none(self.triangles.len());
        self.dirty.mark_all(self.nodes.len());
    }
}

impl<N: Node<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// Number of triangles of a bottom level.
    pub(crate) fn blas_len(&self, blas: u32) -> usize {
        self.blases[blas as usize].triangles.len()
    }

    /// Begins a stage for bottom level `blas`; `None` where there is no such, and in a single level, whose lights are its
    /// triangles.
    pub(crate) fn begin_stage(&mut self, blas: u32, builder: &Builder) -> Option<(StageId, MeshJob<N>)> {
        let own = self.blases.get(blas as usize)?;
        if self.single || own.nodes.is_empty() || own.is_outgoing || own.outgoing.is_some() {
            return None;
        }
        self.drop_stage(blas);
        self.epoch += 1;
        let count = self.blas_len(blas);
        let staged = Staged {
            index: self.blas_ranges.take(1).start,
            unsettled: self.blases[blas as usize].unsettled,
            ..Staged::new(self.id.0, self.epoch, builder, count)
        };
        let id = self.stage(blas, staged);
        Some((id, MeshJob::new(&self.params, count)))
    }

    fn stage(&mut self, blas: u32, staged: Staged) -> StageId {
        let id = StageId {
            tree: staged.tree,
            blas,
            number: staged.number,
        };
        self.blases[blas as usize].staged = Some(Box::new(staged));
        self.staging.push(blas);
        id
    }

    /// The stage of that id, while it is there.
    fn staged(&mut self, id: StageId) -> Option<&mut Staged> {
        let own = self
            .blases
            .get_mut(id.blas as usize)
            .filter(|_| id.tree == self.id.0)?;
        own.staged
            .as_deref_mut()
            .filter(|staged| staged.number == id.number)
    }

    /// Whether it is of this light BVH.
    pub(crate) fn has(&self, id: StageId) -> bool {
        id.tree == self.id.0
    }

    /// Whether its tree is in place.
    pub(crate) fn is_adopted(&self, id: StageId) -> bool {
        let own = self.blases.get(id.blas as usize);
        id.tree == self.id.0 && own.is_some_and(|own| own.adopted == id.number)
    }

    /// The tree of a stage takes the place of the bottom level's; which one it is then.
    fn adopt_stage(&mut self, blas: u32) -> u32 {
        let Some(staged) = self.blases[blas as usize].staged.take() else {
            return blas;
        };
        self.staging.retain(|&other| other != blas);
        self.epoch += 1;
        let new = staged.index;
        self.put_in_place(blas, *staged);
        self.note_size(0, self.blases[new as usize].nodes.len());
        self.settle_some(super::rebuild::ADOPTED);
        // Built for triangles that have changed since, it may be due again, and files tell how it was built.
        self.epoch += 1;
        self.blases[new as usize].changed = self.epoch;
        self.note_refitted(new, self.epoch);
        new
    }

    /// Gives up what was under way for a bottom level.
    pub(super) fn drop_stage(&mut self, blas: u32) {
        if let Some(staged) = self.blases[blas as usize].staged.take() {
            self.node_ranges.give(staged.nodes);
            self.triangle_ranges.give(staged.triangles);
            if staged.index != INVALID {
                self.blas_ranges.give(staged.index..staged.index + 1);
            }
            self.staging.retain(|&other| other != blas);
        }
    }

    /// Gives up what nobody will bring to an end: all that is under way of builders that are gone, and what `builder` does not
    /// keep. Whether another builder has any.
    pub(crate) fn drop_stages_but(&mut self, builder: &Builder, kept: impl Fn(StageId) -> bool) -> bool {
        let mut is_shared = false;
        for blas in self.staging.clone() {
            let Some(staged) = &self.blases[blas as usize].staged else {
                continue;
            };
            let id = StageId {
                tree: self.id.0,
                blas,
                number: staged.number,
            };
            let is_own = staged.is_by(builder);
            if !staged.is_built(self.id.0) || (is_own && !kept(id)) {
                self.drop_stage(blas);
            } else {
                is_shared |= !is_own;
            }
        }
        is_shared
    }

    /// Gives up one.
    pub(crate) fn give_up(&mut self, id: StageId) {
        if self.staged(id).is_some() {
            self.drop_stage(id.blas);
        }
    }

    /// Lists that are not needed any more.
    pub(crate) fn take_retired(&mut self) -> Vec<Levels> {
        core::mem::take(&mut self.retired)
    }

    /// Triangles that were written also go to where they will stand, as far as they are there.
    pub(super) fn write_staged(&mut self, blas: u32, first: u32, count: u32) {
        let own = &mut self.blases[blas as usize];
        let Some(staged) = own.staged.as_deref_mut() else {
            return;
        };
        if let Some(part) = &staged.part {
            staged.fresh += part.mark(first, first + count, &mut staged.changed);
            return;
        }
        let end = (first + count).min(staged.copied);
        if first >= end {
            return;
        }
        let to = staged.triangles.start + first..staged.triangles.start + end;
        if staged.is_placed && count as usize == staged.triangles.len() {
            staged.mark_all();
        } else {
            (first..end).for_each(|triangle| staged.changed.mark(triangle));
            staged.fresh += (end - first) as usize;
        }
        let (start, index) = (own.triangles.start, staged.index);
        self.copy_triangles(start + first, to, index);
    }

    /// Copies triangles that begin at `from` to where those of bottom level `index` will stand.
    fn copy_triangles(&mut self, from: u32, to: Range<u32>, index: u32) {
        for (from, to) in (from..).zip(to.clone()) {
            self.triangles[to as usize] = self.triangles[from as usize].of_mesh(index);
        }
        self.changes.new.written_triangles.push(to);
    }
}

#[cfg(all(test, feature = "std"))]
mod tests;

//! A part of a large mesh's tree built anew: a subtree that lost its shape while the rest of the tree kept it.
//!
//! Its triangles stay where they are, and the new subtree has as many nodes as the old one, so that it takes its place without
//! a gap: only its nodes, and the trails of its triangles, are written. What changes while it is built is computed in it, still
//! apart, as a whole stage is; then it is put in place within one frame.

use alloc::collections::BinaryHeap;
use alloc::vec::Vec;
use core::cmp::Ordering;

use super::job::Place;
use super::{Builder, Dirty, MeshJob, MeshTree, StageId, Staged};
use crate::bvh::quality;
use crate::bvh::{Bvh, RebuildParams, Trails};
use crate::levels::Levels;
use crate::node::{Holds, Node, kind};
use crate::summary::Summary;
use crate::sweep;
use crate::trail::{BitTrail, max_levels, word_levels};

/// Nodes that one search for such a part looks at.
const LOOKED_AT: usize = 128;
/// Nodes known to have no other tree of as many nodes from which on no part of a mesh is built: until parts around them were,
/// or the whole is worn.
pub(in crate::bvh) const MISFITS: usize = 64;
/// Bytes of a frame that take about the time of a node that is put in place, with its triangles.
const PLACED: usize = 128;
/// Bytes that take about the time of a triangle that is copied again, and of a node computed apart.
const TRIANGLE: usize = 1024;
const NODE: usize = 2048;
/// Triangles in one region of trails that are written may be so far apart.
const APART: u32 = 16;

/// Which part.
#[derive(Clone, Debug)]
pub(super) struct Part {
    /// Its first node.
    node: u32,
    /// How many nodes are above that.
    level: u32,
    /// Its triangles, by their places in the mesh.
    members: Dirty,
}

/// A node that a search has reached.
struct Step {
    loss: f64,
    node: u32,
    end: u32,
    level: u32,
    trail: BitTrail,
}

/// What lost most comes first, by place where that is equal.
impl Ord for Step {
    fn cmp(&self, other: &Self) -> Ordering {
        self.loss.total_cmp(&other.loss).then(other.node.cmp(&self.node))
    }
}

impl PartialOrd for Step {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Step {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Step {}

impl<N: Node<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// Begins a stage for a part of bottom level `blas` that `params` wants built anew, if there is one that a frame of `bytes`
    /// can put in place. `None` where there is none, where a stage is under way, and where there are no trails: without them
    /// nothing leads from a triangle to its node.
    pub(crate) fn begin_part(
        &mut self,
        blas: u32,
        builder: &Builder,
        params: &RebuildParams,
        bytes: usize,
    ) -> Option<(StageId, MeshJob<N>)> {
        let own = self.blases.get(blas as usize)?;
        let is_hopeless = own.misfits.len() >= MISFITS;
        let is_busy = own.staged.is_some() || own.is_outgoing || own.outgoing.is_some();
        if own.nodes.is_empty() || is_busy || !T::KEPT || is_hopeless {
            return None;
        }
        let step = self.worn_part(blas, params.drift, (bytes / PLACED) as u32)?;
        let count = self.blas_len(blas);
        let first = self.blases[blas as usize].triangles.start;
        let mut members = Dirty::none(count);
        for node in &self.nodes[step.node as usize..step.end as usize] {
            for slot in (0..W).filter(|&slot| node.kind(slot) == kind::LIGHT) {
                members.mark(node.link(slot) - first);
            }
        }
        let places: Vec<u32> = members.iter_from(0).collect();
        let levels = if self.trail_words == 1 {
            word_levels(W)
        } else {
            max_levels(W)
        };
        let nodes = step.end - step.node;
        let part = Part {
            node: step.node,
            level: step.level,
            members,
        };
        self.epoch += 1;
        let staged = Staged {
            part: Some(part),
            ..Staged::new(self.id.0, self.epoch, builder, count)
        };
        let id = self.stage(blas, staged);
        let place = Place {
            nodes,
            level: step.level,
            trail: step.trail,
            levels: levels - step.level,
        };
        let job = MeshJob::of_part(&self.params, places, place);
        Some((id, job))
    }

    /// The worn subtree of at most `most` nodes that a search by what was lost comes to first.
    fn worn_part(&self, blas: u32, worse: f64, most: u32) -> Option<Step> {
        let own = &self.blases[blas as usize];
        let mut found = BinaryHeap::from([Step {
            loss: 0.0,
            node: own.nodes.start,
            end: own.nodes.end,
            level: 0,
            trail: BitTrail::default(),
        }]);
        for _ in 0..LOOKED_AT {
            let step = found.pop()?;
            let is_worn = step.level > 0 && self.quality(step.node).drift() > worse;
            if is_worn && step.end - step.node <= most && !own.misfits.contains(&step.node) {
                return Some(step);
            }
            let node = &self.nodes[step.node as usize];
            let mut end = step.end;
            for slot in (0..W).rev().filter(|&slot| node.kind(slot) == kind::INNER) {
                let link = node.link(slot);
                let loss = f64::from(node.summary(slot).phi()) * self.quality(link).loss();
                if loss > 0.0 {
                    found.push(Step {
                        loss,
                        node: link,
                        end,
                        level: step.level + 1,
                        trail: step.trail.with::<W>(step.level, slot as u32),
                    });
                }
                end = link;
            }
        }
        None
    }

    /// Computes more of what changed since the triangles were copied, and puts the subtree in place where nothing is left;
    /// whether it has. `None` where the stage is gone, or no subtree of as many nodes was found.
    pub(crate) fn settle_part(
        &mut self,
        id: StageId,
        tree: &mut MeshTree<N>,
        bytes: &mut usize,
    ) -> Option<bool> {
        let (root, level) = self
            .staged(id)?
            .part
            .as_ref()
            .map(|part| (part.node, part.level))?;
        if tree.nodes.is_empty() {
            self.blases[id.blas as usize].misfits.push(root);
            self.drop_stage(id.blas);
            return None;
        }
        let start = self.blases[id.blas as usize].triangles.start;
        let staged = self.staged(id)?;
        let fresh = core::mem::take(&mut staged.fresh);
        let some = staged
            .changed
            .take_last((fresh + (*bytes / TRIANGLE).max(1)) as u32);
        let is_clean = staged.changed.count() == 0;
        *bytes = bytes.saturating_sub(some.len().saturating_sub(fresh) * TRIANGLE);
        let before = tree.dirty.count();
        for &triangle in &some {
            let Ok(local) = tree.places.binary_search(&triangle) else {
                continue;
            };
            tree.triangles[local] = self.triangles[(start + triangle) as usize];
            tree.mark_path::<W>(local, level);
        }
        let own = if fresh > 0 { tree.dirty.count() - before } else { 0 };
        let list = tree.dirty.take_last(own + (*bytes / NODE).max(1) as u32);
        *bytes = bytes.saturating_sub(list.len().saturating_sub(own as usize) * NODE);
        tree.compute::<W>(&list);
        if tree.dirty.count() > 0 || !is_clean {
            return Some(false);
        }
        self.install_part(id, root, level, tree);
        Some(true)
    }

    /// Puts a subtree in place. The nodes above it are for the next refit.
    fn install_part(&mut self, id: StageId, root: u32, level: u32, tree: &MeshTree<N>) {
        let start = self.blases[id.blas as usize].triangles.start;
        for (k, node) in (0..).zip(&tree.nodes) {
            let mut node = *node;
            for slot in 0..W {
                match node.kind(slot) {
                    kind::INNER => node.relink(slot, node.link(slot) + root),
                    kind::LIGHT => node.relink(slot, start + tree.places[node.link(slot) as usize]),
                    _ => {}
                }
            }
            let at = (root + k) as usize;
            self.nodes[at] = node;
            self.quality[at] = tree.quality[k as usize];
            if k > 0 {
                self.parents[at] = tree.parents[k as usize] + root;
            }
        }
        let written = &mut self.changes.new.written_trails;
        let words = self.trail_words as usize;
        for (&place, trail) in tree.places.iter().zip(&tree.trails) {
            let triangle = start + place;
            let at = triangle as usize * words;
            self.trails[at] = trail.low;
            if words == 2 {
                self.trails[at + 1] = trail.high;
            }
            match written.last_mut() {
                Some(last) if (last.start..last.end + APART).contains(&triangle) => {
                    last.end = last.end.max(triangle + 1);
                }
                _ => written.push(triangle..triangle + 1),
            }
        }
        self.changes
            .new
            .written_nodes
            .push(root..root + tree.nodes.len() as u32);
        self.changes.forget_lists();
        // One way down is enough for all nodes above it.
        let one = start + tree.places[0];
        self.changes.new.parts.push(one..one + 1);
        self.bottom_depth = self.bottom_depth.max(level + tree.depth);
        let own = &mut self.blases[id.blas as usize];
        own.depth = own.depth.max(level + tree.depth);
        own.adopted = id.number;
        own.is_unlisted = true;
        // What is below has other nodes, and what is above other triangles in them.
        let end = root + tree.nodes.len() as u32;
        own.misfits.retain(|node| !(root..end).contains(node));
        self.retired.push(core::mem::take(&mut own.levels));
        self.drop_stage(id.blas);
    }

    /// The nodes of a bottom level, level by level.
    pub(in crate::bvh) fn levels_of(&self, blas: u32) -> Levels {
        let own = &self.blases[blas as usize];
        if !own.is_unlisted {
            return own.levels.clone();
        }
        let first = own.nodes.start;
        let mut levels: Vec<u32> = Vec::with_capacity(own.nodes.len());
        for node in own.nodes.clone() {
            let level = match node == first {
                true => 0,
                false => levels[(self.parents[node as usize] - first) as usize] + 1,
            };
            levels.push(level);
        }
        Levels::of_each(&levels, first)
    }

    /// Has the list of a bottom level at hand.
    pub(in crate::bvh) fn list_levels(&mut self, blas: u32) {
        if self.blases[blas as usize].is_unlisted {
            let levels = self.levels_of(blas);
            let own = &mut self.blases[blas as usize];
            own.levels = levels;
            own.is_unlisted = false;
        }
    }
}

impl Part {
    /// Marks those of the triangles `first..end` of the mesh that are its own; how many there are.
    pub fn mark(&self, first: u32, end: u32, changed: &mut Dirty) -> usize {
        let own = self
            .members
            .iter_from(first)
            .take_while(|&triangle| triangle < end);
        own.map(|triangle| changed.mark(triangle)).count()
    }
}

impl<N: Holds> MeshTree<N> {
    /// Marks the nodes on the way to a triangle, whose trail begins so many levels above.
    fn mark_path<const W: usize>(&mut self, triangle: usize, above: u32)
    where
        N: Node<W>,
    {
        let trail = self.trails[triangle];
        let mut node = 0;
        for level in 0..self.depth {
            self.dirty.mark(node);
            let slot = trail.slot::<W>(above + level) as usize;
            let own = &self.nodes[node as usize];
            if own.kind(slot) != kind::INNER {
                break;
            }
            node = own.link(slot);
        }
    }

    /// Computes nodes from the last on.
    fn compute<const W: usize>(&mut self, list: &[u32])
    where
        N: Node<W>,
    {
        for some in list.chunks(super::settle::IN_ORDER) {
            sweep::bottom(&mut self.nodes, &self.triangles, some);
        }
        quality::judge(&self.nodes, &mut self.quality, list);
    }
}

#[cfg(all(test, feature = "std"))]
mod tests;

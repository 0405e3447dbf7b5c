//! Refit of what changed, on the CPU.

use crate::model::{Model, SummaryOf};
use alloc::sync::Arc;
use alloc::vec::Vec;
use core::ops::Range;

use super::Bvh;
use super::top::{Batch, Opened, Part, are_mixed};
use crate::node::{Node, kind};
use crate::refit::{self, Child, has_limits, leaf_child};
use crate::summary::Summary;
use crate::trail::leaf;
use crate::tree::INVALID;
use crate::widest::widest;

/// If more than 1/`SWEPT` of a mesh's lights changed, all of it is swept. Paths to a sixteenth take 0.65 to 0.76 of a
/// sweep's time if the lights lie anywhere in the mesh, to an eighth 0.9 to 1.15 (10^5 and 10^6 lights).
pub(super) const SWEPT: usize = 16;
/// Changes by which a rebuilder may be behind, for each instance. If all move in each frame, a build takes about as long as three
/// frames' edits.
const BEHIND: usize = 16;

impl<M: Model<W>, const W: usize> Bvh<M, W> {
    /// Updates the top level by the edits and by the roots of meshes.
    pub(super) fn refit_top(&mut self) {
        self.send_changes();
        if self.single {
            self.unapplied.clear();
        } else if !self.unapplied.is_empty() || !self.top.lost.is_empty() {
            self.top.edit(&core::mem::take(&mut self.unapplied), &self.params);
            self.build_wanted();
        }
        self.log_top();
    }

    /// Builds the top level within the call.
    pub(super) fn build_top(&mut self) {
        self.top.build(&self.params);
        self.build_wanted();
        self.log_top();
    }

    /// Builds the top level again if the last build lacked parts of instances.
    fn build_wanted(&mut self) {
        if self.mark_wanted() {
            self.send_changes();
            let batches = core::mem::take(&mut self.unapplied);
            batches.iter().for_each(|batch| self.top.set(batch));
            self.top.build(&self.params);
        }
    }

    /// Marks the instances whose parts the last build lacked, to have them in the next batch. Returns whether there are any.
    pub(super) fn mark_wanted(&mut self) -> bool {
        let mut found = false;
        for index in core::mem::take(&mut self.top.wanted) {
            if self.placed[index as usize].live && self.part_count(index) > 1 {
                let pending = Opened {
                    first: INVALID,
                    parts: Vec::new(),
                };
                self.top.opened.insert(index, pending);
                self.mark_stale(index);
                found = true;
            }
        }
        found
    }

    /// Makes a batch of the marked instances, for this top level and for that of a rebuilder.
    fn send_changes(&mut self) {
        if self.stale.is_empty() {
            return;
        }
        let batch = Arc::new(self.take_batch());
        if self.outbox.rebuilder > 0 {
            self.outbox.len += batch.instances.len();
            self.outbox.batches.push(batch.clone());
            // If the rebuilder takes no more batches, drop them all.
            if self.outbox.len > BEHIND * self.instances.len() + (1 << 14) {
                self.outbox.first += self.outbox.batches.len() as u64;
                self.outbox.batches.clear();
                (self.outbox.len, self.outbox.rebuilder) = (0, 0);
            }
        }
        self.unapplied.push(batch);
    }

    pub(super) fn refit_paths(&mut self, mesh: u32, lights: &Range<u32>) {
        let pairs = self.path_nodes(mesh, lights.clone());
        widest(
            #[inline(always)]
            || {
                for &(_, node) in &pairs {
                    self.nodes[node as usize] = refit::bottom(&self.nodes, &self.lights, node);
                }
            },
        );
    }

    /// Marks the leaf of an instance for refit.
    pub(super) fn mark_stale(&mut self, index: u32) {
        if !core::mem::replace(&mut self.placed[index as usize].is_stale, true) {
            self.stale.push(index);
        }
    }

    /// Takes the marked instances, with their new leaves.
    fn take_batch(&mut self) -> Batch {
        let mut instances = core::mem::take(&mut self.stale);
        if !instances.is_sorted() {
            instances.sort_unstable();
        }
        let mut batch = Batch {
            leaves: Vec::with_capacity(instances.len()),
            ..Batch::default()
        };
        for &index in &instances {
            self.placed[index as usize].is_stale = false;
            let is_live = self.placed[index as usize].live;
            let child = self.leaf_of(leaf(index, 0));
            batch.leaves.push(is_live.then(|| child.summary.to_words()));
            if has_limits::<M::Node, W>() {
                batch.limits.push(child.limits);
            }
        }
        if self.params.opens {
            for (&index, words) in instances.iter().zip(&batch.leaves) {
                if words.is_some() && (self.top.opened.contains_key(&index) || self.is_mixed(index)) {
                    let parts = self.parts_of(index);
                    batch.parts.extend((parts.len() > 1).then_some((index, parts)));
                }
            }
        }
        batch.instances = instances;
        batch
    }

    /// The number of parts that an instance may be opened into: the children of its mesh's root if they are in slots without
    /// gaps; else 0.
    fn part_count(&self, index: u32) -> usize {
        let Some(root) = self.nodes.get(self.instances[index as usize].root as usize) else {
            return 0;
        };
        let count = (0..W).take_while(|&slot| root.kind(slot) != kind::EMPTY).count();
        match (count..W).all(|slot| root.kind(slot) == kind::EMPTY) {
            true => count,
            false => 0,
        }
    }

    /// Whether a beam holds the light of some parts, and none that of others.
    fn is_mixed(&self, index: u32) -> bool {
        if !<M::Node as Node<W>>::HAS_BEAMS || self.part_count(index) < 2 {
            return false;
        }
        let root = &self.nodes[self.instances[index as usize].root as usize];
        let beams: [_; W] = core::array::from_fn(|slot| root.beam(slot));
        are_mixed(beams[..self.part_count(index)].iter())
    }

    /// The parts that an instance may be opened into.
    pub(super) fn parts_of(&self, index: u32) -> Vec<Part> {
        let links = (1..=self.part_count(index) as u32).map(|part| self.leaf_of(leaf(index, part)));
        links
            .map(|child| (child.summary.to_words(), child.limits))
            .collect()
    }

    /// Removes opened instances from the top level if their meshes now have another number of parts, which their links do not
    /// fit. The next edit inserts them again.
    #[cfg(feature = "std")]
    pub(crate) fn take_out_changed(&mut self) {
        let opened = self.top.opened.iter();
        let changed =
            opened.filter(|(index, own)| own.first != INVALID && own.parts.len() != self.part_count(**index));
        let changed: Vec<u32> = changed.map(|(&index, _)| index).collect();
        changed
            .into_iter()
            .for_each(|index| self.top.take_out::<W>(index));
    }

    /// Summary and limits of a leaf of the top level.
    pub(super) fn leaf_of(&self, link: u32) -> Child<SummaryOf<M, W>> {
        leaf_child(&self.nodes, &self.lights, &self.instances, &self.roots, link)
    }
}

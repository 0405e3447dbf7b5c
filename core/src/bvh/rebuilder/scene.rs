//! The interface of a light BVH for its rebuilder.

use alloc::sync::Arc;
use alloc::vec::Vec;

use crate::bvh::Bvh;
use crate::bvh::top::{Batch, Top};
use crate::model::Model;

impl<M: Model<W>, const W: usize> Bvh<M, W> {
    /// Keeps batches for a rebuilder from now on, and drops those before number `seen`; false if some from there on are not kept,
    /// or another rebuilder took part since.
    pub(super) fn follow_batches(&mut self, rebuilder: u32, seen: u64) -> bool {
        let own = &mut self.outbox;
        let is_known = seen >= own.first;
        let dropped = seen.saturating_sub(own.first).min(own.batches.len() as u64);
        let dropped: usize = own
            .batches
            .drain(..dropped as usize)
            .map(|batch| batch.instances.len())
            .sum();
        own.len -= dropped;
        own.first = own.first.max(seen);
        core::mem::replace(&mut own.rebuilder, rebuilder) == rebuilder && is_known
    }

    /// Number of the next batch.
    pub(super) fn next_batch(&self) -> u64 {
        self.outbox.first + self.outbox.batches.len() as u64
    }

    /// The batches from number `seen` on.
    pub(super) fn batches_from(&self, seen: u64) -> Vec<Arc<Batch>> {
        let from = seen.saturating_sub(self.outbox.first) as usize;
        self.outbox.batches.get(from..).unwrap_or(&[]).to_vec()
    }

    /// A copy of the top level.
    pub(super) fn copy_top(&self) -> Top<M::Node> {
        let mut top = self.top.clone();
        self.unapplied.iter().for_each(|batch| top.set(batch));
        top
    }

    /// Swaps the top level for another, to which the next refit applies `batches`.
    pub(super) fn swap_top(&mut self, top: &mut Top<M::Node>, batches: Vec<Arc<Batch>>) {
        core::mem::swap(&mut self.top, top);
        // If no refit came since the last swap.
        self.unapplied.iter().for_each(|batch| top.set(batch));
        // Instances removed since the last refit are in no batch yet.
        let changed = batches
            .iter()
            .flat_map(|batch| &batch.instances)
            .chain(&self.stale);
        for &index in changed {
            if !self.placed[index as usize].live && (index as usize) < self.top.places.len() {
                self.top.take_out::<W>(index);
            }
        }
        self.unapplied = batches;
        self.take_out_changed();
        self.mark_wanted();
    }
}

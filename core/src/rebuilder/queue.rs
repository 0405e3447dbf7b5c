//! Meshes that wait for their turn, each once.

use alloc::collections::{BTreeSet, VecDeque};

/// Bottom levels in the order in which they came.
#[derive(Debug, Default)]
pub(super) struct Queue {
    order: VecDeque<u32>,
    known: BTreeSet<u32>,
}

impl Queue {
    /// Lets one wait that does not yet.
    pub fn push(&mut self, blas: u32) {
        if self.known.insert(blas) {
            self.order.push_back(blas);
        }
    }

    /// The one that has waited longest.
    pub fn pop(&mut self) -> Option<u32> {
        let first = self.order.pop_front()?;
        self.known.remove(&first);
        Some(first)
    }

    /// The same, left where it is.
    pub fn first(&self) -> Option<u32> {
        self.order.front().copied()
    }

    pub fn len(&self) -> usize {
        self.order.len()
    }

    pub fn is_empty(&self) -> bool {
        self.order.is_empty()
    }
}

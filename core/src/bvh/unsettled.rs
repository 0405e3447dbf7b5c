//! Meshes whose triangles change a few at a time: how much of a tree is not what it was made for.
//!
//! What a tree lost is measured by flux and node by node, and light reaches a point from dim triangles too: where each change
//! is little, a tree is never worn, and after many it is far worse than a new one. So changes are counted, and a rebuilder
//! makes a new tree once they are at rest.

use super::{Bvh, Trails};
use crate::node::Node;
use crate::summary::Summary;

/// Most that is counted, so that a word of the format has a bit more.
pub(super) const MOST: u32 = u32::MAX >> 2;
/// One in so many triangles must have changed. A tree is made once for that, and only when nothing moves.
const SHARE: u64 = 32;
/// And where some go on changing, as what flickers does, one in so many, each time counting.
#[cfg(feature = "std")]
const MUCH: u64 = 8;

impl<N: Node<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// Some triangles of bottom level `blas` are about to be these. One that outshines the mean of the mesh, as the last refit
    /// saw it, counts as so many; what is as dim is known to none.
    pub(super) fn unsettle_mesh(&mut self, blas: u32, triangles: &[N::Light]) {
        let count = self.blases[blas as usize].triangles.len();
        let mean = f64::from(self.root_of(blas).phi()) / count.max(1) as f64;
        let mut changed = triangles.len() as f64;
        // All of them are so many already.
        if triangles.len() < count && mean > 0.0 {
            let flux = |light: &N::Light| f64::from(N::Summary::of_light(light).phi());
            changed = triangles.iter().map(|light| (flux(light) / mean).max(1.0)).sum();
        }
        let own = &mut self.blases[blas as usize];
        let changed = changed.min(count as f64) as u32;
        own.unsettled = (own.unsettled + changed.min(MOST)).min(MOST);
    }

    /// Whether so much of a bottom level changed since its tree was made that another may be better, whatever it lost.
    #[cfg(feature = "std")]
    pub(crate) fn is_unsettled(&self, blas: u32) -> bool {
        let own = self.blases.get(blas as usize);
        own.is_some_and(|own| {
            let has_inner = own.nodes.len() > 1;
            has_inner && !own.is_outgoing && u64::from(own.unsettled) * SHARE >= own.triangles.len() as u64
        })
    }

    /// So many triangles of a bottom level changed since the refit before, or all.
    pub(super) fn note_changed(&mut self, blas: u32, triangles: Option<usize>, epoch: u64) {
        let own = &mut self.blases[blas as usize];
        own.changed = epoch;
        own.is_stale &= triangles.is_some();
        if triangles.is_none_or(|count| count as u64 * SHARE > own.triangles.len() as u64) {
            own.stirred = epoch;
        }
    }

    /// Whether a bottom level has rested since that epoch: nothing of it changed, or it is much of it that is unsettled, and no
    /// more than one in [`SHARE`] of its triangles changed in any frame.
    #[cfg(feature = "std")]
    pub(crate) fn is_at_rest(&self, blas: u32, since: u64) -> bool {
        let own = self.blases.get(blas as usize);
        own.is_some_and(|own| {
            let is_much = u64::from(own.unsettled) * MUCH >= own.triangles.len() as u64;
            // A rebuilder that is new has seen no frame yet, and of what was before it files tell less than the tree knows.
            own.changed <= since || (is_much && since > 0 && own.stirred <= since)
        })
    }
}

#[cfg(all(test, feature = "std"))]
mod tests;

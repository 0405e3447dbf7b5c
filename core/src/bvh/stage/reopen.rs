//! Instances that are opened into as many parts as a mesh's tree had, and not as many as the new one has.
//!
//! They are closed before it takes the old one's place, a few in each frame: all at once took 35 us each.

use super::hand_over::HANDED;
use crate::bvh::opened::parts_below;
use crate::bvh::{Bvh, Trails};
use crate::node::Node;

/// Instances that are opened anew as a tree is put in place that is handed over at once.
const AT_ONCE: u32 = 2;

impl<N: Node<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// Whether the tree of a stage may take the place of the bottom level's: few of its instances are opened, or into as many
    /// parts.
    pub(super) fn fits_parts(&self, blas: u32) -> bool {
        let own = &self.blases[blas as usize];
        let Some(staged) = own.staged.as_ref().filter(|_| self.is_much_opened(blas)) else {
            return true;
        };
        self.has_as_many_parts(blas, &self.nodes[staged.nodes.start as usize])
    }

    /// Whether more instances of a bottom level are opened than are opened anew in one frame.
    pub(in crate::bvh) fn is_much_opened(&self, blas: u32) -> bool {
        // Of those that are handed over later files do not tell what they would be opened into.
        let most = if self.leaves_of_mesh(blas) > HANDED {
            0
        } else {
            AT_ONCE
        };
        self.blases[blas as usize].opened > most
    }

    /// Whether a tree with this root is opened into as many parts as the bottom level is.
    pub(in crate::bvh) fn has_as_many_parts(&self, blas: u32, root: &N) -> bool {
        parts_below::<N, W>(root) as usize == self.blases[blas as usize].parts.len()
    }

    /// The tree of a stage waits until instances are closed.
    pub(super) fn await_closing(&mut self, blas: u32) {
        if let Some(staged) = &mut self.blases[blas as usize].staged {
            staged.closes.get_or_insert(0);
        }
    }

    /// Whether instances of a bottom level stay closed, for a tree waits for that.
    pub(in crate::bvh) fn stays_closed(&self, blas: u32) -> bool {
        let staged = self.blases[blas as usize].staged.as_ref();
        staged.is_some_and(|staged| staged.closes.is_some() && staged.is_built(self.id.0))
    }

    /// Closes at most `most` instances that trees wait for; how many it has.
    #[cfg(feature = "std")]
    pub(crate) fn close_for_stages(&mut self, most: usize) -> usize {
        let mut closed = 0;
        for blas in self.staging.clone() {
            while closed < most && self.close_one_for(blas) {
                closed += 1;
            }
        }
        closed
    }

    /// Closes the next instance of a bottom level whose tree waits for that; false where there is none.
    #[cfg(feature = "std")]
    fn close_one_for(&mut self, blas: u32) -> bool {
        let own = &self.blases[blas as usize];
        let mesh = own.mesh as usize;
        let Some(at) = own.staged.as_ref().and_then(|staged| staged.closes) else {
            return false;
        };
        if !self.is_much_opened(blas) {
            return false;
        }
        let users = &self.meshes[mesh].users;
        let end = (at as usize + LOOKED_AT).min(users.len());
        let range = (at as usize).min(end)..end;
        let found = users[range.clone()]
            .iter()
            .position(|&user| !self.placed[user as usize].parts.is_empty());
        // The list begins anew at its end: others may have taken places before.
        let (next, index) = match found {
            Some(place) => (range.start + place, Some(users[range.start + place])),
            None if end == users.len() => (0, None),
            None => (end, None),
        };
        if let Some(staged) = &mut self.blases[blas as usize].staged {
            staged.closes = Some(next as u32);
        }
        let Some(index) = index else { return false };
        self.reopen_one(index, false);
        self.note_reopened(&[index]);
        true
    }
}

/// Instances of a mesh that one search looks at.
#[cfg(feature = "std")]
const LOOKED_AT: usize = 1024;

#[cfg(all(test, feature = "std"))]
mod tests;

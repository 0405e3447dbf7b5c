//! A mesh's new tree is handed over to its instances, a few in each frame: all at once cost 0.25 µs for each in the refit that
//! follows.
//!
//! Meanwhile the tree that was the mesh's is a bottom level of its own, with the triangles as they were copied from, and an
//! instance's words say which of the two it follows. Both are of the same lights: once any of them changes, the rest of the
//! instances follow at once, for the refit computes all of their leaves then. An instance that is moved, opened or closed
//! follows too.

use alloc::vec::Vec;

use super::Staged;
use crate::bvh::blas::{Blas, put};
use crate::bvh::opened::parts_below;
use crate::bvh::{Bvh, Trails};
use crate::node::Node;
use crate::refit::{self, BlasRoot};
use crate::summary::Summary;
use crate::tree::INVALID;

/// Leaves of the top level to which a tree is handed over in one frame: 0.1 ms with the refit.
pub(crate) const HANDED: usize = 256;
/// Instances that one frame looks at for that.
#[cfg(feature = "std")]
const LOOKED_AT: usize = 1024;
/// Parts of an opened instance hang apart from each other, and each takes as long as so many leaves that hang together.
#[cfg(feature = "std")]
const APART: usize = 4;
/// Leaves of a subtree that follow together.
#[cfg(feature = "std")]
const TOGETHER: u32 = 64;

/// The tree that was a mesh's before, while instances follow it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::bvh) struct Outgoing {
    pub blas: u32,
    /// How many instances follow it.
    pub left: u32,
    /// Where in the list of the mesh's instances the next one is looked for.
    pub next: u32,
}

impl<N: Node<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// Records of the top level that follow a bottom level's root.
    pub(crate) fn leaves_of_mesh(&self, blas: u32) -> usize {
        let own = &self.blases[blas as usize];
        self.meshes[own.mesh as usize].users.len() + (own.opened as usize) * own.parts.len()
    }

    /// The bottom level that took this one's place.
    #[cfg(feature = "std")]
    pub(crate) fn follower_of(&self, blas: u32) -> Option<u32> {
        let mesh = self.meshes.get(self.blases[blas as usize].mesh as usize);
        mesh.map(|mesh| mesh.blas)
    }

    /// Whether instances of its mesh are still to follow a bottom level.
    pub(crate) fn is_handed_over(&self, blas: u32) -> bool {
        self.blases
            .get(blas as usize)
            .is_some_and(|own| own.outgoing.is_some())
    }

    /// How many meshes have instances that are still to follow their trees.
    #[cfg(feature = "std")]
    pub(crate) fn handing_over(&self) -> usize {
        self.handing.len()
    }

    /// The tree of a stage becomes its mesh's, another bottom level. Where the next refit computes the leaves of all its
    /// instances anyway, or they are few, all follow; else those that [`hand_over_some`](Self::hand_over_some) takes.
    pub(super) fn put_in_place(&mut self, old: u32, staged: Staged) {
        let is_at_once = self.is_to_be_refitted(old) || self.leaves_of_mesh(old) <= HANDED;
        let new = staged.index;
        let own = &mut self.blases[old as usize];
        own.is_outgoing = true;
        own.adopted = staged.number;
        let mesh = own.mesh;
        let left = self.meshes[mesh as usize].users.len() as u32;
        let (root, created) = (staged.nodes.start, self.epoch);
        let blas = Blas {
            nodes: staged.nodes,
            triangles: staged.triangles,
            levels: staged.levels,
            depth: staged.depth,
            extent: own.extent,
            powers: own.powers,
            known_flux: own.known_flux,
            center: own.center,
            created,
            stirred: own.stirred,
            adopted: staged.number,
            unsettled: own.unsettled - staged.unsettled.min(own.unsettled),
            outgoing: Some(Outgoing {
                blas: old,
                left,
                next: 0,
            }),
            ..Blas::none::<N::Light>(mesh)
        };
        put(&mut self.blases, new, blas, &Blas::none::<N::Light>(INVALID));
        let nothing = BlasRoot::new(INVALID, &N::Summary::EMPTY);
        put(&mut self.roots, new, refit::root(&self.nodes, root), &nothing);
        self.meshes[mesh as usize].blas = new;
        // Another tree has the centre within rounding.
        self.note_centers(&[new]);
        self.changes.new.roots.insert(new);
        self.changes.forget_lists();
        let at = self.handing.partition_point(|&other| other < new);
        self.handing.insert(at, new);
        if is_at_once {
            self.hand_over_all(new);
        }
    }

    /// Whether triangles of a bottom level changed since the last refit. What a plan has still to tell is no matter: a mirror
    /// computes the old tree by it, and trees do not depend on plans.
    fn is_to_be_refitted(&self, blas: u32) -> bool {
        let mut lists = [&self.changes.new, &self.changes.unrefitted].into_iter();
        lists.any(|pending| {
            let has_parts = || !pending.parts.is_empty() && self.parts(pending).contains_key(&blas);
            pending.blases.contains(&blas) || has_parts()
        })
    }

    /// Has instances follow the new trees of their meshes, those of about `most` leaves. What lies together in the top level
    /// follows together: nodes above then are computed once for all of them.
    #[cfg(feature = "std")]
    pub(crate) fn hand_over_some(&mut self, mut most: usize) {
        let mut looked_at = 0;
        for blas in self.handing.clone() {
            while let Some(outgoing) = self.blases[blas as usize].outgoing {
                if most == 0 || looked_at >= LOOKED_AT {
                    return;
                }
                looked_at += 1;
                let (old, at) = (outgoing.blas, outgoing.next as usize);
                let users = &self.meshes[self.blases[blas as usize].mesh as usize].users;
                // The list begins anew at its end: others may have taken places before.
                let found = users.get(at).copied();
                let next = if found.is_some() { at as u32 + 1 } else { 0 };
                self.blases[blas as usize].outgoing = Some(Outgoing { next, ..outgoing });
                let Some(index) = found.filter(|&index| self.instances[index as usize].blas == old) else {
                    continue;
                };
                for other in self.around(index) {
                    looked_at += 1;
                    if self.instances[other as usize].blas == old && self.placed[other as usize].live {
                        let leaves = self.leaves_of(other).len();
                        let work = if leaves > 1 { APART * leaves } else { 1 };
                        self.hand_over(other);
                        most -= work.min(most);
                    }
                }
            }
        }
    }

    /// The leaves that hang together with an instance, some [`TOGETHER`] at most; itself where it is opened.
    #[cfg(feature = "std")]
    fn around(&self, index: u32) -> Vec<u32> {
        let mut node = self.placed[index as usize].node;
        if node == INVALID {
            return alloc::vec![index];
        }
        let count = |node: u32| self.top.counts[self.top.number(node) as usize];
        let above = |node: u32| self.parents[node as usize];
        while above(node) != INVALID && count(above(node)) <= TOGETHER {
            node = above(node);
        }
        self.below(node).1.into_iter().map(|(leaf, _)| leaf).collect()
    }

    /// Has all instances follow a bottom level that is their mesh's.
    pub(in crate::bvh) fn hand_over_all(&mut self, blas: u32) {
        let mut at = 0;
        while self.is_handed_over(blas) {
            let mesh = self.blases[blas as usize].mesh;
            let Some(&index) = self.meshes[mesh as usize].users.get(at) else {
                self.end_hand_over(blas);
                break;
            };
            self.hand_over(index);
            at += 1;
        }
    }

    /// Has an instance follow the tree of its mesh; whether it did not yet.
    pub(in crate::bvh) fn hand_over(&mut self, index: u32) -> bool {
        let blas = self.blas_index(&self.placed[index as usize]);
        let own = &self.blases[blas as usize];
        let Some(Outgoing { blas: old, left, .. }) = own.outgoing else {
            return false;
        };
        if self.instances[index as usize].blas != old {
            return false;
        }
        let root = own.nodes.start;
        let parts = self.placed[index as usize].parts.len() as u32;
        if parts > 0 && parts != parts_below::<N, W>(&self.nodes[root as usize]) {
            self.leaves_of(index).for_each(|leaf| self.remove_leaf(leaf));
            // Closed it follows.
            self.close(index);
            self.open(index);
            let leaves: Vec<u32> = self.leaves_of(index).collect();
            self.insert_instances(&leaves);
            return true;
        }
        self.put_on(index, blas);
        if parts > 0 {
            self.take_parts(blas, parts);
            self.write_parts(index);
            self.give_parts(old);
        }
        match &mut self.blases[blas as usize].outgoing {
            Some(outgoing) if left > 1 => outgoing.left = left - 1,
            _ => self.end_hand_over(blas),
        }
        true
    }

    /// Has an instance whose words are those of its mesh's tree follow the one before.
    pub(in crate::bvh) fn put_behind(&mut self, index: u32) {
        let blas = self.blas_index(&self.placed[index as usize]);
        let Some(Outgoing { blas: old, .. }) = self.blases[blas as usize].outgoing else {
            return;
        };
        self.put_on(index, old);
        self.write_parts(index);
    }

    /// Writes into the words of an instance that it follows that bottom level.
    fn put_on(&mut self, index: u32, blas: u32) {
        // A top level that is being built knows it as it was.
        self.epoch += 1;
        self.placed[index as usize].changed = self.epoch;
        let own = &self.blases[blas as usize];
        let record = &mut self.instances[index as usize];
        record.blas = blas;
        record.root = own.nodes.start;
        record.first_triangle = own.triangles.start;
        self.changes.new.mark_instance(index);
    }

    /// Nothing follows the tree any more that was a mesh's before `blas`.
    fn end_hand_over(&mut self, blas: u32) {
        let Some(Outgoing { blas: old, .. }) = self.blases[blas as usize].outgoing.take() else {
            return;
        };
        self.handing.retain(|&other| other != blas);
        // The rebuilder still asks which stage was adopted.
        let nothing = Blas {
            adopted: self.blases[old as usize].adopted,
            ..Blas::none::<N::Light>(self.blases[old as usize].mesh)
        };
        let own = core::mem::replace(&mut self.blases[old as usize], nothing);
        self.retired.push(own.levels);
        self.changes.forget_blas(old);
        self.node_ranges.give(own.nodes);
        self.triangle_ranges.give(own.triangles);
        self.blas_ranges.give(old..old + 1);
    }
}

#[cfg(all(test, feature = "std"))]
mod tests;

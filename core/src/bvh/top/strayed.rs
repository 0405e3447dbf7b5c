//! Meshes whose lights went elsewhere a few at a time, as by ranges of triangles: no single edit is far, and no node of the
//! mesh is worse.
//!
//! A refit compares the centre of each mesh that it computes with where that was as its instances were put where they are.
//! Those of one that left its own extent are noted, and the rebuilder puts a few in elsewhere as a frame begins: edits had to
//! pay for what they did not change.

#[cfg(feature = "std")]
mod looked;

#[cfg(feature = "std")]
pub(crate) use self::looked::Looked;
use super::misplaced::{STIRS, SWAYS, distance};
use crate::bvh::{Bvh, Trails};
use crate::node::Node;
use crate::summary::Summary;
use crate::tree::INVALID;

/// Instances of a mesh that are noted; of more each counts as some that are in subtrees built anew, and parts are tried.
const FEW: usize = 256;
/// Instances that are noted because they were moved far, at most: beside more of them parts are tried in any case, and looking
/// at them takes 64 frames.
const NOTED: usize = 1024;
/// Instances that are noted beside which those that come on are no longer.
const LIT: usize = 4 * NOTED;
/// Part of what its node is spread by beyond which an instance is noted, in squared distance from where it was put: what sways
/// is not.
const LEAVES: f64 = 0.5;
/// Flux, W, up to which an instance is off: a tree is built by flux, and puts it anywhere. What a map of scale 0 hides has
/// 2^-100 or so.
pub(super) const OFF: f32 = crate::exact::pow2(-80);
/// Where an instance is said to have been put that was off, metres along each axis: farther off than any light.
const NOWHERE: f32 = 1e18;

impl<N: Node<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// After a refit of these roots: notes the instances of meshes whose centre left what the mesh's own extent was where they
    /// were put. In time in proportion to their instances, and to nothing where there are none.
    pub(in crate::bvh) fn note_centers(&mut self, roots: &[u32]) {
        // The lights of a single level are in no top level.
        if self.single {
            return;
        }
        for &blas in roots {
            // Parts of opened instances have roots of their own, which go with the whole.
            let Some(own) = self.blases.get(blas as usize).filter(|own| !own.nodes.is_empty()) else {
                continue;
            };
            let root = self.root_of(blas);
            // Without flux it is nowhere.
            if root.phi() <= OFF {
                continue;
            }
            let (was, center) = (own.center, root.center().to_array());
            let is_known = !was[0].is_nan();
            let squared = distance(center.map(f64::from), was.map(f64::from));
            if is_known && squared * SWAYS <= f64::from(root.spread()) {
                continue;
            }
            let mesh = own.mesh as usize;
            self.blases[blas as usize].center = center;
            let few = self.meshes[mesh].users.len() <= FEW;
            for user in 0..self.meshes[mesh].users.len() {
                let index = self.meshes[mesh].users[user];
                // Known once more: where each was put is told by itself.
                if !is_known && self.placed[index as usize].hung_center[0].is_nan() {
                    continue;
                }
                if few {
                    self.note_strayed(index, was);
                } else {
                    for leaf in self.leaves_of(index) {
                        self.stir(self.placed[leaf as usize].node, STIRS);
                    }
                }
            }
        }
    }

    /// An instance was put where it is in the top level as it is now. One without flux was put anywhere: it is looked at once
    /// its mesh shines.
    pub(in crate::bvh) fn settle_placed(&mut self, index: u32) {
        let placed = &mut self.placed[index as usize];
        placed.settle();
        // A part is looked at with the whole.
        if placed.part_of != INVALID {
            return;
        }
        self.top.lit.remove(&index);
        if self.is_dark(index) {
            self.note_nowhere(index);
        }
    }

    /// The centre of a mesh is no longer what tells where its instances were put: each keeps that for itself, and is noted once
    /// the mesh shines.
    fn lose_center(&mut self, blas: u32) {
        let own = &mut self.blases[blas as usize];
        let was = core::mem::replace(&mut own.center, [f32::NAN; 3]);
        let mesh = own.mesh as usize;
        if was[0].is_nan() || self.meshes[mesh].users.len() > FEW {
            return;
        }
        for k in 0..self.meshes[mesh].users.len() {
            let user = self.meshes[mesh].users[k];
            let center = self.instances[user as usize].vertex(was);
            let placed = &mut self.placed[user as usize];
            if placed.hung_center[0].is_nan() {
                placed.hung_center = center;
            }
        }
    }

    /// Before an instance is moved: where it was, where its node does not tell, for it had no flux there.
    pub(in crate::bvh) fn note_dark(&mut self, index: u32) {
        let placed = &self.placed[index as usize];
        if !placed.parts.is_empty() || !placed.hung_center[0].is_nan() {
            return;
        }
        let tells = placed.node != INVALID
            && self.nodes[placed.node as usize]
                .summary(placed.slot as usize)
                .phi()
                > OFF;
        if tells && !self.is_off(index) {
            return;
        }
        let blas = self.meshes[placed.mesh as usize].blas;
        let center = self.blases[blas as usize].center;
        self.placed[index as usize].hung_center = self.instances[index as usize].vertex(center);
        // No light of it tells where it is once it shines: then all of its instances are looked at.
        if self.root_of(blas).phi() <= OFF {
            self.lose_center(blas);
        }
    }

    /// An instance that was moved while it was off shines again. Whether it is noted: an opened one, and one beside very many,
    /// is looked at by the edit.
    pub(in crate::bvh) fn note_lit(&mut self, index: u32) -> bool {
        let placed = &self.placed[index as usize];
        let is_alone = placed.parts.is_empty() && placed.node != INVALID;
        let is_noted = is_alone && (self.is_nowhere(index) || self.top.strayed.len() < LIT);
        if is_noted {
            self.note(index);
        }
        is_noted
    }

    /// An instance is to be looked at. What came on has a list of its own, for each of it is put in elsewhere and others would
    /// wait.
    pub(in crate::bvh) fn note(&mut self, index: u32) {
        if self.is_nowhere(index) {
            self.top.lit.insert(index);
        } else {
            self.top.strayed.insert(index);
        }
    }

    fn is_nowhere(&self, index: u32) -> bool {
        self.placed[index as usize].hung_center[0] == NOWHERE
    }

    /// Whether an instance, or a part of one, has so little flux that a tree is not built by it.
    pub(in crate::bvh) fn is_off(&self, leaf: u32) -> bool {
        let own = &self.instances[leaf as usize];
        self.root_of(own.blas).phi() * own.flux <= OFF
    }

    /// This leaf was put where it is while it was off: it hangs anywhere. It is looked at once it shines.
    pub(super) fn note_nowhere(&mut self, leaf: u32) {
        let owner = self.placed[leaf as usize].part_of;
        let index = if owner == INVALID { leaf } else { owner };
        let blas = self.meshes[self.placed[index as usize].mesh as usize].blas;
        if self.root_of(blas).phi() <= OFF {
            self.lose_center(blas);
        } else if owner != INVALID && self.is_off(leaf) {
            // Of an opened one all parts would be put in elsewhere, and none was seen to need it.
            return;
        }
        let has_come = !self.is_off(index);
        self.placed[index as usize].hung_center = [NOWHERE; 3];
        self.top.strayed.remove(&index);
        if has_come {
            self.note(index);
        }
    }

    /// Whether an instance is off for its mesh is.
    pub(super) fn is_dark(&self, index: u32) -> bool {
        let mesh = self.placed[index as usize].mesh;
        self.is_off(index) && self.root_of(self.meshes[mesh as usize].blas).phi() <= OFF
    }

    /// Whether an instance was moved far since it was put where it is.
    pub(in crate::bvh) fn has_moved(&self, index: u32) -> bool {
        let first = self.leaves_of(index).start;
        let placed = &self.placed[first as usize];
        placed.node != INVALID && !placed.hung_center[0].is_nan() && self.has_left(first)
    }

    /// An instance that was moved, and that lies no farther from what is beside it by a single step, is looked at as a frame
    /// begins: one that walks through a scene is never far from where it was a step before.
    pub(super) fn note_moved(&mut self, index: u32) {
        if self.placed[index as usize].node == INVALID {
            return;
        }
        // Dark ones are nowhere.
        let is_nowhere = self.is_nowhere(index);
        if !self.is_off(index) && (is_nowhere || self.top.strayed.len() < NOTED && self.has_left(index)) {
            self.note(index);
        }
    }

    /// Whether an instance is about as far from where it was put as its node is wide.
    fn has_left(&self, index: u32) -> bool {
        let placed = &self.placed[index as usize];
        let above = self.parents[placed.node as usize];
        if above == INVALID {
            return false;
        }
        let around = self.nodes[above as usize].summary(self.slot_above(placed.node));
        let squared = distance(self.center_now(index), placed.hung_center.map(f64::from));
        squared > LEAVES * f64::from(around.spread())
    }

    /// The centre of an instance, metres, without the rest of [`in_world`](Self::in_world).
    fn center_now(&self, index: u32) -> [f64; 3] {
        let instance = &self.instances[index as usize];
        let center = self.root_of(instance.blas).center().to_array();
        instance.vertex(center).map(f64::from)
    }

    /// An instance is to be looked at whose mesh had its centre at `was`, in its own space.
    fn note_strayed(&mut self, index: u32, was: [f32; 3]) {
        let center = self.instances[index as usize].vertex(was);
        let placed = &mut self.placed[index as usize];
        if placed.hung_center[0].is_nan() {
            placed.hung_center = center;
        }
        self.note(index);
    }
}

#[cfg(all(test, feature = "std"))]
mod tests;

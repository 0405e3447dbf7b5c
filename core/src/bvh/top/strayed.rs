//! Meshes whose lights went elsewhere a few at a time, as by ranges of triangles: no single edit is far, and no node of the
//! mesh is worse.
//!
//! A refit compares the centre of each mesh that it computes with where that was as its instances were put where they are.
//! Those of one that left its own extent are noted, and the rebuilder puts a few in elsewhere as a frame begins: edits had to
//! pay for what they did not change.

#[cfg(feature = "std")]
use alloc::collections::BTreeSet;
#[cfg(feature = "std")]
use alloc::vec::Vec;

use super::misplaced::{STIRS, SWAYS, distance};
use crate::bvh::{Bvh, Trails};
use crate::node::Node;
#[cfg(feature = "std")]
use crate::node::kind;
use crate::summary::Summary;
use crate::tree::INVALID;

/// Instances of a mesh that are noted; of more each counts as some that are in subtrees built anew, and parts are tried.
const FEW: usize = 256;
/// A mesh is dim that was brighter by more than this factor, where it blinks.
#[cfg(feature = "std")]
const DIM: f64 = 2.0;
/// Noted instances that one frame looks at.
#[cfg(feature = "std")]
const LOOKED_AT: usize = 16;

/// Instances that are noted because they were moved far, at most: beside more of them parts are tried in any case, and looking
/// at them takes 64 frames.
const NOTED: usize = 1024;
/// Instances that are noted beside which those that come on are no longer.
const LIT: usize = 4 * NOTED;
/// Part of what its node is spread by beyond which an instance is noted, in squared distance from where it was put: what sways
/// is not.
const LEAVES: f64 = 0.5;
/// What lies elsewhere is farther from the others than it was, in squared distance, by this while it moves: of those that move
/// together some are ahead of the rest for a while. Once it rests, 1.
#[cfg(feature = "std")]
const FARTHER: f64 = 2.0;
/// Where fewer are noted each that rests is put in anew beside which others stayed: those may be others than they were. Where
/// more are, until none is, parts are built anew.
#[cfg(feature = "std")]
const ALONE: usize = 256;

/// What is asked of an instance that went far, besides.
#[cfg(feature = "std")]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Guard {
    /// It changed since the last frame: it is far from the others.
    Moves,
    /// It did not: it is farther from the others than it was.
    Rests,
    /// Few are noted besides: or the others did not move.
    RestsAlone,
}

/// Flux, W, up to which an instance is off: a tree is built by flux, and puts it anywhere. What a map of scale 0 hides has
/// 2^-100 or so.
pub(super) const OFF: f32 = crate::exact::pow2(-80);
/// Where an instance is said to have been put that was off, metres along each axis: farther off than any light.
const NOWHERE: f32 = 1e18;

/// Where a rebuilder goes on.
#[cfg(feature = "std")]
#[derive(Debug, Default)]
pub(crate) struct Looked {
    /// From these indices on, of what strayed and of what came on.
    next: [u32; 2],
    /// The epoch when the last frame began.
    epoch: Option<u64>,
    /// Whether many were noted since none was: parts are built anew then.
    is_crowd: bool,
}

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

    /// What is beside an instance in its node, but for those that are nowhere themselves: they go elsewhere too.
    #[cfg(feature = "std")]
    fn beside(&self, index: u32) -> impl Iterator<Item = N::Summary> + '_ {
        let placed = &self.placed[index as usize];
        let node = &self.nodes[placed.node as usize];
        let is_there = |slot: usize| {
            node.kind(slot) != kind::MESH || self.placed[node.link(slot) as usize].hung_center[0] != NOWHERE
        };
        (0..W)
            .filter(move |&slot| {
                slot != placed.slot as usize && node.kind(slot) != kind::EMPTY && is_there(slot)
            })
            .map(move |slot| {
                let known = node.summary(slot);
                let is_dark = known.phi() <= 0.0;
                let leaf = is_dark.then(|| self.some_leaf(node.kind(slot), node.link(slot)));
                leaf.flatten().map_or(known, |leaf| self.in_world(leaf))
            })
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

    /// Puts noted instances in elsewhere, about `most` leaves of them: those that went farther than what lies beside them is
    /// spread, and then at least one of what came on.
    #[cfg(feature = "std")]
    pub(crate) fn put_strayed_elsewhere(&mut self, most: usize, looked: &mut Looked) {
        let mut out = self.take_strayed(most, looked);
        self.take_lit(most.saturating_sub(out.len()).max(1), looked, &mut out);
        looked.epoch = Some(self.epoch);
        if out.is_empty() {
            return;
        }
        self.epoch += 1;
        for &leaf in &out {
            self.remove_leaf(leaf);
        }
        out.sort_unstable();
        self.insert_instances(&out);
        self.settle_some(crate::bvh::rebuild::ADOPTED);
    }

    /// Leaves of what went far, about `most`.
    #[cfg(feature = "std")]
    fn take_strayed(&mut self, most: usize, looked: &mut Looked) -> Vec<u32> {
        let mut out = Vec::new();
        let mut later = Vec::new();
        let noted = self.top.strayed.len();
        looked.is_crowd = noted >= ALONE || looked.is_crowd && noted > 0;
        for _ in 0..LOOKED_AT {
            if out.len() >= most {
                break;
            }
            let Some(index) = take_next(&mut self.top.strayed, &mut looked.next[0]) else {
                break;
            };
            let blas = self.blas_index(&self.placed[index as usize]);
            let rests = self.rests(index, looked);
            // One that blinks is where it is bright, unless it rests where it is dim.
            if self.was_brighter(blas) > DIM && !rests {
                later.push(index);
                continue;
            }
            if self.root_of(blas).phi() <= 0.0 {
                self.lose_center(blas);
                continue;
            }
            let guard = match (rests, !looked.is_crowd) {
                (false, _) => Guard::Moves,
                (true, false) => Guard::Rests,
                (true, true) => Guard::RestsAlone,
            };
            if self.lies_elsewhere(index, guard) {
                self.take_leaves(index, &mut out);
            } else if !rests {
                later.push(index);
            }
        }
        self.top.strayed.extend(later);
        out
    }

    /// Adds leaves of what came on to `out`, about `most`.
    #[cfg(feature = "std")]
    fn take_lit(&mut self, most: usize, looked: &mut Looked, out: &mut Vec<u32>) {
        let mut later = Vec::new();
        let enough = out.len() + most;
        for _ in 0..LOOKED_AT {
            if out.len() >= enough {
                break;
            }
            let Some(index) = take_next(&mut self.top.lit, &mut looked.next[1]) else {
                break;
            };
            let blas = self.blas_index(&self.placed[index as usize]);
            if self.was_brighter(blas) > DIM && !self.rests(index, looked) {
                later.push(index);
            } else if self.is_dark(index) {
                self.lose_center(blas);
            } else if self.is_nowhere(index) && !self.is_off(index) {
                self.take_leaves(index, out);
            }
        }
        self.top.lit.extend(later);
    }

    /// Adds the leaves of an instance that are in the tree to `out`: it is to be put in anew.
    #[cfg(feature = "std")]
    fn take_leaves(&mut self, index: u32, out: &mut Vec<u32>) {
        let leaves = self.leaves_of(index);
        out.extend(leaves.filter(|&leaf| self.placed[leaf as usize].node != INVALID));
        // Where it is opened that is not said of its parts alone.
        self.settle_placed(index);
    }

    /// Whether an instance and its mesh are as they were when the last frame began.
    #[cfg(feature = "std")]
    fn rests(&self, index: u32, looked: &Looked) -> bool {
        let placed = &self.placed[index as usize];
        let changed = self.blases[self.blas_index(placed) as usize]
            .changed
            .max(placed.changed);
        looked.epoch.is_some_and(|since| changed <= since)
    }

    /// Whether an instance is farther from where it was put than its node was wide then, the others in it, and it where it was;
    /// and as `guard` says, so that those that move together stay together. An opened one, of which each part has a node, where
    /// it is out of its own extent.
    #[cfg(feature = "std")]
    fn lies_elsewhere(&self, index: u32, guard: Guard) -> bool {
        let placed = &self.placed[index as usize];
        let own = self.in_world(index);
        let (was, is) = (
            placed.hung_center.map(f64::from),
            own.center().to_array().map(f64::from),
        );
        if !placed.parts.is_empty() {
            return distance(is, was) * SWAYS > f64::from(own.spread());
        }
        if placed.node == INVALID
            || self.parents[placed.node as usize] == INVALID
            || placed.hung_center[0].is_nan()
        {
            return false;
        }
        if placed.hung_center[0] == NOWHERE {
            return true;
        }
        // Flux, flux times centre, and flux times squared distance from where it was; the instance itself is at zero.
        let mut phi = f64::from(own.phi());
        let (mut first, mut second) = ([0.0; 3], phi * f64::from(own.spread()));
        for other in self.beside(index) {
            let flux = f64::from(other.phi());
            let center = other.center().to_array().map(f64::from);
            phi += flux;
            (0..3).for_each(|k| first[k] += flux * (center[k] - was[k]));
            second += flux * (f64::from(other.spread()) + distance(center, was));
        }
        // Of all about their mean.
        let spread = second / phi - distance(first.map(|x| x / phi), [0.0; 3]);
        let others = phi - f64::from(own.phi());
        let middle = first.map(|x| if others > 0.0 { x / others } else { 0.0 });
        let moved = [0, 1, 2].map(|k| is[k] - was[k]);
        let is_farther = |by: f64| distance(moved, middle) > by * distance([0.0; 3], middle);
        distance(is, was) > spread
            && match guard {
                Guard::Moves => is_farther(FARTHER),
                Guard::Rests => is_farther(1.0),
                Guard::RestsAlone => is_farther(1.0) || !self.moves_with_others(index, distance(is, was)),
            }
    }

    /// Whether three in four of those beside an instance, and of those beside its node, went about as far since they were put
    /// where they are: then parts are built anew where that is due. A few that travel together among others are a node in the
    /// wrong place.
    #[cfg(feature = "std")]
    fn moves_with_others(&self, index: u32, squared: f64) -> bool {
        let placed = &self.placed[index as usize];
        let above = self.parents[placed.node as usize];
        self.move_too(placed.node, placed.slot as usize, squared)
            && self.move_too(above, self.slot_above(placed.node), squared)
    }

    /// Whether three in four of the children of a node but for one, of each an instance, went at least a quarter as far; in
    /// squared distance.
    #[cfg(feature = "std")]
    fn move_too(&self, node: u32, but: usize, squared: f64) -> bool {
        let own = &self.nodes[node as usize];
        let (mut count, mut moved) = (0, 0);
        for slot in (0..W).filter(|&slot| slot != but) {
            let Some(leaf) = self.some_leaf(own.kind(slot), own.link(slot)) else {
                continue;
            };
            let was = self.placed[leaf as usize].hung_center.map(f64::from);
            count += 1;
            // Of one that never moved that is no number.
            moved += u32::from(16.0 * distance(self.center_now(leaf), was) >= squared);
        }
        4 * moved >= 3 * count
    }
}

/// The first of `list` from `next` on, after which the next call goes on: those that are noted in every frame keep nobody waiting.
#[cfg(feature = "std")]
fn take_next(list: &mut BTreeSet<u32>, next: &mut u32) -> Option<u32> {
    let index = *list.range(*next..).next().or(list.first())?;
    list.remove(&index);
    *next = index + 1;
    Some(index)
}

#[cfg(all(test, feature = "std"))]
mod tests;

//! Instances that have moved away from those around them, or are much brighter or dimmer than when they were put there.

use alloc::vec::Vec;

use super::cost::Cluster;
use super::strayed::OFF;
use crate::bvh::{Bvh, Trails};
use crate::exact::hash;
use crate::light::Light;
use crate::moments::LightMoments;
use crate::node::{Holds, Node, kind};
use crate::refit;
use crate::summary::Summary;
use crate::sweep;
use crate::tree::INVALID;

/// An instance is put in elsewhere once it adds this part to what its node costs.
const ADDED: f64 = 0.5;
/// That node's share in what the node above costs as a whole must be this; in a tree as built it is about 1/32.
const SHARE: f64 = 1.0 / 16.0;
/// And once its radiance has changed by this factor since it was put where it is; for being dimmer, once at all.
const FACTOR: f32 = 2.0;
/// Most instances that one call puts in elsewhere, and one more for so many instances. Where more are misplaced the rest waits
/// for a rebuild: an animation of all instances costs what it always did.
const MOST: usize = 64;
/// Each of the rest counts as so many that are in subtrees built anew: where one in 32 of a part is misplaced there may be
/// something to gain, even where no node has lost any of its order, as where lamps come on that were off when it was built.
pub(super) const STIRS: u32 = 4;

/// Of so many instances that are moved one is compared with what lies beside its nodes at all levels.
const FAR_IN: u32 = 4;
/// It has strayed where a node beside is nearer by this factor of squared distance, and it has come so far itself.
const NEARER: f64 = 4.0;

/// Triangles of a mesh that are looked at where all of them are set: of a larger one, one of each two, three or so.
const JUMPS: usize = 1024;
/// Part of a mesh's own variance by which its centre may move for it to stay: half of its deviation.
pub(super) const SWAYS: f64 = 4.0;

/// The centre by flux of lights, or of [`JUMPS`] of them, in the space of their mesh; `None` where none has flux.
fn center_of<N>(lights: &[N::Light]) -> Option<[f32; 3]>
where
    N: Holds,
{
    // One of each run, at any place in it: lights in a pattern are dark every second one.
    let run = lights.len().div_ceil(JUMPS).max(1);
    let place = |k: usize, own: &[N::Light]| hash(k as u32) as usize % own.len();
    let some = lights.chunks(run).enumerate().map(|(k, own)| &own[place(k, own)]);
    // Where none of them has flux few have, and all are looked at.
    center_by_flux(some).or_else(|| center_by_flux(lights.iter()))
}

fn center_by_flux<'a, L: Light + 'a>(lights: impl Iterator<Item = &'a L>) -> Option<[f32; 3]> {
    let (mut phi, mut sum) = (0.0, [0.0; 3]);
    for light in lights {
        let own = LightMoments::of_light(light);
        let flux = f64::from(own.phi());
        phi += flux;
        let c = own.center().to_array();
        for k in 0..3 {
            sum[k] += flux * f64::from(c[k]);
        }
    }
    (phi > 0.0).then(|| sum.map(|x| (x / phi) as f32))
}

/// Squared distance, m².
pub(super) fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| (a[k] - b[k]) * (a[k] - b[k])).sum()
}

impl<N: Node<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// Takes those of `moved` instances, which may repeat, out of the top level that make their nodes wide, and adds them to
    /// `out`. Those of them that `jumped`, in order, are looked at more closely.
    pub(in crate::bvh) fn take_misplaced(&mut self, mut moved: Vec<u32>, jumped: &[u32], out: &mut Vec<u32>) {
        moved.sort_unstable();
        moved.dedup();
        let mut misplaced: Vec<(f64, u32)> = Vec::new();
        for index in moved {
            for leaf in self.leaves_of(index) {
                self.note_center(leaf);
                let mut excess = self.excess(leaf);
                let has_its_turn = self.has_its_turn(leaf) || jumped.binary_search(&index).is_ok();
                if excess == 0.0 && has_its_turn {
                    excess = self.strayed(leaf);
                }
                if excess > 0.0 {
                    misplaced.push((excess, leaf));
                    continue;
                }
                // What goes off costs nothing anywhere, and is where it is bright.
                self.note_flicker(leaf);
                if leaf == self.leaves_of(index).start {
                    if self.placed[index as usize].parts.is_empty() {
                        self.note_moved(index);
                    }
                    // An opened instance's first part stands for all: they move together.
                    for other in self.leaves_of(index) {
                        self.note_flicker(other);
                    }
                    break;
                }
            }
        }
        let most = MOST + self.live.len() / MOST;
        if misplaced.len() > most {
            misplaced.select_nth_unstable_by(most, |a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
            for (_, index) in misplaced.split_off(most) {
                self.note_flicker(index);
                self.stir(self.placed[index as usize].node, STIRS);
                if self.placed[index as usize].part_of == INVALID {
                    self.note_moved(index);
                }
            }
            misplaced.sort_unstable_by_key(|&(_, index)| index);
        }
        for (_, index) in misplaced {
            self.note_flicker(index);
            self.remove_leaf(index);
            out.push(index);
        }
    }

    /// For being dimmer an instance is misplaced once.
    fn note_flicker(&mut self, index: u32) {
        let placed = &mut self.placed[index as usize];
        placed.flickers |= placed.hung_radiance > FACTOR * placed.radiance;
    }

    /// Of bottom levels whose triangles were all set, which may repeat: the instances that lie far from where they were, in
    /// order. What is known of their meshes is brought up to date, as the next refit would. Others are looked at no closer: a
    /// mesh that sways costs a sum over some of its triangles.
    pub(in crate::bvh) fn take_jumped(&mut self, mut reshaped: Vec<u32>) -> Vec<u32> {
        let mut jumped = Vec::new();
        // The lights of a single level are in no top level.
        if self.single {
            return jumped;
        }
        reshaped.sort_unstable();
        reshaped.dedup();
        for blas in reshaped {
            let range = self.blases[blas as usize].triangles.clone();
            let mesh = center_of::<N>(&self.triangles[range.start as usize..range.end as usize]);
            let Some(center) = mesh else { continue };
            // One that sways within its own extent is where it was, wherever its instances are. What is dark has no extent, and
            // no centre.
            let was = self.root_of(blas);
            let squared = distance(center.map(f64::from), was.center().to_array().map(f64::from));
            if was.phi() > OFF && squared * SWAYS <= f64::from(was.spread()) {
                continue;
            }
            let before = jumped.len();
            let lit = self.blases[blas as usize].center;
            for k in 0..self.meshes[self.blases[blas as usize].mesh as usize].users.len() {
                let user = self.meshes[self.blases[blas as usize].mesh as usize].users[k];
                // An opened one is looked at after the refit.
                if !self.placed[user as usize].parts.is_empty() {
                    continue;
                }
                let own = &self.instances[user as usize];
                let (center, lit) = (own.vertex(center), own.vertex(lit));
                if self.has_jumped(user, center, lit) {
                    jumped.push(user);
                }
            }
            if jumped.len() > before {
                // The next refit notes those that stay: each step may have been short for them.
                self.sweep_now(blas);
            }
        }
        jumped.sort_unstable();
        jumped
    }

    /// Where meshes of instances that are added were set as a whole since the last refit, what is known of them is brought up
    /// to date: once each time, in no more than a part of the time that setting them took.
    pub(in crate::bvh) fn freshen(&mut self, added: &[u32]) {
        for &index in added {
            let blas = self.blas_index(&self.placed[index as usize]);
            if self.blases[blas as usize].is_stale {
                self.sweep_now(blas);
            }
        }
    }

    /// Computes a bottom level and its root before the next refit does.
    fn sweep_now(&mut self, blas: u32) {
        let nodes = self.blases[blas as usize].nodes.clone();
        let (first, range) = (nodes.start, nodes.start as usize..nodes.end as usize);
        sweep::bottom_sweep(&mut self.nodes[range], first, &self.triangles, &[first]);
        self.roots[blas as usize] = refit::root(&self.nodes, first);
        self.blases[blas as usize].is_stale = false;
    }

    /// Whether an instance whose centre is `center` now, metres, lies farther from where the last refit saw it than the
    /// deviation of what its node holds; of one that was dark, from where it is noted that it was put, else from where its mesh
    /// had `lit` it. Where neither is known it is where it was: it was dark when it was put there as well, and is looked at as
    /// frames begin.
    fn has_jumped(&mut self, index: u32, center: [f32; 3], lit: [f32; 3]) -> bool {
        let placed = &self.placed[index as usize];
        if placed.node == INVALID || self.parents[placed.node as usize] == INVALID {
            return false;
        }
        let words = &self.nodes[placed.node as usize];
        let known = words.summary(placed.slot as usize);
        let is_dark = known.phi() <= OFF;
        let was = match (is_dark, placed.hung_center[0].is_nan()) {
            (false, _) => known.center().to_array(),
            (true, false) => placed.hung_center,
            (true, true) => lit,
        };
        let squared = distance(center.map(f64::from), was.map(f64::from));
        // Most that blink have not moved at all.
        let has_jumped = squared > 0.0 && squared > f64::from(words.merged().spread());
        if is_dark && has_jumped {
            self.placed[index as usize].hung_center = was;
        }
        has_jumped
    }

    /// What an instance that is misplaced costs more where it is; 0 of one that is not. Looks at a slot of each of the two
    /// nodes above, as they were at the last refit.
    fn excess(&self, index: u32) -> f64 {
        let placed = &self.placed[index as usize];
        if placed.node == INVALID {
            return 0.0;
        }
        let above = self.parents[placed.node as usize];
        if above == INVALID {
            return 0.0;
        }
        let around = Cluster::new(
            &self.nodes[above as usize].summary(self.slot_above(placed.node)),
            0,
        );
        let whole = match self.parents[above as usize] {
            INVALID => Cluster::new(&self.nodes[above as usize].merged(), 0),
            top => Cluster::new(&self.nodes[top as usize].summary(self.slot_above(above)), 0),
        };
        let own = Cluster::new(&self.in_world(index), 1);
        let added = own.merging(&around);
        if self.is_otherwise_bright(index) {
            return added;
        }
        // What lies far from the others in a tree as it was built stays there.
        let moved = own.merging(&Cluster {
            center: placed.hung_center.map(f64::from),
            ..around
        });
        let least = ADDED * around.cost();
        let share = around.cost() + added;
        if added > least && moved > least && share > SHARE * whole.cost() {
            added
        } else {
            0.0
        }
    }

    /// Whether an instance that was moved is looked at closely: now and then, by where it is, so that nothing is to be kept of it.
    fn has_its_turn(&self, index: u32) -> bool {
        let [x, _, z] = self.placed[index as usize].transform.translation;
        hash(hash(index ^ x.to_bits()) ^ z.to_bits()) % FAR_IN == 0
    }

    /// What an instance costs more in the node above parts that it is in than in one beside that; 0 where none is much nearer,
    /// or it was there when it was put where it is. Parts that are built anew keep it among those around it, wherever it goes:
    /// so it is all levels that are looked at, and not the two above it.
    fn strayed(&self, index: u32) -> f64 {
        let placed = &self.placed[index as usize];
        if placed.node == INVALID || placed.hung_center[0].is_nan() {
            return 0.0;
        }
        let own = Cluster::new(&self.in_world(index), 1);
        let was = placed.hung_center.map(f64::from);
        let mut node = placed.node;
        let mut excess = 0.0;
        while self.parents[node as usize] != INVALID {
            let above = self.parents[node as usize];
            let words = &self.nodes[above as usize];
            let slot = self.slot_above(node);
            let of = |slot: usize| words.summary(slot).center().to_array().map(f64::from);
            let here = distance(own.center, of(slot));
            if distance(own.center, was) * NEARER > here {
                for other in (0..W).filter(|&other| other != slot && words.kind(other) == kind::INNER) {
                    let there = distance(own.center, of(other));
                    if there * NEARER < here {
                        excess += own.phi * (here - there);
                        break;
                    }
                }
            }
            node = above;
        }
        excess
    }

    /// Whether an instance's radiance is another than when it was put where it is, by a factor that matters. One that was
    /// dimmer before, as a lamp that flickers is in every other frame, costs nothing among brighter ones: it stays until it is
    /// brighter.
    fn is_otherwise_bright(&self, index: u32) -> bool {
        let placed = &self.placed[index as usize];
        let (was, is) = (placed.hung_radiance, placed.radiance);
        is > FACTOR * was || (was > FACTOR * is && !placed.flickers)
    }

    /// Whether that is so of an instance, or of a part of an opened one; and whether one is brighter at all.
    pub(in crate::bvh) fn shines_otherwise(&self, index: u32) -> (bool, bool) {
        let (mut is_otherwise, mut is_brighter) = (false, false);
        for leaf in self.leaves_of(index) {
            let placed = &self.placed[leaf as usize];
            is_otherwise |= self.is_otherwise_bright(leaf);
            is_brighter |= placed.radiance > placed.hung_radiance;
        }
        (is_otherwise, is_brighter)
    }

    /// Notes where an instance was before it moved for the first time since it was put where it is, as the last refit saw it.
    fn note_center(&mut self, index: u32) {
        let placed = &self.placed[index as usize];
        if placed.node != INVALID && placed.hung_center[0].is_nan() {
            let center = self.nodes[placed.node as usize]
                .summary(placed.slot as usize)
                .center();
            self.placed[index as usize].hung_center = center.to_array();
        }
    }
}

#[cfg(test)]
mod tests;

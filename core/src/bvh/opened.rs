//! Large meshes opened: the top level holds the subtrees below the root of a bottom level in place of the whole (partial
//! re-braiding, Benthin et al. 2017).
//!
//! A part of an opened instance is a leaf of the top level with a record of its own, which follows that of the instance: the
//! same map, the same lights, another root. Parts of one mesh share what is known of their subtrees, which stands among the
//! roots of bottom levels. Nothing else knows of parts: lights are listed, numbered and named by the instance that they belong
//! to.
//!
//! What an instance costs the top level is what its lights cost by Ward's criterion, flux times variance of position. It is opened
//! where that is more than a part [`OPENS`] of what all lights together cost, and closed again below a part [`CLOSES`].

mod parts;

use alloc::vec::Vec;

pub(super) use self::parts::parts_below;
use super::{Bvh, Trails};
use crate::instance::Instance;
use crate::node::Node;
use crate::refit::BlasRoot;
use crate::summary::Summary;
use crate::tree::INVALID;

/// An instance that costs more than this part of the whole is opened. There are at most as many as its inverse.
pub(super) const OPENS: f64 = 1.0 / 8192.0;
/// An opened instance that costs less than this part of the whole is closed: less than [`OPENS`], so that what moves does not
/// open and close from frame to frame.
pub(super) const CLOSES: f64 = OPENS / 4.0;

/// Most instances that are opened or closed as a rebuilt top level is put in place.
const MOST: usize = 64;

/// What sets of lights cost together: flux, its first and second moments.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Together {
    phi: f64,
    first: [f64; 3],
    second: f64,
    /// Where positions count from, so that little is lost to rounding.
    origin: Option<[f64; 3]>,
}

impl Together {
    pub fn add<S: Summary>(&mut self, summary: &S) {
        let c = summary.center();
        let c = [c.x, c.y, c.z].map(f64::from);
        let phi = f64::from(summary.phi());
        let origin = *self.origin.get_or_insert(c);
        let mut squared = f64::from(summary.spread());
        for k in 0..3 {
            let x = c[k] - origin[k];
            self.first[k] += phi * x;
            squared += x * x;
        }
        self.phi += phi;
        self.second += phi * squared;
    }

    /// Flux times variance of position, W m².
    pub fn cost(&self) -> f64 {
        if self.phi > 0.0 {
            let of_mean: f64 = self.first.iter().map(|x| x * x / self.phi).sum();
            (self.second - of_mean).max(0.0)
        } else {
            0.0
        }
    }
}

/// What a set of lights costs by itself, W m².
pub(super) fn cost<S: Summary>(summary: &S) -> f64 {
    f64::from(summary.phi()) * f64::from(summary.spread())
}

/// What sets of lights cost together.
pub(super) fn cost_of<S: Summary>(sets: &[S]) -> f64 {
    let mut whole = Together::default();
    sets.iter().for_each(|set| whole.add(set));
    whole.cost()
}

/// Whether an instance that costs `own` of `whole` is to be open, given whether it is.
pub(super) fn is_to_open(own: f64, whole: f64, is_open: bool) -> bool {
    own > whole * if is_open { CLOSES } else { OPENS }
}

/// An instance that is opened or could be.
#[derive(Clone, Copy, Debug)]
pub(super) struct Openable {
    pub index: u32,
    instance: Instance,
    root: BlasRoot,
    /// By how much its mesh was brighter, where it blinks.
    was_brighter: f64,
}

/// Of the `openable` instances those that are to be opened, and those that are to be closed,
/// the costliest first; at most [`MOST`] of both, so that no frame has much to do for them. All lights together cost `whole`.
pub(super) fn wanted<N: Node<W>, const W: usize>(whole: f64, openable: &[Openable]) -> [Vec<u32>; 2] {
    let mut changes: Vec<(f64, u32, bool)> = Vec::new();
    for own in openable {
        let (index, instance) = (&own.index, &own.instance);
        let as_is = cost(&own.root.summary::<N::Summary>().to_world::<N::Light>(instance));
        let own = as_is * own.was_brighter;
        let is_open = instance.part != INVALID;
        let wanted = is_to_open(own, whole, is_open);
        if wanted != is_open {
            changes.push((own, *index, wanted));
        }
    }
    changes.sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    changes.truncate(MOST);
    [true, false].map(|wanted| {
        let those = changes.iter().filter(|change| change.2 == wanted);
        those.map(|change| change.1).collect()
    })
}

impl<N: Node<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// Those of some instances that are opened or could be.
    pub(super) fn openable(&self, some: impl Iterator<Item = u32>) -> Vec<Openable> {
        if !self.params.opens {
            return Vec::new();
        }
        let found =
            some.filter(|&index| !self.placed[index as usize].parts.is_empty() || self.can_open(index));
        found
            .map(|index| {
                let instance = self.instances[index as usize];
                Openable {
                    index,
                    instance,
                    root: self.roots[instance.blas as usize],
                    was_brighter: self.was_brighter(instance.blas),
                }
            })
            .collect()
    }

    /// Whether instances are ever opened. One alone needs no top level.
    fn opens(&self) -> bool {
        self.params.opens && self.live.len() > 1
    }

    /// What an instance costs as a whole.
    fn own_cost(&self, index: u32) -> f64 {
        cost(&self.in_world(index)) * self.was_brighter(self.instances[index as usize].blas)
    }

    /// Opens and closes instances that hang nowhere in the top level, by what they cost of `whole`.
    pub(super) fn decide(&mut self, instances: &[u32], whole: f64) {
        for &index in instances {
            let is_open = !self.placed[index as usize].parts.is_empty();
            let wanted = self.opens() && is_to_open(self.own_cost(index), whole, is_open);
            match (is_open, wanted) {
                (false, true) => _ = self.open(index),
                (true, false) => self.close(index),
                _ => {}
            }
        }
    }

    /// Opens those of `added` instances, which hang nowhere yet, that cost much of what there is with them.
    pub(super) fn decide_added(&mut self, added: &[u32]) {
        if !self.opens() {
            return;
        }
        let mut whole = Together::default();
        whole.add(&self.nodes[self.top.root as usize].merged());
        for &index in added {
            whole.add(&self.in_world(index));
        }
        self.decide(added, whole.cost());
    }

    /// What all instances in use cost together.
    pub(super) fn cost_of_all(&self) -> f64 {
        let mut whole = Together::default();
        for &index in &self.live {
            whole.add(&self.in_world(index));
        }
        whole.cost()
    }

    /// Opens those of `open` and closes those of `close`, in the top level too, each in time in proportion to its depth. Those that
    /// are no more, or are so already, stay as they are.
    pub(super) fn reopen(&mut self, open: &[u32], close: &[u32]) {
        let changed = self.reopen_some(open, close, false);
        self.note_reopened(&changed);
    }

    /// The tree was built over what these instances were before they were opened or closed. Among few others it has been
    /// decided anew.
    pub(crate) fn note_reopened(&mut self, instances: &[u32]) {
        // A refit that computes nothing leaves the epoch as it is.
        self.epoch += u64::from(!instances.is_empty());
        for &index in instances {
            if !self.placed.get(index as usize).is_some_and(|placed| placed.live) {
                continue;
            }
            for leaf in self.leaves_of(index) {
                let flux = f64::from(self.in_world(leaf).phi());
                self.unsettle_above(self.placed[leaf as usize].node, flux);
            }
        }
    }

    /// Opens and closes, and returns those that were not so yet, which are still to be noted. Where it is done `beside` the
    /// frames, nodes above are computed once for all parts.
    pub(super) fn reopen_some(&mut self, open: &[u32], close: &[u32], beside: bool) -> Vec<u32> {
        let mut changed = Vec::new();
        for (list, wanted) in [(open, true), (close, false)] {
            for &index in list {
                let Some(placed) = self.placed.get(index as usize).filter(|placed| placed.live) else {
                    continue;
                };
                if placed.parts.is_empty() != wanted || (wanted && !self.can_open(index)) {
                    continue;
                }
                self.leaves_of(index).for_each(|leaf| self.remove_leaf(leaf));
                if wanted {
                    self.open(index);
                } else {
                    self.close(index);
                }
                let leaves: Vec<u32> = self.leaves_of(index).collect();
                if beside {
                    self.insert_come(&leaves, Vec::new());
                } else {
                    self.insert_instances(&leaves);
                }
                changed.push(index);
            }
        }
        changed
    }

    fn can_open(&self, index: u32) -> bool {
        let blas = self.blas_index(&self.placed[index as usize]);
        self.opens()
            && !self.stays_closed(blas)
            && parts_below::<N, W>(&self.nodes[self.roots[blas as usize].node as usize]) > 0
    }
}

#[cfg(test)]
mod tests;

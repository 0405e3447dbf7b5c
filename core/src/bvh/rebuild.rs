//! Rebuilds beside the frame (paper section 3.5): what to build is taken out of the scene, built anywhere, and swapped in.

use alloc::vec::Vec;
use core::fmt;
use core::marker::PhantomData;
use core::ops::Range;

use super::blas::Blas;
use super::edit::MeshId;
use super::top::{Quota, TopCopy, TopTree};
use super::{Bvh, Trails};
use crate::build::{BuildParams, Topology, build_over};
use crate::node::{Holds, Node};

/// When trees are built anew: by default once they are 1.1 times worse than when they were built, either level. Any number is
/// sound: NaN means never, and what is below 1 is taken as 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RebuildParams {
    /// The top level is once it is worse than when it was built by this factor, as below: 1 for whenever something has changed,
    /// infinite for never. A [`Rebuilder`](crate::Rebuilder) asks a top level of up to 1024 instances in proportion: of 102 it
    /// takes a tenth of what the factor is above 1, for a tree over them takes a tenth of the time; of 513 and more its root
    /// alone as well, which counts twice. Of one of more than 1024 it builds parts that are worse by the factor, and the nodes
    /// above them where those lost a twentieth at least. At the default of 1.1 trees were better than at 1, for two thirds to
    /// three quarters of the time where lamps mix and about the same where clusters of them change places
    /// (`docs/dynamics-design.md`, "When it pays").
    ///
    /// Worse is what lost its order. That the order edits made is not that of a new tree, as after 10^4 lamps have come in in
    /// the order of a scan, is seen by a rebuilder alone, which tries parts in which much was built; by
    /// [`Bvh::rebuild`](crate::Bvh::rebuild) such a tree stays, unless it is [`eager`](Self::eager).
    pub top: f64,
    /// A bottom level is once it is worse than when it was built by more than this factor; infinite for never. The factor is 1
    /// / (1 - l), where l is the mean by flux, over the nodes, of how much more of their lights' variance of position lies
    /// between the lights of each of their children: 0 as built, wherever the mesh goes, however it is scaled, and whatever
    /// happens elsewhere; 0.65 to 0.85, a factor of 3 to 7, where all triangles changed places. What only a device has refitted
    /// is not seen to lose quality. From 1.01 on a [`Rebuilder`](crate::Rebuilder) also builds a mesh anew once at rest, of
    /// which one triangle in 32 changed a few at a time.
    pub drift: f64,
}

impl Default for RebuildParams {
    /// Trees that are 1.1 times worse than when they were built.
    fn default() -> Self {
        Self { top: 1.1, drift: 1.1 }
    }
}

/// A top level of more instances takes turns with small meshes that are many.
#[cfg(feature = "std")]
const LARGE: usize = 512;

impl RebuildParams {
    /// The top level whatever it lost, as the paper does in each frame; bottom levels as by default. By
    /// [`Bvh::rebuild`](crate::Bvh::rebuild) that is the whole of it; by a [`Rebuilder`](crate::Rebuilder), where it has more
    /// than 1024 instances, each part in which anything changed, in turn.
    #[must_use]
    pub fn eager() -> Self {
        Self {
            top: 1.0,
            ..Self::default()
        }
    }
}

/// A tree that is to be built anew, and why: `drift` is more than `limit`, or as much for the top level.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Due {
    /// The mesh whose bottom level it is; `None` for the top level.
    pub mesh: Option<MeshId>,
    /// How many times worse it is than when it was built; see [`RebuildParams::drift`].
    pub drift: f64,
    /// From what on it is due: [`RebuildParams::top`] or [`RebuildParams::drift`].
    pub limit: f64,
}

/// Below this threshold meshes are built for what they lost alone.
#[cfg(feature = "std")]
const EAGER: f64 = 1.01;

/// Most instances of subtrees that are built anew for what came while a tree was built and was put into it.
pub(super) const ADOPTED: u64 = 64;

/// Entries of the lists of what changed that are not sorted: the refit that comes next takes them, and to sort those of a part
/// was a tenth of the time that putting it in place took.
const MANY: usize = 8192;

/// Work for any thread: a copy of what is to be built anew.
#[derive(Clone, Debug)]
pub struct Rebuild<N: Holds, const W: usize> {
    params: BuildParams,
    taken: Taken,
    top: Vec<TopCopy<N>>,
    bottoms: Vec<Bottom<N::Light>>,
    layout: PhantomData<N>,
}

/// When a copy was taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Taken {
    tree: u32,
    pub epoch: u64,
}

#[cfg(feature = "std")]
impl Taken {
    /// Whether both are of one light BVH.
    pub fn is_of_same(self, other: Self) -> bool {
        self.tree == other.tree
    }
}

/// A bottom level that lost quality.
#[derive(Clone, Debug)]
struct Bottom<L> {
    blas: u32,
    created: u64,
    range: Range<u32>,
    triangles: Vec<L>,
    /// What was unsettled of it then.
    unsettled: u32,
}

/// What a [`Rebuild`] gives: trees to be swapped in by [`Bvh::install`].
#[derive(Debug)]
pub struct Rebuilt<N: Holds, const W: usize> {
    taken: Taken,
    /// The top level or parts of it, refitted.
    top: Vec<TopTree<N>>,
    bottoms: Vec<(Bottom<N::Light>, Topology<N>)>,
}

/// What was built belongs to another light BVH.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Foreign;

impl fmt::Display for Foreign {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "the rebuild was taken from another light BVH; give each its own rebuilder"
        )
    }
}

impl core::error::Error for Foreign {}

#[cfg(feature = "std")]
impl<N: Holds, const W: usize> Rebuilt<N, W> {
    /// What nodes above parts cost over those that they replace.
    pub(crate) fn gain_above(&self) -> Option<f64> {
        self.top.iter().find_map(TopTree::gain_above)
    }
}

impl<N: Node<W>, const W: usize> Rebuild<N, W> {
    /// Whether there is nothing to build.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.top.is_empty() && self.bottoms.is_empty()
    }

    /// The bottom levels to build.
    #[cfg(test)]
    pub(crate) fn bottoms(&self) -> impl Iterator<Item = u32> + '_ {
        self.bottoms.iter().map(|bottom| bottom.blas)
    }

    /// Builds. The result depends on nothing but `self`: not on the thread, nor on when it runs.
    #[must_use]
    pub fn run(self) -> Rebuilt<N, W> {
        let top = self.top.into_iter().map(|copy| copy.build::<W>(&self.params));
        let params = self.params;
        let bottoms = self.bottoms.into_iter().map(|bottom| {
            let mut topology = build_over::<N, W>(&bottom.triangles, &params);
            topology.move_primitives::<W>(bottom.range.start);
            (bottom, topology)
        });
        Rebuilt {
            taken: self.taken,
            top: top.collect(),
            bottoms: bottoms.collect(),
        }
    }
}

impl<N: Node<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// Takes a copy of what `params` wants built anew, as it stands after a [`refit`](Self::refit). It asks each
    /// bottom level refitted since it was built for its quality, in no time; copies of the top level's leaves take
    /// time in proportion to all instances.
    #[must_use]
    pub fn rebuild(&self, params: &RebuildParams) -> Rebuild<N, W> {
        self.rebuild_since(params, None)
    }

    /// As [`rebuild`](Self::rebuild), but looks for lost quality among the bottom levels refitted since then.
    pub(crate) fn rebuild_since(&self, params: &RebuildParams, since: Option<Taken>) -> Rebuild<N, W> {
        let is_worn = self.quality(self.top.root).drift() >= params.top;
        let top = is_worn.then(|| self.copy_top());
        self.rebuild_of(Vec::from_iter(top), &self.worn_since(params, since))
    }

    /// How many times worse the top level is than when its nodes were built.
    #[cfg(test)]
    pub(crate) fn rebuild_drift(&self) -> f64 {
        self.quality(self.top.root).drift()
    }

    /// The bottom levels refitted since then that lost something, but are not to be built anew.
    #[cfg(feature = "std")]
    pub(crate) fn strained_since(&self, params: &RebuildParams, since: Option<Taken>) -> Vec<u32> {
        let mut found = self.refitted_since_taken(params, since);
        found.retain(|&blas| self.drift(blas) > 1.0 && !self.is_worn(blas, params));
        found
    }

    /// The bottom levels refitted since then of which much changed a little at a time.
    #[cfg(feature = "std")]
    pub(crate) fn unsettled_since(&self, params: &RebuildParams, since: Option<Taken>) -> Vec<u32> {
        let mut found = self.refitted_since_taken(params, since);
        found.retain(|&blas| self.is_to_rest(blas, params));
        found
    }

    /// Whether a bottom level is to be built anew once it is at rest. What lost a hundredth is built by those who ask for it,
    /// at rest or not.
    #[cfg(feature = "std")]
    pub(crate) fn is_to_rest(&self, blas: u32, params: &RebuildParams) -> bool {
        params.drift >= EAGER && self.is_unsettled(blas)
    }

    /// Whether a bottom level gets a tree by a stage alone, whatever its size.
    #[cfg(feature = "std")]
    pub(crate) fn is_staged_only(&self, blas: u32) -> bool {
        let own = &self.blases[blas as usize];
        own.is_staged_only && self.is_much_opened(blas)
    }

    /// The bottom levels refitted since then that are to be built anew.
    pub(crate) fn worn_since(&self, params: &RebuildParams, since: Option<Taken>) -> Vec<u32> {
        let mut found = self.refitted_since_taken(params, since);
        found.retain(|&blas| self.is_worn(blas, params));
        found
    }

    fn refitted_since_taken(&self, params: &RebuildParams, since: Option<Taken>) -> Vec<u32> {
        let since = since.filter(|since| since.tree == self.id.0);
        match params.drift.is_finite() {
            true => self.refitted_since(since.map_or(0, |since| since.epoch)),
            false => Vec::new(),
        }
    }

    /// Whether putting a part of the top level in place takes much of what a frame has for that.
    #[cfg(feature = "std")]
    pub(crate) fn is_top_large(&self) -> bool {
        self.live.len() > LARGE
    }

    /// Whether a bottom level is to be built anew.
    pub(crate) fn is_worn(&self, blas: u32, params: &RebuildParams) -> bool {
        let own = self.blases.get(blas as usize);
        own.is_some_and(|own| !own.nodes.is_empty() && !own.is_outgoing) && self.drift(blas) > params.drift
    }

    /// What `params` wants built anew, and why, the top level first: it as a whole, in the mean over its lights, while a
    /// rebuilder asks each part of a large one, and tries those in which much was built besides. A tree that is as built is not
    /// due. In time in proportion to the meshes refitted since they were built.
    #[must_use]
    pub fn due(&self, params: &RebuildParams) -> Vec<Due> {
        let top = Due {
            mesh: None,
            drift: self.quality(self.top.root).drift(),
            limit: params.top,
        };
        let is_worn = !self.single && top.drift > 1.0 && top.drift >= top.limit;
        let worn = self.worn_since(params, None).into_iter();
        let meshes = worn.filter_map(|blas| {
            Some(Due {
                mesh: Some(self.mesh_id(self.blases[blas as usize].mesh)?),
                drift: self.drift(blas),
                limit: params.drift,
            })
        });
        is_worn.then_some(top).into_iter().chain(meshes).collect()
    }

    /// Work for what is to be built anew of the top level, and a copy of the triangles of those bottom levels.
    pub(crate) fn rebuild_of(&self, top: Vec<TopCopy<N>>, bottoms: &[u32]) -> Rebuild<N, W> {
        let bottoms = bottoms.iter().map(|&blas| {
            let own = &self.blases[blas as usize];
            let range = own.triangles.clone();
            Bottom {
                blas,
                created: own.created,
                triangles: self.triangles[range.start as usize..range.end as usize].to_vec(),
                range,
                unsettled: own.unsettled,
            }
        });
        Rebuild {
            params: self.params,
            taken: self.now(),
            top,
            bottoms: bottoms.collect(),
            layout: PhantomData,
        }
    }

    /// Swaps in what was built. Edits since the [`rebuild`](Self::rebuild) are not lost: instances removed meanwhile are taken
    /// out of it, added ones put into it, bottom levels replaced meanwhile stay as they are. Comes before the next
    /// frame's [`apply`](Self::apply) or after it, but before its [`refit`](Self::refit).
    ///
    /// # Errors
    /// [`Foreign`] where it was taken from another light BVH; this one is as before then.
    pub fn install(&mut self, rebuilt: Rebuilt<N, W>) -> Result<(), Foreign> {
        self.install_as(rebuilt, true).map(|_| ())
    }

    /// The same, and unless it `opens` them, but for opening and closing instances: returns those that are still to be opened,
    /// those to be closed, and bottom levels whose trees have to wait for that.
    pub(crate) fn install_as(
        &mut self,
        rebuilt: Rebuilt<N, W>,
        opens: bool,
    ) -> Result<([Vec<u32>; 2], Vec<u32>), Foreign> {
        let mut changes = [const { Vec::new() }; 2];
        let mut unfit = Vec::new();
        if rebuilt.taken.tree != self.id.0 {
            return Err(Foreign);
        }
        for (bottom, topology) in &rebuilt.bottoms {
            let same = |own: &Blas| {
                own.created == bottom.created && own.triangles == bottom.range && !own.is_outgoing
            };
            if !self.blases.get(bottom.blas as usize).is_some_and(same) {
                continue;
            }
            // Many instances that would have to be opened anew are closed before, while a stage waits.
            if !opens
                && self.is_much_opened(bottom.blas)
                && !self.has_as_many_parts(bottom.blas, &topology.nodes[0])
            {
                self.blases[bottom.blas as usize].is_staged_only = true;
                unfit.push(bottom.blas);
                continue;
            }
            let unsettled = self.blases[bottom.blas as usize].unsettled;
            self.place_blas(bottom.blas, topology);
            self.update_root(bottom.blas);
            // Another tree has the centre within rounding.
            self.note_centers(&[bottom.blas]);
            self.note_unsettled(bottom.blas, unsettled - bottom.unsettled.min(unsettled));
        }
        let mut room = Quota::default();
        for top in &rebuilt.top {
            let wanted = self.install_top(top, rebuilt.taken.epoch, &mut room);
            if opens {
                self.reopen(&wanted[0], &wanted[1]);
                continue;
            }
            for (all, own) in changes.iter_mut().zip(wanted) {
                all.extend(own);
            }
        }
        self.settle_some(ADOPTED);
        if self.changes.new.len() > MANY {
            self.bound_changes();
        }
        Ok((changes, unfit))
    }

    /// So much of a bottom level changed while its tree was built, which counts as built for it as it is: it may want another
    /// at rest.
    fn note_unsettled(&mut self, blas: u32, unsettled: u32) {
        self.blases[blas as usize].unsettled = unsettled;
        if unsettled > 0 {
            self.epoch += 1;
            self.blases[blas as usize].changed = self.epoch;
            self.note_refitted(blas, self.epoch);
        }
    }

    /// Opens or closes one instance beside the frames, unless it is so already; that is still to be [noted](Self::note_reopened).
    #[cfg(feature = "std")]
    pub(crate) fn reopen_one(&mut self, index: u32, opens: bool) -> bool {
        let one = &[index][..];
        let (open, close) = if opens { (one, &[][..]) } else { (&[][..], one) };
        let changed = self.reopen_some(open, close, true);
        self.settle_some(ADOPTED);
        !changed.is_empty()
    }

    pub(crate) fn now(&self) -> Taken {
        Taken {
            tree: self.id.0,
            epoch: self.epoch,
        }
    }
}

#[cfg(test)]
mod tests;

//! Refit of what changed, on the CPU, and the lists by which a device does the same.

use alloc::vec::Vec;
use core::ops::Range;

use super::changes::{Counted, Pending};
use super::{Bvh, Trails};
use crate::levels::Levels;
use crate::node::Node;
use crate::refit;
use crate::sweep;
use crate::tree::INVALID;

/// Where more than this share of all instances changed, all of the top level is refitted by its ready-made lists.
const MOST: usize = 2;

/// What a refit does: what a mirror of the scene's arrays must copy before it, and the lists of the passes that then make its
/// nodes the same. Copy first, then run [`refit::bottom`], [`refit::root`] and [`refit::top`] over the lists in this order,
/// each range of levels by itself.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct RefitPlan {
    /// Nodes whose links or kinds changed.
    pub written_nodes: Vec<Range<u32>>,
    /// Triangles that changed.
    pub written_triangles: Vec<Range<u32>>,
    /// Triangles whose trails changed: `LightTree::trail_words` words each. Where a trail takes two words from now on, all of them.
    pub written_trails: Vec<Range<u32>>,
    /// Instances that changed.
    pub written_instances: Vec<Range<u32>>,
    /// Nodes of bottom levels whose triangles changed.
    pub bottom: Levels,
    /// The same nodes by bottom level, each range in depth-first order: swept from its last node to its first, it reads memory in
    /// one direction.
    pub trees: Vec<Range<u32>>,
    /// Nodes of bottom levels of which only some triangles changed: those of `bottom` that are in none of `trees`.
    pub parts: Levels,
    /// Bottom levels whose root changed: another node, or another summary. A mirror takes the node from [`Bvh::roots`] and computes
    /// [`refit::root`] of its own nodes and it.
    pub roots: Vec<u32>,
    /// Nodes of the top level with instances that changed, and those above them.
    pub top: Levels,
}

impl RefitPlan {
    /// Number of nodes and roots that the passes compute.
    #[must_use]
    pub fn computed(&self) -> usize {
        self.bottom.nodes().len() + self.roots.len() + self.top.nodes().len()
    }
}

impl<N: Node<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// Says what changed since the last call: the lists of [`work`](Self::work), for a mirror on a device that does them in its
    /// place, call by call without gaps. Whether and when the BVH is refitted here does not matter to what it says. The first
    /// call says what changed since the last [`refit`](Self::refit); a mirror takes over all arrays before it. Arrays that are
    /// longer than before are longer in the mirror, whose new places may hold anything: lists name a place once something
    /// stands there, and no walk comes to it before. Arrays never get shorter, and what is in use of their nodes and roots
    /// [`plan_of_everything`](Self::plan_of_everything) says. The words of places that are not in use any more may differ from
    /// a mirror's.
    ///
    /// One who asks is enough: `lightbvh_gpu::Mirror` makes this call itself, and copies everything after one besides.
    ///
    /// To read the arrays beside the lists, drop what this returns and ask [`work`](Self::work), before the next refit.
    ///
    /// Where only a device refits, nodes here stay as they were: samples taken here are of that tree, and a
    /// [`rebuild`](Self::rebuild) sees no bottom level lose quality. A refit here, now and then, is enough for both.
    pub fn plan(&mut self) -> &RefitPlan {
        self.adopt_swept();
        self.changes.is_planned = true;
        self.changes.plans += 1;
        let new = core::mem::take(&mut self.changes.new);
        let mut told = core::mem::take(&mut self.changes.unplanned);
        let is_whole = self.changes.unrefitted.is_empty() && told.is_empty();
        self.changes.unrefitted.join(new.clone());
        told.join(new);
        self.bound_changes();
        self.spell_out(&mut told);
        (self.planned, self.changes.counted) = self.gather(told);
        self.done = None;
        self.changes.is_fresh = is_whole;
        &self.planned
    }

    /// A refit of everything, for a mirror that has just taken all arrays over: its ranges of what was written are empty, for
    /// nothing is left to be copied. To compare a mirror, compare the nodes and roots that it lists; for the rest, what
    /// [`triangle`](Self::triangle) and the instances that are live name.
    #[must_use]
    pub fn plan_of_everything(&self) -> RefitPlan {
        let used = || (0..).zip(&self.blases).filter(|(_, blas)| !blas.nodes.is_empty());
        let levels: Vec<Levels> = used().map(|(index, _)| self.levels_of(index)).collect();
        RefitPlan {
            bottom: Levels::join(&levels.iter().collect::<Vec<_>>()),
            trees: used().map(|(_, blas)| blas.nodes.clone()).collect(),
            roots: used()
                .flat_map(|(index, blas)| core::iter::once(index).chain(blas.parts.clone()))
                .collect(),
            top: self.top.levels.clone().unwrap_or_else(|| self.top.by_height()),
            ..RefitPlan::default()
        }
    }

    /// Computes the nodes that the edits since the last call touch, and no other.
    pub fn refit(&mut self) {
        self.adopt_swept();
        let new = core::mem::take(&mut self.changes.new);
        let mut pending = core::mem::take(&mut self.changes.unrefitted);
        let is_listed = self.changes.is_fresh && new.is_empty();
        self.changes.is_fresh = false;
        // A mirror that follows without plans takes the lists of refits.
        let is_told = !self.changes.is_planned && !new.is_empty();
        if self.changes.is_planned {
            self.changes.unplanned.join(new.clone());
        } else {
            self.changes.plans += u64::from(is_told);
        }
        self.bound_changes();
        pending.join(new);
        self.spell_out(&mut pending);
        // Any of them is computed, so the epoch is one later below.
        let parts = self.parts(&pending);
        for &blas in pending.blases.iter().chain(parts.keys()) {
            let changed = parts.get(&blas);
            let changed = changed.map(|ranges| ranges.iter().map(ExactSizeIterator::len).sum());
            self.note_changed(blas, changed, self.epoch + 1);
            self.note_refitted(blas, self.epoch + 1);
        }
        let (work, counted) = if is_listed {
            let counted = core::mem::take(&mut self.changes.counted);
            (core::mem::take(&mut self.planned), counted)
        } else {
            self.gather(pending)
        };
        self.note_changes(&counted, &work.top);
        self.epoch += u64::from(work.computed() > 0);
        sweep::trees(&mut self.nodes, &self.triangles, &work.trees);
        for range in work.parts.ranges() {
            sweep::bottom(&mut self.nodes, &self.triangles, &work.parts.nodes()[range]);
        }
        for tree in &work.trees {
            self.judge_range(tree.clone(), false);
        }
        self.judge_list(work.parts.nodes());
        for &blas in &work.roots {
            let root = self.roots[blas as usize].node;
            self.roots[blas as usize] = refit::root(&self.nodes, root);
        }
        for range in work.top.ranges() {
            sweep::top(
                &mut self.nodes,
                &self.instances,
                &self.roots,
                &work.top.nodes()[range],
            );
        }
        self.judge_list(work.top.nodes());
        self.note_fluxes(&work.roots);
        self.note_centers(&work.roots);
        // The lists of the last plan stay, for mirrors that follow it later.
        if is_listed || is_told {
            self.planned = work;
            self.done = None;
        } else {
            self.done = Some(work);
        }
    }

    /// The last lists: what the last [`plan`](Self::plan) said, or the last [`refit`](Self::refit) did.
    #[must_use]
    pub fn work(&self) -> &RefitPlan {
        self.done.as_ref().unwrap_or(&self.planned)
    }

    /// The lists of the plan that [`last_plan`](Self::last_plan) numbers, whatever was refitted since.
    #[doc(hidden)]
    #[must_use]
    pub fn planned(&self) -> &RefitPlan {
        &self.planned
    }

    /// By what mirrors tell plans apart: the number of this BVH, and that of its last plan; and whether that plan says all.
    #[doc(hidden)]
    #[must_use]
    pub fn last_plan(&self) -> ((u32, u64), bool) {
        let is_current = self.changes.new.is_empty() && self.changes.unplanned.is_empty();
        ((self.id.0, self.changes.plans), is_current)
    }

    /// Turns changes into lists, and what of them counts at the nodes above.
    fn gather(&mut self, mut pending: Pending) -> (RefitPlan, Counted) {
        pending.merge_long();
        for list in [
            &mut pending.instances,
            &mut pending.top_nodes,
            &mut pending.written_instances,
        ] {
            list.sort_unstable();
            list.dedup();
        }
        let mut work = RefitPlan {
            written_nodes: pending.written_nodes.clone(),
            written_triangles: pending.written_triangles.clone(),
            written_trails: pending.written_trails.clone(),
            written_instances: joined(pending.written_instances.clone()),
            ..RefitPlan::default()
        };
        let (touched, parts) = self.touched(&mut pending);
        let swept: Vec<u32> = pending.blases.iter().copied().collect();
        let changed = swept.iter().chain(&pending.built).chain(&touched);
        let users = changed.flat_map(|&blas| {
            let own = &self.blases[blas as usize];
            let users = &self.meshes[own.mesh as usize].users;
            users.iter().flat_map(|&user| self.leaves_of(user))
        });
        let mut instances = pending.instances.clone();
        instances.extend(users);

        let (mut computed, mut roots) = (pending.blases, pending.built);
        roots.extend(pending.roots);
        let mut lists: Vec<&Levels> = parts.iter().collect();
        roots.extend(touched);
        if pending.all_nodes {
            let used = (0..).zip(&self.blases).filter(|(_, blas)| !blas.nodes.is_empty());
            computed.extend(used.map(|(index, _)| index));
            lists.clear();
        }
        computed.iter().for_each(|&blas| self.list_levels(blas));
        work.parts = Levels::join(&lists);
        for &blas in &computed {
            let own = &self.blases[blas as usize];
            work.trees.push(own.nodes.clone());
            lists.push(&own.levels);
        }
        work.bottom = Levels::join(&lists);
        roots.extend(computed);
        for blas in roots {
            work.roots.push(blas);
            work.roots.extend(self.blases[blas as usize].parts.clone());
        }

        if pending.whole_top || instances.len() > self.live.len() / MOST {
            work.top = self.top_levels().clone();
        } else {
            self.dirty_top(&instances, &pending.top_nodes, &mut work);
        }
        let counted = Counted {
            refitted: pending.instances,
            swept,
            all: instances,
        };
        (work, counted)
    }

    /// Lists all instances where all may have changed.
    fn spell_out(&self, pending: &mut Pending) {
        if core::mem::take(&mut pending.all_instances) {
            pending.instances = self.leaves_of_all(&self.live);
            pending.written_instances = (0..self.instances.len() as u32).collect();
        }
    }

    /// Keeps the lists of changes as short as the arrays, however many edits come before a refit or a plan.
    pub(super) fn bound_changes(&mut self) {
        let (instances, nodes, triangles) = (self.instances.len(), self.nodes.len(), self.triangles.len());
        for pending in self.changes.all() {
            pending.bound(instances, nodes, triangles);
        }
    }

    /// The leaves of the given instances, the given nodes, and all nodes above them.
    fn dirty_top(&mut self, instances: &[u32], nodes: &[u32], work: &mut RefitPlan) {
        let leaves = instances.iter().map(|&i| self.placed[i as usize].node);
        let mut pairs = Vec::new();
        let depth = self.top.depth();
        self.top.mark += 1;
        for start in leaves.chain(nodes.iter().copied()) {
            let mut node = start;
            // Nodes that were marked may be gone since.
            while self.top.number(node) != INVALID {
                let number = self.top.number(node) as usize;
                if self.top.marks[number] == self.top.mark {
                    break;
                }
                self.top.marks[number] = self.top.mark;
                pairs.push((depth - self.top.heights[number], node));
                node = self.parents[node as usize];
            }
        }
        work.top = Levels::gather(pairs);
    }
}

/// Indices as ranges, in order, each once.
fn joined(mut indices: Vec<u32>) -> Vec<Range<u32>> {
    indices.sort_unstable();
    let mut out: Vec<Range<u32>> = Vec::new();
    for i in indices {
        match out.last_mut() {
            Some(last) if i < last.end => {}
            Some(last) if i == last.end => last.end += 1,
            _ => out.push(i..i + 1),
        }
    }
    out
}

//! Bottom levels built beside the frames and put in place piece by piece, so that no frame waits for a large mesh.
//!
//! A stage copies the triangles of a mesh a piece at a time, to where they will stand and for the builder; the builder, on a thread of
//! its own, gives a tree that is refitted; its nodes and trails are put in place a piece at a time, beside those that are walked; what
//! changed meanwhile is refitted there; then the instances are told of the new root and triangles, all at once. The order of lights
//! is a hint: what is exact comes from the refit. Edits meanwhile write both places.

use alloc::boxed::Box;
use alloc::vec::Vec;
use core::marker::PhantomData;
use core::ops::Range;

use super::changes::merged;
use super::quality::Quality;
use super::{Bvh, Trails};
use crate::build::{BuildParams, build_over};
use crate::levels::Levels;
use crate::light::EmissiveTriangle;
use crate::node::{LightNode, kind};
use crate::refit;
use crate::sweep;
use crate::trail::BitTrail;
use crate::tree::INVALID;

/// Bytes that take about the time of a node in a sweep, and of a path to a triangle.
const NODE: usize = 2048;
const PATH: usize = 16384;
/// Where more than this share of the triangles changed since they were copied, all nodes are swept.
const MOST: usize = 16;

/// Which stage, of which light BVH.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct StageId {
    tree: u32,
    blas: u32,
    number: u64,
}

/// What a light BVH knows of a tree that is to take the place of a bottom level's.
#[derive(Clone, Debug)]
pub(super) struct Staged {
    number: u64,
    /// Where the triangles will stand; the first `copied` of them do.
    triangles: Range<u32>,
    copied: u32,
    /// Where the nodes will stand; empty until they are built.
    nodes: Range<u32>,
    /// Whether all nodes and trails are there.
    is_placed: bool,
    depth: u32,
    levels: Levels,
    /// Triangles, where they will stand, that changed since they were copied.
    changed: Vec<Range<u32>>,
    /// How many since the last frame began.
    fresh: usize,
    /// Whether all nodes from the first to that of index `swept` are to be computed.
    is_whole: bool,
    swept: u32,
}

impl Staged {
    /// Whether so much changed that paths are no less work than all nodes.
    fn is_worn(&self) -> bool {
        let changed: usize = self.changed.iter().map(ExactSizeIterator::len).sum();
        changed * MOST > self.triangles.len()
    }

    fn sweep_all(&mut self) {
        self.is_whole = true;
        self.swept = self.nodes.len() as u32;
        self.changed.clear();
    }
}

/// A bottom level's triangles as they were when they were copied.
#[derive(Clone, Debug)]
pub(crate) struct MeshJob<N> {
    params: BuildParams,
    triangles: Vec<EmissiveTriangle>,
    layout: PhantomData<N>,
}

/// A bottom level as it is built beside the frames; nodes and triangles count from 0.
#[derive(Debug)]
pub(crate) struct MeshTree<N> {
    nodes: Vec<N>,
    parents: Vec<u32>,
    quality: Vec<Quality>,
    trails: Vec<BitTrail>,
    levels: Levels,
    depth: u32,
    /// How many nodes and trails are in place.
    nodes_placed: usize,
    trails_placed: usize,
}

impl<N> MeshJob<N> {
    /// Builds and refits. The result depends on nothing but `self`.
    pub fn run<const W: usize>(self) -> MeshTree<N>
    where
        N: LightNode<W>,
    {
        let topology = build_over::<N, W>(&self.triangles, &self.params);
        let levels = Levels::gather(topology.leveled(0));
        let mut nodes = topology.nodes;
        sweep::bottom_sweep(&mut nodes, 0, &self.triangles, &[0]);
        let mut parents = alloc::vec![INVALID; nodes.len()];
        for (index, node) in (0..).zip(&nodes) {
            for slot in (0..W).filter(|&slot| node.kind(slot) == kind::INNER) {
                parents[node.link(slot) as usize] = index;
            }
        }
        let mut trails = alloc::vec![BitTrail::default(); self.triangles.len()];
        for (triangle, trail) in topology.trails {
            trails[triangle as usize] = trail;
        }
        MeshTree {
            quality: Quality::as_built(&nodes),
            nodes,
            parents,
            trails,
            levels,
            depth: topology.depth,
            nodes_placed: 0,
            trails_placed: 0,
        }
    }
}

impl<N: LightNode<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// Number of triangles of a bottom level.
    pub(crate) fn blas_len(&self, blas: u32) -> usize {
        self.blases[blas as usize].triangles.len()
    }

    /// Begins a stage for bottom level `blas`; `None` where there is no such, and in a single level, whose lights are its triangles.
    pub(crate) fn begin_stage(&mut self, blas: u32) -> Option<(StageId, MeshJob<N>)> {
        if self.single || self.blases.get(blas as usize)?.nodes.is_empty() {
            return None;
        }
        self.drop_stage(blas);
        self.epoch += 1;
        let count = self.blas_len(blas);
        let staged = Staged {
            number: self.epoch,
            triangles: self.triangle_ranges.take(count as u32),
            copied: 0,
            nodes: 0..0,
            is_placed: false,
            depth: 0,
            levels: Levels::default(),
            changed: Vec::new(),
            fresh: 0,
            is_whole: false,
            swept: 0,
        };
        self.blases[blas as usize].staged = Some(Box::new(staged));
        self.staging.push(blas);
        let id = StageId {
            tree: self.id.0,
            blas,
            number: self.epoch,
        };
        let job = MeshJob {
            params: self.params,
            triangles: Vec::with_capacity(count),
            layout: PhantomData,
        };
        Some((id, job))
    }

    /// The stage of that id, while it is there.
    fn staged(&mut self, id: StageId) -> Option<&mut Staged> {
        let own = self
            .blases
            .get_mut(id.blas as usize)
            .filter(|_| id.tree == self.id.0)?;
        own.staged
            .as_deref_mut()
            .filter(|staged| staged.number == id.number)
    }

    /// Whether its tree is in place.
    pub(crate) fn is_adopted(&self, id: StageId) -> bool {
        let own = self.blases.get(id.blas as usize);
        id.tree == self.id.0 && own.is_some_and(|own| own.adopted == id.number)
    }

    /// Copies more of the triangles, by at most `bytes`, of which what it takes is subtracted; whether all are copied. `None` where the
    /// stage is gone.
    pub(crate) fn copy_stage(
        &mut self,
        id: StageId,
        job: &mut MeshJob<N>,
        bytes: &mut usize,
    ) -> Option<bool> {
        let size = 2 * size_of::<EmissiveTriangle>();
        let staged = self.staged(id)?;
        let from = staged.copied;
        let count = (staged.triangles.len() as u32 - from).min((*bytes / size) as u32);
        let to = staged.triangles.start + from;
        staged.copied += count;
        let is_done = staged.copied as usize == staged.triangles.len();
        if count > 0 {
            *bytes -= count as usize * size;
            let start = (self.blases[id.blas as usize].triangles.start + from) as usize;
            let own = start..start + count as usize;
            job.triangles.extend_from_slice(&self.triangles[own.clone()]);
            self.cover_triangles(to + count);
            self.triangles.copy_within(own, to as usize);
            self.changes.new.written_triangles.push(to..to + count);
        }
        Some(is_done)
    }

    /// Puts more of what was built in place, as [`copy_stage`](Self::copy_stage) copies.
    pub(crate) fn place_stage(
        &mut self,
        id: StageId,
        tree: &mut MeshTree<N>,
        bytes: &mut usize,
    ) -> Option<bool> {
        let count = tree.nodes.len() as u32;
        let staged = self.staged(id)?;
        if staged.nodes.is_empty() {
            let nodes = self.node_ranges.take(count);
            let staged = self.staged(id)?;
            staged.nodes = nodes;
            if staged.is_whole {
                staged.sweep_all();
            }
        }
        let staged = self.staged(id)?;
        let (nodes, triangles) = (staged.nodes.clone(), staged.triangles.clone());
        self.place_nodes_of(tree, &nodes, &triangles, bytes);
        if T::KEPT {
            self.place_trails_of(tree, &triangles, bytes);
        }
        let is_done =
            tree.nodes_placed == tree.nodes.len() && (!T::KEPT || tree.trails_placed == tree.trails.len());
        if is_done {
            let (depth, levels) = (tree.depth, core::mem::take(&mut tree.levels));
            self.bottom_depth = self.bottom_depth.max(depth);
            let staged = self.staged(id)?;
            staged.depth = depth;
            staged.levels = levels;
            staged.fresh = 0;
            staged.is_placed = true;
        }
        Some(is_done)
    }

    fn place_nodes_of(
        &mut self,
        tree: &mut MeshTree<N>,
        nodes: &Range<u32>,
        triangles: &Range<u32>,
        bytes: &mut usize,
    ) {
        let size = size_of::<N>() + size_of::<Quality>() + 2 * size_of::<u32>();
        let from = tree.nodes_placed;
        let to = (from + *bytes / size).min(tree.nodes.len());
        if from == to {
            return;
        }
        *bytes -= (to - from) * size;
        let base = nodes.start;
        self.cover_nodes(base + to as u32);
        if self.quality.len() < self.nodes.len() {
            self.quality.resize(self.nodes.len(), Quality::default());
        }
        for k in from..to {
            let mut node = tree.nodes[k];
            for slot in 0..W {
                match node.kind(slot) {
                    kind::INNER => node.relink(slot, node.link(slot) + base),
                    kind::LIGHT => node.relink(slot, node.link(slot) + triangles.start),
                    _ => {}
                }
            }
            let at = base as usize + k;
            self.nodes[at] = node;
            self.parents[at] = if k == 0 { INVALID } else { tree.parents[k] + base };
            self.quality[at] = tree.quality[k];
        }
        // As many entries in all.
        for node in &mut tree.levels.nodes[from..to] {
            *node += base;
        }
        tree.nodes_placed = to;
        self.changes
            .new
            .written_nodes
            .push(base + from as u32..base + to as u32);
    }

    fn place_trails_of(&mut self, tree: &mut MeshTree<N>, triangles: &Range<u32>, bytes: &mut usize) {
        // All trails are rewritten where this is the first tree too deep for one word.
        self.reserve_trails(tree.depth, triangles.start);
        let words = self.trail_words as usize;
        let from = tree.trails_placed;
        let to = (from + *bytes / (4 * words)).min(tree.trails.len());
        if from == to {
            return;
        }
        *bytes -= (to - from) * 4 * words;
        let start = triangles.start;
        self.reserve_trails(tree.depth, start + to as u32);
        for k in from..to {
            let at = (start as usize + k) * words;
            self.trails[at] = tree.trails[k].low;
            if words == 2 {
                self.trails[at + 1] = tree.trails[k].high;
            }
        }
        tree.trails_placed = to;
        self.changes
            .new
            .written_trails
            .push(start + from as u32..start + to as u32);
    }

    /// Refits more of what changed since the triangles were copied, and lets the new tree take the place of the old where nothing is
    /// left; whether it has. `None` where the stage is gone.
    pub(crate) fn settle_stage(&mut self, id: StageId, bytes: &mut usize) -> Option<bool> {
        let staged = self.staged(id)?;
        if !staged.is_whole && (staged.is_worn() || (!T::KEPT && !staged.changed.is_empty())) {
            staged.sweep_all();
        }
        if staged.is_whole {
            self.sweep_stage(id, bytes)?;
        }
        let staged = self.staged(id)?;
        if !staged.is_whole {
            // Never fewer than come, so that it ends.
            let fresh = core::mem::take(&mut staged.fresh);
            let paths = (*bytes / PATH).max(2 * fresh).max(1);
            *bytes = bytes.saturating_sub(paths * PATH);
            let some = first_of(&mut staged.changed, paths);
            let (root, depth) = (staged.nodes.start, staged.depth);
            if !some.is_empty() {
                let levels = self.paths(root, depth, some);
                for range in levels.ranges() {
                    sweep::bottom(&mut self.nodes, &self.triangles, &levels.nodes()[range]);
                }
                self.judge_list(levels.nodes());
                let written = levels.nodes().iter().map(|&node| node..node + 1);
                self.changes.new.written_nodes.extend(written);
            }
        }
        let staged = self.staged(id)?;
        let is_settled = !staged.is_whole && staged.changed.is_empty();
        if is_settled {
            self.adopt_stage(id.blas);
        }
        Some(is_settled)
    }

    /// Computes more of the nodes, from the last to the first.
    fn sweep_stage(&mut self, id: StageId, bytes: &mut usize) -> Option<()> {
        let staged = self.staged(id)?;
        // Few enough for one thread, which takes them in order.
        let count = ((*bytes / NODE).clamp(1, 1024) as u32).min(staged.swept);
        *bytes = bytes.saturating_sub(count as usize * NODE);
        let end = staged.nodes.start + staged.swept;
        staged.swept -= count;
        staged.is_whole = staged.swept > 0;
        let list: Vec<u32> = (end - count..end).rev().collect();
        sweep::bottom(&mut self.nodes, &self.triangles, &list);
        self.judge_list(&list);
        self.changes.new.written_nodes.push(end - count..end);
        Some(())
    }

    /// Before a refit or a plan: meshes that it sweeps anyway get the trees that wait for that.
    pub(super) fn adopt_swept(&mut self) {
        for blas in self.staging.clone() {
            let own = &self.blases[blas as usize];
            let is_ready = own.staged.as_ref().is_some_and(|staged| staged.is_placed);
            if is_ready && self.changes.new.blases.contains(&blas) {
                self.adopt_stage(blas);
            }
        }
    }

    /// The tree of a stage takes the place of the bottom level's.
    fn adopt_stage(&mut self, blas: u32) {
        let own = &mut self.blases[blas as usize];
        let Some(staged) = own.staged.take() else {
            return;
        };
        self.staging.retain(|&other| other != blas);
        self.epoch += 1;
        own.created = self.epoch;
        own.adopted = staged.number;
        own.depth = staged.depth;
        own.levels = staged.levels;
        let nodes = core::mem::replace(&mut own.nodes, staged.nodes);
        let triangles = core::mem::replace(&mut own.triangles, staged.triangles);
        let (root, first) = (own.nodes.start, own.triangles.start);
        self.node_ranges.give(nodes);
        self.triangle_ranges.give(triangles);
        self.roots[blas as usize] = refit::root(&self.nodes, root);
        let mesh = self.blases[blas as usize].mesh;
        for k in 0..self.meshes[mesh as usize].users.len() {
            let user = self.meshes[mesh as usize].users[k];
            let instance = &mut self.instances[user as usize];
            instance.root = root;
            instance.first_triangle = first;
            self.changes.new.mark_instance(user);
        }
        self.changes.forget_lists();
        self.changes.new.built.insert(blas);
        // Built for triangles that have changed since, it may be due again.
        if self.drift(blas) > 1.0 {
            self.epoch += 1;
            self.blases[blas as usize].changed = self.epoch;
            self.note_refitted(blas, self.epoch);
        }
    }

    /// Gives up what was under way for a bottom level.
    pub(super) fn drop_stage(&mut self, blas: u32) {
        if let Some(staged) = self.blases[blas as usize].staged.take() {
            self.node_ranges.give(staged.nodes);
            self.triangle_ranges.give(staged.triangles);
            self.staging.retain(|&other| other != blas);
        }
    }

    /// Gives up all that is under way but `kept`.
    pub(crate) fn drop_stages_but(&mut self, kept: impl Fn(StageId) -> bool) {
        for blas in self.staging.clone() {
            let number = self.blases[blas as usize]
                .staged
                .as_ref()
                .map_or(0, |staged| staged.number);
            let id = StageId {
                tree: self.id.0,
                blas,
                number,
            };
            if !kept(id) {
                self.drop_stage(blas);
            }
        }
    }

    /// Triangles that were written also go to where they will stand, as far as they are there.
    pub(super) fn write_staged(&mut self, blas: u32, first: u32, count: u32) {
        let own = &mut self.blases[blas as usize];
        let Some(staged) = own.staged.as_deref_mut() else {
            return;
        };
        let end = (first + count).min(staged.copied);
        if first >= end {
            return;
        }
        let to = staged.triangles.start + first..staged.triangles.start + end;
        if count as usize == staged.triangles.len() {
            staged.sweep_all();
        } else {
            staged.changed.push(to.clone());
            staged.fresh += to.len();
            if staged.changed.len() > 2 * staged.triangles.len() / MOST + 64 {
                staged.changed = merged(core::mem::take(&mut staged.changed));
            }
        }
        let start = own.triangles.start;
        let from = (start + first) as usize..(start + end) as usize;
        self.triangles.copy_within(from, to.start as usize);
        self.changes.new.written_triangles.push(to);
    }
}

/// Takes the first `count` indices, or all there are.
fn first_of(ranges: &mut Vec<Range<u32>>, count: usize) -> Vec<Range<u32>> {
    let mut all = merged(core::mem::take(ranges)).into_iter();
    let (mut some, mut left) = (Vec::new(), count as u32);
    for range in all.by_ref() {
        let end = range.end.min(range.start + left);
        left -= end - range.start;
        some.push(range.start..end);
        if left == 0 {
            if end < range.end {
                ranges.push(end..range.end);
            }
            break;
        }
    }
    ranges.extend(all);
    some
}

#[cfg(all(test, feature = "std"))]
mod tests;

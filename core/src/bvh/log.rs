//! One log of changes, which each mirror reads from its own cursor on.

use crate::model::Model;
use alloc::collections::{BTreeSet, VecDeque};
use alloc::vec::Vec;
use core::ops::Range;

use super::Bvh;
use crate::levels::Levels;
use crate::node::{Node, kind};
use crate::trail::{leaf_parts, place_parts};
use crate::tree::INVALID;

/// Number of entries that the log keeps at any size of the scene.
const LEAST: usize = 4096;

/// A change.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Entry {
    /// The words of an instance's record.
    Instance(u32),
    /// Children of a node of the top level.
    Links(u32),
    /// A node of the top level was computed, and those above it.
    Computed(u32),
    /// All of the top level.
    Top,
    /// Most nodes of the top level were computed.
    TopComputed,
    /// Lights' words.
    Lights(Range<u32>),
    /// The nodes on the paths to lights of a mesh are to be computed.
    Paths(u32, Range<u32>),
    /// All nodes of a mesh are to be computed.
    Mesh(u32),
    /// A mesh got another tree.
    Tree(u32),
}

/// Changes, the oldest first, each with a number. The log is bounded: it drops the oldest entries.
#[derive(Clone, Debug, Default)]
pub(super) struct Log {
    /// Number of the first entry.
    start: u64,
    entries: VecDeque<Entry>,
}

impl Log {
    /// A log that begins after all of `old`: no cursor from before it is valid.
    pub fn after(old: &Self) -> Self {
        Self {
            start: old.end() + 1,
            entries: VecDeque::new(),
        }
    }

    fn end(&self) -> u64 {
        self.start + self.entries.len() as u64
    }

    /// Adds an entry. Equal ones are not merged: a mirror may have read the last one already.
    pub fn push(&mut self, entry: Entry) {
        self.entries.push_back(entry);
    }

    /// Drops the oldest entries; the newest `most` stay.
    fn bound(&mut self, most: usize) {
        let dropped = self.entries.len().saturating_sub(most);
        self.entries.drain(..dropped);
        self.start += dropped as u64;
    }
}

/// How far a mirror has followed a [`Bvh`]. A new one has not begun.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cursor {
    tree: u32,
    at: u64,
}

/// Ranges that a mirror of the arrays copies, and lists of the nodes that it then computes. Copy first, then run
/// [`refit::bottom`](crate::refit::bottom) and [`refit::top`](crate::refit::top) over their lists in this order, each range of levels by
/// itself. The mirror's nodes are one array, the top level behind the others.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct RefitPlan {
    /// Whether all of every array is to be copied; the ranges below are empty then.
    pub everything: bool,
    /// Whether all of the top level and its links is to be copied; their ranges are empty then.
    pub whole_top: bool,
    /// Nodes of bottom levels whose links or kinds changed.
    pub written_nodes: Vec<Range<u32>>,
    /// Lights that changed.
    pub written_lights: Vec<Range<u32>>,
    /// Lights whose trails changed: `LightTree::trail_words` words each.
    pub written_trails: Vec<Range<u32>>,
    /// Instances that changed.
    pub written_instances: Vec<Range<u32>>,
    /// Nodes of the top level whose links or kinds changed.
    pub written_top: Vec<Range<u32>>,
    /// Nodes whose place in the node above changed.
    pub written_above: Vec<Range<u32>>,
    /// Entries of [`Links::places`](crate::tree::Links::places) that changed.
    pub written_places: Vec<Range<u32>>,
    /// Entries of [`Links::parts`](crate::tree::Links::parts) that changed.
    pub written_parts: Vec<Range<u32>>,
    /// Nodes of bottom levels to compute.
    pub bottom: Levels,
    /// Nodes of the top level to compute.
    pub top: Levels,
}

impl RefitPlan {
    /// Number of nodes that the passes compute.
    #[must_use]
    pub fn computed(&self) -> usize {
        self.bottom.nodes().len() + self.top.nodes().len()
    }
}

impl<M: Model<W>, const W: usize> Bvh<M, W> {
    /// Logs the edits of the top level.
    pub(super) fn log_top(&mut self) {
        let written = core::mem::take(&mut self.top.written);
        if written.is_whole {
            self.log.push(Entry::Top);
        } else {
            let links = written.links.into_iter().map(Entry::Links);
            links.for_each(|entry| self.log.push(entry));
            if written.computed.len() > self.top.nodes.len() / 2 {
                self.log.push(Entry::TopComputed);
            } else {
                let computed = written.computed.into_iter().map(Entry::Computed);
                computed.for_each(|entry| self.log.push(entry));
            }
        }
        self.bound_log();
    }

    /// Bounds the log in proportion to the arrays that a mirror copies.
    pub(super) fn bound_log(&mut self) {
        self.log
            .bound(2 * (self.instances.len() + self.nodes.len()) + LEAST);
    }
}

impl Cursor {
    /// Lists changes by refits since the last call, for a mirror of the arrays, as on a device. Call it after
    /// [`refit`](Bvh::refit); each mirror has its own cursor. Everything is to be copied at the first call, if the last was of
    /// another BVH, or if the log has dropped changes since.
    ///
    /// If an array has grown, the mirror's must grow too. New places may hold anything: a list names a place once it is in use,
    /// and no walk reaches it before. Places that are no longer in use may differ from a mirror's.
    #[must_use]
    pub fn plan<M: Model<W>, const W: usize>(&mut self, bvh: &Bvh<M, W>) -> RefitPlan {
        let now = Self {
            tree: bvh.id.0,
            at: bvh.log.end(),
        };
        let from = core::mem::replace(self, now);
        if from.tree != bvh.id.0 || from.at < bvh.log.start {
            return bvh.plan_of_everything();
        }
        let mut plan = RefitPlan::default();
        let (mut instances, mut links) = (Vec::new(), Vec::new());
        let (mut meshes, mut trees, mut paths) = (BTreeSet::new(), BTreeSet::new(), Vec::new());
        let (mut computed, mut is_computed) = (Vec::new(), false);
        for entry in bvh.log.entries.range((from.at - bvh.log.start) as usize..) {
            match entry {
                Entry::Instance(index) => instances.push(*index),
                Entry::Links(node) => links.push(*node),
                Entry::Computed(node) => computed.push(*node),
                Entry::Top => plan.whole_top = true,
                Entry::TopComputed => is_computed = true,
                Entry::Lights(range) => plan.written_lights.push(range.clone()),
                Entry::Paths(mesh, range) => paths.push((*mesh, range.clone())),
                Entry::Mesh(mesh) => _ = meshes.insert(*mesh),
                Entry::Tree(mesh) => _ = trees.insert(*mesh),
            }
        }
        plan.written_lights = joined(plan.written_lights);
        plan.written_instances = indices(instances);
        // A mesh may have been removed since.
        let is_live = |mesh: &u32| bvh.meshes[*mesh as usize].live;
        trees.retain(is_live);
        meshes.retain(is_live);
        let with_trees = trees.iter().map(|&mesh| &bvh.meshes[mesh as usize]);
        plan.written_nodes = joined(with_trees.clone().map(|own| own.nodes.clone()).collect());
        plan.written_trails = joined(with_trees.map(|own| own.lights.clone()).collect());
        meshes.extend(trees);
        let mut pairs = Vec::new();
        let mut changed = meshes.clone();
        for (mesh, range) in paths.into_iter().filter(|(mesh, _)| is_live(mesh)) {
            let own = &bvh.meshes[mesh as usize].lights;
            let range = range.start.max(own.start)..range.end.min(own.end);
            if !meshes.contains(&mesh) && !range.is_empty() {
                changed.insert(mesh);
                pairs.extend(bvh.path_nodes(mesh, range));
            }
        }
        meshes.iter().for_each(|&mesh| pairs.extend(bvh.mesh_nodes(mesh)));
        plan.bottom = Levels::by_height(&sorted(pairs));
        if !plan.whole_top {
            bvh.plan_links(&mut plan, links.clone());
        }
        if plan.whole_top || is_computed {
            plan.top = Levels::by_height(&bvh.top.by_height());
        } else {
            let users = changed.iter().flat_map(|&mesh| &bvh.meshes[mesh as usize].users);
            let known = users.filter(|&&user| (user as usize) < bvh.top.places.len());
            let leaves = known.flat_map(|&user| {
                let parts = bvh.top.links_of(user);
                parts.map(move |part| bvh.top.place_of(user, part))
            });
            let leaves = leaves.filter(|&at| at != INVALID);
            let starts = computed.into_iter().chain(links);
            let starts = starts.chain(leaves.map(|at| place_parts::<W>(at).0));
            plan.top = Levels::by_height(&bvh.top.above_some::<W>(starts));
        }
        plan
    }
}

impl<M: Model<W>, const W: usize> Bvh<M, W> {
    /// Adds the copies of links to the plan: of nodes whose children changed, and of leaves.
    fn plan_links(&self, plan: &mut RefitPlan, mut nodes: Vec<u32>) {
        nodes.sort_unstable();
        nodes.dedup();
        let (mut above, mut places) = (nodes.clone(), Vec::new());
        for &node in &nodes {
            let own = &self.top.nodes[node as usize];
            for slot in 0..W {
                match own.kind(slot) {
                    kind::INNER => above.push(own.link(slot)),
                    kind::MESH => places.push(leaf_parts(own.link(slot)).0),
                    _ => {}
                }
            }
        }
        let opened = places.iter().filter_map(|instance| self.top.opened.get(instance));
        let opened = opened.filter(|own| own.first != INVALID);
        plan.written_parts = joined(
            opened
                .map(|own| own.first..own.first + own.parts.len() as u32)
                .collect(),
        );
        plan.written_top = indices(nodes);
        plan.written_above = indices(above);
        plan.written_places = indices(places);
    }

    /// Lists everything.
    fn plan_of_everything(&self) -> RefitPlan {
        let used = (0u32..).zip(&self.meshes).filter(|(_, mesh)| mesh.live);
        let meshes: Vec<u32> = used.map(|(index, _)| index).collect();
        let pairs = meshes.iter().flat_map(|&mesh| self.mesh_nodes(mesh)).collect();
        RefitPlan {
            everything: true,
            whole_top: true,
            bottom: Levels::by_height(&sorted(pairs)),
            top: Levels::by_height(&self.top.by_height()),
            ..RefitPlan::default()
        }
    }

    /// The nodes of a mesh by height.
    fn mesh_nodes(&self, mesh: u32) -> Vec<(u32, u32)> {
        let range = self.meshes[mesh as usize].nodes.clone();
        let mut heights = alloc::vec![1u32; range.len()];
        // Children come after their parents.
        for node in range.clone().rev() {
            let own = &self.nodes[node as usize];
            let below = (0..W).filter(|&slot| own.kind(slot) == kind::INNER);
            let below = below.map(|slot| 1 + heights[(own.link(slot) - range.start) as usize]);
            heights[(node - range.start) as usize] = below.max().unwrap_or(1);
        }
        heights.into_iter().zip(range).collect()
    }

    /// The nodes on the paths to some lights of a mesh, each with a number that is greater for parents than for children.
    pub(super) fn path_nodes(&self, mesh: u32, lights: Range<u32>) -> Vec<(u32, u32)> {
        let own = &self.meshes[mesh as usize];
        let mut pairs = Vec::new();
        for light in lights {
            let trail = self.trail_of(light);
            let mut node = own.nodes.start;
            for level in 0..own.depth {
                pairs.push((own.depth - level, node));
                let slot = trail.slot::<W>(level) as usize;
                let node_of = &self.nodes[node as usize];
                if node_of.kind(slot) != kind::INNER {
                    break;
                }
                node = node_of.link(slot);
            }
        }
        sorted(pairs)
    }
}

fn sorted(mut pairs: Vec<(u32, u32)>) -> Vec<(u32, u32)> {
    pairs.sort_unstable();
    pairs.dedup();
    pairs
}

/// Sorts ranges, and joins those that touch or overlap.
fn joined(mut ranges: Vec<Range<u32>>) -> Vec<Range<u32>> {
    ranges.sort_unstable_by_key(|range| (range.start, range.end));
    let mut out: Vec<Range<u32>> = Vec::with_capacity(ranges.len());
    for range in ranges {
        match out.last_mut() {
            Some(last) if range.start <= last.end => last.end = last.end.max(range.end),
            _ => out.push(range),
        }
    }
    out
}

/// Indices as ranges.
fn indices(indices: Vec<u32>) -> Vec<Range<u32>> {
    joined(indices.into_iter().map(|index| index..index + 1).collect())
}

#[cfg(test)]
mod tests;

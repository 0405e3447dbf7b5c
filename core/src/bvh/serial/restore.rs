//! What follows from the words that were read: links are walked before anything trusts them, then all is refitted.

use alloc::vec::Vec;
use core::ops::Range;

use super::error::ReadError;
use super::header::Header;
use super::places::taken;
use crate::bvh::Bvh;
use crate::bvh::apply::NO_INSTANCE;
use crate::bvh::changes::Changes;
use crate::bvh::opened::parts_below;
use crate::bvh::quality::Quality;
use crate::bvh::validate::Found;
use crate::levels::Levels;
use crate::node::{Node, kind};
use crate::refit::{self, BlasRoot};
use crate::summary::Summary;
use crate::sweep;
use crate::trail::trail_words;
use crate::transform::Transform;
use crate::tree::INVALID;

const NODES: ReadError = ReadError::Places { what: "nodes" };
const PARTS: ReadError = ReadError::Places {
    what: "parts of opened meshes",
};
const LISTS: ReadError = ReadError::Places {
    what: "instances in lists",
};

impl<N: Node<W>, I, const W: usize> Bvh<N, I, W> {
    /// The instances `behind` follow trees that go.
    pub(super) fn restore(&mut self, header: &Header, behind: &[u32]) -> Result<(), ReadError> {
        let bottoms = self.blases.iter().map(|blas| blas.nodes.clone());
        let tops = self.top.in_use().map(|node| node..node + 1);
        let used = bottoms.chain(tops).collect();
        self.node_ranges = taken(header.nodes, used, "nodes")?;
        self.restore_lists()?;
        self.restore_lights(header)?;
        self.restore_bottoms(behind)?;
        self.restore_top(behind)?;
        if self.single {
            self.check_single()?;
        }
        Ok(())
    }

    /// The bottom levels that may have lost quality.
    pub(super) fn restore_changes(
        &mut self,
        refitted: Vec<u32>,
        built: Vec<Vec<f32>>,
    ) -> Result<(), ReadError> {
        self.changes = Changes::default();
        self.epoch = 1;
        // Putting them in place counted as changes, later than all epochs to come.
        for placed in &mut self.placed {
            placed.changed = 0;
        }
        for (blas, built) in refitted.into_iter().zip(built) {
            let own = &mut self.blases[blas as usize];
            if own.nodes.is_empty() {
                return Err(ReadError::Places {
                    what: "refitted bottom levels",
                });
            }
            own.changed = self.epoch;
            own.stirred = self.epoch;
            let nodes = own.nodes.clone();
            for (node, share) in nodes.clone().zip(built) {
                self.quality[node as usize].built = share;
            }
            self.judge_range(nodes, false);
            self.note_refitted(blas, self.epoch);
        }
        Ok(())
    }

    /// What the nodes of the top level, by number, were as they were built; those of which nothing is known are so now.
    pub(super) fn restore_top_quality(&mut self, built: &[u32]) {
        self.quality.resize(self.nodes.len(), Quality::default());
        for (&node, &built) in self.top.nodes.iter().zip(built) {
            if node != INVALID {
                self.quality[node as usize].built = f32::from_bits(built);
            }
        }
        for node in self.top.by_height().nodes {
            if self.quality[node as usize].built.is_nan() {
                self.judge_new(node);
            } else {
                self.judge_list(&[node]);
            }
        }
    }

    /// The list of instances in use, and each mesh's.
    fn restore_lists(&mut self) -> Result<(), ReadError> {
        let live = self.placed.iter().filter(|placed| placed.live);
        self.live = alloc::vec![INVALID; live.clone().count()];
        for placed in live {
            self.meshes[placed.mesh as usize].users.push(INVALID);
        }
        for (index, placed) in (0..).zip(&self.placed).filter(|(_, placed)| placed.live) {
            let users = &mut self.meshes[placed.mesh as usize].users;
            for (list, at) in [(users, placed.user), (&mut self.live, placed.listed)] {
                match list.get_mut(at as usize) {
                    Some(entry) if *entry == INVALID => *entry = index,
                    _ => return Err(LISTS),
                }
            }
        }
        Ok(())
    }

    /// Which numbers of lights are free.
    fn restore_lights(&mut self, header: &Header) -> Result<(), ReadError> {
        let live = self.placed.iter().filter(|placed| placed.live);
        let mut used: Vec<Range<u32>> = live.map(|placed| placed.lights.clone()).collect();
        self.light_count = used.iter().map(ExactSizeIterator::len).sum();
        let waiting = &self.removed_lights[usize::from(self.forgotten)..];
        self.waiting_lights = waiting.iter().map(ExactSizeIterator::len).sum();
        used.extend_from_slice(waiting);
        self.lights = taken(header.lights, used, "lights")?;
        if header.lights != self.light_end() {
            return Err(ReadError::Places {
                what: "the end of the lights' numbers",
            });
        }
        Ok(())
    }

    fn restore_bottoms(&mut self, behind: &[u32]) -> Result<(), ReadError> {
        self.trail_words = trail_words(W, self.bottom_depth);
        self.trails = alloc::vec![0; self.triangles.len() * self.trail_words as usize];
        self.roots = alloc::vec![BlasRoot::new(INVALID, &N::Summary::EMPTY); self.blases.len()];
        let mut seen = alloc::vec![false; self.nodes.len()];
        let mut leaves = alloc::vec![false; self.triangles.len()];
        for index in 0..self.blases.len() {
            let (range, triangles) = (
                self.blases[index].nodes.clone(),
                self.blases[index].triangles.clone(),
            );
            if range.is_empty() {
                continue;
            }
            let found = self
                .walk(range.start, kind::LIGHT, &mut seen)
                .map_err(ReadError::Tree)?;
            self.is_depth_first(&range, &found)?;
            if found.depth > self.bottom_depth || found.leaves.len() != triangles.len() {
                return Err(NODES);
            }
            for &(triangle, _, _, trail) in &found.leaves {
                // As many as there are triangles, each for the first time: so all of them.
                if !triangles.contains(&triangle) || core::mem::replace(&mut leaves[triangle as usize], true)
                {
                    return Err(NODES);
                }
                let at = triangle as usize * self.trail_words as usize;
                self.trails[at] = trail.low;
                if self.trail_words == 2 {
                    self.trails[at + 1] = trail.high;
                }
            }
            self.blases[index].depth = found.depth;
            self.blases[index].levels = Levels::gather(found.levels);
            sweep::bottom_sweep(
                &mut self.nodes[range.start as usize..range.end as usize],
                range.start,
                &self.triangles,
                &[range.start],
            );
            self.roots[index] = refit::root(&self.nodes, range.start);
            self.judge_range(range, true);
        }
        self.restore_parts(behind)
    }

    /// What is known of opened meshes' parts, whose places hold nothing else.
    fn restore_parts(&mut self, behind: &[u32]) -> Result<(), ReadError> {
        let opened = (0u32..).zip(&self.placed);
        for (index, placed) in opened.filter(|(_, placed)| placed.live && !placed.parts.is_empty()) {
            let blas = self.blas_index(placed);
            // They are in order.
            let blas = match self.blases[blas as usize].outgoing {
                Some(outgoing) if behind.binary_search(&index).is_ok() => outgoing.blas,
                _ => blas,
            } as usize;
            self.blases[blas].opened += 1;
            if placed.parts.len() != self.blases[blas].parts.len() {
                return Err(PARTS);
            }
        }
        for blas in 0..self.blases.len() as u32 {
            let own = &self.blases[blas as usize];
            if own.nodes.is_empty() {
                continue;
            }
            let root = &self.nodes[own.nodes.start as usize];
            let count = if own.opened > 0 {
                parts_below::<N, W>(root)
            } else {
                0
            };
            if own.parts.len() as u32 != count || (own.opened > 0 && count == 0) {
                return Err(PARTS);
            }
            self.place_parts(blas);
        }
        Ok(())
    }

    /// Whether the nodes found are those of `range`, and those below any one of them follow it without a gap: what a sweep needs.
    fn is_depth_first(&self, range: &Range<u32>, found: &Found) -> Result<(), ReadError> {
        if found.levels.len() != range.len() || found.levels.iter().any(|(_, node)| !range.contains(node)) {
            return Err(NODES);
        }
        // By node of the range: how many are below it and itself, and the end of their range.
        let mut below: Vec<(u32, u32)> = range.clone().map(|node| (1, node + 1)).collect();
        for node in range.clone().rev() {
            let (count, end) = below[(node - range.start) as usize];
            let parent = self.parents[node as usize];
            // A node before its parent is counted by nothing above: then the root has too few.
            if end - node != count {
                return Err(NODES);
            }
            if node != range.start {
                let above = &mut below[(parent - range.start) as usize];
                *above = (above.0 + count, above.1.max(end));
            }
        }
        Ok(())
    }

    fn restore_top(&mut self, behind: &[u32]) -> Result<(), ReadError> {
        self.instances = alloc::vec![NO_INSTANCE; self.placed.len()];
        for (instance, &listed) in self.instances.iter_mut().zip(&self.live) {
            instance.listed = listed;
        }
        for index in self.live.clone() {
            let parts = self.placed[index as usize].parts.clone();
            for part in parts.clone() {
                self.put_part(part, index, self.placed[part as usize].hung_words());
            }
            if !parts.is_empty() {
                self.instances[index as usize].part = parts.start;
            }
            self.put_words(index);
        }
        for &index in behind {
            self.put_behind(index);
        }
        let mut seen = alloc::vec![false; self.nodes.len()];
        let found = self
            .walk(self.top.root, kind::MESH, &mut seen)
            .map_err(ReadError::Tree)?;
        let mut leaves = alloc::vec![false; self.placed.len()];
        for &(instance, ..) in &found.leaves {
            let is_leaf = (instance as usize) < self.placed.len() && self.is_leaf(instance);
            if !is_leaf || core::mem::replace(&mut leaves[instance as usize], true) {
                return Err(LISTS);
            }
        }
        // Each is in one place at most, and so in a place of its own. No two of the listed nodes are one, or they would overlap.
        let mut is_listed = alloc::vec![false; self.nodes.len()];
        self.top.in_use().for_each(|node| is_listed[node as usize] = true);
        let root = self.top.root;
        let is_branched = |node: u32| {
            (0..W)
                .filter(|&slot| self.nodes[node as usize].kind(slot) != kind::EMPTY)
                .count()
                > 1
        };
        let mut nodes = found.levels.iter().map(|&(_, node)| node);
        // There are fewer nodes than records, unless there are none of these.
        let fits = self.top.nodes.len() <= self.placed.len().max(1);
        let expected = self.live.iter().map(|&index| self.leaves_of(index).len());
        if found.leaves.len() != expected.sum::<usize>()
            || found.levels.len() != self.top.len()
            || !fits
            || !nodes.all(|node| is_listed[node as usize] && (node == root || is_branched(node)))
        {
            return Err(NODES);
        }
        self.index_top();
        let levels = self.top.by_height();
        for range in levels.ranges() {
            let nodes = &levels.nodes()[range];
            sweep::top(&mut self.nodes, &self.instances, &self.roots, nodes);
        }
        Ok(())
    }

    /// Whether it is one mesh that stands where it is.
    fn check_single(&self) -> Result<(), ReadError> {
        let is_alone = match (&*self.placed, &*self.meshes) {
            ([placed], [mesh]) => {
                placed.live
                    && mesh.blas == 0
                    && placed.transform == Transform::IDENTITY
                    && placed.radiance == 1.0
                    && placed.lights.start == 0
                    && self.blases[0].triangles.start == 0
            }
            // Over no lights.
            ([], []) => true,
            _ => false,
        };
        if is_alone {
            Ok(())
        } else {
            Err(ReadError::Places {
                what: "the single level",
            })
        }
    }
}

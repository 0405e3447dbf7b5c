//! The invariants of a scene, checked one by one; the first that does not hold is named.

mod violation;
mod walk;

use crate::model::Model;
use alloc::vec::Vec;
use core::ops::Range;

pub use self::violation::Violation;
use self::violation::{equal, same_words};
pub(super) use self::walk::Found;
use super::apply::NO_INSTANCE;
use super::{Bvh, View};
use crate::instance::Instance;
use crate::light::Light;
use crate::node::{Node, kind};
use crate::refit;
use crate::summary::Summary;
use crate::trail::{leaf_parts, place};
use crate::tree::{INVALID, OPENED};

impl<M: Model<W>, const W: usize> View<'_, M, W> {
    /// Checks every invariant, after a [`refit`](Bvh::refit):
    /// - each node in use is reached once, through links that are in range, and knows its place above;
    /// - each live instance, or each of its parts, is a leaf of the top level exactly once, each light of a mesh a leaf of its
    ///   tree exactly once, and their trails lead there;
    /// - the nodes of a mesh are in depth-first order; heights are those of what is below;
    /// - every node of the top level but its root has two children or more;
    /// - ranges of nodes and of numbers of lights do not overlap;
    /// - no path is longer than [`depth`](Self::depth), and [`light_count`](Self::light_count) counts the lights;
    /// - an instance's words are those of its transform and mesh, and its leaf in the top level is that of a refit;
    /// - every word of every node is what refit makes of lights and instances from scratch.
    ///
    /// It trusts no word, runs on the CPU alone, takes time linear in the number of nodes, and needs as much memory again as the
    /// tree.
    ///
    /// # Errors
    /// The first [`Violation`].
    pub fn validate(&self) -> Result<(), Violation> {
        let bvh = self.0;
        let mut seen = alloc::vec![false; bvh.nodes.len()];
        let (mut used_nodes, mut used_lights, mut lights, mut depth) = (Vec::new(), Vec::new(), 0, 0);
        let mut again = alloc::vec![M::Node::EMPTY; bvh.nodes.len()];
        for (index, mesh) in (0u32..).zip(&bvh.meshes).filter(|(_, mesh)| mesh.live) {
            let found = bvh.check_mesh(index, &mut seen, &mut again)?;
            depth = depth.max(found.depth);
            used_nodes.push(mesh.nodes.start..mesh.capacity);
        }
        disjoint(used_nodes)?;
        for (index, placed) in (0u32..).zip(&bvh.placed) {
            if placed.live {
                lights += placed.numbers.end - placed.numbers.start;
                used_lights.push(placed.numbers.clone());
                bvh.check_instance(index)?;
            } else {
                let record = &bvh.instances[index as usize];
                let nothing = Instance {
                    listed: record.listed,
                    ..NO_INSTANCE
                };
                same_words(INVALID, index, &nothing, record)?;
            }
            if index as usize >= bvh.live.len() {
                let listed = bvh.instances[index as usize].listed;
                equal(INVALID, index, "list entry", NO_INSTANCE.listed, listed)?;
            }
        }
        disjoint(used_lights)?;
        if !bvh.single || bvh.meshes.is_empty() {
            depth += bvh.check_top()?.depth;
        }
        equal(INVALID, INVALID, "lights", lights, bvh.light_count as u32)?;
        equal(INVALID, INVALID, "depth", depth.max(self.depth()), self.depth())
    }
}

impl<M: Model<W>, const W: usize> Bvh<M, W> {
    /// The tree of a mesh, its trails, and every word of its nodes. Each of its lights is in one leaf, and of this mesh: no two meshes
    /// have one.
    fn check_mesh(&self, index: u32, seen: &mut [bool], again: &mut [M::Node]) -> Result<Found, Violation> {
        let mesh = &self.meshes[index as usize];
        let root = self.roots[index as usize].node;
        equal(root, INVALID, "root", mesh.root(), root)?;
        equal(
            INVALID,
            index,
            "flux by area",
            u32::from(self.goes_by_area(index)),
            u32::from(mesh.is_by_area),
        )?;
        let expected = self.root_of(index);
        same_words(INVALID, index, &expected, &self.roots[index as usize])?;
        let is_alone = self.is_alone(mesh.lights.len());
        equal(
            INVALID,
            index,
            "nodes",
            u32::from(!is_alone),
            u32::from(root != INVALID),
        )?;
        if is_alone {
            let owner = self.lights[mesh.lights.start as usize].mesh();
            equal(INVALID, index, "light's mesh", index, owner)?;
            return Ok(Found::default());
        }
        let found = Found::of(&self.nodes, root, kind::LIGHT, seen)?;
        found.check_depth_first(&mesh.nodes)?;
        equal(root, INVALID, "level", found.depth, mesh.depth)?;
        let mut times = alloc::vec![0u32; mesh.lights.len()];
        for own in &found.leaves {
            let (node, slot) = (own.node, own.slot);
            if !mesh.lights.contains(&own.link) {
                return Err(Violation::new(
                    node,
                    slot,
                    "light's mesh",
                    mesh.lights.start,
                    own.link,
                ));
            }
            times[(own.link - mesh.lights.start) as usize] += 1;
            let trail = self.trail_of(own.link);
            equal(node, slot, "low trail word", own.trail.low, trail.low)?;
            equal(node, slot, "high trail word", own.trail.high, trail.high)?;
            let light = &self.lights[own.link as usize];
            equal(node, slot, "light's mesh", index, light.mesh())?;
        }
        for (triangle, &count) in mesh.lights.clone().zip(&times) {
            equal(INVALID, triangle, "triangle's leaves", 1, count)?;
        }
        bare(again, &self.nodes, &found);
        for node in found.upward() {
            again[node as usize] = refit::bottom(again, &self.lights, node);
            same_words(node, INVALID, &again[node as usize], &self.nodes[node as usize])?;
        }
        Ok(found)
    }

    /// An instance's words against its transform and mesh.
    fn check_instance(&self, index: u32) -> Result<(), Violation> {
        let placed = &self.placed[index as usize];
        let found = &self.instances[index as usize];
        let mesh = &self.meshes[placed.mesh as usize];
        let count = mesh.lights.len() as u32;
        let lights = placed.numbers.end - placed.numbers.start;
        equal(INVALID, index, "range of lights", count, lights)?;
        same_words(INVALID, index, &self.record_of(index), found)?;
        let user = mesh.users.get(placed.user as usize).copied();
        equal(INVALID, index, "list entry", index, user.unwrap_or(INVALID))?;
        let listed = self.live.get(placed.listed as usize).copied();
        equal(INVALID, index, "list entry", index, listed.unwrap_or(INVALID))?;
        let listed = self.instances[placed.listed as usize].listed;
        equal(INVALID, index, "list entry", index, listed)
    }

    /// Leaves, links upward, heights and words of the top level.
    fn check_top(&self) -> Result<Found, Violation> {
        let top = &self.top;
        let mut seen = alloc::vec![false; top.nodes.len()];
        let found = Found::of(&top.nodes, top.root, kind::MESH, &mut seen)?;
        let mut times = alloc::vec![0u32; self.placed.len()];
        for own in &found.leaves {
            let (node, slot) = (own.node, own.slot);
            let (instance, part) = leaf_parts(own.link);
            let is_live = self
                .placed
                .get(instance as usize)
                .is_some_and(|placed| placed.live);
            if !is_live || !top.links_of(instance).contains(&part) {
                return Err(Violation::new(node, slot, "instance's leaf", INVALID, own.link));
            }
            times[instance as usize] += 1;
            let at = place::<W>(node, slot);
            equal(node, slot, "place above", at, top.place_of(instance, part))?;
            let known = top.leaf(own.link);
            let expected = self.leaf_of(own.link);
            for (e, f) in expected.summary.to_words().iter().zip(known.summary.to_words()) {
                equal(node, slot, "instance's leaf", e.to_bits(), f.to_bits())?;
            }
        }
        for (index, placed) in (0u32..).zip(&self.placed) {
            let leaves = if placed.live {
                top.links_of(index).len() as u32
            } else {
                let place = top.places.get(index as usize).copied().unwrap_or(INVALID);
                equal(INVALID, index, "place above", INVALID, place)?;
                0
            };
            equal(INVALID, index, "instance's leaf", leaves, times[index as usize])?;
        }
        for (&instance, own) in top.opened.iter().filter(|(_, own)| own.first != INVALID) {
            let place = top.places[instance as usize];
            equal(INVALID, instance, "parts", OPENED | own.first, place)?;
        }
        // Those of meshes come first.
        let first = self.nodes.len();
        let mut again = self.nodes.clone();
        again.resize(first + top.nodes.len(), M::Node::EMPTY);
        bare(&mut again[first..], &top.nodes, &found);
        for node in found.upward() {
            let (first, at) = (first as u32, first + node as usize);
            again[at] = refit::top(&again, first, &self.lights, &self.instances, at as u32);
            same_words(node, INVALID, &again[at], &top.nodes[node as usize])?;
            let own = &top.nodes[node as usize];
            let inner = (0..W).filter(|&slot| own.kind(slot) == kind::INNER);
            let height = inner
                .map(|slot| 1 + top.shapes[own.link(slot) as usize].height)
                .max();
            let shape = &top.shapes[node as usize];
            for (e, f) in again[at].merged().to_words().iter().zip(shape.words) {
                equal(node, INVALID, "instance's leaf", e.to_bits(), f.to_bits())?;
            }
            equal(node, INVALID, "level", height.unwrap_or(1), shape.height)?;
            let children = (0..W).filter(|&slot| own.kind(slot) != kind::EMPTY).count() as u32;
            if node != top.root {
                equal(node, INVALID, "children", children.max(2), children)?;
            }
            for slot in (0..W).filter(|&slot| own.kind(slot) == kind::INNER) {
                let at = place::<W>(node, slot as u32);
                let above = top.above[own.link(slot) as usize];
                equal(node, slot as u32, "place above", at, above)?;
            }
        }
        let root = top.root;
        equal(root, INVALID, "place above", INVALID, top.above[root as usize])?;
        let used = top.shapes.iter().filter(|shape| shape.height > 0).count();
        let listed = top.nodes.len() - top.free.len();
        equal(
            INVALID,
            INVALID,
            "list entry",
            found.levels.len() as u32,
            used as u32,
        )?;
        equal(INVALID, INVALID, "list entry", used as u32, listed as u32)?;
        Ok(found)
    }

    /// Live instances that are not in the tree. A BVH that was read from words may have some before its next edit.
    pub(super) fn unplaced(&self) -> Vec<u32> {
        let live = (0u32..).zip(&self.placed).filter(|(_, placed)| placed.live);
        let is_out = |index: u32| {
            let mut links = self.top.links_of(index);
            links.any(|part| self.top.place_of(index, part) == INVALID)
        };
        live.map(|(index, _)| index)
            .filter(|&index| is_out(index))
            .collect()
    }
}

/// Puts the nodes found into `again`, with kinds and links alone.
fn bare<N: Node<W>, const W: usize>(again: &mut [N], nodes: &[N], found: &Found) {
    for &(_, node) in &found.levels {
        let own = &nodes[node as usize];
        for slot in 0..W {
            again[node as usize].set_child(slot, own.kind(slot), own.link(slot));
        }
    }
}

fn disjoint(mut ranges: Vec<Range<u32>>) -> Result<(), Violation> {
    ranges.sort_unstable_by_key(|range| (range.start, range.end));
    for pair in ranges.windows(2) {
        if pair[0].end > pair[1].start {
            return Err(Violation::new(
                INVALID,
                INVALID,
                "range of lights",
                pair[0].end,
                pair[1].start,
            ));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests;

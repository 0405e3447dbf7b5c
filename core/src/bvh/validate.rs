//! The invariants of a scene, checked one by one; the first that does not hold is named.

mod walk;

use alloc::vec::Vec;
use core::ops::Range;

pub(super) use self::walk::Found;
use self::walk::{bad, listed};
use super::apply::NO_INSTANCE;
use super::{Bvh, Trails};
use crate::instance::Instance;
use crate::light::Light;
use crate::node::{Node, kind};
use crate::refit;
use crate::trail::place;
use crate::tree::INVALID;
use crate::validate::{Violation, What, contained, equal, same_words};

/// What a valid scene consists of.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Stats {
    /// Nodes in use.
    pub nodes: u32,
    /// Instances in use.
    pub instances: u32,
    /// Bottom levels in use.
    pub blases: u32,
    /// Lights in the world.
    pub lights: u32,
    /// Greatest number of nodes on a path from the root to a light.
    pub depth: u32,
}

impl<N: Node<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// Checks every invariant, after a [`refit`](Self::refit):
    /// - each node in use is reached once, through links that are in range, and knows its parent;
    /// - each live instance is a leaf of the top level exactly once, each triangle of a bottom level a leaf of it exactly
    ///   once, and their trails lead there;
    /// - the lists of levels are complete and run from the deepest level to the root; heights and counts are those of what is
    ///   below;
    /// - every node of the top level but its root has two children or more;
    /// - ranges of nodes, triangles and lights in use do not overlap;
    /// - an instance's words are those of its transform, mesh and bottom level;
    /// - every word of every bounds is what refit makes of triangles and instances from scratch;
    /// - where nodes hold bounds (Eq. 4), a child's box, cone and flux lie within its parent's.
    ///
    /// # Errors
    /// The first [`Violation`].
    pub fn validate(&self) -> Result<Stats, Violation> {
        let mut seen = alloc::vec![false; self.nodes.len()];
        let mut again: Vec<N> = alloc::vec![N::EMPTY; self.nodes.len()];
        let mut used_triangles: Vec<Range<u32>> = Vec::new();
        let mut blases = 0;
        let mut bottom_depth = 0;

        for (index, blas) in self
            .blases
            .iter()
            .enumerate()
            .filter(|(_, b)| !b.nodes.is_empty())
        {
            blases += u32::from(!blas.is_outgoing);
            let root = self.roots[index].node;
            equal(root, INVALID, What::Root, blas.nodes.start, root)?;
            let found = self.walk(root, kind::LIGHT, &mut seen)?;
            bottom_depth = bottom_depth.max(found.depth);
            let mut times = alloc::vec![0u32; blas.triangles.len()];
            for &(link, node, slot, trail) in &found.leaves {
                if !blas.triangles.contains(&link) {
                    return Err(bad(node, slot, What::Owner, blas.triangles.start, link));
                }
                times[(link - blas.triangles.start) as usize] += 1;
                if T::KEPT {
                    let own = self.trail_of(link);
                    equal(node, slot, What::TrailLow, trail.low, own.low)?;
                    equal(node, slot, What::TrailHigh, trail.high, own.high)?;
                }
                let owner = self.triangles[link as usize].mesh();
                equal(node, slot, What::Owner, index as u32, owner)?;
            }
            self.check_powers(index as u32)?;
            for (triangle, &count) in (blas.triangles.start..).zip(&times) {
                equal(INVALID, triangle, What::Triangle, 1, count)?;
            }
            self.refit_again(&found, &mut again, false);
            same_words(
                INVALID,
                index as u32,
                &refit::root(&again, root),
                &self.roots[index],
            )?;
            self.check_parts(index as u32, &again)?;
            listed(&self.levels_of(index as u32), &found)?;
            used_triangles.push(blas.triangles.clone());
        }
        disjoint(used_triangles)?;

        let found = self.walk(self.top.root, kind::MESH, &mut seen)?;
        let mut times = alloc::vec![0u32; self.placed.len()];
        for &(link, node, slot, trail) in &found.leaves {
            if link as usize >= self.placed.len() || !self.is_leaf(link) {
                return Err(bad(node, slot, What::Mesh, INVALID, link));
            }
            times[link as usize] += 1;
            let placed = &self.placed[link as usize];
            equal(node, slot, What::Link, node, placed.node)?;
            equal(node, slot, What::Link, slot, placed.slot)?;
            let own = self.arrays().path_of(INVALID, link).top;
            equal(node, slot, What::TrailLow, trail.low, own.low)?;
            equal(node, slot, What::TrailHigh, trail.high, own.high)?;
            let at = place::<W>(self.top.number(node), slot);
            equal(node, slot, What::Place, at, self.instances[link as usize].place)?;
        }
        for (index, record) in (0..).zip(&self.instances) {
            if !self.is_leaf(index) {
                equal(INVALID, index, What::Place, INVALID, record.place)?;
            }
            if index as usize >= self.live.len() {
                equal(INVALID, index, What::Listed, NO_INSTANCE.listed, record.listed)?;
            }
            let placed = &self.placed[index as usize];
            if !placed.live && placed.part_of == INVALID {
                let nothing = Instance {
                    place: record.place,
                    above: record.above,
                    listed: record.listed,
                    ..NO_INSTANCE
                };
                same_words(INVALID, index, &nothing, record)?;
            }
        }
        self.refit_again(&found, &mut again, true);

        let mut used_lights = Vec::new();
        let mut instances = 0;
        for (index, placed) in (0u32..).zip(&self.placed) {
            equal(
                INVALID,
                index,
                What::Mesh,
                u32::from(self.is_leaf(index)),
                times[index as usize],
            )?;
            if placed.live {
                instances += 1;
                used_lights.push(placed.lights.clone());
                self.check_instance(index)?;
            }
        }
        let lights = used_lights
            .iter()
            .map(|range: &Range<u32>| range.end - range.start)
            .sum();
        disjoint(used_lights)?;
        self.check_top(&found)?;

        let mut nodes = 0;
        for (index, (expected, found)) in (0u32..).zip(again.iter().zip(&self.nodes)) {
            if seen[index as usize] {
                nodes += 1;
                crate::validate::same(index, expected, found)?;
                self.check_children(index)?;
            }
        }
        Ok(Stats {
            nodes,
            instances,
            blases,
            lights,
            depth: bottom_depth + if self.single && blases > 0 { 0 } else { found.depth },
        })
    }

    /// Bounds from scratch, into `again`, of the nodes found.
    fn refit_again(&self, found: &Found, again: &mut [N], top: bool) {
        let mut levels = found.levels.clone();
        levels.sort_unstable_by_key(|&(level, node)| (core::cmp::Reverse(level), node));
        for &(_, node) in &levels {
            let mut bare = N::EMPTY;
            let own = &self.nodes[node as usize];
            for slot in 0..W {
                bare.set_child(slot, own.kind(slot), own.link(slot));
            }
            again[node as usize] = bare;
        }
        for &(_, node) in &levels {
            again[node as usize] = if top {
                refit::top(again, &self.instances, &self.roots, node)
            } else {
                refit::bottom(again, &self.triangles, node)
            };
        }
    }

    /// Whether an instance or a part is a leaf of the top level.
    pub(super) fn is_leaf(&self, index: u32) -> bool {
        let placed = &self.placed[index as usize];
        (placed.live && placed.parts.is_empty()) || placed.part_of != INVALID
    }

    /// What is known of the parts of a bottom level, and how many of its instances have them.
    fn check_parts(&self, index: u32, again: &[N]) -> Result<(), Violation> {
        let blas = &self.blases[index as usize];
        let users = self.meshes[blas.mesh as usize].users.iter();
        let users = users.filter(|&&user| self.instances[user as usize].blas == index);
        if let Some(outgoing) = blas.outgoing {
            let followers = self.meshes[blas.mesh as usize].users.len() - users.clone().count();
            equal(INVALID, index, What::Blas, followers as u32, outgoing.left)?;
            equal(INVALID, index, What::Blas, 1, outgoing.left.min(1))?;
        }
        let opened = users
            .filter(|&&user| !self.placed[user as usize].parts.is_empty())
            .count();
        let slot = blas.parts.start;
        equal(INVALID, slot, What::Parts, blas.opened, opened as u32)?;
        let root = &self.nodes[blas.nodes.start as usize];
        let count = if opened > 0 {
            super::opened::parts_below::<N, W>(root)
        } else {
            0
        };
        equal(INVALID, slot, What::Parts, count, blas.parts.len() as u32)?;
        for (part, slot) in blas.parts.clone().zip(0..) {
            let expected = refit::root(again, root.link(slot));
            same_words(INVALID, part, &expected, &self.roots[part as usize])?;
        }
        Ok(())
    }

    /// An instance's words against its transform, mesh and bottom level.
    fn check_instance(&self, index: u32) -> Result<(), Violation> {
        let placed = &self.placed[index as usize];
        let found = &self.instances[index as usize];
        let blas = match self.blas_of(placed).outgoing {
            Some(outgoing) if outgoing.blas == found.blas => outgoing.blas,
            _ => self.blas_index(placed),
        };
        let own = &self.blases[blas as usize];
        equal(INVALID, index, What::Blas, blas, found.blas)?;
        equal(
            INVALID,
            index,
            What::Root,
            self.roots[blas as usize].node,
            found.root,
        )?;
        equal(INVALID, index, What::First, placed.lights.start, found.first)?;
        equal(
            INVALID,
            index,
            What::First,
            own.triangles.start,
            found.first_triangle,
        )?;
        let count = own.triangles.end - own.triangles.start;
        equal(
            INVALID,
            index,
            What::First,
            count,
            placed.lights.end - placed.lights.start,
        )?;
        let expected = Instance {
            root: found.root,
            place: found.place,
            above: found.above,
            blas: found.blas,
            first: found.first,
            first_triangle: found.first_triangle,
            count,
            listed: found.listed,
            part: if placed.parts.is_empty() {
                INVALID
            } else {
                placed.parts.start
            },
            ..self.in_place(blas, placed.transform, placed.radiance)
        };
        same_words(INVALID, index, &expected, found)?;
        if !placed.parts.is_empty() {
            equal(
                INVALID,
                index,
                What::Parts,
                own.parts.len() as u32,
                placed.parts.len() as u32,
            )?;
        }
        for (part, blas) in placed.parts.clone().zip(own.parts.clone()) {
            let found = &self.instances[part as usize];
            equal(
                INVALID,
                part,
                What::Parts,
                index,
                self.placed[part as usize].part_of,
            )?;
            let words = Instance {
                root: self.roots[blas as usize].node,
                blas,
                count: 0,
                part: index,
                listed: found.listed,
                place: found.place,
                above: found.above,
                ..expected
            };
            same_words(INVALID, part, &words, found)?;
        }
        equal(
            INVALID,
            index,
            What::Listed,
            self.live[placed.listed as usize],
            index,
        )?;
        equal(
            INVALID,
            index,
            What::Listed,
            index,
            self.instances[placed.listed as usize].listed,
        )
    }

    /// Numbers, heights, counts and links upward of the top level's nodes, as a walk found them. Every node but the root has two
    /// children or more.
    fn check_top(&self, found: &Found) -> Result<(), Violation> {
        let top = &self.top;
        equal(
            INVALID,
            INVALID,
            What::Listed,
            found.levels.len() as u32,
            top.len() as u32,
        )?;
        let mut levels = found.levels.clone();
        levels.sort_unstable_by_key(|&(level, node)| (core::cmp::Reverse(level), node));
        let mut measured = alloc::vec![(0, 0); top.nodes.len()];
        for &(_, node) in &levels {
            let number = top.number(node);
            let listed = top.nodes.get(number as usize).copied().unwrap_or(INVALID);
            equal(node, INVALID, What::Listed, node, listed)?;
            let own = &self.nodes[node as usize];
            let (mut height, mut count, mut children) = (1, 0, 0);
            for slot in 0..W {
                let link = own.link(slot);
                if own.kind(slot) == kind::INNER {
                    let (below, instances): (u32, u32) = measured[top.number(link) as usize];
                    (height, count) = (height.max(below + 1), count + instances);
                    let above = place::<W>(number, slot as u32);
                    let record = self.instances.get(top.number(link) as usize);
                    equal(
                        node,
                        slot as u32,
                        What::Place,
                        above,
                        record.map_or(0, |record| record.above),
                    )?;
                } else if own.kind(slot) == kind::MESH {
                    count += 1;
                }
                children += u32::from(own.kind(slot) != kind::EMPTY);
            }
            measured[number as usize] = (height, count);
            equal(
                node,
                INVALID,
                What::ListedLevel,
                height,
                top.heights[number as usize],
            )?;
            equal(node, INVALID, What::Listed, count, top.counts[number as usize])?;
            if node != top.root {
                equal(node, INVALID, What::Children, children.max(2), children)?;
            }
        }
        for (number, record) in (0..).zip(&self.instances) {
            let node = top.nodes.get(number as usize).copied().unwrap_or(INVALID);
            if node == INVALID || node == top.root {
                equal(INVALID, number, What::Place, INVALID, record.above)?;
            }
        }
        Ok(())
    }

    /// The children of what `node` links to lie within what it holds of them.
    fn check_children(&self, node: u32) -> Result<(), Violation> {
        let own = &self.nodes[node as usize];
        for slot in 0..W {
            if own.kind(slot) == kind::INNER {
                let child = own.link(slot);
                contained(&own.summary(slot), child, &self.nodes[child as usize])?;
            }
        }
        Ok(())
    }
}

fn disjoint(mut ranges: Vec<Range<u32>>) -> Result<(), Violation> {
    ranges.sort_unstable_by_key(|range| (range.start, range.end));
    for pair in ranges.windows(2) {
        if pair[0].end > pair[1].start {
            return Err(bad(INVALID, INVALID, What::First, pair[0].end, pair[1].start));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests;

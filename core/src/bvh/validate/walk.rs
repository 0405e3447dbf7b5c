//! A tree as a walk over its links finds it.

use alloc::vec::Vec;

use crate::bvh::{Bvh, Trails};
use crate::levels::Levels;
use crate::node::{Node, kind};
use crate::trail::{BitTrail, max_levels};
use crate::tree::INVALID;
use crate::validate::{Violation, What, equal};

/// A tree that is walked: its nodes in order of the walk, and what was found.
pub(in crate::bvh) struct Found {
    /// Nodes by level.
    pub levels: Vec<(u32, u32)>,
    /// (leaf's link, node, slot, trail).
    pub leaves: Vec<(u32, u32, u32, BitTrail)>,
    pub depth: u32,
}

impl<N: Node<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// Walks the tree below `root`, whose leaves are to be of `leaf` kind.
    pub(in crate::bvh) fn walk(&self, root: u32, leaf: u32, seen: &mut [bool]) -> Result<Found, Violation> {
        let mut found = Found {
            levels: Vec::new(),
            leaves: Vec::new(),
            depth: 0,
        };
        let mut stack = alloc::vec![(root, (INVALID, INVALID), 0, BitTrail::default())];
        while let Some((node, (parent, slot), level, trail)) = stack.pop() {
            if node as usize >= self.nodes.len() {
                return Err(bad(parent, slot, What::Link, self.nodes.len() as u32 - 1, node));
            }
            if level >= max_levels(W) {
                return Err(bad(node, INVALID, What::Level, max_levels(W) - 1, level));
            }
            equal(
                node,
                INVALID,
                What::Reached,
                1,
                1 + u32::from(seen[node as usize]),
            )?;
            seen[node as usize] = true;
            equal(node, INVALID, What::Link, parent, self.parents[node as usize])?;
            found.levels.push((level, node));
            found.depth = found.depth.max(level + 1);
            let own = &self.nodes[node as usize];
            for slot in 0..W {
                let (to, link) = (own.kind(slot), own.link(slot));
                let own_trail = trail.with::<W>(level, slot as u32);
                if to == kind::INNER {
                    stack.push((link, (node, slot as u32), level + 1, own_trail));
                } else if to == leaf {
                    found.leaves.push((link, node, slot as u32, own_trail));
                } else {
                    equal(node, slot as u32, What::Kind, kind::EMPTY, to)?;
                    equal(node, slot as u32, What::Link, 0, link)?;
                }
            }
        }
        Ok(found)
    }
}

/// Whether a list of levels has each node of a tree once, in its level, from the deepest level to the root.
pub(super) fn listed(levels: &Levels, found: &Found) -> Result<(), Violation> {
    let mut expected = found.levels.clone();
    expected.sort_unstable_by_key(|&(level, node)| (core::cmp::Reverse(level), node));
    let mut own = Vec::new();
    for (level, range) in (0..found.depth).rev().zip(levels.ranges()) {
        let first = own.len();
        own.extend(levels.nodes()[range].iter().map(|&node| (level, node)));
        own[first..].sort_unstable();
    }
    equal(
        INVALID,
        INVALID,
        What::Listed,
        expected.len() as u32,
        levels.nodes().len() as u32,
    )?;
    equal(
        INVALID,
        INVALID,
        What::Listed,
        expected.len() as u32,
        own.len() as u32,
    )?;
    for (&(level, node), &(own_level, own_node)) in expected.iter().zip(&own) {
        equal(node, INVALID, What::Listed, node, own_node)?;
        equal(node, INVALID, What::ListedLevel, level, own_level)?;
    }
    Ok(())
}

pub(super) fn bad(node: u32, slot: u32, what: What, expected: u32, found: u32) -> Violation {
    Violation {
        node,
        slot,
        what,
        expected,
        found,
    }
}

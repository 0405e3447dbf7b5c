//! A tree as a walk over its links finds it.

use alloc::vec::Vec;
use core::ops::Range;

use super::violation::{Violation, equal};
use crate::node::{Node, kind};
use crate::trail::{BitTrail, max_levels};
use crate::tree::INVALID;

/// A leaf as a walk comes to it.
#[derive(Clone, Copy, Debug)]
pub(in crate::bvh) struct FoundLeaf {
    pub link: u32,
    pub node: u32,
    pub slot: u32,
    pub trail: BitTrail,
}

/// A tree that is walked: its nodes in order of the walk, and what was found.
#[derive(Clone, Debug, Default)]
pub(in crate::bvh) struct Found {
    /// (level, node).
    pub levels: Vec<(u32, u32)>,
    /// By entry of `levels`: the node above, [`INVALID`] for the root.
    pub above: Vec<u32>,
    pub leaves: Vec<FoundLeaf>,
    pub depth: u32,
}

impl Found {
    /// Walks the tree below `root`, whose leaves are to be of `leaf` kind.
    pub fn of<N: Node<W>, const W: usize>(
        nodes: &[N],
        root: u32,
        leaf: u32,
        seen: &mut [bool],
    ) -> Result<Self, Violation> {
        let mut found = Self::default();
        let mut stack = alloc::vec![(root, (INVALID, INVALID), 0, BitTrail::default())];
        while let Some((node, (parent, slot), level, trail)) = stack.pop() {
            if node as usize >= nodes.len() {
                let last = (nodes.len() as u32).wrapping_sub(1);
                return Err(Violation::new(parent, slot, "link", last, node));
            }
            if level >= max_levels(W) {
                return Err(Violation::new(node, INVALID, "level", max_levels(W) - 1, level));
            }
            equal(
                node,
                INVALID,
                "times reached",
                1,
                1 + u32::from(seen[node as usize]),
            )?;
            seen[node as usize] = true;
            found.levels.push((level, node));
            found.above.push(parent);
            found.depth = found.depth.max(level + 1);
            let own = &nodes[node as usize];
            for slot in 0..W {
                let (to, link) = (own.kind(slot), own.link(slot));
                let own_trail = trail.with::<W>(level, slot as u32);
                if to == kind::INNER {
                    stack.push((link, (node, slot as u32), level + 1, own_trail));
                } else if to == leaf {
                    found.leaves.push(FoundLeaf {
                        link,
                        node,
                        slot: slot as u32,
                        trail: own_trail,
                    });
                } else {
                    equal(node, slot as u32, "kind", kind::EMPTY, to)?;
                    equal(node, slot as u32, "link", 0, link)?;
                }
            }
        }
        Ok(found)
    }

    /// Whether the nodes are those of `range`, and those below any one of them follow it without a gap: what a sweep needs.
    pub fn check_depth_first(&self, range: &Range<u32>) -> Result<(), Violation> {
        let start = range.start;
        let count = self.levels.len() as u32;
        equal(start, INVALID, "list entry", range.len() as u32, count)?;
        let mut above = alloc::vec![INVALID; range.len()];
        for (&(_, node), &parent) in self.levels.iter().zip(&self.above) {
            if !range.contains(&node) {
                return Err(Violation::new(node, INVALID, "list entry", start, node));
            }
            above[(node - start) as usize] = parent;
        }
        // By node: how many are below it and itself, and the end of their range.
        let mut below: Vec<(u32, u32)> = range.clone().map(|node| (1, node + 1)).collect();
        for node in range.clone().rev() {
            let (count, end) = below[(node - start) as usize];
            // A node before its parent is counted by nothing above: then the root has too few.
            equal(node, INVALID, "list entry", end - node, count)?;
            if node != start {
                let above = &mut below[(above[(node - start) as usize] - start) as usize];
                *above = (above.0 + count, above.1.max(end));
            }
        }
        Ok(())
    }

    /// The nodes from the deepest level to the root.
    pub fn upward(&self) -> Vec<u32> {
        let mut levels = self.levels.clone();
        levels.sort_unstable_by_key(|&(level, node)| (core::cmp::Reverse(level), node));
        levels.into_iter().map(|(_, node)| node).collect()
    }
}

//! Refit without levels: from the lowest nodes upward, each node by whoever comes to it last.
//!
//! An invocation computes a node and goes on to the node above, where it counts as arrived; all but the last to arrive end
//! there (Karras, "Maximizing parallelism in the construction of BVHs, octrees, and k-d trees", HPG 2012, section 4). A tree
//! is then refitted by one dispatch. Who is last differs from run to run, what is computed does not: children are merged
//! in slot order, as [`refit::level`](crate::refit::level) does it for either way.
//!
//! A climb starts below a lowest node with inner children, not at each node without: its invocation first gives the nodes
//! that hold lights their bounds. That has fewer invocations, but all of a group do the same for most of the time. The
//! bounds of lights in nodes higher up are the task of some climb that passes there: whoever merges into such a node comes after.

#[cfg(feature = "alloc")]
use alloc::vec::Vec;

use bytemuck::{Pod, Zeroable};

#[cfg(feature = "alloc")]
use crate::node::{LightNode, kind};
#[cfg(feature = "alloc")]
use crate::tree::INVALID;

/// Where an invocation begins.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
pub struct Start {
    /// First of the listed nodes whose leaves it refits.
    pub first: u32,
    /// One past the last of them.
    pub end: u32,
    /// Index of the step that it goes on with, or [`INVALID`](crate::INVALID).
    pub step: u32,
}

/// A node whose inner children are to be merged.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
pub struct Step {
    /// Its index.
    pub node: u32,
    /// Index of the step of the node above it, or [`INVALID`](crate::INVALID).
    pub parent: u32,
    /// How many steps have this one as their parent: the arrivals that it waits for.
    pub children: u32,
}

/// What the invocations of one or more dispatches do.
#[cfg(feature = "alloc")]
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Plan {
    /// One for each invocation.
    pub starts: Vec<Start>,
    /// The nodes whose leaves are refitted, those of one start together.
    pub leaves: Vec<u32>,
    /// The nodes that are merged into.
    pub steps: Vec<Step>,
}

#[cfg(feature = "alloc")]
impl Plan {
    /// Appends the refit of some trees: the leaves of the nodes `leaves`, and the inner children of the nodes `inner`, as
    /// the passes level by level list them. Either may be in any order and repeat. Returns the number of its starts.
    /// `parents` is as [`parents`] makes it.
    pub fn add(&mut self, parents: &[u32], mut leaves: Vec<u32>, mut inner: Vec<u32>) -> u32 {
        for list in [&mut leaves, &mut inner] {
            list.sort_unstable();
            list.dedup();
        }
        let base = self.steps.len() as u32;
        let step_of = |node: u32| inner.binary_search(&node).ok();
        let above = |node: u32| parents.get(node as usize).and_then(|&parent| step_of(parent));
        self.steps.extend(inner.iter().map(|&node| Step {
            node,
            parent: above(node).map_or(INVALID, |step| base + step as u32),
            children: 0,
        }));
        let steps = &mut self.steps[base as usize..];
        for i in 0..steps.len() {
            if steps[i].parent != INVALID {
                steps[(steps[i].parent - base) as usize].children += 1;
            }
        }

        // The climb that passes each step: the first that comes by.
        let mut climbs = Vec::new();
        let mut passes = alloc::vec![INVALID; steps.len()];
        for lowest in (0..steps.len()).filter(|&i| steps[i].children == 0) {
            let climb = climbs.len() as u32;
            climbs.push(base + lowest as u32);
            let mut at = lowest;
            while passes[at] == INVALID {
                passes[at] = climb;
                if steps[at].parent != INVALID {
                    at = (steps[at].parent - base) as usize;
                }
            }
        }
        // Nodes without a step at them or above are climbs of their own. So are, in circles of parents, all without a climb.
        let mut tasks: Vec<(u32, u32)> = Vec::with_capacity(leaves.len());
        for node in leaves {
            let climb = step_of(node)
                .or_else(|| above(node))
                .map_or(INVALID, |step| passes[step]);
            if climb == INVALID {
                tasks.push((climbs.len() as u32, node));
                climbs.push(INVALID);
            } else {
                tasks.push((climb, node));
            }
        }
        tasks.sort_unstable();
        let mut task = 0;
        for (climb, &step) in (0..).zip(&climbs) {
            let first = self.leaves.len() as u32;
            while task < tasks.len() && tasks[task].0 == climb {
                self.leaves.push(tasks[task].1);
                task += 1;
            }
            let end = self.leaves.len() as u32;
            self.starts.push(Start { first, end, step });
        }
        climbs.len() as u32
    }
}

/// By node: the node above it in the same tree, or [`INVALID`]. Links out of range are left out.
#[cfg(feature = "alloc")]
#[must_use]
pub fn parents<N: LightNode<W>, const W: usize>(nodes: &[N]) -> Vec<u32> {
    let mut parents = alloc::vec![INVALID; nodes.len()];
    for (i, node) in (0..).zip(nodes) {
        for slot in (0..W).filter(|&slot| node.kind(slot) == kind::INNER) {
            if let Some(parent) = parents.get_mut(node.link(slot) as usize) {
                *parent = i;
            }
        }
    }
    parents
}

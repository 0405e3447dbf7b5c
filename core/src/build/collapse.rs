//! Which nodes of a binary tree become nodes of a wide one.
//!
//! A wide node takes the place of a binary node and of up to `W − 2` more below it, so that it has `W` children at
//! most. Of all the ways to do that, the cheapest is found bottom-up (after R. Ylitie et al., "Efficient incoherent ray
//! traversal on GPUs through compressed wide BVHs", HPG 2017, section 4): least is the number of nodes that a walk to
//! each of the lights visits, all lights together. That also fills the nodes well.

use alloc::vec::Vec;

use super::binary::{Binary, BinaryTree, LEAF};
use crate::trail::max_levels;

/// How each binary node is to be collapsed.
pub(super) struct Collapse<const W: usize> {
    choices: Vec<Choice<W>>,
}

/// For a binary node that may become at most `j` children of a wide node, `j` from 1 on (entry `j − 1`).
#[derive(Clone, Copy)]
struct Choice<const W: usize> {
    /// How many of the `j` go to its left child when it is dissolved.
    left: [u8; W],
    /// Whether it is dissolved into its children; if not, it becomes one child, a node of its own.
    dissolved: [bool; W],
}

impl<const W: usize> Collapse<W> {
    /// The best collapse of `tree` that fits into `max_levels(W)` levels; the tree itself must fit into
    /// [`binary_levels`].
    pub fn of(tree: &BinaryTree) -> Self {
        let mut best = Self::cheapest(&tree.nodes);
        // Deeper than a trail is long only for absurd trees: then every wide node takes the same number of levels.
        if tree.depth > max_levels(W) && best.height(&tree.nodes, 0) > max_levels(W) {
            best = Self::even(tree.nodes.len());
        }
        best
    }

    fn cheapest(nodes: &[Binary]) -> Self {
        let mut choices = alloc::vec![Self::EVEN; nodes.len()];
        let mut costs = alloc::vec![[0.0_f32; W]; nodes.len()];
        let cost_of = |costs: &[[f32; W]], child: u32, j: usize| {
            if child & LEAF != 0 {
                0.0
            } else {
                costs[child as usize][j - 1]
            }
        };
        // Children come after their parents.
        for (i, node) in nodes.iter().enumerate().rev() {
            let [l, r] = node.children;
            let mut dissolved = [0.0; W];
            let mut choice = Self::EVEN;
            for j in 2..=W {
                let mut least = f32::MAX;
                for a in 1..j {
                    let cost = cost_of(&costs, l, a) + cost_of(&costs, r, j - a);
                    if cost < least {
                        least = cost;
                        choice.left[j - 1] = a as u8;
                    }
                }
                dissolved[j - 1] = least;
            }
            let whole = node.count as f32 + dissolved[W - 1];
            for j in 1..=W {
                choice.dissolved[j - 1] = j > 1 && dissolved[j - 1] <= whole;
                costs[i][j - 1] = if choice.dissolved[j - 1] {
                    dissolved[j - 1]
                } else {
                    whole
                };
            }
            choices[i] = choice;
        }
        Self { choices }
    }

    /// Dissolves every node as evenly as can be.
    const EVEN: Choice<W> = {
        let mut even = Choice {
            left: [1; W],
            dissolved: [true; W],
        };
        let mut j = 1;
        while j <= W {
            even.left[j - 1] = (j / 2) as u8;
            even.dissolved[j - 1] = j > 1;
            j += 1;
        }
        even
    };

    fn even(nodes: usize) -> Self {
        Self {
            choices: alloc::vec![Self::EVEN; nodes],
        }
    }

    /// The children of the wide node in place of binary node `index`, in order, and how many there are.
    pub fn children(&self, nodes: &[Binary], index: u32) -> ([u32; W], usize) {
        let mut out = ([0; W], 0);
        self.dissolve(nodes, index, W, &mut out);
        out
    }

    fn dissolve(&self, nodes: &[Binary], index: u32, j: usize, out: &mut ([u32; W], usize)) {
        let left = self.choices[index as usize].left[j - 1] as usize;
        for (child, j) in nodes[index as usize].children.into_iter().zip([left, j - left]) {
            if child & LEAF == 0 && self.choices[child as usize].dissolved[j - 1] {
                self.dissolve(nodes, child, j, out);
            } else {
                out.0[out.1] = child;
                out.1 += 1;
            }
        }
    }

    /// Levels of wide nodes from binary node `index` down.
    fn height(&self, nodes: &[Binary], index: u32) -> u32 {
        let (children, count) = self.children(nodes, index);
        let below = children[..count]
            .iter()
            .filter(|&&child| child & LEAF == 0)
            .map(|&child| self.height(nodes, child))
            .max();
        1 + below.unwrap_or(0)
    }
}

/// Most levels of a binary tree that surely fits into `max_levels(W)` levels of a wide one.
pub(super) const fn binary_levels<const W: usize>() -> u32 {
    const { assert!(W >= 2, "a node has at least two children") };
    max_levels(W) * W.ilog2()
}

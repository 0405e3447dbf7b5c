//! The order of a refit.

use alloc::vec::Vec;
use core::ops::Range;

/// Nodes level by level, deepest first: what `refit::bottom` or `refit::top` is to run over.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Levels {
    pub(crate) nodes: Vec<u32>,
    ends: Vec<u32>,
}

impl Levels {
    /// The node indices of all levels, deepest level first.
    #[must_use]
    pub fn nodes(&self) -> &[u32] {
        &self.nodes
    }

    /// The levels as ranges of [`nodes`](Self::nodes), in the order in which they must be refitted.
    pub fn ranges(&self) -> impl Iterator<Item = Range<usize>> + '_ {
        (0..self.ends.len()).map(|i| {
            let start = if i == 0 { 0 } else { self.ends[i - 1] };
            start as usize..self.ends[i] as usize
        })
    }

    /// The levels of several trees together: the roots' levels are one, and so on down.
    pub(crate) fn join(trees: &[&Self]) -> Self {
        if let [only] = trees {
            return (*only).clone();
        }
        let deepest = trees.iter().map(|tree| tree.ends.len()).max().unwrap_or(0);
        let mut all = Self::default();
        // Every level above a tree's deepest has nodes with inner children, so its ranges count up from the last.
        for level in (0..deepest).rev() {
            for tree in trees.iter().filter(|tree| tree.ends.len() > level) {
                let range = tree.ends.len() - 1 - level;
                let start = if range == 0 { 0 } else { tree.ends[range - 1] };
                let end = tree.ends[range];
                all.nodes
                    .extend_from_slice(&tree.nodes[start as usize..end as usize]);
            }
            all.ends.push(all.nodes.len() as u32);
        }
        all
    }

    /// Of a tree whose nodes, from `first` on, stand in these levels.
    pub(crate) fn of_each(levels: &[u32], first: u32) -> Self {
        let depth = levels.iter().max().map_or(0, |&deepest| deepest as usize + 1);
        let mut ends = alloc::vec![0; depth];
        for &level in levels {
            ends[depth - 1 - level as usize] += 1;
        }
        let mut next = Vec::with_capacity(depth);
        let mut end = 0;
        for count in &mut ends {
            next.push(end);
            end += *count;
            *count = end;
        }
        let mut nodes = alloc::vec![0; levels.len()];
        for (node, &level) in (first..).zip(levels) {
            let place: &mut u32 = &mut next[depth - 1 - level as usize];
            nodes[*place as usize] = node;
            *place += 1;
        }
        Self { nodes, ends }
    }

    /// Gathers (level, node) pairs.
    pub(crate) fn gather(mut pairs: Vec<(u32, u32)>) -> Self {
        pairs.sort_unstable_by_key(|&(level, node)| (core::cmp::Reverse(level), node));
        let mut levels = Self::default();
        for (i, &(level, node)) in pairs.iter().enumerate() {
            levels.nodes.push(node);
            if pairs.get(i + 1).is_none_or(|&(next, _)| next != level) {
                levels.ends.push(i as u32 + 1);
            }
        }
        levels
    }
}

//! The order of a refit.

use alloc::vec::Vec;
use core::ops::Range;

/// Nodes level by level, deepest first: what `refit::bottom` or `refit::top` is to run over.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Levels {
    nodes: Vec<u32>,
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

    /// The levels of pairs of a height and a node, in order, each once.
    pub(crate) fn by_height(pairs: &[(u32, u32)]) -> Self {
        let mut levels = Self::default();
        for level in pairs.chunk_by(|a, b| a.0 == b.0) {
            levels.nodes.extend(level.iter().map(|&(_, node)| node));
            levels.ends.push(levels.nodes.len() as u32);
        }
        levels
    }
}

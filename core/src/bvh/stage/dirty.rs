//! Which nodes of a tree that is put in place are still to be computed.

use alloc::vec::Vec;

/// Nodes by their places in the tree, which is in depth-first order: the last of them has none below it. Where a node is
/// marked, so are those above it; taken from the last on, each is computed after those below it, and once, however often it was
/// marked.
#[derive(Clone, Debug, Default)]
pub(super) struct Dirty {
    words: Vec<u64>,
    /// How many are marked.
    count: u32,
    /// None is marked in the words from here on.
    end: usize,
}

impl Dirty {
    /// None of `nodes`.
    pub fn none(nodes: usize) -> Self {
        Self {
            words: alloc::vec![0; nodes.div_ceil(64)],
            count: 0,
            end: 0,
        }
    }

    /// Marks all of `nodes`.
    pub fn mark_all(&mut self, nodes: usize) {
        self.words.fill(u64::MAX);
        if let Some(last) = self.words.last_mut().filter(|_| nodes % 64 != 0) {
            *last = (1 << (nodes % 64)) - 1;
        }
        self.count = nodes as u32;
        self.end = self.words.len();
    }

    /// Marks one.
    pub fn mark(&mut self, node: u32) {
        let (word, bit) = (node as usize / 64, 1 << (node % 64));
        self.count += u32::from(self.words[word] & bit == 0);
        self.words[word] |= bit;
        self.end = self.end.max(word + 1);
    }

    /// How many are marked.
    pub fn count(&self) -> u32 {
        self.count
    }

    /// Those that are marked, from `first` on.
    pub fn iter_from(&self, first: u32) -> impl Iterator<Item = u32> + '_ {
        let start = first as usize / 64;
        let words = self.words.get(start..self.end).unwrap_or_default().iter();
        words.zip(start as u32..).flat_map(move |(&word, index)| {
            let below = if index as usize == start { first % 64 } else { 0 };
            let mut left = word >> below << below;
            core::iter::from_fn(move || {
                let bit = left.trailing_zeros();
                left &= left.wrapping_sub(1);
                (bit < 64).then_some(64 * index + bit)
            })
        })
    }

    /// Takes the last `count`, or all there are, from the last on.
    pub fn take_last(&mut self, count: u32) -> Vec<u32> {
        let count = count.min(self.count);
        (0..count).filter_map(|_| self.pop()).collect()
    }

    /// Takes the last.
    pub fn pop(&mut self) -> Option<u32> {
        self.count = self.count.checked_sub(1)?;
        loop {
            let word = &mut self.words[self.end - 1];
            if *word != 0 {
                let bit = 63 - word.leading_zeros();
                *word &= !(1 << bit);
                return Some((self.end as u32 - 1) * 64 + bit);
            }
            self.end -= 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_come_first_and_once() {
        for nodes in [1, 63, 64, 65, 200] {
            let mut dirty = Dirty::none(nodes);
            assert!(dirty.take_last(9).is_empty());
            dirty.mark_all(nodes);
            assert_eq!(dirty.count(), nodes as u32);
            let first = dirty.take_last(3);
            dirty.mark(0);
            dirty.mark(nodes as u32 - 1);
            let marked: Vec<u32> = dirty.iter_from(0).collect();
            assert_eq!(marked.len(), dirty.count() as usize);
            for first in [1, 64, 100, 300] {
                let later: Vec<u32> = marked.iter().copied().filter(|&node| node >= first).collect();
                assert!(dirty.iter_from(first).eq(later));
            }
            let mut all = dirty.take_last(u32::MAX);
            assert!(all.iter().rev().eq(&marked));
            assert_eq!(all.first(), Some(&(nodes as u32 - 1)));
            assert_eq!(dirty.count(), 0);
            assert!(all.is_sorted_by(|a, b| a > b));
            all.extend(first);
            all.sort_unstable();
            all.dedup();
            assert_eq!(all.len(), nodes);
        }
    }
}

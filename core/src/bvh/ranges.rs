//! Ranges of an index space that grows: handed out first fit, taken back and joined.

use alloc::collections::{BTreeMap, BTreeSet};
use alloc::vec::Vec;
use core::ops::Range;

/// Which indices below `end` are free.
#[derive(Clone, Debug, Default)]
pub(super) struct Ranges {
    /// Length by start; no two touch.
    free: BTreeMap<u32, u32>,
    /// Length and start of the same.
    by_length: BTreeSet<(u32, u32)>,
    end: u32,
}

impl Ranges {
    /// The index space below `end` of which all but `used` is free; `None` where those overlap or lie beyond it. Empty ones are of
    /// no account.
    pub fn taken(end: u32, mut used: Vec<Range<u32>>) -> Option<Self> {
        used.retain(|range| !range.is_empty());
        used.sort_unstable_by_key(|range| range.start);
        let mut ranges = Self {
            end,
            ..Self::default()
        };
        let mut start = 0;
        for range in used.into_iter().chain(core::iter::once(end..end)) {
            let gap = range.start.checked_sub(start)?;
            if gap > 0 {
                ranges.insert(start, gap);
            }
            start = range.end;
        }
        Some(ranges)
    }

    /// One more than the greatest index ever handed out.
    pub fn end(&self) -> u32 {
        self.end
    }

    /// Takes `count` indices without a gap: the first that fit, so that equal edits get equal indices. Looks at one free range
    /// of each length that there is: few, and never more than the root of twice the indices.
    pub fn take(&mut self, count: u32) -> Range<u32> {
        if count == 0 {
            return 0..0;
        }
        let mut first: Option<(u32, u32)> = None;
        let mut least = count;
        while let Some(&(length, start)) = self.by_length.range((least, 0)..).next() {
            if first.is_none_or(|(found, _)| start < found) {
                first = Some((start, length));
            }
            least = length + 1;
        }
        if let Some((start, length)) = first {
            self.remove(start);
            if length > count {
                self.insert(start + count, length - count);
            }
            start..start + count
        } else {
            // What is free at the end is part of the new range.
            let last = self
                .free
                .iter()
                .next_back()
                .map(|(&start, &length)| (start, length));
            let start = match last {
                Some((start, length)) if start + length == self.end => {
                    self.remove(start);
                    start
                }
                _ => self.end,
            };
            self.end = start + count;
            start..self.end
        }
    }

    /// Gives a range back.
    pub fn give(&mut self, range: Range<u32>) {
        if range.is_empty() {
            return;
        }
        let (mut start, mut length) = (range.start, range.end - range.start);
        let before = self.free.range(..start).next_back();
        if let Some((&before, &size)) = before.filter(|&(before, size)| before + size == start) {
            self.remove(before);
            start = before;
            length += size;
        }
        length += self.remove(range.end);
        self.insert(start, length);
    }

    fn insert(&mut self, start: u32, length: u32) {
        self.free.insert(start, length);
        self.by_length.insert((length, start));
    }

    /// Returns the length of the free range that begins there: 0 if none does.
    fn remove(&mut self, start: u32) -> u32 {
        let length = self.free.remove(&start).unwrap_or(0);
        self.by_length.remove(&(length, start));
        length
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_are_joined_and_used_again() {
        let mut ranges = Ranges::default();
        let (a, b, c) = (ranges.take(3), ranges.take(2), ranges.take(4));
        assert_eq!((a.clone(), b.clone(), c.clone()), (0..3, 3..5, 5..9));
        ranges.give(a);
        ranges.give(c);
        assert_eq!(ranges.take(2), 0..2, "first fit");
        ranges.give(b);
        assert_eq!(ranges.take(9), 2..11, "all that is free at the end, and more");
        assert_eq!(ranges.end(), 11);
        ranges.give(0..2);
        ranges.give(2..11);
        assert_eq!(ranges.take(11), 0..11);
    }

    /// The same as a search from the first index on, and no search at all where a million holes are too small.
    #[test]
    fn the_first_that_fit() {
        let mut ranges = Ranges::default();
        let mut used: Vec<bool> = Vec::new();
        let mut held: Vec<Range<u32>> = Vec::new();
        for i in 0..4000 {
            let random = crate::exact::hash(i);
            if random % 5 < 2 && !held.is_empty() {
                let range = held.swap_remove(random as usize / 8 % held.len());
                used[range.start as usize..range.end as usize].fill(false);
                ranges.give(range);
            } else {
                let count = 1 + (random >> 8) % 9;
                let fits = |start: u32| {
                    (start..start + count).all(|at| !used.get(at as usize).is_some_and(|&used| used))
                };
                let first = (0..).find(|&start| fits(start)).expect("at the end");
                let range = ranges.take(count);
                assert_eq!(range, first..first + count);
                used.resize(used.len().max(range.end as usize), false);
                used[range.start as usize..range.end as usize].fill(true);
                held.push(range);
            }
            assert_eq!(ranges.free.len(), ranges.by_length.len());
        }
        let mut ranges = Ranges::default();
        ranges.take(2_000_000);
        (0..1_000_000).for_each(|i| ranges.give(2 * i..2 * i + 1));
        (0..1_000_000).for_each(|i| assert_eq!(ranges.take(2).start, 2_000_000 + 2 * i));
    }

    #[test]
    fn what_is_not_taken_is_free() {
        let mut ranges = Ranges::taken(9, alloc::vec![5..7, 2..3, 4..4, 3..4]).expect("they do not overlap");
        assert_eq!(
            [ranges.take(2), ranges.take(2), ranges.take(1)],
            [0..2, 7..9, 4..5]
        );
        assert_eq!((ranges.take(1), ranges.end()), (9..10, 10));
        for wrong in [[0..2, 1..3], [8..10, 0..1]] {
            assert!(Ranges::taken(9, wrong.to_vec()).is_none());
        }
    }
}

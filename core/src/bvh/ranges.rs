//! Ranges of an index space that grows: handed out first fit, taken back and joined.

use alloc::collections::BTreeMap;
use alloc::vec::Vec;
use core::ops::Range;

/// Which indices below `end` are free.
#[derive(Clone, Debug, Default)]
pub(super) struct Ranges {
    /// Length by start; no two touch.
    free: BTreeMap<u32, u32>,
    end: u32,
}

impl Ranges {
    /// The index space below `end` of which all but `used` is free; `None` where those overlap or lie beyond it. Empty ones are of
    /// no account.
    pub fn taken(end: u32, mut used: Vec<Range<u32>>) -> Option<Self> {
        used.retain(|range| !range.is_empty());
        used.sort_unstable_by_key(|range| range.start);
        let mut ranges = Self {
            free: BTreeMap::new(),
            end,
        };
        let mut start = 0;
        for range in used.into_iter().chain(core::iter::once(end..end)) {
            let gap = range.start.checked_sub(start)?;
            if gap > 0 {
                ranges.free.insert(start, gap);
            }
            start = range.end;
        }
        Some(ranges)
    }

    /// One more than the greatest index ever handed out.
    pub fn end(&self) -> u32 {
        self.end
    }

    /// Takes `count` indices without a gap: the first that fit, so that equal edits get equal indices.
    pub fn take(&mut self, count: u32) -> Range<u32> {
        let fit = self.free.iter().find(|&(_, &length)| length >= count);
        if let Some((&start, &length)) = fit {
            self.free.remove(&start);
            if length > count {
                self.free.insert(start + count, length - count);
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
                    self.free.remove(&start);
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
            self.free.remove(&before);
            start = before;
            length += size;
        }
        if let Some(size) = self.free.remove(&range.end) {
            length += size;
        }
        self.free.insert(start, length);
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

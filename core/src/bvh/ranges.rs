//! Index ranges in a space that grows, first fit. Taking and giving back cost the logarithm of the number of free ranges, plus the free
//! ranges before the first fit that have half its length.
//!
//! Used ranges never move, so no rule of fit bounds the space by a constant factor (Robson 1971, 1974). First fit needs at most about log2(n)
//! times the most in use, for ranges of up to n (Robson 1977). Ranges of equal length take no more than the most in use.

use alloc::collections::{BTreeMap, BTreeSet};
use alloc::vec::Vec;
use core::ops::Range;

/// Which indices below `end` are free.
#[derive(Clone, Debug, Default)]
pub(super) struct Ranges {
    /// Length by start; no two touch.
    free: BTreeMap<u32, u32>,
    /// Starts by the logarithm of the length, rounded down.
    by_length: [BTreeSet<u32>; 32],
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

    /// One more than the greatest index in use.
    pub fn used_end(&self) -> u32 {
        match self.free.last_key_value() {
            Some((&start, &length)) if start + length == self.end => start,
            _ => self.end,
        }
    }

    /// Takes `count` indices without a gap: the first that fit, so that equal edits get equal indices.
    pub fn take(&mut self, count: u32) -> Range<u32> {
        if count == 0 {
            return 0..0;
        }
        let start = self.first_fit(count).unwrap_or_else(|| self.used_end());
        let length = self.remove(start);
        if length > count {
            self.insert(start + count, length - count);
        }
        // Free indices at the end become part of a new range.
        self.end = self.end.max(start + count);
        start..start + count
    }

    /// Gives a range back.
    pub fn give(&mut self, range: Range<u32>) {
        if range.is_empty() {
            return;
        }
        let (mut start, mut length) = (range.start, range.end - range.start);
        let before = self.free.range(..start).next_back();
        if let Some((&before, _)) = before.filter(|&(before, size)| before + size == range.start) {
            length += self.remove(before);
            start = before;
        }
        length += self.remove(range.end);
        self.insert(start, length);
    }

    /// Start of the first free range of at least `count`.
    fn first_fit(&self, count: u32) -> Option<u32> {
        let own = count.ilog2() as usize;
        // All of these fit; of the own class some do.
        let longer = self.by_length[own + 1..].iter().filter_map(BTreeSet::first);
        let longer = longer.min().copied();
        let mut own = self.by_length[own].range(..longer.unwrap_or(u32::MAX));
        own.find(|start| self.free[start] >= count).copied().or(longer)
    }

    fn insert(&mut self, start: u32, length: u32) {
        self.free.insert(start, length);
        self.by_length[length.ilog2() as usize].insert(start);
    }

    /// Removes the free range that begins there, and returns its length: 0 if none does.
    fn remove(&mut self, start: u32) -> u32 {
        let length = self.free.remove(&start).unwrap_or(0);
        if length > 0 {
            self.by_length[length.ilog2() as usize].remove(&start);
        }
        length
    }
}

#[cfg(test)]
mod tests;

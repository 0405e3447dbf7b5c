//! Ranges of an index space that grows: handed out first fit, taken back and joined, each in time of the logarithm of the
//! number of free ranges.
//!
//! What is live is never moved: numbers of lights and indices of instances are their users'. So no rule of fit keeps the space
//! within a constant factor of what is live, whatever is asked for (Robson 1971, 1974: where ranges are of 1 to *n* indices, at
//! least log2(*n*) / 2 times the most that was ever live at once, for some sequence of edits). First fit needs at most about
//! log2(*n*) times that (Robson 1977), and is the best rule known in that respect; best fit may need *n* times. Where all
//! ranges are equally long, as those of instances, meshes and single nodes, the space is the most that was live at once.

mod holes;

use alloc::vec::Vec;
use core::ops::Range;

use self::holes::Holes;

/// Which indices below `end` are free.
#[derive(Clone, Debug, Default)]
pub(super) struct Ranges {
    /// No two touch.
    free: Holes,
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

    /// One more than the greatest index in use.
    pub fn used_end(&self) -> u32 {
        match self.free.before(self.end) {
            Some((start, length)) if start + length == self.end => start,
            _ => self.end,
        }
    }

    /// Takes `count` indices without a gap: the first that fit, so that equal edits get equal indices.
    pub fn take(&mut self, count: u32) -> Range<u32> {
        if count == 0 {
            return 0..0;
        }
        if let Some(start) = self.free.take_first(count) {
            return start..start + count;
        }
        // What is free at the end is part of the new range.
        let start = self.used_end();
        if start < self.end {
            self.free.remove(start);
        }
        self.end = start + count;
        start..self.end
    }

    /// Gives a range back.
    pub fn give(&mut self, range: Range<u32>) {
        if range.is_empty() {
            return;
        }
        let (mut start, mut length) = (range.start, range.end - range.start);
        let before = self.free.before(start);
        if let Some((before, size)) = before.filter(|&(before, size)| before + size == start) {
            self.free.remove(before);
            start = before;
            length += size;
        }
        length += self.free.remove(range.end);
        self.free.insert(start, length);
    }
}

#[cfg(test)]
mod tests;

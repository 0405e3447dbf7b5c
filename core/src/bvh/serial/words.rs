//! Words one after another.

use alloc::vec::Vec;
use core::ops::Range;

use super::error::ReadError;
use crate::bvh::ranges::Ranges;

/// Words that are read in order, never beyond their end.
#[derive(Debug)]
pub(super) struct Words<'a> {
    all: &'a [u32],
    next: usize,
}

impl<'a> Words<'a> {
    pub fn of(all: &'a [u32]) -> Self {
        Self { all, next: 0 }
    }

    /// Number of all words.
    pub fn len(&self) -> usize {
        self.all.len()
    }

    /// The next `COUNT`.
    pub fn array<const COUNT: usize>(&mut self) -> Result<[u32; COUNT], ReadError> {
        let mut own = [0; COUNT];
        match self.all[self.next..].get(..COUNT) {
            Some(words) => own.copy_from_slice(words),
            None => return Err(self.too_few(COUNT)),
        }
        self.next += COUNT;
        Ok(own)
    }

    /// The next one.
    pub fn one(&mut self) -> Result<u32, ReadError> {
        self.array::<1>().map(|[word]| word)
    }

    /// A range of at least one of `end`.
    pub fn range(&mut self, end: u32, what: &'static str) -> Result<Range<u32>, ReadError> {
        let [from, to] = self.array()?;
        self.expect(from < to && to <= end, what)?;
        Ok(from..to)
    }

    /// `Ok` where at least `count` words are left, so that memory for as many things may be taken.
    pub fn need(&self, count: u32) -> Result<usize, ReadError> {
        let count = count as usize;
        if count <= self.all.len() - self.next {
            Ok(count)
        } else {
            Err(self.too_few(count))
        }
    }

    /// The word read last, called `what`, is out of range.
    pub fn wrong(&self, what: &'static str) -> ReadError {
        let at = self.next.saturating_sub(1);
        ReadError::Word {
            at,
            what,
            found: self.all.get(at).copied().unwrap_or(0),
        }
    }

    /// `Ok` where `holds`, which is said of the word read last, called `what`.
    pub fn expect(&self, holds: bool, what: &'static str) -> Result<(), ReadError> {
        if holds { Ok(()) } else { Err(self.wrong(what)) }
    }

    /// `Ok` where none is left.
    pub fn end(&self) -> Result<(), ReadError> {
        if self.next == self.all.len() {
            Ok(())
        } else {
            Err(ReadError::Length {
                expected: self.next,
                found: self.all.len(),
            })
        }
    }

    fn too_few(&self, count: usize) -> ReadError {
        ReadError::Length {
            expected: self.next + count,
            found: self.all.len(),
        }
    }
}

/// The index space of which `used` is in use.
pub(super) fn taken(end: u32, used: Vec<Range<u32>>, what: &'static str) -> Result<Ranges, ReadError> {
    Ranges::taken(end, used).ok_or(ReadError::Places { what })
}

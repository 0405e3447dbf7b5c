//! Words one after another, and what is wrong with words that are no light BVH.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use core::fmt;
use core::ops::Range;

use crate::bvh::ranges::Ranges;

/// Why words are not read as a light BVH: which word or what of the tree is wrong, and what to do.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ReadError(pub(super) String);

impl fmt::Display for ReadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl core::error::Error for ReadError {}

/// Places in use overlap, or lie outside of their array.
pub(super) fn misplaced(what: &str) -> ReadError {
    ReadError(format!(
        "places of {what} overlap or lie outside; the file is damaged"
    ))
}

/// What is wrong with the tree, or with a light or an instance in it.
pub(super) fn damaged(what: impl fmt::Display) -> ReadError {
    ReadError(format!("{what}; the file is damaged"))
}

/// Words that are read in order, never beyond their end.
#[derive(Debug)]
pub(super) struct Words<'a> {
    pub all: &'a [u32],
    pub next: usize,
}

impl Words<'_> {
    /// The next `COUNT`.
    pub fn array<const COUNT: usize>(&mut self) -> Result<[u32; COUNT], ReadError> {
        self.need(COUNT as u32)?;
        self.next += COUNT;
        Ok(core::array::from_fn(|k| self.all[self.next - COUNT + k]))
    }

    /// The next one.
    pub fn one(&mut self) -> Result<u32, ReadError> {
        self.array::<1>().map(|[word]| word)
    }

    /// A range of at least one of `end`.
    pub fn range(&mut self, end: u32, what: &str) -> Result<Range<u32>, ReadError> {
        let [from, to] = self.array()?;
        self.expect(from < to && to <= end, what)?;
        Ok(from..to)
    }

    /// `Ok` where at least `count` words are left, so that memory for as many things may be taken.
    pub fn need(&self, count: u32) -> Result<usize, ReadError> {
        let end = self.next.saturating_add(count as usize);
        match end <= self.all.len() {
            true => Ok(count as usize),
            false => Err(self.length(end)),
        }
    }

    /// There are other than `expected` words.
    pub fn length(&self, expected: usize) -> ReadError {
        let found = self.all.len();
        ReadError(format!(
            "{found} words, expected {expected}; the file is cut or damaged"
        ))
    }

    /// The word read last, called `what`, is out of range.
    pub fn wrong(&self, what: &str) -> ReadError {
        let at = self.next.saturating_sub(1);
        let found = self.all.get(at).copied().unwrap_or(0);
        ReadError(format!(
            "word {at}, {what}, is {found}, which is out of range; the file is damaged"
        ))
    }

    /// `Ok` where `holds`, which is said of the word read last, called `what`.
    pub fn expect(&self, holds: bool, what: &str) -> Result<(), ReadError> {
        if holds { Ok(()) } else { Err(self.wrong(what)) }
    }
}

/// The index space of which `used` is in use.
pub(super) fn taken(end: u32, used: Vec<Range<u32>>, what: &str) -> Result<Ranges, ReadError> {
    Ranges::taken(end, used).ok_or_else(|| misplaced(what))
}

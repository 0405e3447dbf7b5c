//! Places in arrays, as they are read.

use alloc::vec::Vec;
use core::ops::Range;

use super::error::ReadError;
use super::words::Words;
use crate::bvh::ranges::Ranges;

/// A range of at least one of `end`.
pub(super) fn read_range(
    words: &mut Words<'_>,
    end: u32,
    what: &'static str,
) -> Result<Range<u32>, ReadError> {
    let [from, to] = words.array()?;
    words.expect(from < to && to <= end, what)?;
    Ok(from..to)
}

/// So many of them.
pub(super) fn read_ranges(
    words: &mut Words<'_>,
    count: u32,
    end: u32,
    what: &'static str,
) -> Result<Vec<Range<u32>>, ReadError> {
    let mut ranges = Vec::with_capacity(words.need(count)?);
    for _ in 0..count {
        ranges.push(read_range(words, end, what)?);
    }
    Ok(ranges)
}

/// Indices below `end`.
pub(super) fn read_indices(
    words: &mut Words<'_>,
    count: u32,
    end: u32,
    what: &'static str,
) -> Result<Vec<u32>, ReadError> {
    let mut indices = Vec::with_capacity(words.need(count)?);
    for _ in 0..count {
        let index = words.one()?;
        words.expect(index < end, what)?;
        indices.push(index);
    }
    Ok(indices)
}

/// The index space of which `used` is in use.
pub(super) fn taken(end: u32, used: Vec<Range<u32>>, what: &'static str) -> Result<Ranges, ReadError> {
    Ranges::taken(end, used).ok_or(ReadError::Places { what })
}

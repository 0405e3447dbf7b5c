//! Summaries: what refit makes of the lights, and children within their parents.

use bytemuck::Pod;

use super::{Violation, What, equal};
use crate::node::{Node, kind};
use crate::summary::Summary;
use crate::tree::INVALID;

/// Checks that two nodes have the same words; the first difference is named by what it means, where it shows.
pub(crate) fn same<N: Node<W>, const W: usize>(index: u32, expected: &N, found: &N) -> Result<(), Violation> {
    if bytemuck::bytes_of(expected) == bytemuck::bytes_of(found) {
        return Ok(());
    }
    for slot in 0..W {
        let (own, other) = (expected.summary(slot).to_words(), found.summary(slot).to_words());
        for (component, (e, f)) in N::Summary::NAMES.into_iter().zip(own.into_iter().zip(other)) {
            equal(
                index,
                slot as u32,
                What::Bounds(component),
                e.to_bits(),
                f.to_bits(),
            )?;
        }
    }
    same_words(index, INVALID, expected, found)
}

/// Checks that two records have the same words; the first that differs is named by its place.
pub(crate) fn same_words<T: Pod>(node: u32, slot: u32, expected: &T, found: &T) -> Result<(), Violation> {
    let words = |record: &T, i: usize| {
        let bytes = bytemuck::bytes_of(record);
        u32::from_ne_bytes([bytes[4 * i], bytes[4 * i + 1], bytes[4 * i + 2], bytes[4 * i + 3]])
    };
    for i in 0..size_of::<T>() / 4 {
        equal(
            node,
            slot,
            What::Word(i as u32),
            words(expected, i),
            words(found, i),
        )?;
    }
    Ok(())
}

/// Checks that the children of node `index` lie within `outer`, what its parent holds of it.
pub(crate) fn within<N: Node<W>, const W: usize>(
    outer: &N::Summary,
    index: u32,
    node: &N,
) -> Result<(), Violation> {
    for slot in (0..W).filter(|&slot| node.kind(slot) != kind::EMPTY) {
        let inner = node.summary(slot);
        if let Some(component) = outer.uncontained(&inner) {
            return Err(Violation {
                node: index,
                slot: slot as u32,
                what: What::Containment(N::Summary::NAMES[component]),
                expected: outer.to_words()[component].to_bits(),
                found: inner.to_words()[component].to_bits(),
            });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests;

//! The invariants of a light BVH, checked one by one; the first that does not hold is named.
//!
//! [`Bvh::validate`](crate::Bvh::validate) trusts no word: links, kinds and trails may hold anything. It runs on the CPU only,
//! takes time linear in the number of nodes, and needs as much memory again as the tree.

use alloc::format;
use alloc::string::String;
use core::fmt;

use bytemuck::Pod;

use crate::node::{Node, kind};
use crate::summary::Summary;
use crate::tree::INVALID;

#[cfg(test)]
mod tests;

/// A word that is not what it must be: of which node and slot, what it means, and what was expected.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Violation(String);

impl Violation {
    /// Of a node and a slot, or a record of that index; [`INVALID`] for none.
    pub(crate) fn new(
        node: u32,
        slot: u32,
        what: impl fmt::Display,
        expected: impl fmt::Display,
        found: impl fmt::Display,
    ) -> Self {
        let place = |name: &str, index: u32| match index {
            INVALID => String::new(),
            _ => format!("{name} {index}, "),
        };
        let (node, slot) = (place("node", node), place("slot", slot));
        Self(format!("{node}{slot}{what}: expected {expected}, found {found}"))
    }
}

impl fmt::Display for Violation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl core::error::Error for Violation {}

/// `Ok` if the words are equal.
pub(crate) fn equal(node: u32, slot: u32, what: &str, expected: u32, found: u32) -> Result<(), Violation> {
    if expected == found {
        Ok(())
    } else {
        Err(Violation::new(node, slot, what, expected, found))
    }
}

/// Checks that two nodes have the same words; the first difference is named by what it means, where it shows.
pub(crate) fn same<N: Node<W>, const W: usize>(index: u32, expected: &N, found: &N) -> Result<(), Violation> {
    if bytemuck::bytes_of(expected) == bytemuck::bytes_of(found) {
        return Ok(());
    }
    for slot in 0..W {
        let (own, other) = (expected.summary(slot).to_words(), found.summary(slot).to_words());
        for (name, (e, f)) in N::Summary::NAMES.into_iter().zip(own.into_iter().zip(other)) {
            if e.to_bits() != f.to_bits() {
                let what = format!("{name} after a refit");
                let [e, f] = [e, f].map(|x| format!("{x:e}"));
                return Err(Violation::new(index, slot as u32, what, e, f));
            }
        }
    }
    same_words(index, INVALID, expected, found)
}

/// Checks that two records have the same words; the first that differs is named by its place.
pub(crate) fn same_words<T: Pod>(node: u32, slot: u32, expected: &T, found: &T) -> Result<(), Violation> {
    let [expected, found] = [expected, found].map(|record| bytemuck::bytes_of(record).chunks(4));
    for (word, (e, f)) in expected.zip(found).enumerate() {
        if e != f {
            let [e, f] = [e, f].map(bytemuck::pod_read_unaligned::<u32>);
            return Err(Violation::new(node, slot, format!("word {word}"), e, f));
        }
    }
    Ok(())
}

/// Checks that the children of node `index` lie within `outer`, what its parent holds of it.
pub(crate) fn contained<N: Node<W>, const W: usize>(
    outer: &N::Summary,
    index: u32,
    node: &N,
) -> Result<(), Violation> {
    for slot in (0..W).filter(|&slot| node.kind(slot) != kind::EMPTY) {
        let inner = node.summary(slot);
        if let Some(component) = outer.uncontained(&inner) {
            let what = format!("{} within the parent's", N::Summary::NAMES[component]);
            let [e, f] = [outer, &inner].map(|own| format!("{:e}", own.to_words()[component]));
            return Err(Violation::new(index, slot as u32, what, e, f));
        }
    }
    Ok(())
}

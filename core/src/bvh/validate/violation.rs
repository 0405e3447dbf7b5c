//! A word that does not hold, named by where it is and what it means.

use alloc::format;
use alloc::string::String;
use core::fmt;

use bytemuck::Pod;

use crate::tree::INVALID;

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

//! A SPIR-V module as a checked sequence of instructions.
//!
//! Opcodes and operand layouts: SPIR-V specification 1.6, sections 2.3 (physical layout) and 3.42 (instructions).

use alloc::vec::Vec;
use core::fmt;
use core::ops::{Range, RangeInclusive};

/// First word of every module.
const MAGIC: u32 = 0x0723_0203;
/// Words before the first instruction: magic, version, generator, id bound, schema.
pub(crate) const HEADER: usize = 5;
/// Version words of SPIR-V 1.4 and 1.5: float-control modes are core from 1.4 on, Vulkan 1.2 takes 1.5 at most.
const VERSIONS: RangeInclusive<u32> = 0x0001_0400..=0x0001_0500;

/// Why a module cannot be used.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct ModuleError {
    /// Index of the offending word, the magic number being 0.
    pub at: usize,
    /// What is wrong there.
    pub what: &'static str,
}

impl fmt::Display for ModuleError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "word {}: {}", self.at, self.what)
    }
}

impl core::error::Error for ModuleError {}

/// A module's bytes, little endian, as words; a ragged end is dropped, and the module will not parse then.
#[must_use]
pub fn words(bytes: &[u8]) -> Vec<u32> {
    let words = bytes.chunks_exact(4);
    words
        .map(|word| u32::from_le_bytes([word[0], word[1], word[2], word[3]]))
        .collect()
}

/// One instruction: its opcode, its operands, and where it starts.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Instruction<'a> {
    pub(crate) opcode: u16,
    /// Index of its first word in the module.
    pub(crate) at: usize,
    /// The words after the first.
    pub(crate) operands: &'a [u32],
}

impl Instruction<'_> {
    /// Operand number `index`, or an error that points at the instruction.
    pub(crate) fn operand(&self, index: usize) -> Result<u32, ModuleError> {
        self.operands
            .get(index)
            .copied()
            .ok_or_else(|| self.error("the instruction is too short"))
    }

    /// Its words in the module.
    pub(crate) fn range(&self) -> Range<usize> {
        self.at..self.at + 1 + self.operands.len()
    }

    pub(crate) fn error(&self, what: &'static str) -> ModuleError {
        ModuleError { at: self.at, what }
    }
}

/// Splits a module into instructions after checking its header; no length in it is trusted.
///
/// # Errors
/// [`ModuleError`] for a wrong magic number or version, or an instruction of no length or beyond the end.
pub(crate) fn instructions(words: &[u32]) -> Result<Vec<Instruction<'_>>, ModuleError> {
    if words.len() < HEADER {
        return Err(ModuleError {
            at: words.len(),
            what: "the module ends inside its header",
        });
    }
    if words[0] != MAGIC {
        return Err(ModuleError {
            at: 0,
            what: "not the SPIR-V magic number",
        });
    }
    if !VERSIONS.contains(&words[1]) {
        return Err(ModuleError {
            at: 1,
            what: "not SPIR-V 1.4 or 1.5",
        });
    }
    let mut list = Vec::new();
    let mut at = HEADER;
    while at < words.len() {
        let count = (words[at] >> 16) as usize;
        if count == 0 {
            return Err(ModuleError {
                at,
                what: "an instruction of length zero",
            });
        }
        let Some(operands) = words.get(at + 1..at + count) else {
            return Err(ModuleError {
                at,
                what: "an instruction reaches beyond the end",
            });
        };
        list.push(Instruction {
            opcode: (words[at] & 0xffff) as u16,
            at,
            operands,
        });
        at += count;
    }
    Ok(list)
}

/// Opcodes that are looked at.
pub(crate) mod op {
    pub(crate) const MEMORY_MODEL: u16 = 14;
    pub(crate) const ENTRY_POINT: u16 = 15;
    pub(crate) const EXECUTION_MODE: u16 = 16;
    pub(crate) const CAPABILITY: u16 = 17;
    pub(crate) const TYPE_INT: u16 = 21;
    pub(crate) const TYPE_FLOAT: u16 = 22;
    pub(crate) const TYPE_VECTOR: u16 = 23;
    pub(crate) const TYPE_ARRAY: u16 = 28;
    pub(crate) const TYPE_RUNTIME_ARRAY: u16 = 29;
    pub(crate) const TYPE_STRUCT: u16 = 30;
    pub(crate) const TYPE_POINTER: u16 = 32;
    pub(crate) const CONSTANT: u16 = 43;
    pub(crate) const VARIABLE: u16 = 59;
    pub(crate) const LOAD: u16 = 61;
    pub(crate) const STORE: u16 = 62;
    pub(crate) const COPY_MEMORY: u16 = 63;
    pub(crate) const DECORATE: u16 = 71;
    pub(crate) const MEMBER_DECORATE: u16 = 72;
    /// OpAtomicLoad to OpAtomicXor.
    pub(crate) const ATOMICS: core::ops::RangeInclusive<u16> = 227..=242;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ragged_end_is_no_word() {
        assert_eq!(words(&[1, 0, 0, 0, 2]), [1]);
        assert_eq!(words(&[]), [0; 0]);
    }

    const HEAD: [u32; HEADER] = [MAGIC, 0x0001_0500, 0, 10, 0];

    fn module(body: &[u32]) -> Vec<u32> {
        HEAD.iter().chain(body).copied().collect()
    }

    #[test]
    fn refuses_corrupt_words() {
        assert_eq!(instructions(&HEAD[..3]).unwrap_err().at, 3);
        assert_eq!(instructions(&[0; 5]).unwrap_err().at, 0);
        assert_eq!(instructions(&[MAGIC, 0x0001_0600, 0, 0, 0]).unwrap_err().at, 1);
        assert_eq!(
            instructions(&module(&[17])).unwrap_err(),
            ModuleError {
                at: 5,
                what: "an instruction of length zero"
            }
        );
        assert_eq!(
            instructions(&module(&[2 << 16 | 17, 1, 0xffff_0011]))
                .unwrap_err()
                .at,
            7
        );
    }
}

//! Which storage buffers a module reads and writes, followed from their variables through access chains.

use alloc::collections::BTreeMap;
use alloc::vec::Vec;

use super::words::{Instruction, ModuleError, op};
use crate::kernel::Access;

/// What has been seen of a module's storage buffers, instruction by instruction.
#[derive(Default)]
pub(super) struct Accesses {
    buffers: Vec<Seen>,
    /// Pointer id -> index in `buffers`. A pointer is always defined before it is used, but for loops, whose phis count as both.
    pointers: BTreeMap<u32, usize>,
}

struct Seen {
    binding: u32,
    /// Whether the module promises not to write it.
    read_only: bool,
    read: bool,
    written: bool,
}

impl Accesses {
    /// Variable `id` is the storage buffer `binding`.
    pub fn declare(&mut self, id: u32, binding: u32, read_only: bool) {
        self.pointers.insert(id, self.buffers.len());
        self.buffers.push(Seen {
            binding,
            read_only,
            read: false,
            written: false,
        });
    }

    /// Takes in an instruction.
    pub fn visit(&mut self, instruction: &Instruction<'_>) -> Result<(), ModuleError> {
        match instruction.opcode {
            op::ACCESS_CHAIN
            | op::IN_BOUNDS_ACCESS_CHAIN
            | op::PTR_ACCESS_CHAIN
            | op::IN_BOUNDS_PTR_ACCESS_CHAIN
            | op::COPY_OBJECT => {
                if let Some(&buffer) = self.pointers.get(&instruction.operand(2)?) {
                    self.pointers.insert(instruction.operand(1)?, buffer);
                }
            }
            op::LOAD => self.mark(instruction.operand(2)?, true, false),
            op::STORE => self.mark(instruction.operand(0)?, false, true),
            op::COPY_MEMORY => {
                self.mark(instruction.operand(0)?, false, true);
                self.mark(instruction.operand(1)?, true, false);
            }
            // Operands are ids, and what becomes of a pointer is not followed further.
            op::FUNCTION_CALL | op::SELECT | op::PHI => self.mark_all(instruction),
            opcode if op::ATOMICS.contains(&opcode) => self.mark_all(instruction),
            _ => {}
        }
        Ok(())
    }

    /// What the module does with the buffer at `binding`. Several variables may share it.
    pub fn of(&self, binding: u32) -> Access {
        let (mut read, mut written) = (false, false);
        for seen in self.buffers.iter().filter(|seen| seen.binding == binding) {
            read |= seen.read;
            written |= seen.written && !seen.read_only;
        }
        match (read, written) {
            (_, false) => Access::Read,
            (false, true) => Access::Write,
            (true, true) => Access::ReadWrite,
        }
    }

    fn mark(&mut self, pointer: u32, read: bool, written: bool) {
        if let Some(&buffer) = self.pointers.get(&pointer) {
            self.buffers[buffer].read |= read;
            self.buffers[buffer].written |= written;
        }
    }

    fn mark_all(&mut self, instruction: &Instruction<'_>) {
        for &operand in instruction.operands {
            self.mark(operand, true, true);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn after(instructions: &[(u16, &[u32])]) -> [Access; 2] {
        let mut accesses = Accesses::default();
        accesses.declare(10, 0, false);
        accesses.declare(11, 1, true);
        for &(opcode, operands) in instructions {
            let instruction = Instruction {
                opcode,
                at: 0,
                operands,
            };
            accesses.visit(&instruction).unwrap();
        }
        [accesses.of(0), accesses.of(1)]
    }

    #[test]
    fn loads_and_stores_are_followed_through_chains() {
        assert_eq!(after(&[]), [Access::Read; 2]);
        assert_eq!(after(&[(op::STORE, &[10, 5])])[0], Access::Write);
        let chain: (u16, &[u32]) = (op::ACCESS_CHAIN, &[1, 20, 10, 3]);
        let further: (u16, &[u32]) = (op::IN_BOUNDS_ACCESS_CHAIN, &[1, 21, 20, 3]);
        assert_eq!(after(&[chain, further, (op::STORE, &[21, 5])])[0], Access::Write);
        let load: (u16, &[u32]) = (op::LOAD, &[1, 22, 20]);
        assert_eq!(
            after(&[chain, further, (op::STORE, &[21, 5]), load])[0],
            Access::ReadWrite
        );
        assert_eq!(after(&[chain, load])[0], Access::Read);
        assert_eq!(
            after(&[(op::COPY_MEMORY, &[10, 11])]),
            [Access::Write, Access::Read]
        );
    }

    #[test]
    fn what_is_not_followed_counts_as_both() {
        for opcode in [op::FUNCTION_CALL, op::SELECT, op::PHI, 234] {
            assert_eq!(
                after(&[(opcode, &[1, 30, 10, 11])]),
                [Access::ReadWrite, Access::Read]
            );
        }
    }

    #[test]
    fn a_short_instruction_is_an_error() {
        for opcode in [op::ACCESS_CHAIN, op::LOAD, op::STORE, op::COPY_MEMORY] {
            let instruction = Instruction {
                opcode,
                at: 7,
                operands: &[],
            };
            assert_eq!(Accesses::default().visit(&instruction).unwrap_err().at, 7);
        }
    }
}

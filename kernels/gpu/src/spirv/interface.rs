//! What a kernel takes, read from its module: entry point, workgroup, bindings, push constants.
//!
//! Read from the words rather than written down a second time, so that the two cannot disagree.

use alloc::collections::BTreeMap;
use alloc::string::String;
use alloc::vec::Vec;

use super::Access;
use super::words::{Instruction, ModuleError, instructions, op};

/// The declared interface of a module with one compute entry point.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Interface {
    /// Name of the entry point.
    pub entry_point: String,
    /// Invocations per workgroup.
    pub workgroup: [u32; 3],
    /// By binding of descriptor set 0.
    pub buffers: Vec<BufferUse>,
    /// Size of the push constant block, bytes.
    pub push_constants: u32,
}

/// What a module says of a storage buffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BufferUse {
    /// Whether it may write the elements.
    pub access: Access,
    /// Bytes from one element of its runtime array to the next.
    pub stride: u32,
}

/// Execution model GLCompute.
const GL_COMPUTE: u32 = 5;
const MODE_LOCAL_SIZE: u32 = 17;
const STORAGE_UNIFORM_CONSTANT: u32 = 0;
const STORAGE_UNIFORM: u32 = 2;
const STORAGE_PUSH_CONSTANT: u32 = 9;
const STORAGE_BUFFER: u32 = 12;
const DECORATION_ARRAY_STRIDE: u32 = 6;
const DECORATION_NON_WRITABLE: u32 = 24;
const DECORATION_BINDING: u32 = 33;
const DECORATION_DESCRIPTOR_SET: u32 = 34;
const DECORATION_OFFSET: u32 = 35;

/// More bindings than any device offers in one set for this use; keeps a hostile number from allocating.
const MAX_BINDINGS: u32 = 64;

impl Interface {
    /// Reads the interface.
    ///
    /// # Errors
    /// [`ModuleError`] if the words do not parse, hold not exactly one compute entry point, or declare resources other
    /// than storage buffers at bindings 0, 1, .. of descriptor set 0, each a runtime array, and one push constant block.
    pub fn read(words: &[u32]) -> Result<Self, ModuleError> {
        let mut reader = Reader::default();
        for instruction in &instructions(words)? {
            reader.visit(instruction)?;
        }
        let whole = |what| ModuleError {
            at: words.len(),
            what,
        };
        if reader.interface.entry_point.is_empty() {
            return Err(whole("the module has no compute entry point"));
        }
        if reader.interface.workgroup.contains(&0) {
            return Err(whole("the entry point declares no workgroup size"));
        }
        let buffers: Option<Vec<BufferUse>> = reader.buffers.into_iter().collect();
        reader.interface.buffers = buffers.ok_or_else(|| whole("a binding that no runtime array has"))?;
        Ok(reader.interface)
    }
}

/// Facts by id, gathered in module order: a type is always defined before it is used in another.
#[derive(Default)]
struct Reader {
    interface: Interface,
    /// By binding.
    buffers: Vec<Option<BufferUse>>,
    /// (id, decoration) -> first operand, 0 where it has none.
    decorations: BTreeMap<(u32, u32), u32>,
    /// (struct id, member) -> byte offset.
    offsets: BTreeMap<(u32, u32), u32>,
    /// Type id -> size in bytes, where it has one.
    sizes: BTreeMap<u32, u32>,
    /// Type id -> stride of the runtime array it is or ends with.
    strides: BTreeMap<u32, u32>,
    /// Pointer type id -> pointee type id.
    pointees: BTreeMap<u32, u32>,
    constants: BTreeMap<u32, u32>,
}

impl Reader {
    fn visit(&mut self, instruction: &Instruction<'_>) -> Result<(), ModuleError> {
        let word = |index| instruction.operand(index);
        match instruction.opcode {
            op::ENTRY_POINT => self.entry_point(instruction)?,
            op::EXECUTION_MODE if word(1)? == MODE_LOCAL_SIZE => {
                self.interface.workgroup = [word(2)?, word(3)?, word(4)?];
            }
            op::DECORATE => {
                let value = instruction.operands.get(2).copied().unwrap_or(0);
                self.decorations.insert((word(0)?, word(1)?), value);
            }
            op::MEMBER_DECORATE if word(2)? == DECORATION_OFFSET => {
                self.offsets.insert((word(0)?, word(1)?), word(3)?);
            }
            op::TYPE_INT | op::TYPE_FLOAT => {
                self.sizes.insert(word(0)?, word(1)? / 8);
            }
            op::TYPE_VECTOR => {
                let (id, length) = (word(0)?, word(2)?);
                let size = self.sizes.get(&word(1)?).map(|size| size.wrapping_mul(length));
                self.sizes.extend(size.map(|size| (id, size)));
            }
            op::TYPE_ARRAY => {
                let stride = self.decorations.get(&(word(0)?, DECORATION_ARRAY_STRIDE));
                let length = self.constants.get(&word(2)?);
                let size = stride
                    .zip(length)
                    .map(|(stride, length)| stride.wrapping_mul(*length));
                self.sizes
                    .extend(size.map(|size| (instruction.operands[0], size)));
            }
            op::TYPE_RUNTIME_ARRAY => {
                let stride = self
                    .decorations
                    .get(&(word(0)?, DECORATION_ARRAY_STRIDE))
                    .copied();
                self.strides
                    .extend(stride.map(|stride| (instruction.operands[0], stride)));
            }
            op::TYPE_STRUCT => self.structure(instruction)?,
            op::TYPE_POINTER => {
                self.pointees.insert(word(0)?, word(2)?);
            }
            op::CONSTANT => {
                self.constants.insert(word(1)?, word(2)?);
            }
            op::VARIABLE => self.variable(instruction)?,
            _ => {}
        }
        Ok(())
    }

    fn entry_point(&mut self, instruction: &Instruction<'_>) -> Result<(), ModuleError> {
        if instruction.operand(0)? != GL_COMPUTE {
            return Err(instruction.error("an entry point that is not a compute kernel"));
        }
        if !self.interface.entry_point.is_empty() {
            return Err(instruction.error("more than one entry point"));
        }
        // A literal string: UTF-8, four bytes to a word from the low end, ended by a zero byte.
        let bytes: Vec<u8> = instruction
            .operands
            .iter()
            .skip(2)
            .flat_map(|word| word.to_le_bytes())
            .collect();
        let name = bytes.split(|byte| *byte == 0).next().unwrap_or_default();
        match core::str::from_utf8(name) {
            Ok(name) if !name.is_empty() && name.len() < bytes.len() => {
                self.interface.entry_point = name.into()
            }
            _ => return Err(instruction.error("the entry point's name is not a string")),
        }
        Ok(())
    }

    /// A structure ends where its last-reaching member ends.
    fn structure(&mut self, instruction: &Instruction<'_>) -> Result<(), ModuleError> {
        let id = instruction.operand(0)?;
        let members = &instruction.operands[1..];
        let end = (0u32..)
            .zip(members)
            .map(|(index, member)| {
                Some(
                    self.offsets
                        .get(&(id, index))?
                        .wrapping_add(*self.sizes.get(member)?),
                )
            })
            .try_fold(0, |end: u32, member| Some(end.max(member?)));
        self.sizes.extend(end.map(|end| (id, end)));
        let stride = members
            .last()
            .and_then(|member| self.strides.get(member))
            .copied();
        self.strides.extend(stride.map(|stride| (id, stride)));
        Ok(())
    }

    fn variable(&mut self, instruction: &Instruction<'_>) -> Result<(), ModuleError> {
        let id = instruction.operand(1)?;
        let pointee = self.pointees.get(&instruction.operand(0)?).copied().unwrap_or(0);
        match instruction.operand(2)? {
            STORAGE_PUSH_CONSTANT => {
                let size = self.sizes.get(&pointee).copied();
                self.interface.push_constants =
                    size.ok_or_else(|| instruction.error("a push constant block of unknown size"))?;
            }
            STORAGE_BUFFER => {
                let decoration = |kind| self.decorations.get(&(id, kind)).copied();
                if decoration(DECORATION_DESCRIPTOR_SET) != Some(0) {
                    return Err(instruction.error("a storage buffer outside descriptor set 0"));
                }
                let binding = decoration(DECORATION_BINDING)
                    .filter(|binding| *binding < MAX_BINDINGS)
                    .ok_or_else(|| instruction.error("a storage buffer without a usable binding"))?;
                let access = match decoration(DECORATION_NON_WRITABLE) {
                    Some(_) => Access::Read,
                    None => Access::Write,
                };
                let stride = self.strides.get(&pointee);
                let buffers = &mut self.buffers;
                buffers.resize(buffers.len().max(binding as usize + 1), None);
                buffers[binding as usize] = stride.map(|&stride| BufferUse { access, stride });
            }
            STORAGE_UNIFORM | STORAGE_UNIFORM_CONSTANT => {
                return Err(instruction.error("a resource that is not a storage buffer"));
            }
            _ => {}
        }
        Ok(())
    }
}

#[cfg(all(test, feature = "kernels"))]
mod tests {
    use super::super::words::HEADER;
    use super::*;

    #[test]
    fn any_cut_or_flipped_word_gives_a_value_or_an_error() {
        let words = crate::table::SELF_TEST.words();
        for end in 0..words.len() {
            let _ = Interface::read(&words[..end]);
        }
        for at in 0..words.len() {
            for value in [0, u32::MAX, words[at] ^ 0x0001_0000, words[at].wrapping_add(1)] {
                let mut corrupt = words.clone();
                corrupt[at] = value;
                let _ = Interface::read(&corrupt);
            }
        }
        assert!(Interface::read(&words[..HEADER]).is_err());
    }
}

//! Memory through which invocations of one dispatch speak to each other.
//!
//! In the Vulkan memory model a load or store is private unless it says otherwise, and no atomic and no barrier of a shader
//! orders private accesses of different invocations (Vulkan specification, appendix "Memory Model", "Private vs.
//! Non-Private"). rust-gpu writes all of them private. In a kernel with arrival counters the invocation that comes last to
//! a node reads what others wrote, so there every access to a buffer that the kernel writes becomes `NonPrivatePointer`; the
//! counter's semantics then make writes available and visible for all of them. (`Coherent`, which does this in the
//! older model, is not allowed in this one.) Kernels without atomics stay as they are: their dispatches meet at barriers of
//! the command buffer, which order private accesses too.

use rspirv::dr::{Instruction, Module, Operand};
use rspirv::spirv::{Decoration, MemoryAccess, Op, StorageClass};
use std::collections::{HashMap, HashSet};

/// Marks the accesses to written buffers in a module with atomics.
pub(crate) fn publish(module: &mut Module) {
    if !has_atomics(module) {
        return;
    }
    let shared = SharedPointers::of(module);
    let instructions = module
        .functions
        .iter_mut()
        .flat_map(|function| &mut function.blocks)
        .flat_map(|block| &mut block.instructions);
    for inst in instructions {
        if shared.is_accessed_by(inst) && !is_non_private(inst) {
            let at = operands_before_access(inst.class.opcode);
            match inst.operands.get_mut(at) {
                Some(Operand::MemoryAccess(access)) => *access |= MemoryAccess::NON_PRIVATE_POINTER,
                _ => inst
                    .operands
                    .insert(at, Operand::MemoryAccess(MemoryAccess::NON_PRIVATE_POINTER)),
            }
        }
    }
}

/// Whether invocations of the module's kernel may meet.
pub(crate) fn has_atomics(module: &Module) -> bool {
    module.all_inst_iter().any(|inst| is_atomic(inst.class.opcode))
}

/// Operations on counters, by their names.
pub(crate) fn is_atomic(op: Op) -> bool {
    format!("{op:?}").starts_with("Atomic")
}

/// Whether a load or store takes part in what atomics order.
pub(crate) fn is_non_private(inst: &Instruction) -> bool {
    let at = operands_before_access(inst.class.opcode);
    matches!(inst.operands.get(at), Some(Operand::MemoryAccess(access)) if access.contains(MemoryAccess::NON_PRIVATE_POINTER))
}

/// Pointer, and value of a store; then comes what is said of the access.
fn operands_before_access(op: Op) -> usize {
    if op == Op::Load { 1 } else { 2 }
}

/// The pointers into storage buffers that the module does not declare read-only, with the buffer that each leads into as far
/// as it is known, or else itself.
pub(crate) struct SharedPointers(HashMap<u32, u32>);

impl SharedPointers {
    pub(crate) fn of(module: &Module) -> Self {
        let read_only: HashSet<u32> = module
            .annotations
            .iter()
            .filter_map(|inst| match inst.operands.as_slice() {
                [Operand::IdRef(id), Operand::Decoration(Decoration::NonWritable)] => Some(*id),
                _ => None,
            })
            .collect();
        let classes: HashMap<u32, StorageClass> = module
            .types_global_values
            .iter()
            .filter_map(|inst| match (inst.class.opcode, inst.operands.first()) {
                (Op::TypePointer, Some(Operand::StorageClass(class))) => Some((inst.result_id?, *class)),
                _ => None,
            })
            .collect();
        let mut shared = HashMap::new();
        let mut private = HashSet::new();
        for inst in module.all_inst_iter() {
            let (Some(id), Some(ty)) = (inst.result_id, inst.result_type) else {
                continue;
            };
            if classes.get(&ty) != Some(&StorageClass::StorageBuffer) {
                continue;
            }
            // A way into a read-only buffer; a pointer that is come by in any other way may lead anywhere.
            let base = match (inst.class.opcode, inst.operands.first()) {
                (Op::AccessChain | Op::InBoundsAccessChain | Op::CopyObject, Some(Operand::IdRef(base))) => {
                    Some(*base)
                }
                _ => None,
            };
            if read_only.contains(&id) || base.is_some_and(|base| private.contains(&base)) {
                private.insert(id);
            } else {
                let buffer = base.and_then(|base| shared.get(&base).copied());
                shared.insert(id, buffer.unwrap_or(id));
            }
        }
        Self(shared)
    }

    /// Whether the instruction loads from or stores to such a pointer.
    pub(crate) fn is_accessed_by(&self, inst: &Instruction) -> bool {
        matches!(inst.class.opcode, Op::Load | Op::Store) && self.buffer_of(inst).is_some()
    }

    /// Whether the instruction copies from or to such a pointer.
    pub(crate) fn is_copied_by(&self, inst: &Instruction) -> bool {
        matches!(inst.class.opcode, Op::CopyMemory | Op::CopyMemorySized)
            && inst
                .operands
                .iter()
                .take(2)
                .any(|operand| matches!(operand, Operand::IdRef(id) if self.0.contains_key(id)))
    }

    /// Where the instruction's first operand leads, if it is such a pointer.
    pub(crate) fn buffer_of(&self, inst: &Instruction) -> Option<u32> {
        match inst.operands.first() {
            Some(Operand::IdRef(id)) => self.0.get(id).copied(),
            _ => None,
        }
    }
}

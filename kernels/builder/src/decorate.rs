//! The post-pass: what rust-gpu leaves out for equal bits, and what it leaves in that nobody needs.
//!
//! Vulkan lets a driver fuse and rearrange float arithmetic unless the result is decorated `NoContraction`
//! (Vulkan specification, "Precision and Operation of SPIR-V Instructions"), and rust-gpu never decorates. The pass
//! runs after the link, because the linker merges scalar instructions into vector ones and would lose decorations.
//!
//! Nothing here asks a device for a feature: no execution mode and no capability is added.

use crate::branches::one_armed;
use crate::{Error, load};
use rspirv::binary::Assemble;
use rspirv::dr::{Instruction, Module, Operand};
use rspirv::spirv::{Capability, Decoration, Op};
use std::collections::HashSet;

/// Returns the module with `NoContraction` on the result of every float operation, without debug information (it
/// holds absolute paths and whole source files), without the capability that braked `spirv-opt`, without empty arms
/// of branches.
///
/// # Errors
/// When the words are not a SPIR-V module.
pub fn decorate(words: &[u32]) -> Result<Vec<u32>, Error> {
    let mut module = load(words)?;
    strip_debug(&mut module);
    strip_brake(&mut module);
    one_armed(&mut module);
    forbid_contraction(&mut module);
    Ok(module.assemble())
}

/// The result ids of all float arithmetic in `module`, in the order of the instructions.
pub(crate) fn float_operations(module: &Module) -> impl Iterator<Item = &Instruction> {
    let floats = float_types(module);
    module.all_inst_iter().filter(move |inst| {
        is_float_arithmetic(inst.class.opcode)
            || (inst.class.opcode == Op::ExtInst && inst.result_type.is_some_and(|ty| floats.contains(&ty)))
    })
}

/// The ids that carry `NoContraction`.
pub(crate) fn uncontracted(module: &Module) -> HashSet<u32> {
    let decorations = module
        .annotations
        .iter()
        .filter(|inst| inst.class.opcode == Op::Decorate);
    decorations
        .filter_map(|inst| match inst.operands.as_slice() {
            [Operand::IdRef(id), Operand::Decoration(Decoration::NoContraction)] => Some(*id),
            _ => None,
        })
        .collect()
}

/// Whether the instruction computes floats from floats by arithmetic. Comparisons, selections, moves and conversions
/// are not arithmetic: there is nothing in them to fuse.
fn is_float_arithmetic(op: Op) -> bool {
    matches!(
        op,
        Op::FNegate
            | Op::FAdd
            | Op::FSub
            | Op::FMul
            | Op::FDiv
            | Op::FRem
            | Op::FMod
            | Op::VectorTimesScalar
            | Op::MatrixTimesScalar
            | Op::VectorTimesMatrix
            | Op::MatrixTimesVector
            | Op::MatrixTimesMatrix
            | Op::OuterProduct
            | Op::Dot
    )
}

/// Ids of the float types: scalars, and vectors and matrices of them.
pub(crate) fn float_types(module: &Module) -> HashSet<u32> {
    let mut floats = HashSet::new();
    for inst in &module.types_global_values {
        let composed_of_floats = matches!(inst.class.opcode, Op::TypeVector | Op::TypeMatrix)
            && matches!(inst.operands.first(), Some(Operand::IdRef(part)) if floats.contains(part));
        if inst.class.opcode == Op::TypeFloat || composed_of_floats {
            floats.extend(inst.result_id);
        }
    }
    floats
}

fn forbid_contraction(module: &mut Module) {
    let done = uncontracted(module);
    let missing: Vec<u32> = float_operations(module)
        .filter_map(|inst| inst.result_id)
        .filter(|id| !done.contains(id))
        .collect();
    module.annotations.extend(missing.into_iter().map(|id| {
        let operands = vec![Operand::IdRef(id), Operand::Decoration(Decoration::NoContraction)];
        Instruction::new(Op::Decorate, None, None, operands)
    }));
}

fn strip_debug(module: &mut Module) {
    module.debug_string_source.clear();
    module.debug_names.clear();
    module.debug_module_processed.clear();
    let is_line = |inst: &Instruction| matches!(inst.class.opcode, Op::Line | Op::NoLine);
    module.types_global_values.retain(|inst| !is_line(inst));
    for block in module
        .functions
        .iter_mut()
        .flat_map(|function| &mut function.blocks)
    {
        block.instructions.retain(|inst| !is_line(inst));
    }
}

/// Drops the capability `SignedZeroInfNanPreserve`. The build declares it only because `spirv-opt` leaves float algebra alone in a
/// module that has it.
fn strip_brake(module: &mut Module) {
    let brake = Operand::Capability(Capability::SignedZeroInfNanPreserve);
    module.capabilities.retain(|inst| !inst.operands.contains(&brake));
}

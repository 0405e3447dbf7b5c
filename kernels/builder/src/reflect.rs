//! The interface of a module: what the host must bind to run it.

use crate::{Unreadable, load};
use rspirv::dr::{Instruction, Module, Operand};
use rspirv::spirv::{Decoration, ExecutionMode, Op, StorageClass};
use serde::{Deserialize, Serialize};
use std::collections::HashMap;

/// What the host must know of a kernel.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Interface {
    /// Name of the entry point.
    pub entry_point: String,
    /// Invocations of a workgroup in x, y and z.
    pub workgroup: [u32; 3],
    /// Number of storage buffers: bindings 0 to `bindings - 1` of descriptor set 0.
    pub bindings: u32,
    /// Size of the push constants in bytes; 0 when there are none.
    pub push_constant_bytes: u32,
}

/// Why a module's interface is not one that the host offers.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ReflectError {
    /// The words are no module.
    #[error(transparent)]
    Unreadable(#[from] Unreadable),
    /// Not exactly one entry point.
    #[error("the module has {found} entry points, expected 1; build with multimodule(true)")]
    EntryPoints {
        /// How many there are.
        found: usize,
    },
    /// No fixed workgroup size.
    #[error("entry point `{entry_point}` has no LocalSize; write #[spirv(compute(threads(64)))]")]
    NoLocalSize {
        /// The entry point.
        entry_point: String,
    },
    /// A buffer outside the layout that all kernels share.
    #[error(
        "entry point `{entry_point}`: buffer %{id} is at set {set}, binding {binding}; \
         kernels use set 0 with bindings 0, 1, .. in parameter order, each once"
    )]
    Binding {
        /// The entry point.
        entry_point: String,
        /// Result id of the variable.
        id: u32,
        /// Its descriptor set.
        set: u32,
        /// Its binding.
        binding: u32,
    },
}

/// Reads the interface of a module with one entry point.
///
/// # Errors
/// When the words are no module, or its interface is not the one that all kernels share.
pub fn reflect(words: &[u32]) -> Result<Interface, ReflectError> {
    let module = load(words)?;
    let [entry] = module.entry_points.as_slice() else {
        return Err(ReflectError::EntryPoints {
            found: module.entry_points.len(),
        });
    };
    let entry_point = entry.operands.iter().find_map(literal_string).unwrap_or_default();
    let workgroup = local_size(&module).ok_or_else(|| ReflectError::NoLocalSize {
        entry_point: entry_point.clone(),
    })?;
    let bindings = count_bindings(&module, &entry_point)?;
    let push_constant_bytes = variables(&module, StorageClass::PushConstant)
        .map(|variable| pointee_size(&module, variable))
        .max()
        .unwrap_or(0);
    Ok(Interface {
        entry_point,
        workgroup,
        bindings,
        push_constant_bytes,
    })
}

fn literal_string(operand: &Operand) -> Option<String> {
    match operand {
        Operand::LiteralString(text) => Some(text.clone()),
        _ => None,
    }
}

fn literal(operand: &Operand) -> Option<u32> {
    match operand {
        Operand::LiteralBit32(value) => Some(*value),
        _ => None,
    }
}

fn local_size(module: &Module) -> Option<[u32; 3]> {
    let is_size =
        |inst: &&Instruction| inst.operands.get(1) == Some(&Operand::ExecutionMode(ExecutionMode::LocalSize));
    let size = module.execution_modes.iter().find(is_size)?;
    let dims: Vec<u32> = size.operands.iter().filter_map(literal).collect();
    dims.try_into().ok()
}

fn variables(module: &Module, class: StorageClass) -> impl Iterator<Item = &Instruction> {
    module.types_global_values.iter().filter(move |inst| {
        inst.class.opcode == Op::Variable && inst.operands.first() == Some(&Operand::StorageClass(class))
    })
}

/// The literal of a decoration with one, such as `Binding`.
fn decoration(module: &Module, id: u32, kind: Decoration) -> Option<u32> {
    module
        .annotations
        .iter()
        .find_map(|inst| match inst.operands.as_slice() {
            [Operand::IdRef(target), Operand::Decoration(found), value]
                if *target == id && *found == kind =>
            {
                literal(value)
            }
            _ => None,
        })
}

fn count_bindings(module: &Module, entry_point: &str) -> Result<u32, ReflectError> {
    let mut seen = Vec::new();
    for id in variables(module, StorageClass::StorageBuffer).filter_map(|inst| inst.result_id) {
        let set = decoration(module, id, Decoration::DescriptorSet).unwrap_or(u32::MAX);
        let binding = decoration(module, id, Decoration::Binding).unwrap_or(u32::MAX);
        seen.push((binding, set, id));
    }
    seen.sort_unstable();
    for (expected, &(binding, set, id)) in seen.iter().enumerate() {
        if set != 0 || binding as usize != expected {
            return Err(ReflectError::Binding {
                entry_point: entry_point.to_owned(),
                id,
                set,
                binding,
            });
        }
    }
    Ok(seen.len() as u32)
}

/// Size in bytes of what the variable's pointer points at.
fn pointee_size(module: &Module, variable: &Instruction) -> u32 {
    let types: HashMap<u32, &Instruction> = module
        .types_global_values
        .iter()
        .filter_map(|inst| Some((inst.result_id?, inst)))
        .collect();
    let pointer = variable.result_type.and_then(|id| types.get(&id));
    match pointer.and_then(|inst| inst.operands.get(1)) {
        Some(Operand::IdRef(pointee)) => size(module, &types, *pointee),
        _ => 0,
    }
}

/// Size in bytes of a type as laid out by its offsets and strides; 0 for a type without a size.
fn size(module: &Module, types: &HashMap<u32, &Instruction>, id: u32) -> u32 {
    let Some(inst) = types.get(&id) else { return 0 };
    match (inst.class.opcode, inst.operands.as_slice()) {
        (Op::TypeInt | Op::TypeFloat, [Operand::LiteralBit32(bits), ..]) => bits / 8,
        (Op::TypeVector, [Operand::IdRef(part), Operand::LiteralBit32(count)]) => {
            size(module, types, *part).saturating_mul(*count)
        }
        (Op::TypeArray, [_, Operand::IdRef(length)]) => {
            let count = types
                .get(length)
                .and_then(|inst| inst.operands.first())
                .and_then(literal);
            let stride = decoration(module, id, Decoration::ArrayStride);
            stride.unwrap_or(0).saturating_mul(count.unwrap_or(0))
        }
        (Op::TypeStruct, members) => (0u32..)
            .zip(members)
            .map(|(index, member)| match member {
                Operand::IdRef(part) => member_offset(module, id, index) + size(module, types, *part),
                _ => 0,
            })
            .max()
            .unwrap_or(0),
        _ => 0,
    }
}

fn member_offset(module: &Module, structure: u32, member: u32) -> u32 {
    let is_offset = |inst: &Instruction| match inst.operands.as_slice() {
        [
            Operand::IdRef(target),
            Operand::LiteralBit32(index),
            Operand::Decoration(Decoration::Offset),
            value,
        ] if *target == structure && *index == member => literal(value),
        _ => None,
    };
    module.annotations.iter().find_map(is_offset).unwrap_or(0)
}

//! Atomics: arrival counters, and nothing else.
//!
//! A kernel's words must not depend on the order of its invocations. A counter at which all but the last to arrive end keeps
//! to that, if the last one sees what the others wrote; so one atomic instruction is permitted, in the one form that
//! promises this in the Vulkan memory model, and in its company no access that the promise does not cover.

use super::Findings;
use crate::publish::{SharedPointers, has_atomics, is_atomic, is_non_private};
use rspirv::dr::{Instruction, Module, Operand};
use rspirv::spirv::{MemorySemantics, Op, Scope};
use std::collections::{HashMap, HashSet};

/// The semantics of an arrival: see `arrive` in the kernels.
fn semantics() -> u32 {
    (MemorySemantics::ACQUIRE_RELEASE
        | MemorySemantics::UNIFORM_MEMORY
        | MemorySemantics::MAKE_AVAILABLE
        | MemorySemantics::MAKE_VISIBLE)
        .bits()
}

const REMEDY: &str = "count arrivals with `arrive` (kernels/src/arrival.rs)";

/// Looks at all atomics, and in a module that has any at all accesses.
pub(super) fn arrivals(module: &Module, findings: &mut Findings) {
    if !has_atomics(module) {
        return;
    }
    let constants: HashMap<u32, u32> = module
        .types_global_values
        .iter()
        .filter(|inst| inst.class.opcode == Op::Constant)
        .filter_map(|inst| match inst.operands.as_slice() {
            [Operand::LiteralBit32(value)] => Some((inst.result_id?, *value)),
            _ => None,
        })
        .collect();
    let operand = |inst: &Instruction, at: usize| match inst.operands.get(at) {
        Some(Operand::IdScope(id) | Operand::IdMemorySemantics(id) | Operand::IdRef(id)) => {
            constants.get(id).copied()
        }
        _ => None,
    };
    let shared = SharedPointers::of(module);
    let instructions = || {
        module
            .functions
            .iter()
            .flat_map(|function| function.all_inst_iter())
    };
    let counters: HashSet<u32> = instructions()
        .filter(|inst| is_atomic(inst.class.opcode))
        .filter_map(|inst| shared.buffer_of(inst))
        .collect();
    for inst in instructions() {
        let op = inst.class.opcode;
        // Other atomics are not among the permitted operations.
        if op == Op::AtomicIAdd {
            if operand(inst, 1) != Some(Scope::QueueFamily as u32) {
                let rule = "an arrival counts among the queue family; the wider scope is not on every device";
                findings.refuse(inst, rule, REMEDY);
            }
            if operand(inst, 2) != Some(semantics()) {
                let rule = "an arrival must show what was written before it and see what others wrote";
                findings.refuse(inst, rule, REMEDY);
            }
            if operand(inst, 3) != Some(1) {
                findings.refuse(inst, "an arrival counts one", REMEDY);
            }
            if shared.buffer_of(inst).is_none() {
                findings.refuse(inst, "a counter lies in a storage buffer that is written", REMEDY);
            }
        }
        if shared.is_copied_by(inst) {
            let rule = "with arrival counters, copies to and from written buffers are not ordered";
            findings.refuse(inst, rule, "load and store the value");
        }
        if shared.is_accessed_by(inst) && !is_non_private(inst) {
            let rule = "with arrival counters, a private access to a written buffer is not ordered by them";
            let remedy = "run the module through decorate (build-kernels does)";
            findings.refuse(inst, rule, remedy);
        }
        if op == Op::Load
            && shared
                .buffer_of(inst)
                .is_some_and(|buffer| counters.contains(&buffer))
        {
            findings.refuse(inst, "a counter may change while it is read", REMEDY);
        }
    }
}

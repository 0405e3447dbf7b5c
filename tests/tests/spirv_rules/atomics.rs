//! Atomics and barriers, of which no kernel has any: what they give depends on who comes first.

use lightbvh_kernels_builder::manifest;
use rspirv::binary::Assemble;
use rspirv::dr::{Instruction, Operand};
use rspirv::spirv::{MemoryAccess, Op, StorageClass};

use super::module::{complaint, complaint_about, module};
use super::shipped::root;

/// An invocation that adds one to a counter in a buffer.
fn counting() -> Vec<u32> {
    let words = module(|b, t| {
        let pointer = b.type_pointer(None, StorageClass::StorageBuffer, t.uint);
        let [scope, semantics, one] = [5, 0, 1].map(|value| b.constant_bit32(t.uint, value));
        let counter = b.variable(pointer, None, StorageClass::StorageBuffer, None);
        b.atomic_i_add(t.uint, None, counter, scope, semantics, one)
            .unwrap();
    });
    // Variables of buffers stand outside of functions.
    let mut module = rspirv::dr::load_words(&words).unwrap();
    let block = &mut module.functions[0].blocks[0].instructions;
    let (variables, rest) = block
        .drain(..)
        .partition(|inst: &Instruction| inst.class.opcode == Op::Variable);
    *block = rest;
    module.types_global_values.extend::<Vec<_>>(variables);
    module.assemble()
}

#[test]
fn atomics_are_refused() {
    for op in [
        Op::AtomicIAdd,
        Op::AtomicISub,
        Op::AtomicExchange,
        Op::AtomicUMin,
        Op::AtomicOr,
        Op::AtomicFAddEXT,
    ] {
        let mut module = rspirv::dr::load_words(counting()).unwrap();
        let instructions = &mut module.functions[0].blocks[0].instructions;
        let inst = instructions
            .iter_mut()
            .find(|inst| inst.class.opcode == Op::AtomicIAdd)
            .expect("an addition");
        *inst = Instruction::new(op, inst.result_type, inst.result_id, inst.operands.clone());
        let text = complaint(&module.assemble());
        assert!(text.contains("order of arrival"), "{op:?}: {text}");
    }
}

#[test]
fn barriers_are_refused() {
    let text = complaint_about(|b, t| {
        let [scope, semantics] = [5, 0x48].map(|value| b.constant_bit32(t.uint, value));
        b.memory_barrier(scope, semantics).unwrap();
    });
    assert!(text.contains("OpMemoryBarrier"), "{text}");
}

/// Accesses stay private, which is faster: no invocation reads what another of its dispatch writes.
#[test]
fn shipped_modules_share_no_memory() {
    for record in manifest::read(root()).unwrap().modules {
        let words = manifest::read_module(root(), &record).unwrap();
        let module = rspirv::dr::load_words(&words).unwrap();
        let marked = Operand::MemoryAccess(MemoryAccess::NON_PRIVATE_POINTER);
        let shared = module.all_inst_iter().any(|inst| inst.operands.contains(&marked));
        assert!(!shared, "{}", record.file);
    }
}

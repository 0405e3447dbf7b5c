//! Where invocations meet: atomics, barriers, and memory that is shared.

use lightbvh_kernels_builder::decorate::decorate;
use lightbvh_kernels_builder::manifest;
use rspirv::binary::Assemble;
use rspirv::dr::{Instruction, Operand};
use rspirv::spirv::{Decoration, MemoryAccess, Op, StorageClass};

use super::module::{complaint, module};
use super::shipped::root;

/// What an arrival is written as.
#[derive(Clone, Copy)]
struct Arrival {
    scope: u32,
    semantics: u32,
    /// The value added.
    one: u32,
    /// Whether the counter is also read without an atomic.
    read: bool,
}

/// As `arrive` in the kernels: queue family; acquire and release, storage buffers, available and visible.
const ARRIVAL: Arrival = Arrival {
    scope: 5,
    semantics: 0x8 | 0x40 | 0x2000 | 0x4000,
    one: 1,
    read: false,
};

/// Stores to one buffer, arrives at a counter in another, loads from the first and from a third that is read-only.
fn arriving(arrival: Arrival) -> Vec<u32> {
    let words = module(|b, t| {
        let pointer = b.type_pointer(None, StorageClass::StorageBuffer, t.uint);
        let [scope, semantics, one] =
            [arrival.scope, arrival.semantics, arrival.one].map(|value| b.constant_bit32(t.uint, value));
        let [data, counter, read_only] =
            [(); 3].map(|()| b.variable(pointer, None, StorageClass::StorageBuffer, None));
        b.decorate(read_only, Decoration::NonWritable, []);
        let inside = b.access_chain(pointer, None, data, []).unwrap();
        b.store(inside, one, None, []).unwrap();
        b.atomic_i_add(t.uint, None, counter, scope, semantics, one)
            .unwrap();
        if arrival.read {
            b.load(t.uint, None, counter, None, []).unwrap();
        }
        b.load(t.uint, None, inside, None, []).unwrap();
        b.load(t.uint, None, read_only, None, []).unwrap();
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

/// The loads and stores of a module, in order, and whether each is non-private.
fn non_private(words: &[u32]) -> Vec<(Op, bool)> {
    let module = rspirv::dr::load_words(words).unwrap();
    let marked = Operand::MemoryAccess(MemoryAccess::NON_PRIVATE_POINTER);
    module
        .all_inst_iter()
        .filter(|inst| matches!(inst.class.opcode, Op::Load | Op::Store))
        .map(|inst| (inst.class.opcode, inst.operands.contains(&marked)))
        .collect()
}

#[test]
fn where_invocations_meet_their_memory_is_shared() {
    let words = arriving(ARRIVAL);
    let text = complaint(&words);
    assert!(
        text.contains("2 violation(s)") && text.contains("private access"),
        "{text}"
    );
    let decorated = decorate(&words).unwrap();
    assert_eq!(complaint(&decorated), "");
    assert_eq!(
        non_private(&decorated),
        [(Op::Store, true), (Op::Load, true), (Op::Load, false)]
    );
    assert_eq!(
        decorate(&decorated).unwrap(),
        decorated,
        "decorating twice changes nothing"
    );
    // Every other kernel's accesses stay private, which is faster.
    for record in manifest::read(root()).unwrap().modules {
        let words = manifest::read_module(root(), &record).unwrap();
        let shared = non_private(&words).iter().any(|&(_, marked)| marked);
        assert_eq!(shared, record.file.starts_with("refit_climb"), "{}", record.file);
    }
}

#[test]
fn arrivals_in_any_other_form_are_refused() {
    let about = |arrival| complaint(&decorate(&arriving(arrival)).unwrap());
    for scope in [0, 1, 2, 3, 4] {
        let text = about(Arrival { scope, ..ARRIVAL });
        assert!(
            text.contains("1 violation(s)") && text.contains("queue family"),
            "{text}"
        );
    }
    for bit in [0x8, 0x40, 0x2000, 0x4000, 0x8000] {
        let semantics = ARRIVAL.semantics ^ bit;
        let text = about(Arrival { semantics, ..ARRIVAL });
        assert!(
            text.contains("1 violation(s)") && text.contains("see what others wrote"),
            "{text}"
        );
    }
    let text = about(Arrival { one: 2, ..ARRIVAL });
    assert!(text.contains("counts one"), "{text}");
    let text = about(Arrival {
        read: true,
        ..ARRIVAL
    });
    assert!(text.contains("may change while it is read"), "{text}");
}

#[test]
fn other_atomics_and_barriers_are_refused() {
    let with = |change: &dyn Fn(&mut Instruction)| {
        let mut module = rspirv::dr::load_words(decorate(&arriving(ARRIVAL)).unwrap()).unwrap();
        let instructions = &mut module.functions[0].blocks[0].instructions;
        let at = instructions
            .iter()
            .position(|inst| inst.class.opcode == Op::AtomicIAdd)
            .expect("an arrival");
        change(&mut instructions[at]);
        complaint(&module.assemble())
    };
    assert_eq!(with(&|_| ()), "");
    for op in [
        Op::AtomicISub,
        Op::AtomicExchange,
        Op::AtomicUMin,
        Op::AtomicOr,
        Op::AtomicFAddEXT,
    ] {
        let text = with(&|inst| {
            *inst = Instruction::new(op, inst.result_type, inst.result_id, inst.operands.clone());
        });
        assert!(text.contains("order of arrival"), "{op:?}: {text}");
    }
    let text = with(&|inst| {
        let operands = inst.operands[1..3].to_vec();
        *inst = Instruction::new(Op::MemoryBarrier, None, None, operands);
    });
    assert!(
        text.contains("OpMemoryBarrier") && text.contains("no kernel waits"),
        "{text}"
    );
}

//! The committed kernels belong to the committed sources and obey the rules; modules that do not are refused.

use lightbvh_kernels::WORKGROUP;
use lightbvh_kernels_builder::decorate::decorate;
use lightbvh_kernels_builder::manifest::{self, ManifestError};
use lightbvh_kernels_builder::reflect::reflect;
use lightbvh_kernels_builder::verify::{VerifyError, verify};
use rspirv::binary::Assemble;
use rspirv::dr::{Builder, Instruction, Operand};
use rspirv::spirv::{
    AddressingModel, Capability, Decoration, ExecutionMode, ExecutionModel, FunctionControl, GlslStd450Op,
    LoopControl, MemoryAccess, MemoryModel, Op, SelectionControl, StorageClass,
};
use std::path::Path;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .parent()
        .expect("the workspace above the tests")
}

#[test]
fn shipped_modules_are_those_of_the_sources() {
    let manifest = manifest::check(root()).unwrap_or_else(|error| panic!("{error}"));
    assert!(
        manifest
            .modules
            .iter()
            .any(|record| record.file == "self_test.spv")
    );
}

#[test]
fn shipped_modules_obey_the_rules() {
    for record in manifest::read(root()).unwrap().modules {
        let words = manifest::read_module(root(), &record).unwrap();
        verify(&record.file, &words).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(record.interface.workgroup, [WORKGROUP, 1, 1], "{}", record.file);
        assert_eq!(format!("{}.spv", record.interface.entry_point), record.file);
        assert!(record.interface.push_constant_bytes <= 128, "{}", record.file);
    }
}

#[test]
fn shipped_modules_name_no_file_of_the_machine_that_built_them() {
    for record in manifest::read(root()).unwrap().modules {
        let words = manifest::read_module(root(), &record).unwrap();
        let module = rspirv::dr::load_words(&words).unwrap();
        assert!(
            module.debug_string_source.is_empty() && module.debug_names.is_empty(),
            "{}",
            record.file
        );
    }
}

/// A compute module whose body is what `body` writes between the entry label and the return.
fn module(body: impl FnOnce(&mut Builder, Types)) -> Vec<u32> {
    let mut b = Builder::new();
    b.set_version(1, 5);
    b.capability(Capability::Shader);
    b.capability(Capability::VulkanMemoryModel);
    b.memory_model(AddressingModel::Logical, MemoryModel::Vulkan);
    let void = b.type_void();
    let kernel = b.type_function(void, []);
    let float = b.type_float(32, None);
    let uint = b.type_int(32, 0);
    let two = b.constant_bit32(float, 2f32.to_bits());
    let three = b.constant_bit32(float, 3f32.to_bits());
    let glsl = b.ext_inst_import("GLSL.std.450");
    let main = b
        .begin_function(void, None, FunctionControl::NONE, kernel)
        .unwrap();
    b.begin_block(None).unwrap();
    body(
        &mut b,
        Types {
            float,
            uint,
            two,
            three,
            glsl,
        },
    );
    b.ret().unwrap();
    b.end_function().unwrap();
    b.entry_point(ExecutionModel::GLCompute, main, "kernel", []);
    b.execution_mode(main, ExecutionMode::LocalSize, [64, 1, 1]);
    b.module().assemble()
}

/// Ids that the bodies use.
struct Types {
    float: u32,
    uint: u32,
    two: u32,
    three: u32,
    glsl: u32,
}

/// The rules that the module breaks, as one text; empty when it is accepted.
fn complaint(words: &[u32]) -> String {
    match verify("kernel.spv", words) {
        Ok(()) => String::new(),
        Err(error) => error.to_string(),
    }
}

/// Decorates first, so that only the operation itself can be what is refused.
fn complaint_about(body: impl FnOnce(&mut Builder, Types)) -> String {
    complaint(&decorate(&module(body)).unwrap())
}

#[test]
fn an_undecorated_operation_is_refused_and_a_decorated_one_is_not() {
    let words = module(|b, t| {
        let product = b.f_mul(t.float, None, t.two, t.three).unwrap();
        let negative = b.f_negate(t.float, None, product).unwrap();
        b.f_add(t.float, None, product, negative).unwrap();
    });
    let text = complaint(&words);
    assert!(text.starts_with("kernel.spv: 3 violation(s)"), "{text}");
    for part in ["OpFMul", "OpFNegate", "OpFAdd", "NoContraction", "(result %"] {
        assert!(text.contains(part), "{part} is missing in: {text}");
    }
    let decorated = decorate(&words).unwrap();
    assert_eq!(complaint(&decorated), "");
    assert_eq!(
        decorate(&decorated).unwrap(),
        decorated,
        "decorating twice changes nothing"
    );
    assert_eq!(reflect(&decorated).unwrap().workgroup, [64, 1, 1]);
}

#[test]
fn inexact_operations_are_refused_even_when_decorated() {
    let text = complaint_about(|b, t| {
        b.f_div(t.float, None, t.two, t.three).unwrap();
    });
    assert!(
        text.contains("OpFDiv") && text.contains("lightbvh::exact::div"),
        "{text}"
    );
    let text = complaint_about(|b, t| {
        b.f_rem(t.float, None, t.two, t.three).unwrap();
        b.f_mod(t.float, None, t.two, t.three).unwrap();
    });
    assert!(text.contains("2 violation(s)"), "{text}");
    let text = complaint_about(|b, t| {
        let vector = b.type_vector(t.float, 2);
        let pair = b.constant_composite(vector, [t.two, t.three]);
        b.dot(t.float, None, pair, pair).unwrap();
    });
    assert!(
        text.contains("OpDot") && text.contains("lightbvh::vector"),
        "{text}"
    );
    let text = complaint_about(|b, t| {
        let wide = b.constant_bit32(t.uint, 7);
        b.convert_u_to_f(t.float, None, wide).unwrap();
    });
    assert!(text.contains("OpConvertUToF") && text.contains("i32"), "{text}");
}

#[test]
fn extended_instructions_are_refused_unless_defined_exactly() {
    let extended = |op: GlslStd450Op, operands: usize| {
        complaint_about(|b, t| {
            let values = [t.two, t.three, t.two].map(Operand::IdRef);
            b.ext_inst(
                t.float,
                None,
                t.glsl,
                op as u32,
                values[..operands].iter().cloned(),
            )
            .unwrap();
        })
    };
    for op in [GlslStd450Op::FAbs, GlslStd450Op::Floor, GlslStd450Op::Trunc] {
        assert_eq!(extended(op, 1), "", "{op:?}");
    }
    assert!(extended(GlslStd450Op::Sqrt, 1).contains("lightbvh::exact::sqrt"));
    assert!(extended(GlslStd450Op::InverseSqrt, 1).contains("lightbvh::exact::rsqrt"));
    assert!(extended(GlslStd450Op::Fma, 3).contains("mul_add"));
    assert!(extended(GlslStd450Op::Round, 1).contains("tie"));
    assert!(extended(GlslStd450Op::FMin, 2).contains("lightbvh::exact"));
    assert!(extended(GlslStd450Op::Sin, 1).contains("not among"));
}

#[test]
fn an_undecorated_extended_instruction_is_refused() {
    let words = module(|b, t| {
        b.ext_inst(
            t.float,
            None,
            t.glsl,
            GlslStd450Op::FAbs as u32,
            [Operand::IdRef(t.two)],
        )
        .unwrap();
    });
    assert!(complaint(&words).contains("NoContraction"));
}

#[test]
fn types_and_capabilities_outside_the_widest_set_are_refused() {
    let text = complaint_about(|b, _| {
        b.capability(Capability::Float64);
        b.capability(Capability::Int8);
        b.type_float(64, None);
        b.type_int(8, 0);
    });
    for part in [
        "4 violation(s)",
        "Float64",
        "Int8",
        "OpTypeFloat 64",
        "OpTypeInt 8 0",
    ] {
        assert!(text.contains(part), "{part} is missing in: {text}");
    }
    let text = complaint_about(|b, _| b.extension("SPV_KHR_float_controls"));
    assert!(text.contains("extensions"), "{text}");
}

#[test]
fn execution_modes_that_devices_may_lack_are_refused() {
    let words = module(|_, _| ());
    let mut module = rspirv::dr::load_words(&words).unwrap();
    let mut mode = module.execution_modes[0].clone();
    mode.operands.truncate(1);
    mode.operands
        .push(Operand::ExecutionMode(ExecutionMode::RoundingModeRTE));
    mode.operands.push(Operand::LiteralBit32(32));
    module.execution_modes.push(mode);
    let text = complaint(&module.assemble());
    assert!(
        text.contains("RoundingModeRTE") && text.contains("some devices lack"),
        "{text}"
    );
}

#[test]
fn constants_that_devices_may_change_are_refused() {
    let text = complaint_about(|b, t| {
        b.constant_bit32(t.float, f32::INFINITY.to_bits());
        b.constant_bit32(t.float, 1);
        b.constant_bit32(t.uint, 1);
    });
    assert!(
        text.contains("2 violation(s)") && text.contains("denormal"),
        "{text}"
    );
}

#[test]
fn computing_with_an_undefined_value_is_refused() {
    let text = complaint_about(|b, t| {
        let nothing = b.undef(t.float, None);
        b.f_add(t.float, None, nothing, t.two).unwrap();
    });
    assert!(text.contains("undefined value"), "{text}");
}

#[test]
fn debug_information_and_the_optimiser_brake_do_not_survive_decoration() {
    let words = module(|b, t| {
        b.capability(Capability::SignedZeroInfNanPreserve);
        let file = b.string("/home/someone/kernels/src/lib.rs");
        b.line(file, 1, 1);
        b.f_add(t.float, None, t.two, t.three).unwrap();
        b.name(t.two, "two");
    });
    let decorated = decorate(&words).unwrap();
    assert_eq!(complaint(&decorated), "");
    let module = rspirv::dr::load_words(&decorated).unwrap();
    assert!(module.debug_string_source.is_empty() && module.debug_names.is_empty());
    assert!(module.all_inst_iter().all(|inst| inst.class.opcode != Op::Line));
    assert_eq!(module.capabilities.len(), 2);
}

#[test]
fn a_buffer_outside_the_common_layout_is_refused() {
    let words = module(|b, t| {
        b.type_pointer(None, StorageClass::StorageBuffer, t.uint);
    });
    let mut module = rspirv::dr::load_words(&words).unwrap();
    let pointer = module.types_global_values.last().and_then(|inst| inst.result_id);
    let class = Operand::StorageClass(StorageClass::StorageBuffer);
    // A buffer without a descriptor set and binding.
    module
        .types_global_values
        .push(Instruction::new(Op::Variable, pointer, Some(999), vec![class]));
    let error = reflect(&module.assemble()).unwrap_err().to_string();
    assert!(error.contains("%999") && error.contains("set 0"), "{error}");
}

#[test]
fn words_that_are_no_module_are_refused() {
    assert!(matches!(
        verify("x.spv", &[1, 2, 3]),
        Err(VerifyError::Unreadable { .. })
    ));
    assert!(decorate(&[]).is_err());
    assert!(matches!(
        manifest::read(Path::new("/nowhere")),
        Err(ManifestError::File(_))
    ));
}

/// A loop whose body is a row of `count` selections between two blocks; with `work`, each of the two computes something.
fn loop_of_selections(count: usize, work: bool) -> Vec<u32> {
    module(|b, t| {
        let boolean = b.type_bool();
        let yes = b.constant_true(boolean);
        let [header, first, next, end] = [(); 4].map(|()| b.id());
        b.branch(header).unwrap();
        b.begin_block(Some(header)).unwrap();
        b.loop_merge(end, next, LoopControl::NONE, []).unwrap();
        b.branch(first).unwrap();
        b.begin_block(Some(first)).unwrap();
        for _ in 0..count {
            let [left, right, meeting] = [(); 3].map(|()| b.id());
            b.selection_merge(meeting, SelectionControl::NONE).unwrap();
            b.branch_conditional(yes, left, right, []).unwrap();
            let mut values = Vec::new();
            for side in [left, right] {
                b.begin_block(Some(side)).unwrap();
                let value = if work || side == left {
                    b.f_add(t.float, None, t.two, t.three).unwrap()
                } else {
                    t.three
                };
                values.push((value, side));
                b.branch(meeting).unwrap();
            }
            b.begin_block(Some(meeting)).unwrap();
            b.phi(t.float, None, values).unwrap();
        }
        b.branch(next).unwrap();
        b.begin_block(Some(next)).unwrap();
        b.branch_conditional(yes, header, end, []).unwrap();
        b.begin_block(Some(end)).unwrap();
    })
}

#[test]
fn an_arm_without_instructions_goes_away() {
    let words = decorate(&loop_of_selections(40, false)).unwrap();
    assert_eq!(complaint(&words), "");
    assert_eq!(
        decorate(&words).unwrap(),
        words,
        "decorating twice changes nothing"
    );
    let module = rspirv::dr::load_words(&words).unwrap();
    let blocks = &module.functions[0].blocks;
    // The entry, the loop's header, first block, last block and end, and two for each selection.
    assert_eq!(blocks.len(), 5 + 2 * 40);
    let labels: Vec<u32> = blocks
        .iter()
        .filter_map(|block| block.label.as_ref()?.result_id)
        .collect();
    let used = blocks.iter().flat_map(|block| &block.instructions);
    for inst in used.filter(|inst| matches!(inst.class.opcode, Op::Phi | Op::Branch)) {
        let Some(Operand::IdRef(block)) = inst.operands.last() else {
            panic!("{inst:?}");
        };
        assert!(labels.contains(block), "{inst:?}");
    }
}

#[test]
fn a_loop_with_too_many_ways_through_it_is_refused() {
    // As rust-gpu writes it; the post-pass makes such a loop acceptable.
    let text = complaint(&loop_of_selections(40, true));
    assert!(text.contains("OpLoopMerge"), "{text}");
    assert!(!complaint(&loop_of_selections(8, true)).contains("OpLoopMerge"));
    for arms in [false, true] {
        assert_eq!(complaint(&decorate(&loop_of_selections(40, arms)).unwrap()), "");
    }
}

#[test]
fn a_structure_of_pointers_is_refused() {
    let text = complaint_about(|b, t| {
        let pointer = b.type_pointer(None, StorageClass::Function, t.float);
        let closure = b.type_struct([pointer, t.uint]);
        let variable = b.variable(pointer, None, StorageClass::Function, None);
        let count = b.constant_bit32(t.uint, 7);
        b.composite_construct(closure, None, [variable, count]).unwrap();
    });
    assert!(
        text.contains("OpCompositeConstruct") && text.contains("closure"),
        "{text}"
    );
}

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

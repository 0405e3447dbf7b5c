//! Operations, types, modes and constants outside of what Vulkan defines exactly.

use lightbvh_gpu::spirv::Interface;
use lightbvh_kernels_builder::decorate::decorate;
use rspirv::binary::Assemble;
use rspirv::dr::{Builder, Instruction, Operand};
use rspirv::spirv::{Capability, ExecutionMode, GlslStd450Op, Op, StorageClass};

use super::module::{Types, complaint, complaint_about, module};

#[test]
fn an_undecorated_operation_is_refused_and_a_decorated_one_is_not() {
    let words = module(|b, t| {
        let product = b.f_mul(t.float, None, t.two, t.three).unwrap();
        let negative = b.f_negate(t.float, None, product).unwrap();
        let sum = b.f_add(t.float, None, product, negative).unwrap();
        let absolute = GlslStd450Op::FAbs as u32;
        b.ext_inst(t.float, None, t.glsl, absolute, [Operand::IdRef(sum)])
            .unwrap();
    });
    let text = complaint(&words);
    assert!(text.starts_with("kernel.spv: 4 violation(s)"), "{text}");
    for part in [
        "OpFMul",
        "OpFNegate",
        "OpFAdd",
        "OpExtInst",
        "NoContraction",
        "(result %",
    ] {
        assert!(text.contains(part), "{part} is missing in: {text}");
    }
    let decorated = decorate(&words).unwrap();
    assert_eq!(complaint(&decorated), "");
    assert_eq!(
        decorate(&decorated).unwrap(),
        decorated,
        "decorating twice changes nothing"
    );
    assert_eq!(Interface::read(&decorated).unwrap().workgroup, [64, 1, 1]);
}

type Case = (fn(&mut Builder, Types), &'static [&'static str]);

/// Each is decorated first, so that the operation itself is what is refused.
#[test]
fn what_devices_may_do_otherwise_is_refused() {
    let cases: [Case; 12] = [
        (
            |b, t| _ = b.f_div(t.float, None, t.two, t.three).unwrap(),
            &["OpFDiv", "lightbvh::exact::div"],
        ),
        (
            |b, t| {
                b.f_rem(t.float, None, t.two, t.three).unwrap();
                b.f_mod(t.float, None, t.two, t.three).unwrap();
            },
            &["2 violation(s)"],
        ),
        (
            |b, t| {
                let vector = b.type_vector(t.float, 2);
                let pair = b.constant_composite(vector, [t.two, t.three]);
                b.dot(t.float, None, pair, pair).unwrap();
            },
            &["OpDot", "lightbvh::device::vector"],
        ),
        (
            |b, t| {
                let wide = b.constant_bit32(t.uint, 7);
                b.convert_u_to_f(t.float, None, wide).unwrap();
            },
            &["OpConvertUToF", "i32"],
        ),
        (
            |b, _| {
                b.capability(Capability::Float64);
                b.capability(Capability::Int8);
                b.type_float(64, None);
                b.type_int(8, 0);
            },
            &[
                "4 violation(s)",
                "Float64",
                "Int8",
                "OpTypeFloat 64",
                "OpTypeInt 8 0",
            ],
        ),
        (|b, _| b.extension("SPV_KHR_float_controls"), &["extensions"]),
        (
            |b, t| {
                b.constant_bit32(t.float, f32::INFINITY.to_bits());
                b.constant_bit32(t.float, 1);
                b.constant_bit32(t.uint, 1);
            },
            &["2 violation(s)", "denormal"],
        ),
        (
            |b, t| {
                let nothing = b.undef(t.float, None);
                b.f_add(t.float, None, nothing, t.two).unwrap();
            },
            &["undefined value"],
        ),
        (
            |b, t| {
                let [scope, semantics] = [5, 0x48].map(|value| b.constant_bit32(t.uint, value));
                b.memory_barrier(scope, semantics).unwrap();
            },
            &["OpMemoryBarrier"],
        ),
        (
            |b, t| {
                let pointer = b.type_pointer(None, StorageClass::Function, t.uint);
                let counter = b.variable(pointer, None, StorageClass::Function, None);
                let [scope, semantics, one] = [5, 0, 1].map(|value| b.constant_bit32(t.uint, value));
                b.atomic_i_add(t.uint, None, counter, scope, semantics, one)
                    .unwrap();
            },
            &["OpAtomicIAdd", "order of arrival"],
        ),
        (
            |b, t| {
                let pointer = b.type_pointer(None, StorageClass::Function, t.float);
                let sum = b.variable(pointer, None, StorageClass::Function, None);
                let [scope, semantics] = [5, 0].map(|value| b.constant_bit32(t.uint, value));
                b.atomic_f_add_ext(t.float, None, sum, scope, semantics, t.two)
                    .unwrap();
            },
            &["OpAtomicFAddEXT", "order of arrival"],
        ),
        // A closure, which breaks drivers.
        (
            |b, t| {
                let pointer = b.type_pointer(None, StorageClass::Function, t.float);
                let closure = b.type_struct([pointer, t.uint]);
                let variable = b.variable(pointer, None, StorageClass::Function, None);
                let count = b.constant_bit32(t.uint, 7);
                b.composite_construct(closure, None, [variable, count]).unwrap();
            },
            &["OpCompositeConstruct", "closure"],
        ),
    ];
    for (body, parts) in cases {
        let text = complaint_about(body);
        for part in parts {
            assert!(text.contains(part), "{part} is missing in: {text}");
        }
    }
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
    let error = Interface::read(&module.assemble()).unwrap_err().to_string();
    assert!(error.contains("outside descriptor set 0"), "{error}");
}

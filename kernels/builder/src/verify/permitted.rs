//! What a module may contain, and what to write instead of the rest.

use super::Refusal;
use rspirv::dr::{Instruction, Operand};
use rspirv::spirv::{Capability, GlslStd450Op as GLOp, Op};
use std::ops::RangeInclusive;

/// Capabilities of the widest set: every Vulkan 1.2 device that this project names supports them.
pub(super) fn vulkan_everywhere(capability: Capability) -> bool {
    matches!(capability, Capability::Shader | Capability::VulkanMemoryModel)
}

/// Operations that give the same bits on every device, as ranges of their numbers (SPIR-V specification 1.6, section 3.42): between
/// the ends of a range there are no others.
const PERMITTED: [RangeInclusive<Op>; 21] = [
    Op::Undef..=Op::Undef,
    // Types, without matrices, images and samplers.
    Op::TypeVoid..=Op::TypeVector,
    Op::TypeArray..=Op::TypeStruct,
    Op::TypePointer..=Op::TypeFunction,
    Op::ConstantTrue..=Op::ConstantComposite,
    Op::ConstantNull..=Op::ConstantNull,
    Op::SpecConstant..=Op::SpecConstant,
    // Functions and memory.
    Op::Function..=Op::Variable,
    Op::Load..=Op::CopyMemory,
    Op::AccessChain..=Op::InBoundsAccessChain,
    Op::ArrayLength..=Op::ArrayLength,
    // Vectors and composites.
    Op::VectorExtractDynamic..=Op::CopyObject,
    Op::CopyLogical..=Op::CopyLogical,
    Op::ConvertFToU..=Op::ConvertSToF,
    // Arithmetic of integers, and what Vulkan rounds correctly of floats: negation, sum, difference, product.
    Op::Bitcast..=Op::SDiv,
    Op::UMod..=Op::SMod,
    Op::VectorTimesScalar..=Op::VectorTimesScalar,
    Op::IAddCarry..=Op::All,
    // Logic, selection, comparisons, bits.
    Op::LogicalEqual..=Op::BitCount,
    // Control flow, without `OpKill`.
    Op::Phi..=Op::Switch,
    Op::Return..=Op::Unreachable,
];

/// Whether an operation gives the same bits on every device, for operands in the ranges that shared code keeps.
pub(super) fn operation(op: Op) -> Result<(), Refusal> {
    match op {
        _ if PERMITTED.iter().any(|range| range.contains(&op)) => Ok(()),
        Op::FDiv => refuse(
            "division has 2.5 ULP on a device",
            "use lightbvh::exact::div or recip",
        ),
        Op::FRem | Op::FMod => refuse("remainders of floats are not exact", "work with integers"),
        Op::Dot
        | Op::MatrixTimesScalar
        | Op::VectorTimesMatrix
        | Op::MatrixTimesVector
        | Op::MatrixTimesMatrix
        | Op::OuterProduct
        | Op::Transpose
        | Op::TypeMatrix => refuse(
            "the order of its operations is left open",
            "use lightbvh::device::vector",
        ),
        Op::ConvertUToF => refuse(
            "one driver rounds u32 to f32 wrongly above 2^31 (SwiftShader)",
            "convert through i32: `n as i32 as f32`, n below 2^31",
        ),
        Op::IsNan | Op::IsInf => refuse(
            "devices may assume that no NaN and no infinity occurs",
            "look at the bits: `x.to_bits()`",
        ),
        Op::AtomicFAddEXT | Op::AtomicFMinEXT | Op::AtomicFMaxEXT => refuse(
            "float atomics depend on the order of arrival",
            "let one invocation compute in a fixed order",
        ),
        _ if format!("{op:?}").starts_with("Atomic") => refuse(
            "what atomics give depends on the order of arrival",
            "let one invocation compute in a fixed order",
        ),
        Op::ControlBarrier | Op::MemoryBarrier => refuse(
            "no kernel waits for other invocations",
            "use one dispatch after the other",
        ),
        _ => refuse(
            "not among the operations known to be exact and everywhere",
            EXTEND,
        ),
    }
}

/// Whether an extended instruction gives the same bits on every device.
pub(super) fn extended_instruction(inst: &Instruction) -> Result<(), Refusal> {
    let number = match inst.operands.get(1) {
        Some(Operand::LiteralExtInstInteger(number)) => *number,
        _ => u32::MAX,
    };
    match GLOp::from_u32(number) {
        // Defined as correct results.
        Some(GLOp::FAbs | GLOp::Floor | GLOp::Ceil | GLOp::Trunc | GLOp::RoundEven) => Ok(()),
        // Integers.
        Some(GLOp::SAbs | GLOp::UMin | GLOp::SMin | GLOp::UMax | GLOp::SMax) => Ok(()),
        Some(GLOp::FindILsb | GLOp::FindSMsb | GLOp::FindUMsb) => Ok(()),
        Some(GLOp::Round) => refuse(
            "the direction in which Round takes a tie is left open",
            "add a half and truncate",
        ),
        Some(GLOp::Sqrt) => refuse(
            "Sqrt inherits the 2 ULP of InverseSqrt",
            "use lightbvh::exact::sqrt",
        ),
        Some(GLOp::InverseSqrt) => refuse("InverseSqrt has 2 ULP", "use lightbvh::exact::rsqrt"),
        Some(GLOp::Fma) => refuse("Fma may round once or twice", "write `a * b + c`, not mul_add"),
        Some(
            GLOp::FMin | GLOp::FMax | GLOp::FClamp | GLOp::NMin | GLOp::NMax | GLOp::NClamp | GLOp::FSign,
        ) => refuse(
            "-0 and NaN are left open",
            "use lightbvh::exact::{min, max, clamp} or the bits",
        ),
        _ => refuse("not among the extended instructions known to be exact", EXTEND),
    }
}

const EXTEND: &str =
    "write it with permitted operations, or prove it exact and add it to verify/permitted.rs";

fn refuse(rule: &'static str, remedy: &'static str) -> Result<(), Refusal> {
    Err(Refusal { rule, remedy })
}

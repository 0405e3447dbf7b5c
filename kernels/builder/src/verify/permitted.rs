//! What a module may contain, and what to write instead of the rest.

use super::Refusal;
use rspirv::dr::{Instruction, Operand};
use rspirv::spirv::{Capability, GlslStd450Op as GLOp, Op};

/// Capabilities of the widest set: every Vulkan 1.2 device that this project names supports them.
pub(super) fn vulkan_everywhere(capability: Capability) -> bool {
    matches!(capability, Capability::Shader | Capability::VulkanMemoryModel)
}

/// Whether an operation gives the same bits on every device, for operands in the ranges that shared code keeps.
pub(super) fn operation(op: Op) -> Result<(), Refusal> {
    match op {
        _ if is_structure(op) || is_integer(op) || is_exact_float(op) => Ok(()),
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
        | Op::TypeMatrix => refuse("the order of its operations is left open", "use lightbvh::vector"),
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

/// Types, constants, memory, control flow and moves of bits.
fn is_structure(op: Op) -> bool {
    matches!(
        op,
        Op::TypeVoid
            | Op::TypeBool
            | Op::TypeInt
            | Op::TypeFloat
            | Op::TypeVector
            | Op::TypeArray
            | Op::TypeRuntimeArray
            | Op::TypeStruct
            | Op::TypePointer
            | Op::TypeFunction
            | Op::ConstantTrue
            | Op::ConstantFalse
            | Op::Constant
            | Op::SpecConstant
            | Op::ConstantComposite
            | Op::ConstantNull
            | Op::Undef
            | Op::Variable
            | Op::Function
            | Op::FunctionParameter
            | Op::FunctionEnd
            | Op::FunctionCall
            | Op::Label
            | Op::Phi
            | Op::SelectionMerge
            | Op::LoopMerge
            | Op::Branch
            | Op::BranchConditional
            | Op::Switch
            | Op::Return
            | Op::ReturnValue
            | Op::Unreachable
            | Op::Load
            | Op::Store
            | Op::CopyMemory
            | Op::AccessChain
            | Op::InBoundsAccessChain
            | Op::ArrayLength
            | Op::CopyObject
            | Op::CopyLogical
            | Op::CompositeConstruct
            | Op::CompositeExtract
            | Op::CompositeInsert
            | Op::VectorShuffle
            | Op::VectorExtractDynamic
            | Op::VectorInsertDynamic
            | Op::Select
            | Op::Bitcast
    )
}

/// Integer and boolean operations.
fn is_integer(op: Op) -> bool {
    matches!(
        op,
        Op::IAdd
            | Op::ISub
            | Op::IMul
            | Op::UDiv
            | Op::SDiv
            | Op::UMod
            | Op::SRem
            | Op::SMod
            | Op::SNegate
            | Op::IAddCarry
            | Op::ISubBorrow
            | Op::UMulExtended
            | Op::SMulExtended
            | Op::ShiftLeftLogical
            | Op::ShiftRightLogical
            | Op::ShiftRightArithmetic
            | Op::BitwiseAnd
            | Op::BitwiseOr
            | Op::BitwiseXor
            | Op::Not
            | Op::BitFieldInsert
            | Op::BitFieldSExtract
            | Op::BitFieldUExtract
            | Op::BitReverse
            | Op::BitCount
            | Op::IEqual
            | Op::INotEqual
            | Op::ULessThan
            | Op::ULessThanEqual
            | Op::UGreaterThan
            | Op::UGreaterThanEqual
            | Op::SLessThan
            | Op::SLessThanEqual
            | Op::SGreaterThan
            | Op::SGreaterThanEqual
            | Op::LogicalAnd
            | Op::LogicalOr
            | Op::LogicalNot
            | Op::LogicalEqual
            | Op::LogicalNotEqual
            | Op::Any
            | Op::All
    )
}

/// Float operations that Vulkan rounds correctly or answers exactly.
fn is_exact_float(op: Op) -> bool {
    matches!(
        op,
        Op::FNegate
            | Op::FAdd
            | Op::FSub
            | Op::FMul
            | Op::VectorTimesScalar
            | Op::ConvertFToU
            | Op::ConvertFToS
            | Op::ConvertSToF
            | Op::FOrdEqual
            | Op::FUnordEqual
            | Op::FOrdNotEqual
            | Op::FUnordNotEqual
            | Op::FOrdLessThan
            | Op::FUnordLessThan
            | Op::FOrdLessThanEqual
            | Op::FUnordLessThanEqual
            | Op::FOrdGreaterThan
            | Op::FUnordGreaterThan
            | Op::FOrdGreaterThanEqual
            | Op::FUnordGreaterThanEqual
    )
}

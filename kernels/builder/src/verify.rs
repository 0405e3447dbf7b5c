//! The verifier: refuses what Vulkan does not define to the bit on every device.
//!
//! It works by permission: an instruction, type, capability or constant that is not known to be exact and widely
//! supported is refused, so that a new compiler version cannot bring in something nobody has looked at. What is exact
//! follows the Vulkan specification, "Precision and Operation of SPIR-V Instructions": additions, subtractions and
//! products are correctly rounded, comparisons and moves are exact, division has 2.5 ULP, and so on.

mod permitted;

use crate::decorate::{float_operations, float_types, uncontracted};
use crate::{Error, load};
use permitted::{extended_instruction, operation, vulkan_everywhere};
use rspirv::binary::Disassemble;
use rspirv::dr::{Instruction, Module, Operand};
use rspirv::spirv::{AddressingModel, ExecutionMode, ExecutionModel, MemoryModel, Op};
use std::collections::HashSet;

/// Why an instruction is refused, and what to write instead.
#[derive(Clone, Copy)]
struct Refusal {
    rule: &'static str,
    remedy: &'static str,
}

/// Checks a finished module; `name` stands in the error.
///
/// # Errors
/// When the words are no module, or with every violation found.
pub fn verify(name: &str, words: &[u32]) -> Result<(), Error> {
    let module = load(words).map_err(|error| Error(format!("{name}: {error}")))?;
    let mut findings = Findings::default();
    preamble(&module, &mut findings);
    types_and_constants(&module, &mut findings);
    decorations(&module, &mut findings);
    bodies(&module, &mut findings);
    match findings.0 {
        violations if violations.is_empty() => Ok(()),
        violations => Err(Error(format!(
            "{name}: {} violation(s)\n  {}",
            violations.len(),
            violations.join("\n  ")
        ))),
    }
}

#[derive(Default)]
struct Findings(Vec<String>);

impl Findings {
    fn refuse(&mut self, inst: &Instruction, rule: &'static str, remedy: &'static str) {
        let id = inst.result_id.map(|id| format!(" (result %{id})"));
        let (text, id) = (inst.disassemble(), id.unwrap_or_default());
        self.0.push(format!("`{text}`{id}: {rule}; {remedy}"));
    }
}

/// Capabilities, extensions, memory model, entry points and execution modes.
fn preamble(module: &Module, findings: &mut Findings) {
    let mut all = |list: &[Instruction], is_fine: &dyn Fn(&Instruction) -> bool, rule, remedy| {
        for inst in list.iter().filter(|inst| !is_fine(inst)) {
            findings.refuse(inst, rule, remedy);
        }
    };
    all(
        &module.capabilities,
        &|inst| matches!(inst.operands.first(), Some(Operand::Capability(own)) if vulkan_everywhere(*own)),
        "not a capability that every Vulkan 1.2 device for this project has",
        "use 32-bit integers and floats in storage buffers only",
    );
    all(
        &module.extensions,
        &|_| false,
        "extensions are not part of the widest set",
        "avoid what asks for it",
    );
    all(
        &module.ext_inst_imports,
        &|inst| inst.operands == [Operand::LiteralString("GLSL.std.450".to_owned())],
        "the only known instruction set is GLSL.std.450",
        "strip debug instructions",
    );
    let vulkan = [
        Operand::AddressingModel(AddressingModel::Logical),
        Operand::MemoryModel(MemoryModel::Vulkan),
    ];
    all(
        module.memory_model.as_slice(),
        &|inst| inst.operands == vulkan,
        "the memory model must be Logical Vulkan",
        "build for spirv-unknown-vulkan1.2",
    );
    all(
        &module.entry_points,
        &|inst| inst.operands.first() == Some(&Operand::ExecutionModel(ExecutionModel::GLCompute)),
        "not a compute kernel",
        "write #[spirv(compute(threads(64)))]",
    );
    all(
        &module.execution_modes,
        &|inst| inst.operands.get(1) == Some(&Operand::ExecutionMode(ExecutionMode::LocalSize)),
        "an execution mode that some devices lack",
        "remove it from #[spirv(compute(..))]; the host may add modes that a device reports",
    );
}

fn types_and_constants(module: &Module, findings: &mut Findings) {
    let floats = float_types(module);
    for inst in &module.types_global_values {
        let width = match inst.operands.first() {
            Some(Operand::LiteralBit32(width)) => *width,
            _ => 0,
        };
        match inst.class.opcode {
            Op::TypeFloat | Op::TypeInt if width != 32 => {
                findings.refuse(inst, "only 32-bit numbers are everywhere", "use f32, u32 and i32");
            }
            Op::SpecConstant if inst.result_type.is_some_and(|ty| floats.contains(&ty)) => {
                findings.refuse(inst, "a device may get any float for it", "use an integer");
            }
            Op::Constant if inst.result_type.is_some_and(|ty| floats.contains(&ty)) => {
                // The literal's bits: exponent all ones is an infinity or NaN, all zeros with a fraction a denormal.
                let (exponent, fraction) = (width >> 23 & 0xff, width & 0x007f_ffff);
                if exponent == 0xff {
                    let remedy = "use f32::MAX, or a flag in an integer";
                    findings.refuse(
                        inst,
                        "devices may assume that no infinity and no NaN occurs",
                        remedy,
                    );
                } else if exponent == 0 && fraction != 0 {
                    let remedy = "use f32::MIN_POSITIVE or more";
                    findings.refuse(inst, "devices may take a denormal for zero", remedy);
                }
            }
            op => {
                if let Err(refusal) = operation(op) {
                    findings.refuse(inst, refusal.rule, refusal.remedy);
                }
            }
        }
    }
}

/// Every float operation must be protected from contraction and re-association.
fn decorations(module: &Module, findings: &mut Findings) {
    let protected = uncontracted(module);
    for inst in float_operations(module) {
        if inst.result_id.is_some_and(|id| !protected.contains(&id)) {
            let remedy = "run the module through decorate (build-kernels does)";
            findings.refuse(
                inst,
                "a float operation without NoContraction may be fused or rearranged",
                remedy,
            );
        }
    }
}

fn bodies(module: &Module, findings: &mut Findings) {
    let undefined: HashSet<u32> = module
        .all_inst_iter()
        .filter(|inst| inst.class.opcode == Op::Undef)
        .filter_map(|inst| inst.result_id)
        .collect();
    let holders = holders_of_pointers(module);
    for inst in module
        .functions
        .iter()
        .flat_map(|function| function.all_inst_iter())
    {
        let op = inst.class.opcode;
        let verdict = match op {
            Op::ExtInst => extended_instruction(inst),
            _ => operation(op),
        };
        if let Err(refusal) = verdict {
            findings.refuse(inst, refusal.rule, refusal.remedy);
        }
        if inst.result_type.is_some_and(|ty| holders.contains(&ty)) {
            let remedy =
                "pass slices and references to a function; a closure that captures them is such a structure";
            findings.refuse(
                inst,
                "with logical addressing, a pointer is no part of a structure (SPIR-V 2.16.1); SwiftShader crashes",
                remedy,
            );
        }
        if !carries_undefined(op) && uses_any(inst, &undefined) {
            let remedy = "give the variable a value on every path (rust-gpu loses values in complex loops)";
            findings.refuse(inst, "computes with an undefined value", remedy);
        }
    }
}

/// The structures and arrays with pointers in them. rust-gpu declares some; only values of them are wrong.
fn holders_of_pointers(module: &Module) -> HashSet<u32> {
    let mut pointers = HashSet::new();
    let mut holders = HashSet::new();
    for inst in &module.types_global_values {
        match inst.class.opcode {
            Op::TypePointer => pointers.extend(inst.result_id),
            Op::TypeStruct | Op::TypeArray if uses_any(inst, &pointers) || uses_any(inst, &holders) => {
                holders.extend(inst.result_id);
            }
            _ => {}
        }
    }
    holders
}

/// Operations that may hand an undefined value on without looking at it, as the unused half of an `Option` is.
fn carries_undefined(op: Op) -> bool {
    matches!(
        op,
        Op::Phi | Op::Select | Op::CompositeConstruct | Op::CompositeInsert
    )
}

fn uses_any(inst: &Instruction, ids: &HashSet<u32>) -> bool {
    inst.operands
        .iter()
        .any(|operand| matches!(operand, Operand::IdRef(id) if ids.contains(id)))
}

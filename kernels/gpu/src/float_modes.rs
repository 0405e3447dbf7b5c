//! Float-control execution modes, put into a module for the device it is about to run on.
//!
//! `SignedZeroInfNanPreserve 32` stops a driver from rewrites that are exact only when signs of zero, infinities and
//! NaNs do not matter; `RoundingModeRTE 32` pins round-to-nearest-even. Both are legal only where the device reports
//! them (Vulkan specification, "Validation Rules within a Module"), so they cannot be in the stored module.

pub use crate::float_environment::FloatEnvironment;

use alloc::vec::Vec;

use crate::spirv::ModuleError;
use crate::spirv::words::{HEADER, Instruction, instructions, op};

/// What of `VkPhysicalDeviceFloatControlsProperties` a device reports as true.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FloatControls {
    /// `shaderSignedZeroInfNanPreserveFloat32`.
    pub signed_zero_inf_nan_preserve_32: bool,
    /// `shaderRoundingModeRTEFloat32`.
    pub rounding_mode_rte_32: bool,
}

/// `NoContraction`.
const NO_CONTRACTION: u32 = 42;

/// The module without any decoration `NoContraction`, for measurements of what exactness costs: the driver may fuse and rearrange
/// sums and products, so bits may differ from the CPU's. Everything else keeps its words and its order.
///
/// # Errors
/// [`ModuleError`] if the words do not parse.
pub fn contractible(words: &[u32]) -> Result<Vec<u32>, ModuleError> {
    let mut patched = words.get(..HEADER).unwrap_or_default().to_vec();
    for instruction in instructions(words)? {
        let operands = instruction.operands;
        if instruction.opcode != op::DECORATE || operands.get(1) != Some(&NO_CONTRACTION) {
            patched.push((operands.len() as u32 + 1) << 16 | u32::from(instruction.opcode));
            patched.extend_from_slice(operands);
        }
    }
    Ok(patched)
}

/// A capability together with the execution mode it allows.
#[derive(Clone, Copy)]
struct Mode {
    capability: u32,
    execution_mode: u32,
}

const SIGNED_ZERO_INF_NAN_PRESERVE: Mode = Mode {
    capability: 4466,
    execution_mode: 4461,
};
const ROUNDING_MODE_RTE: Mode = Mode {
    capability: 4467,
    execution_mode: 4462,
};

/// The width of float the modes are for, bits.
const WIDTH: u32 = 32;

/// The module with exactly those of the two modes that `controls` reports, for every entry point: what a device is to load.
///
/// What the module said about the two before is replaced. Everything else keeps its words and its order. A module without the
/// modes is valid on every device, but a driver may then round otherwise, or rewrite what signs of zero depend on.
///
/// # Errors
/// [`ModuleError`] if the words do not parse or hold no entry point.
pub fn with_float_modes(words: &[u32], controls: FloatControls) -> Result<Vec<u32>, ModuleError> {
    let list = instructions(words)?;
    let wanted: Vec<Mode> = [
        (
            controls.signed_zero_inf_nan_preserve_32,
            SIGNED_ZERO_INF_NAN_PRESERVE,
        ),
        (controls.rounding_mode_rte_32, ROUNDING_MODE_RTE),
    ]
    .into_iter()
    .filter_map(|(reported, mode)| reported.then_some(mode))
    .collect();

    let mut entries = Vec::new();
    for entry in list
        .iter()
        .filter(|instruction| instruction.opcode == op::ENTRY_POINT)
    {
        entries.push(entry.operand(1)?);
    }
    let Some(last_entry) = list
        .iter()
        .rposition(|instruction| instruction.opcode == op::ENTRY_POINT)
    else {
        return Err(ModuleError {
            at: words.len(),
            what: "the module has no entry point",
        });
    };

    let mut patched = words[..HEADER].to_vec();
    // Capabilities come first in a module; execution modes follow the entry points (specification section 2.4).
    for mode in &wanted {
        patched.extend([2 << 16 | u32::from(op::CAPABILITY), mode.capability]);
    }
    for (index, instruction) in list.iter().enumerate() {
        if !is_float_mode(instruction) {
            patched.push((instruction.operands.len() as u32 + 1) << 16 | u32::from(instruction.opcode));
            patched.extend_from_slice(instruction.operands);
        }
        if index == last_entry {
            for entry in &entries {
                for mode in &wanted {
                    let head = 4 << 16 | u32::from(op::EXECUTION_MODE);
                    patched.extend([head, *entry, mode.execution_mode, WIDTH]);
                }
            }
        }
    }
    Ok(patched)
}

/// Whether an instruction declares or sets one of the two modes.
fn is_float_mode(instruction: &Instruction<'_>) -> bool {
    [SIGNED_ZERO_INF_NAN_PRESERVE, ROUNDING_MODE_RTE]
        .iter()
        .any(|mode| match instruction.opcode {
            op::CAPABILITY => instruction.operands.first() == Some(&mode.capability),
            op::EXECUTION_MODE => instruction.operands.get(1) == Some(&mode.execution_mode),
            _ => false,
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOTH: FloatControls = FloatControls {
        signed_zero_inf_nan_preserve_32: true,
        rounding_mode_rte_32: true,
    };
    const ONE: FloatControls = FloatControls {
        rounding_mode_rte_32: false,
        ..BOTH
    };
    const NONE: FloatControls = FloatControls {
        signed_zero_inf_nan_preserve_32: false,
        ..ONE
    };

    fn head(count: u32, opcode: u16) -> u32 {
        count << 16 | u32::from(opcode)
    }

    /// Shader capability, memory model, one entry point (id 4, name "m"), its LocalSize, a trailing OpName.
    fn plain() -> Vec<u32> {
        let mut words = alloc::vec![0x0723_0203, 0x0001_0500, 0, 10, 0];
        words.extend([head(2, 17), 1]);
        words.extend([head(3, 14), 0, 3]);
        words.extend([head(4, 15), 5, 4, 0x6d]);
        words.extend([head(6, 16), 4, 17, 64, 1, 1]);
        words.extend([head(3, 5), 4, 0x6d]);
        words
    }

    #[test]
    fn adds_what_is_reported() {
        let words = plain();
        let patched = with_float_modes(&words, BOTH).unwrap();
        let mut expected = words[..5].to_vec();
        expected.extend([head(2, 17), 4466, head(2, 17), 4467]);
        expected.extend(&words[5..14]);
        expected.extend([head(4, 16), 4, 4461, 32, head(4, 16), 4, 4462, 32]);
        expected.extend(&words[14..]);
        assert_eq!(patched, expected);
    }

    #[test]
    fn leaves_out_what_is_not_reported() {
        let words = plain();
        assert_eq!(with_float_modes(&words, NONE).unwrap(), words);
        let patched = with_float_modes(&words, ONE).unwrap();
        assert!(patched.contains(&4461) && patched.contains(&4466));
        assert!(!patched.contains(&4462) && !patched.contains(&4467));
    }

    #[test]
    fn replaces_what_was_there() {
        let words = plain();
        let both = with_float_modes(&words, BOTH).unwrap();
        assert_eq!(with_float_modes(&both, BOTH).unwrap(), both);
        assert_eq!(with_float_modes(&both, NONE).unwrap(), words);
        assert_eq!(
            with_float_modes(&both, ONE).unwrap(),
            with_float_modes(&words, ONE).unwrap()
        );
    }

    #[test]
    fn contractible_drops_decorations_alone() {
        let words = plain();
        let mut decorated = words.clone();
        decorated.extend([head(3, 71), 7, 42, head(4, 71), 8, 33, 0]);
        let mut expected = words.clone();
        expected.extend([head(4, 71), 8, 33, 0]);
        assert_eq!(contractible(&decorated).unwrap(), expected);
        assert_eq!(contractible(&expected).unwrap(), expected);
        assert!(contractible(&words[..4]).is_err());
    }

    #[test]
    fn refuses_corrupt_modules() {
        let words = plain();
        for end in 0..words.len() {
            // A cut between instructions may still be a module, with or without its entry point.
            if let Ok(patched) = with_float_modes(&words[..end], BOTH) {
                assert!(patched.len() > end && end >= 14, "cut at {end}");
            }
        }
        let mut no_entry = words.clone();
        no_entry.drain(10..20);
        assert_eq!(
            with_float_modes(&no_entry, BOTH).unwrap_err().what,
            "the module has no entry point"
        );
        let mut short_entry = words[..10].to_vec();
        short_entry.extend([head(2, 15), 5]);
        assert_eq!(with_float_modes(&short_entry, BOTH).unwrap_err().at, 10);
    }
}

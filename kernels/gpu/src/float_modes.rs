//! Float-control execution modes, put into a module for the device it is about to run on.
//!
//! `SignedZeroInfNanPreserve 32` stops a driver from rewrites that are exact only when signs of zero, infinities and
//! NaNs do not matter; `RoundingModeRTE 32` pins round-to-nearest-even. Both are legal only where the device reports
//! them (Vulkan specification, "Validation Rules within a Module"), so they cannot be in the stored module.

pub use crate::float_environment::FloatEnvironment;

use alloc::vec::Vec;

use crate::spirv::ModuleError;
use crate::spirv::words::{HEADER, instructions, op};

/// What of `VkPhysicalDeviceFloatControlsProperties` a device reports as true.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FloatControls {
    /// `shaderSignedZeroInfNanPreserveFloat32`.
    pub signed_zero_inf_nan_preserve_32: bool,
    /// `shaderRoundingModeRTEFloat32`.
    pub rounding_mode_rte_32: bool,
}

/// Capability and execution mode `SignedZeroInfNanPreserve`.
const SIGNED_ZERO_INF_NAN_PRESERVE: [u32; 2] = [4466, 4461];
/// Capability and execution mode `RoundingModeRTE`.
const ROUNDING_MODE_RTE: [u32; 2] = [4467, 4462];

/// The width of float the modes are for, bits.
const WIDTH: u32 = 32;

/// The module, which has neither mode yet, with exactly those of the two that `controls` reports: what a device is to load.
///
/// Everything else keeps its words and its order. A module without the modes is valid on every device, but a driver may then
/// round otherwise, or rewrite what signs of zero depend on.
///
/// # Errors
/// [`ModuleError`] if the words do not parse or hold no entry point.
pub fn with_float_modes(words: &[u32], controls: FloatControls) -> Result<Vec<u32>, ModuleError> {
    let list = instructions(words)?;
    let entry = list
        .iter()
        .find(|instruction| instruction.opcode == op::ENTRY_POINT)
        .ok_or(ModuleError {
            at: words.len(),
            what: "the module has no entry point",
        })?;
    let both = [
        (
            controls.signed_zero_inf_nan_preserve_32,
            SIGNED_ZERO_INF_NAN_PRESERVE,
        ),
        (controls.rounding_mode_rte_32, ROUNDING_MODE_RTE),
    ];
    let wanted = both.into_iter().filter(|(reported, _)| *reported);
    let (id, after) = (entry.operand(1)?, entry.range().end);
    // Capabilities come first in a module; execution modes follow the entry point (specification section 2.4).
    let mut patched = words[..HEADER].to_vec();
    for (_, [capability, _]) in wanted.clone() {
        patched.extend([2 << 16 | u32::from(op::CAPABILITY), capability]);
    }
    patched.extend_from_slice(&words[HEADER..after]);
    for (_, [_, mode]) in wanted {
        patched.extend([4 << 16 | u32::from(op::EXECUTION_MODE), id, mode, WIDTH]);
    }
    patched.extend_from_slice(&words[after..]);
    Ok(patched)
}

#[cfg(test)]
mod tests {
    use super::*;

    const NONE: FloatControls = FloatControls {
        signed_zero_inf_nan_preserve_32: false,
        rounding_mode_rte_32: false,
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
    fn what_is_reported_is_added() {
        let words = plain();
        assert_eq!(with_float_modes(&words, NONE).unwrap(), words);
        let one = FloatControls {
            signed_zero_inf_nan_preserve_32: true,
            ..NONE
        };
        let patched = with_float_modes(&words, one).unwrap();
        assert!(patched.contains(&4461) && patched.contains(&4466));
        assert!(!patched.contains(&4462) && !patched.contains(&4467));
        let both = FloatControls {
            rounding_mode_rte_32: true,
            ..one
        };
        let mut expected = words[..5].to_vec();
        expected.extend([head(2, 17), 4466, head(2, 17), 4467]);
        expected.extend(&words[5..14]);
        expected.extend([head(4, 16), 4, 4461, 32, head(4, 16), 4, 4462, 32]);
        expected.extend(&words[14..]);
        assert_eq!(with_float_modes(&words, both).unwrap(), expected);
    }

    #[test]
    fn modules_without_an_entry_point_are_refused() {
        let words = plain();
        let error = with_float_modes(&words[..10], NONE).unwrap_err();
        assert_eq!(error.what, "the module has no entry point");
        let short = [&words[..10], &[head(2, 15), 5]].concat();
        assert_eq!(with_float_modes(&short, NONE).unwrap_err().at, 10);
    }
}

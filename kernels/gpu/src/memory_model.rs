//! Modules for devices and interfaces without the feature `vulkanMemoryModel`.
//!
//! No invocation of a kernel reads what another one of the same dispatch writes, so the memory model decides nothing: a module
//! that says otherwise is refused.

use alloc::vec::Vec;

use crate::spirv::ModuleError;
use crate::spirv::words::{HEADER, instructions, op};

const VULKAN_MEMORY_MODEL: u32 = 5345;
/// Memory models of SPIR-V.
const GLSL450: u32 = 1;
const VULKAN: u32 = 3;
/// Memory operands of the Vulkan memory model: make available, make visible, non-private.
const VULKAN_OPERANDS: u32 = 0x38;
/// OpControlBarrier and OpMemoryBarrier.
const BARRIERS: core::ops::RangeInclusive<u16> = 224..=225;

/// The module by the memory model GLSL450, which needs no feature. Everything else keeps its words and its order.
///
/// wgpu, for one, opens devices without `vulkanMemoryModel`.
///
/// # Errors
/// [`ModuleError`] if the words do not parse, or if invocations share memory by the rules of the Vulkan memory model; the kernels
/// of this crate do not.
pub fn without_vulkan_memory_model(words: &[u32]) -> Result<Vec<u32>, ModuleError> {
    let mut patched = words.get(..HEADER).unwrap_or_default().to_vec();
    for instruction in instructions(words)? {
        let (operands, at) = (instruction.operands, patched.len());
        match instruction.opcode {
            op::CAPABILITY if operands.first() == Some(&VULKAN_MEMORY_MODEL) => continue,
            opcode @ (op::LOAD | op::STORE | op::COPY_MEMORY) => {
                // Masks follow the type, result and pointer of a load, and two ids of the others.
                let ids = if opcode == op::LOAD { 3 } else { 2 };
                if operands.get(ids).is_some_and(|mask| mask & VULKAN_OPERANDS != 0) {
                    return Err(instruction.error("an access by the rules of the Vulkan memory model"));
                }
            }
            opcode if BARRIERS.contains(&opcode) || op::ATOMICS.contains(&opcode) => {
                return Err(instruction.error("invocations share memory"));
            }
            _ => {}
        }
        patched.extend_from_slice(&words[instruction.range()]);
        if instruction.opcode == op::MEMORY_MODEL && operands.get(1) == Some(&VULKAN) {
            patched[at + 2] = GLSL450;
        }
    }
    Ok(patched)
}

#[cfg(all(test, feature = "kernels"))]
mod tests {
    use super::*;
    use crate::KERNELS;
    use crate::spirv::Interface;

    #[test]
    fn every_kernel_does_without() {
        for kernel in KERNELS {
            let words = kernel.words();
            let patched = without_vulkan_memory_model(&words).expect(kernel.name);
            assert_eq!(patched.len(), words.len() - 2, "{}", kernel.name);
            assert_eq!(
                Interface::read(&patched),
                Interface::read(&words),
                "{}",
                kernel.name
            );
            let model = [3 << 16 | u32::from(op::MEMORY_MODEL), 0, GLSL450];
            assert!(patched.windows(3).any(|words| words == model), "{}", kernel.name);
            // It has nothing left to change.
            assert_eq!(without_vulkan_memory_model(&patched).expect(kernel.name), patched);
        }
    }

    #[test]
    fn shared_memory_is_refused() {
        let mut words = alloc::vec![0x0723_0203, 0x0001_0500, 0, 10, 0];
        words.extend([3 << 16 | 14, 0, VULKAN]);
        assert!(without_vulkan_memory_model(&words).is_ok());
        let load = [5 << 16 | u32::from(op::LOAD), 1, 2, 3, 0x20];
        let store = [5 << 16 | u32::from(op::STORE), 1, 2, 0x28, 4];
        let barrier = [4 << 16 | 224, 1, 2, 3];
        let atomic = [7 << 16 | 234, 1, 2, 3, 4, 5, 6];
        for bad in [&load[..], &store[..], &barrier[..], &atomic[..]] {
            let module = [&words, bad].concat();
            assert_eq!(without_vulkan_memory_model(&module).unwrap_err().at, 8);
        }
        // Aligned and volatile accesses are those of any model.
        let plain = [6 << 16 | u32::from(op::LOAD), 1, 2, 3, 2, 4];
        assert!(without_vulkan_memory_model(&[&words, &plain[..]].concat()).is_ok());
    }
}

//! What a device may do beyond exact arithmetic, for measurements of what exactness costs: contraction where the driver likes
//! it, and the fused sum of `VK_KHR_shader_fma`.

use alloc::vec::Vec;

use crate::spirv::ModuleError;
use crate::spirv::words::{HEADER, instructions, op};

/// `NoContraction`.
const NO_CONTRACTION: u32 = 42;
/// `Fma` of GLSL.std.450, which may round once or twice.
const GLSL_FMA: u32 = 50;
/// `OpFmaKHR`, its capability and its extension (SPV_KHR_fma), which rounds once.
const FMA: u16 = 4427;
const FMA_CAPABILITY: u32 = 6030;
const FMA_EXTENSION: &[u8] = b"SPV_KHR_fma\0";

/// The module without any decoration `NoContraction`: the driver may fuse and rearrange sums and products as it likes, so words
/// may be other ones than the CPU's. Everything else keeps its words and its order.
///
/// # Errors
/// [`ModuleError`] if the words do not parse.
pub fn contractible(words: &[u32]) -> Result<Vec<u32>, ModuleError> {
    let list = instructions(words)?;
    let mut patched = words[..HEADER].to_vec();
    for instruction in &list {
        if instruction.opcode != op::DECORATE || instruction.operands.get(1) != Some(&NO_CONTRACTION) {
            push(&mut patched, instruction.opcode, instruction.operands);
        }
    }
    Ok(patched)
}

/// The module with `OpFmaKHR` in the place of each `Fma` of GLSL.std.450, and with its capability and extension; without any
/// such it stays as it is. For devices with `VK_KHR_shader_fma` and its feature `shaderFmaFloat32`: there sums and products of
/// native kernels are rounded once, as on any other such device.
///
/// # Errors
/// [`ModuleError`] if the words do not parse.
pub fn with_shader_fma(words: &[u32]) -> Result<Vec<u32>, ModuleError> {
    let list = instructions(words)?;
    // Type, result, set, number, three operands: the one set of a kernel is GLSL.std.450.
    let is_fma = |opcode, operands: &[u32]| {
        opcode == op::EXT_INST && operands.len() == 7 && operands.get(3) == Some(&GLSL_FMA)
    };
    if !list
        .iter()
        .any(|instruction| is_fma(instruction.opcode, instruction.operands))
    {
        return Ok(words.to_vec());
    }
    let mut patched = words[..HEADER].to_vec();
    // Capabilities come first in a module, extensions after them (specification section 2.4).
    push(&mut patched, op::CAPABILITY, &[FMA_CAPABILITY]);
    let mut declared = false;
    for instruction in &list {
        let (opcode, operands) = (instruction.opcode, instruction.operands);
        if opcode != op::CAPABILITY && !declared {
            let name = FMA_EXTENSION.chunks(4);
            let name: Vec<u32> = name
                .map(|bytes| {
                    let byte = |k: usize| u32::from(bytes.get(k).copied().unwrap_or(0)) << (8 * k);
                    byte(0) | byte(1) | byte(2) | byte(3)
                })
                .collect();
            push(&mut patched, op::EXTENSION, &name);
            declared = true;
        }
        if is_fma(opcode, operands) {
            let [ty, result, _, _, a, b, c] = *operands else {
                return Err(instruction.error("the instruction is too short"));
            };
            push(&mut patched, FMA, &[ty, result, a, b, c]);
        } else {
            push(&mut patched, opcode, operands);
        }
    }
    Ok(patched)
}

fn push(words: &mut Vec<u32>, opcode: u16, operands: &[u32]) {
    words.push((operands.len() as u32 + 1) << 16 | u32::from(opcode));
    words.extend_from_slice(operands);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn head(count: u32, opcode: u16) -> u32 {
        count << 16 | u32::from(opcode)
    }

    /// Capability Shader, memory model, a decoration of id 7, and `Fma` and `Sqrt` of set 1.
    fn module(number: u32) -> Vec<u32> {
        let mut words = alloc::vec![0x0723_0203, 0x0001_0500, 0, 20, 0];
        words.extend([head(2, 17), 1]);
        words.extend([head(3, 14), 0, 3]);
        words.extend([head(3, 71), 7, 42]);
        words.extend([head(4, 71), 8, 33, 0]);
        words.extend([head(8, 12), 2, 7, 1, number, 4, 5, 6]);
        words.extend([head(6, 12), 2, 9, 1, 31, 4]);
        words
    }

    #[test]
    fn decorations_go_alone() {
        let words = module(50);
        let mut expected = words[..10].to_vec();
        expected.extend(&words[13..]);
        assert_eq!(contractible(&words).unwrap(), expected);
        assert_eq!(contractible(&expected).unwrap(), expected);
    }

    #[test]
    fn fused_sums_are_the_extension_s() {
        let words = module(50);
        let mut expected = words[..5].to_vec();
        expected.extend([head(2, 17), 6030]);
        expected.extend(&words[5..7]);
        // "SPV_KHR_fma" and its end, little endian.
        expected.extend([head(4, 10), 0x5f56_5053, 0x5f52_484b, 0x0061_6d66]);
        expected.extend(&words[7..17]);
        expected.extend([head(6, 4427), 2, 7, 4, 5, 6]);
        expected.extend(&words[25..]);
        assert_eq!(with_shader_fma(&words).unwrap(), expected);
    }

    #[test]
    fn other_modules_stay() {
        for number in [31, 46, 49, 51] {
            assert_eq!(with_shader_fma(&module(number)).unwrap(), module(number));
        }
        assert!(with_shader_fma(&module(50)[..4]).is_err());
        assert!(contractible(&module(50)[..4]).is_err());
    }
}

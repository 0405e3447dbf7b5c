//! Does a device calculate exactly? The kernel [`SELF_TEST`] answers, on the device at hand, in milliseconds.
//!
//! Bind a buffer that holds [`operands`] and one of [`ANSWERS_BYTES`] for the answers, push [`PUSH`], dispatch [`INVOCATIONS`] (two
//! workgroups), and give what was written to [`defect`]. Where it finds none, a device with the float modes that
//! [`FloatControls`](crate::FloatControls) adds computes the words of the CPU: sums, products, quotients, roots, comparisons and
//! conversions are those of IEEE 754, none contracted, none re-associated. Equal words do not prove a driver right in every
//! expression; `lightbvh verify` compares whole results.

mod checks;

use core::fmt;

pub use self::checks::{CHECKS, Check};
pub use crate::table::SELF_TEST;

/// Invocations of the kernel: each takes three operands.
pub const INVOCATIONS: u32 = 128;
/// The push constant.
pub const PUSH: [u32; 1] = [INVOCATIONS];

const TRIPLES: usize = INVOCATIONS as usize;
/// Bytes of the operands; the answers follow in the file.
const OPERANDS_BYTES: usize = 3 * 4 * TRIPLES;
/// Bytes that the kernel writes.
pub const ANSWERS_BYTES: usize = CHECKS.len() * 4 * TRIPLES;

/// Operands, then what the CPU answers: the words of `kernels/src/self_test.rs` as native code, little-endian (a test compares
/// them).
static WORDS: &[u8; OPERANDS_BYTES + ANSWERS_BYTES] = include_bytes!("self_test/words.bin");

/// An answer that differs from the CPU's and may not.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Defect {
    /// What it shows.
    pub check: &'static Check,
    /// The operands, as bits of `f32`.
    pub operands: [u32; 3],
    /// The CPU's answer.
    pub cpu: u32,
    /// The device's.
    pub device: u32,
}

impl fmt::Display for Defect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            check,
            operands: [a, b, c],
            cpu,
            device,
        } = self;
        write!(
            f,
            "the device {}: {} of {a:08x}, {b:08x}, {c:08x} is {device:08x}, on the CPU {cpu:08x}; samples and nodes will differ \
             from the CPU's. Are the float modes added that the device has (`with_float_modes`), and does the thread that opened a \
             software device round to nearest (`FloatEnvironment`)?",
            check.defect, check.name,
        )
    }
}

impl core::error::Error for Defect {}

/// What binding 0 holds.
#[must_use]
pub fn operands() -> &'static [u8] {
    &WORDS[..OPERANDS_BYTES]
}

/// The first answer that differs and [counts](Check::counts). `answers` are the [`ANSWERS_BYTES`] bytes that the kernel wrote;
/// what is missing of them differs.
#[must_use]
pub fn defect(answers: &[u8]) -> Option<Defect> {
    let word = |bytes: &[u8], index: usize| {
        let at = bytes.get(4 * index..4 * index + 4)?;
        Some(u32::from_le_bytes(at.try_into().ok()?))
    };
    let expected = &WORDS[OPERANDS_BYTES..];
    (0..TRIPLES * CHECKS.len()).find_map(|index| {
        let (triple, check) = (index / CHECKS.len(), &CHECKS[index % CHECKS.len()]);
        let (cpu, device) = (word(expected, index)?, word(answers, index));
        let differs = check.counts && device != Some(cpu);
        differs.then(|| Defect {
            check,
            operands: [0, 1, 2].map(|k| word(operands(), 3 * triple + k).unwrap_or_default()),
            cpu,
            device: device.unwrap_or(!cpu),
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_answer_that_counts_is_compared() {
        let right = &WORDS[OPERANDS_BYTES..];
        assert_eq!(defect(right), None);
        let mut counted = 0;
        for index in (0..ANSWERS_BYTES / 4).step_by(7) {
            let mut answers = right.to_vec();
            answers[4 * index + 2] ^= 1;
            let check = &CHECKS[index % CHECKS.len()];
            let found = defect(&answers);
            assert_eq!(found.map(|found| found.check), check.counts.then_some(check));
            counted += u32::from(check.counts);
        }
        assert!(counted > 300, "{counted}");
        assert_eq!(
            defect(&right[..ANSWERS_BYTES - 40]).map(|found| found.check.name),
            Some("reciprocal")
        );
        assert_eq!(defect(&[]).map(|found| found.check.name), Some("multiply_add"));
    }
}

//! Random numbers are integers here; a float comes only at the end, by an exact conversion.

/// Hashes 32 bits to 32 bits, a permutation: PCG's output function on one step of its generator (M. Jarzynski and
/// M. Olano, "Hash Functions for GPU Rendering", JCGT 9(3), 2020).
#[inline]
#[must_use]
pub fn hash(x: u32) -> u32 {
    let state = x.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
    let word = ((state >> ((state >> 28) + 4)) ^ state).wrapping_mul(277_803_737);
    (word >> 22) ^ word
}

/// A number in `[0, 1)` from the upper 24 bits of `h`: a multiple of 2^-24, so exact.
#[inline]
#[must_use]
pub fn unit_f32(h: u32) -> f32 {
    // Through i32: one widespread software device rounds its conversion from u32 wrongly (above 2^31).
    (h >> 8) as i32 as f32 * 5.960_464_5e-8
}

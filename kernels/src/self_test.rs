//! The self-test: known answers that tell whether a device's arithmetic is the CPU's.
//!
//! The host runs this kernel before any other, calls the same function on the CPU and compares word by word. Each
//! word stands for one defect (`lightbvh_gpu::self_test::CHECKS`); a device with a differing word that counts is named with that defect
//! and never called exact. Words that do not count describe freedoms which Vulkan leaves to every device and which
//! shared code never leans on (denormals, the sign of zero, wide integer conversions): they are reported only.
//!
//! One invocation takes one triple of operands and writes [`CHECK_COUNT`] words. The operands come from a buffer
//! ([`operands`] makes the standard set on the host), so that no compiler on the way can compute the answers ahead.
//!
//! What a word can reveal, and what it cannot: the operations here are the ones the rules for shared code permit, on
//! operands that make contraction, re-association and another rounding mode change the result. Equal words do not
//! prove a driver right in every expression; the comparison of whole results (`lightbvh verify`) goes beyond this.

#[cfg(not(target_arch = "spirv"))]
mod operands;

#[cfg(not(target_arch = "spirv"))]
pub use operands::operands;

use crate::invocation;
use bytemuck::{Pod, Zeroable};
use glam::UVec3;
use lightbvh::exact;
use spirv_std::spirv;

/// Words per operand triple.
pub const CHECK_COUNT: u32 = 38;

/// Three operands as `f32` bit patterns, so that loading them changes no bit.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
pub struct Operands {
    /// Bits of the first operand: a normal number with magnitude in [2^-42, 2^42].
    pub a: u32,
    /// Bits of the second operand, in the same range.
    pub b: u32,
    /// Bits of the third operand, in the same range.
    pub c: u32,
}

/// Push constants of [`self_test`].
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
pub struct SelfTestPush {
    /// Number of operand triples.
    pub count: u32,
}

/// Writes the answers for triple `i` to `answers[i * CHECK_COUNT ..][.. CHECK_COUNT]`, in the order of `lightbvh_gpu::self_test::CHECKS`.
#[spirv(compute(threads(64), entry_point_name = "self_test"))]
pub fn self_test(
    #[spirv(global_invocation_id)] id: UVec3,
    #[spirv(push_constant)] push: &SelfTestPush,
    #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] operands: &[Operands],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] answers: &mut [u32],
) {
    let i = invocation(id);
    if i < push.count {
        let a = f32::from_bits(operands[i as usize].a);
        let b = f32::from_bits(operands[i as usize].b);
        let c = f32::from_bits(operands[i as usize].c);
        let at = (i * CHECK_COUNT) as usize;
        contraction(a, b, c, answers, at);
        association(a, b, c, answers, at + 6);
        rounding(a, b, c, answers, at + 15);
        conversion(a, b, c, answers, at + 21);
        root_and_quotient(a, b, answers, at + 26);
        freedoms(a, b, c, answers, at + 30);
    }
}

/// Six words that a fused multiply-add changes whenever a product is inexact.
#[inline]
fn contraction(a: f32, b: f32, c: f32, out: &mut [u32], at: usize) {
    out[at] = (a * b + c).to_bits();
    out[at + 1] = (a * b - c).to_bits();
    out[at + 2] = (c - a * b).to_bits();
    out[at + 3] = (a * b - c * b).to_bits();
    out[at + 4] = ((a * a + b * b) + c * c).to_bits();
    out[at + 5] = ((a * b + c) * b + a).to_bits();
}

/// Nine words that change when a compiler uses an identity of the real numbers that rounding does not have.
#[inline]
fn association(a: f32, b: f32, c: f32, out: &mut [u32], at: usize) {
    out[at] = ((a + b) - a).to_bits();
    out[at + 1] = ((a + b) - b).to_bits();
    // The error of a sum: Knuth, The Art of Computer Programming vol. 2, section 4.2.2, theorem B. Real arithmetic says 0.
    let sum = a + b;
    let part = sum - a;
    out[at + 2] = ((a - (sum - part)) + (b - part)).to_bits();
    out[at + 3] = ((a + b) + c).to_bits();
    out[at + 4] = (a + (b + c)).to_bits();
    out[at + 5] = ((a * b) * c).to_bits();
    out[at + 6] = (a * (b * c)).to_bits();
    out[at + 7] = (a * b + a * c).to_bits();
    // The same with constants, which compilers like to collect: 2^24, and 3 with the float next to 1/3.
    out[at + 8] = (((a + 16_777_216.0) - 16_777_216.0) + (a * 3.0) * 0.333_333_34).to_bits();
}

/// Six words that another rounding mode than to-nearest-even changes, or a wrong sign or order.
#[inline]
fn rounding(a: f32, b: f32, c: f32, out: &mut [u32], at: usize) {
    out[at] = (a + b).to_bits();
    out[at + 1] = (a - b).to_bits();
    out[at + 2] = (a * b).to_bits();
    out[at + 3] = (-a).to_bits();
    // Comparisons, and the minimum and maximum that shared code makes of them.
    let mut order = 0;
    if a < b {
        order |= 1;
    }
    if b <= c {
        order |= 2;
    }
    if a == c {
        order |= 4;
    }
    if c > a {
        order |= 8;
    }
    out[at + 4] = order;
    let low = if a < b { a } else { b };
    let high = if c > low { c } else { low };
    out[at + 5] = (high - low).to_bits();
}

/// Five words of conversions between integers and floats inside the ranges that shared code keeps, and of integers.
#[inline]
fn conversion(a: f32, b: f32, c: f32, out: &mut [u32], at: usize) {
    let small = a.to_bits() & 0x00ff_ffff;
    out[at] = (small as i32 as f32).to_bits();
    out[at + 1] = ((small as i32).wrapping_sub(0x0080_0000) as f32).to_bits();
    // A float in [1, 2^24) that is rarely whole: the exponent from b, the fraction from c.
    let exponent = 127 + (b.to_bits() >> 23) % 24;
    let wide = f32::from_bits((exponent << 23) | (c.to_bits() & 0x007f_ffff));
    out[at + 2] = wide as u32;
    // One less, so that no answer is the word of ones that the host fills buffers with.
    out[at + 3] = ((-wide) as i32).wrapping_sub(1) as u32;
    let mixed = a.to_bits().wrapping_mul(0x9e37_79b9) ^ (b.to_bits() >> (c.to_bits() & 31));
    out[at + 4] = mixed.wrapping_add((mixed as i32 >> 7) as u32) ^ mixed.leading_zeros();
}

/// Four words of the division, root and reciprocals of [`lightbvh::exact`], on magnitudes.
#[inline]
fn root_and_quotient(a: f32, b: f32, out: &mut [u32], at: usize) {
    let x = exact::abs(a);
    let y = exact::abs(b);
    out[at] = exact::div(x, y).to_bits();
    out[at + 1] = exact::sqrt(x).to_bits();
    out[at + 2] = exact::recip(x).to_bits();
    out[at + 3] = exact::rsqrt(y).to_bits();
}

/// Eight words that a conformant device may answer in its own way; they never count.
#[inline]
fn freedoms(a: f32, b: f32, c: f32, out: &mut [u32], at: usize) {
    let denormal = f32::from_bits((a.to_bits() & 0x007f_ffff) | 1);
    let smallest_normal = f32::from_bits((b.to_bits() & 0x007f_ffff) | 0x0080_0000);
    // Is a denormal operand taken for zero? Doubling it often gives a normal number.
    out[at] = (denormal + denormal).to_bits();
    // Is a denormal result written as zero? A quarter of a number in [2^-126, 2^-125) always is one.
    let quarter = f32::from_bits(0x3e80_0000 | (a.to_bits() & 0x8000_0000));
    out[at + 1] = (smallest_normal * quarter).to_bits();
    out[at + 2] = if denormal > 0.0 { 1 } else { 0 };
    // The sign of a zero product, and of a zero sum.
    let zero = f32::from_bits(a.to_bits() & 0x8000_0000);
    out[at + 3] = (zero * b).to_bits();
    out[at + 4] = (a * 0.0).to_bits();
    out[at + 5] = (zero + 0.0).to_bits();
    // Integers above 2^24 round on the way to a float.
    out[at + 6] = (c.to_bits() as i32 as f32).to_bits();
    out[at + 7] = ((c.to_bits() >> 1) as i32 as f32).to_bits();
}

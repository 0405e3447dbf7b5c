//! Codes of the quantised moments, and the frame that the children of a node share.

use glam::Vec3;

use crate::bounds::{MAX_SUM, MIN_PHI};
use crate::exact::{self, exponent, pow2};
use crate::light::MIN_COORDINATE;
use crate::moments::{LEAST_EXPONENT, LightMoments};
use crate::vector::{abs3, dot, flush3, greatest_exponent, max3};

/// The bits of 1.
const ONE_BITS: u32 = 0x3f80_0000;

/// A child's flux is a code of 7 bits of exponent and 4 of significand, shifted to the place of an `f32`'s: 2^-63 to 2^0 for
/// the codes from 64·16 on, the greatest child's in the last octave. Code 0 is no flux; those between are not used. So the
/// code costs no multiplication and no test for zero.
pub(crate) const PHI_MASK: u32 = 0x7ff;
pub(crate) const PHI_SHIFT: u32 = 19;
/// A breadth code shifted likewise: 5 bits of exponent, 3 of significand.
pub(crate) const BREADTH_SHIFT: u32 = 20;
pub(crate) const BREADTH_MASK: u32 = 0xff << BREADTH_SHIFT;
/// Added to the exponent of a shifted breadth code, which so becomes 2^-30 to nearly 2^2 units; the code 0 a little less. None
/// is zero, and none need be.
pub(crate) const BREADTH_BIAS: i32 = 97;
/// Half extents are stored up to this many breadths; those of sets whose flux lies mostly in one place are cut.
pub(crate) const EXTENT_RANGE: f32 = 8.0;
/// A constant of its own: rust-gpu does not fold an expression of literals.
pub(crate) const PER_EXTENT_RANGE: f32 = 1.0 / EXTENT_RANGE;
/// Signed fractions are read as whole words, what lies below them included: it is less than one unit of the code, and the
/// packer takes it into account. So a component costs one shift and one conversion.
pub(crate) const WORD_UNIT: f32 = pow2(-31);

/// √(1 − |m|²) is stored in units of 1/255.
pub(crate) const SPREAD_UNIT: f32 = 1.0 / 255.0;

#[inline(always)]
pub(super) fn spread(m: Vec3) -> f32 {
    let rest = 1.0 - dot(m, m);
    // Rounding leaves a unit normal's rest at some 2^-20.
    exact::min(exact::sqrt(exact::flush(exact::max(rest, 0.0), pow2(-18))), 1.0)
}

/// Puts the signed fraction `x` into the `bits` bits that start `shift` bits below the top, above what `low` holds: the code
/// whose reading, `low` included, comes nearest.
#[inline(always)]
pub(super) fn field(x: f32, shift: u32, bits: u32, low: u32) -> u32 {
    let half_range = 1_i32 << (bits - 1);
    // `low` as the reading sees it, in units of the code: below 1.
    let noise = (low << shift) as i32 as f32 * (pow2(bits as i32 - 1) * WORD_UNIT);
    let bounded = exact::clamp(x, -1.0, 1.0);
    // A positive number below 2^22, of which the floor is taken.
    let code = exact::floor_small(exact::max(
        bounded * pow2(bits as i32 - 1) - noise + pow2(bits as i32 - 1) + 0.5,
        0.0,
    )) as i32;
    let top = 2 * half_range - 1;
    let code = (if code > top { top } else { code }) - half_range;
    let mask = (1_u32 << bits) - 1;
    low | (((code as u32) & mask) << (32 - bits - shift))
}

/// What the children of a node are stored in relation to.
pub(super) struct Header {
    pub origin: Vec3,
    pub unit_exponent: i32,
    pub phi_exponent: i32,
}

#[inline(always)]
pub(super) fn header<const W: usize>(sets: &[LightMoments; W]) -> Header {
    let mut greatest = 0.0;
    let mut low = Vec3::new(0.0, 0.0, 0.0);
    let mut high = Vec3::new(0.0, 0.0, 0.0);
    for i in 0..W {
        let s = &sets[i];
        let first = greatest == 0.0;
        let shines = s.phi > 0.0;
        let l = if first { s.c } else { -max3(-low, -s.c) };
        let h = if first { s.c } else { max3(high, s.c) };
        low = if shines { l } else { low };
        high = if shines { h } else { high };
        greatest = exact::max(s.phi, greatest);
    }
    let origin = flush3((low + high) * 0.5, MIN_COORDINATE);
    // The unit is above every offset, and the greatest deviation that fits is nearly twice the unit.
    let mut e = LEAST_EXPONENT;
    for i in 0..W {
        let s = &sets[i];
        let offset = greatest_exponent(abs3(s.c - origin), LEAST_EXPONENT) + 1;
        let size = greatest_exponent(Vec3::new(s.across, 0.0, 0.0), LEAST_EXPONENT);
        let needed = if offset > size { offset } else { size };
        e = if (s.phi > 0.0) & (needed > e) { needed } else { e };
    }
    let phi_exponent = exponent(exact::max(greatest, MIN_PHI));
    Header {
        origin,
        unit_exponent: e,
        phi_exponent,
    }
}

/// √2, and its half.
pub(crate) const SQRT_2: f32 = core::f32::consts::SQRT_2;
pub(crate) const SQRT_HALF: f32 = core::f32::consts::FRAC_1_SQRT_2;

/// Code of a flux: that of the greatest child lies in the last octave but one, so that rounding may carry; flux of less than
/// 2^-62 of it counts as that much.
#[inline(always)]
pub(super) fn phi_code(phi: f32, greatest: i32) -> u32 {
    let rounded = phi.to_bits().wrapping_add(1 << (PHI_SHIFT - 1));
    let octave = (rounded >> 23) as i32 - 127 - greatest + 126;
    let code = if octave < 64 {
        64 << 4
    } else {
        ((octave as u32) << 4) | ((rounded >> PHI_SHIFT) & 15)
    };
    if phi > 0.0 { code } else { 0 }
}

/// The flux that a code stands for.
#[inline(always)]
pub(super) fn phi_value(code: u32, greatest: i32) -> f32 {
    let e = (code >> 4) as i32 - 126 + greatest;
    let significand = f32::from_bits(ONE_BITS | ((code & 15) << PHI_SHIFT));
    let within = if e < -100 { -100 } else { e };
    if code == 0 {
        0.0
    } else {
        exact::min(significand * pow2(within), MAX_SUM)
    }
}

/// Code of the breadth √2·`deviation` in units of the frame.
#[inline(always)]
pub(super) fn breadth_code(deviation: f32, unit_exponent: i32) -> u32 {
    let breadth = (deviation * pow2(-unit_exponent)) * SQRT_2;
    let rounded = breadth.to_bits().wrapping_add(1 << (BREADTH_SHIFT - 1));
    let octave = (rounded >> 23) as i32 - BREADTH_BIAS;
    if octave < 0 {
        0
    } else if octave > 31 {
        255
    } else {
        ((octave as u32) << 3) | ((rounded >> BREADTH_SHIFT) & 7)
    }
}

/// The breadth that a code stands for, in units of the frame.
#[inline(always)]
pub(super) fn breadth_value(code: u32) -> f32 {
    f32::from_bits((code << BREADTH_SHIFT).wrapping_add((BREADTH_BIAS as u32) << 23))
}

/// The word's signed fraction whose top bit is `shift` below the word's.
#[inline(always)]
pub(super) fn fraction(word: u32, shift: u32) -> f32 {
    (word << shift) as i32 as f32
}

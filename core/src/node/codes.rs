//! Codes of the quantised moments, and the frame that the children of a node share.

use glam::Vec3;

use crate::emission::{MAX_SUM, MIN_PHI};
use crate::exact::{self, exponent, pow2};
use crate::halves::maxima;
use crate::light::MIN_COORDINATE;
use crate::moments::{Frame, row};
use crate::summary::Lanes;
use crate::unroll::each;
use crate::vector::{dot, flush3};

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
const BREADTH_BIAS: i32 = 97;
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

/// The code of a spread of normals.
#[inline(always)]
pub(super) fn spread_code(m: Vec3) -> u32 {
    (spread(m) * 255.0 + COUNTS).to_bits() & 255
}

/// Added to a number below 2^22 in magnitude, 3 · 2^22 rounds it to the nearest integer, and the last bits of the sum's word
/// are that integer's, negative ones as two's complements. Processors do it several numbers at a time.
const COUNTS: f32 = 12_582_912.0;

/// Puts the signed fraction `x` into the `bits` bits that start `shift` bits below the top, above what `low` holds: the code
/// whose reading, `low` included, comes nearest.
#[inline(always)]
pub(super) fn field(x: f32, shift: u32, bits: u32, low: u32) -> u32 {
    let half_range = pow2(bits as i32 - 1);
    // `low` as the reading sees it, in units of the code: below 1.
    let noise = fraction(low, shift) * (half_range * WORD_UNIT);
    let nearest = exact::min(exact::max(x * half_range - noise, -half_range), half_range - 1.0);
    let mask = (1_u32 << bits) - 1;
    low | (((nearest + COUNTS).to_bits() & mask) << (32 - bits - shift))
}

/// The frame that the children of a node are stored in: about the middle of their centres, of the exponent of the greatest
/// flux.
#[inline(always)]
pub(super) fn frame_of<const W: usize>(sets: &Lanes<W>) -> Frame {
    let s = &sets.0;
    // The greatest coordinates, the least ones as the greatest of opposite sign, and the greatest flux.
    let mut ends = [[0.0; W]; 7];
    each!(i, W, {
        let shines = exact::mask_of(s[row::PHI][i] > 0.0);
        // The numbers of a set without flux mean nothing.
        let shining = |c: f32| f32::from_bits(exact::masked_u32(shines, c.to_bits(), f32::MIN.to_bits()));
        ends[0][i] = shining(s[row::C][i]);
        ends[1][i] = shining(s[row::C + 1][i]);
        ends[2][i] = shining(s[row::C + 2][i]);
        ends[3][i] = shining(-s[row::C][i]);
        ends[4][i] = shining(-s[row::C + 1][i]);
        ends[5][i] = shining(-s[row::C + 2][i]);
        ends[6][i] = s[row::PHI][i];
    });
    maxima(&mut ends);
    let middle = Vec3::new(
        ends[0][0] - ends[3][0],
        ends[1][0] - ends[4][0],
        ends[2][0] - ends[5][0],
    ) * 0.5;
    let origin = flush3(middle, MIN_COORDINATE);
    // The unit is above every offset, and the greatest deviation that fits is nearly twice the unit.
    let mut needed = [[0.0; W]];
    each!(i, W, {
        let x = exact::abs(s[row::C][i] - origin.x);
        let y = exact::abs(s[row::C + 1][i] - origin.y);
        let z = exact::abs(s[row::C + 2][i] - origin.z);
        let offset = exact::max(exact::max(x, y), z);
        let size = exact::max(exact::max(offset + offset, s[row::ACROSS][i]), LEAST_UNIT);
        needed[0][i] = exact::masked(exact::mask_of(s[row::PHI][i] > 0.0), size);
    });
    maxima(&mut needed);
    let e = exponent(needed[0][0]);
    Frame {
        origin,
        unit_exponent: if e > LEAST_UNIT_EXPONENT {
            e
        } else {
            LEAST_UNIT_EXPONENT
        },
        phi_exponent: exponent(exact::max(ends[6][0], MIN_PHI)),
    }
}

/// Exponent of the least unit of a frame: 2^-87 m. A centre's whole words of 2^-31 units and the least breadth, 2^-30, are normal numbers then,
/// and a code of a centre, 2^-14 or 2^-15 units, is below the least coordinate that is not zero.
const LEAST_UNIT_EXPONENT: i32 = -87;
/// The least unit.
const LEAST_UNIT: f32 = pow2(LEAST_UNIT_EXPONENT);

/// √2, and its half.
pub(crate) const SQRT_2: f32 = core::f32::consts::SQRT_2;
pub(crate) const SQRT_HALF: f32 = core::f32::consts::FRAC_1_SQRT_2;

/// Code of a flux: that of the greatest child lies in the last octave but one, so that rounding may carry; flux of less than
/// 2^-62 of it counts as that much.
#[inline(always)]
pub(super) fn phi_code(phi: f32, greatest: i32) -> u32 {
    let rounded = phi.to_bits().wrapping_add(1 << (PHI_SHIFT - 1));
    let code = (rounded >> PHI_SHIFT) as i32 - ((greatest + 1) << 4);
    let code = if code < 64 << 4 { 64 << 4 } else { code };
    code as u32 & exact::mask_of(phi > 0.0)
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

/// The breadths of the first and the last code.
const LEAST_BREADTH: f32 = pow2(-30);
const MOST_BREADTH: f32 = 3.75;

/// Code of the breadth √2·`deviation`, in units of the frame, one of which has 1/`per_unit` of the deviation's.
#[inline(always)]
pub(super) fn breadth_code(deviation: f32, per_unit: f32) -> u32 {
    let breadth = (deviation * per_unit) * SQRT_2;
    let bounded = exact::min(exact::max(breadth, LEAST_BREADTH), MOST_BREADTH);
    let rounded = bounded.to_bits().wrapping_add(1 << (BREADTH_SHIFT - 1));
    (rounded >> BREADTH_SHIFT).wrapping_sub((BREADTH_BIAS as u32) << 3)
}

/// Factor from a shifted breadth code to its length. `unit`: of the frame, a power of two.
#[inline(always)]
pub(super) fn breadth_bias(unit: f32) -> u32 {
    unit.to_bits()
        .wrapping_sub(ONE_BITS)
        .wrapping_add((BREADTH_BIAS as u32) << 23)
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

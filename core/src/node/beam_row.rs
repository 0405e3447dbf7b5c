//! The two words of a child's limits in a node of moments, and their factor on its weight.
//!
//! One is its [end](Limits::end), metres beyond the box of its lights, as an `f32`; zero if there is none. The other is its [`Beam`].
//!
//! The directions of a beam are those within θ of the mean normal m as it is stored. The places of its lights lie within r of the
//! centre c. So all light stays in the cone of the angle θ whose apex lies r / sin θ behind the centre.
//!
//! | bits | content |
//! |---|---|
//! | 16 | cos² θ · m², rounded down, in units of 2^-16; zero where the beam says nothing, as is the whole word |
//! | 8 | r / (sin θ · m), in units of the frame, rounded up: 5 bits of exponent, 3 of significand, from 2^-26 on |
//! | 8 | how much more than a diffuse emitter sends it to a point in the cone, √(0.5 / (1 − cos θ)) − 1, in units of 1/4 |

use glam::Vec3;

use super::codes::{EXTENT_RANGE, SQRT_2};
use crate::beam::{Beam, Limits, Space, rounding_at};
use crate::exact::{self, pow2};
use crate::moments::LightMoments;
use crate::vector::{abs3, dot, flush3, length_squared, max3};
use crate::weight::{Lobe, recip};

/// Least factor on a weight, outside of the cone or beyond the end: positive, for rounding may put a lit point there.
pub(super) const OUTSIDE: f32 = pow2(-16);
/// The exponent of the first code of a length, as a shifted code takes it.
const LENGTH_BIAS: u32 = 101;
const LENGTH_SHIFT: u32 = 20;
const LEAST_LENGTH: f32 = pow2(-26);
/// Just below the last code, which counts as beyond.
const MOST_LENGTH: f32 = 56.0;
const UNITS: f32 = 65536.0;
const PER_UNIT: f32 = pow2(-16);
const PER_GAIN: f32 = 4.0;
const GAIN_UNIT: f32 = 0.25;
/// The slack at which all points count as inside, and the least slack.
const ALL_OF_SPACE: f32 = 256.0;
const LEAST_SLACK: f32 = pow2(-60);
/// A longer reach counts as this one, metres: all of space, at any scale.
const MOST_REACH: f32 = pow2(80);
/// An end is rounded up by this factor: more than the errors of the distance.
const LONGER: f32 = 1.001;
/// A unit of the code of an extent, in breadths, and some of the code of a centre, in units of the frame.
const EXTENT_CODE: f32 = EXTENT_RANGE * pow2(-6);
const CENTER_CODES: f32 = pow2(-12);
/// Lengths along an axis count as zero below this, in units of the scale: their squares are then normal numbers.
const LEAST_AWAY: f32 = pow2(-30);
/// Absorbs the rounding of a squared length, as `LEAST_DISTANCE` of the weights.
const LEAST_SQUARED: f32 = pow2(-50);

/// The length of a code, in units of the frame.
#[inline(always)]
fn length_of(word: u32) -> f32 {
    f32::from_bits((((word >> 8) & 255) << LENGTH_SHIFT).wrapping_add(LENGTH_BIAS << 23))
}

/// Encodes the beam. `stored`: moments as the node has them. `per_unit`: units of the frame per metre.
#[inline(always)]
pub(super) fn beam_word(beam: &Beam, stored: &LightMoments, per_unit: f32) -> u32 {
    let m = flush3(stored.m, pow2(-30));
    let squared = length_squared(m);
    let cosine = beam.cosine_about(m);
    let narrow = cosine > 0.0;
    let within = if narrow { cosine } else { 0.5 };
    let sine = exact::sqrt((1.0 - within) * (1.0 + within));
    let bounded = exact::max(squared, pow2(-24));
    let length = exact::div(beam.radius_about(stored.c, per_unit), sine * exact::sqrt(bounded));
    // One code more: the remainder of the division and of what reads it.
    let code = exact::max(length, LEAST_LENGTH)
        .to_bits()
        .wrapping_add((1 << LENGTH_SHIFT) + (1 << 10))
        >> LENGTH_SHIFT;
    let length_code = code.wrapping_sub(LENGTH_BIAS << 3) & 255;
    let scaled = (within * within) * squared * UNITS - 1.0;
    let cone = exact::clamp(scaled, 0.0, UNITS - 1.0) as i32 as u32;
    let gain = exact::sqrt(exact::div(0.5, 1.0 - within)) - 1.0;
    let gain_code = exact::clamp(gain * PER_GAIN + 0.5, 0.0, 255.0) as i32 as u32;
    if narrow & (length < MOST_LENGTH) & (cone > 0) {
        (cone << 16) | (length_code << 8) | gain_code
    } else {
        0
    }
}

/// Decodes the beam. `unit`: metres per unit of the frame.
#[inline(always)]
pub(super) fn beam_of(word: u32, stored: &LightMoments, unit: f32) -> Beam {
    let m = flush3(stored.m, pow2(-30));
    let squared = exact::max(length_squared(m), pow2(-24));
    let per_length = exact::rsqrt(squared);
    let cos_squared = exact::min(exact::div((word >> 16) as i32 as f32 * PER_UNIT, squared), 1.0);
    let cosine = exact::sqrt(cos_squared);
    let sine = exact::sqrt((1.0 - cosine) * (1.0 + cosine));
    let radius = length_of(word) * (sine * exact::sqrt(squared));
    if word == 0 {
        Beam::ANYWHERE
    } else {
        Beam {
            axis: m * per_length,
            cos_theta_e: cosine,
            c: stored.c,
            radius: exact::flush(radius * unit, pow2(-100)),
        }
    }
}

/// Encodes the end. `end`: metres from the box of `set`. `unit`: metres per unit of the frame.
///
/// A stored box that does not hold all lights gets no end: the part outside is a length of another space.
#[inline(always)]
pub(super) fn end_word(end: f32, set: &LightMoments, stored: &LightMoments, unit: f32) -> u32 {
    let needed = abs3(set.c - stored.c) + set.h;
    let has = stored.h + widened(stored.across * SQRT_2, unit);
    let is_in = (needed.x <= has.x) & (needed.y <= has.y) & (needed.z <= has.z);
    let longer = end * LONGER;
    if is_in & (longer < Limits::ENDLESS) {
        longer.to_bits()
    } else {
        0
    }
}

/// Margin of a stored box, for a child of this breadth in a frame of this unit: more than two steps of the centre's code, and one of the
/// extent's.
#[inline(always)]
fn widened(breadth: f32, unit: f32) -> Vec3 {
    let by = breadth * EXTENT_CODE + unit * CENTER_CODES;
    Vec3::new(by, by, by)
}

/// Shared by the tests of all children's cones and ends.
#[derive(Clone, Copy, Debug)]
pub(super) struct Near {
    /// Slack: twice the rounding error of the point, in units of the scale.
    pub slack: f32,
    /// A metre of the world in metres of the space, and one of these in units of the scale.
    per_world: f32,
    per_metre: f32,
}

impl Near {
    /// Of a point at `p` where a metre is `per_metre` units of the scale.
    #[inline(always)]
    pub fn new(p: Vec3, space: &Space, per_metre: f32) -> Self {
        let moved = (space.slack + rounding_at(p)) * per_metre;
        // Lengths are at most about 60, and what a device flushes is cut here.
        Self {
            slack: exact::flush(exact::min(moved + moved, ALL_OF_SPACE), LEAST_SLACK),
            per_world: space.per_metre,
            per_metre,
        }
    }

    /// Factor of the end on the child's weight. `h`: half extents of its box, in breadths. `unit`: of the frame, in units of the scale.
    ///
    /// The squared mean of the window 1 − (d / end)⁴ at the box's nearest point, its farthest point and its centre. The square accounts for
    /// lights whose own end is less than the stored maximum (`docs/beams.md`).
    #[inline(always)]
    pub fn within(&self, end: u32, lobe: &Lobe, h: Vec3, unit: f32) -> f32 {
        let (x, h) = (abs3(lobe.x), h * lobe.breadth + widened(lobe.breadth, unit));
        let nearest = length_squared(flush3(max3(x - h, Vec3::new(0.0, 0.0, 0.0)), LEAST_AWAY));
        let reached = exact::min(f32::from_bits(end) * self.per_world, MOST_REACH) * self.per_metre;
        let most = exact::min(reached + self.slack, ALL_OF_SPACE);
        let per_square = recip(most * most + LEAST_SQUARED);
        let window = |squared: f32| {
            let q = exact::min(squared * per_square, 1.0);
            1.0 - q * q
        };
        let ends = window(nearest) + window(length_squared(x + h));
        let mean = 0.25 * ends + 0.5 * window(length_squared(x));
        if end == 0 { 1.0 } else { mean * mean }
    }
}

/// Factor of the beam on the child's weight. `m_unit`: unit of the mean normal. `unit`: of the frame, in units of the scale. `slack`:
/// [`Near::slack`].
#[inline(always)]
pub(super) fn beam_factor(word: u32, lobe: &Lobe, m_unit: f32, unit: f32, slack: f32) -> f32 {
    let (x, m) = (lobe.x, lobe.m);
    let behind = length_of(word) * unit * m_unit;
    let from_apex = x - m * behind;
    let along = slack + dot(m, from_apex) * -m_unit;
    let apex_squared = dot(from_apex, from_apex) + LEAST_SQUARED;
    let squared = dot(x, x) + LEAST_SQUARED;
    let cone = (word >> 16) as i32 as f32 * PER_UNIT;
    let inside = (along > 0.0) & (along * along >= cone * apex_squared);
    let nearer = exact::min(squared, apex_squared) * recip(apex_squared);
    let gain = (word & 255) as i32 as f32 * GAIN_UNIT;
    let within = 1.0 + gain * nearer;
    let factor = if inside { within } else { OUTSIDE };
    if word == 0 { 1.0 } else { factor }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_are_rounded_up_by_a_thousandth() {
        let set = LightMoments::EMPTY;
        for e in -20..40 {
            let end = 1.7 * pow2(e);
            let found = f32::from_bits(end_word(end, &set, &set, 1.0));
            assert!((1.0005 * end..=1.002 * end).contains(&found), "{end}: {found}");
        }
    }
}

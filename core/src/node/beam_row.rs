//! The word that a node of moments stores of each child's [`Beam`], and what it makes of a weight.
//!
//! The directions of a beam are those within θ of the mean normal m as it is stored. The places of its lights lie within r of the
//! centre c. So all light stays in the cone of the angle θ whose apex lies r / sin θ behind the centre.
//!
//! | bits | content |
//! |---|---|
//! | 16 | cos² θ · m², rounded down, in units of 2^-16; zero where the beam says nothing, as is the whole word |
//! | 8 | r / (sin θ · m), in units of the frame, rounded up: 5 bits of exponent, 3 of significand, from 2^-26 on |
//! | 8 | how much more than a diffuse emitter sends it to a point in the cone, √(0.5 / (1 − cos θ)) − 1, in units of 1/4 |

use crate::beam::Beam;
use crate::exact::{self, pow2};
use crate::moments::LightMoments;
use crate::vector::{dot, flush3, length_squared};
use crate::weight::{Lobe, recip};

/// A weight outside of the cone is this part of what it is without one: positive, for whatever the rounding of coordinates may put there.
const OUTSIDE: f32 = pow2(-16);
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
/// A slack that takes all points in, and the least that counts.
const ALL_OF_SPACE: f32 = 256.0;
const LEAST_SLACK: f32 = pow2(-60);
/// What absorbs the rounding of a squared length, as `LEAST_DISTANCE` of the weights.
const LEAST_SQUARED: f32 = pow2(-50);

/// The length of a code, in units of the frame.
#[inline(always)]
fn length_of(word: u32) -> f32 {
    f32::from_bits((((word >> 8) & 255) << LENGTH_SHIFT).wrapping_add(LENGTH_BIAS << 23))
}

/// The word of the lights that keep to `beam`, of a child whose moments are stored as `stored` in a frame of which one unit is 1/`per_unit`
/// metres.
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

/// The beam that the word tells, with lengths in units of which one is `unit` metres.
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

/// What the test of a cone allows for where rounding may have moved a point by `moved`, in units of the scale: with v from the apex, v·m − cos θ m |v|
/// changes by twice as much at most.
#[inline(always)]
pub(super) fn cone_slack(moved: f32) -> f32 {
    // Lengths are at most about 60, and what a device flushes is cut here.
    exact::flush(exact::min(moved + moved, ALL_OF_SPACE), LEAST_SLACK)
}

/// The factor on the weight of a child with this word and these moments, its mean normal in units of which one is `m_unit`; lengths are in
/// units of the scale, of which one of the frame has `unit`; a point counts as in the cone by [`cone_slack`] `slack`.
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

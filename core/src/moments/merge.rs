//! The moments of several sets together.
//!
//! Sets are merged in a frame: an origin near them and one unit for all lengths, one for all flux. A packed node has such a
//! frame; for other numbers one is found first. Sums are by halves of the slots, as registers of several numbers are added.

use glam::Vec3;

use super::{LEAST_LENGTH, LightMoments, row};
use crate::emission::MAX_SUM_EXPONENT;
use crate::exact::{self, exponent, pow2};
use crate::halves::{maxima, sums};
use crate::light::MIN_COORDINATE_EXPONENT;
use crate::summary::{Lanes, SUMMARY_WORDS};
use crate::unroll::each;
use crate::vector::{abs3, dot, flush3};

/// Flux below this part of the greatest among its siblings moves no centre: 2^-40. It keeps products of flux and squared
/// lengths normal.
const LEAST_SHARE: f32 = pow2(-40);
/// Squares below this, in units of the set's size squared, count as zero: what a device flushes is far below it. So do lengths.
const LEAST_SQUARE_EXPONENT: i32 = -60;
const LEAST_SQUARE: f32 = pow2(LEAST_SQUARE_EXPONENT);
/// Least exponent of a set's size: the factor on lengths, 2^31 over twice the size, is then a number.
const LEAST_SIZE_EXPONENT: i32 = -97;
/// Squared length of a mean normal below which it has no direction: 2^-6.
const LEAST_NORMAL: f32 = pow2(-6);
/// The unit of the words, its inverse, and its square.
const WORD_UNIT: f32 = pow2(-31);
const PER_WORD_UNIT: f32 = pow2(31);
const SQUARE_UNIT: f32 = pow2(-62);
/// [`LEAST_NORMAL`] in units of the words.
const LEAST_OWN: f32 = pow2(56);
/// A constant of its own: rust-gpu does not fold an expression of literals.
const THIRD: f32 = 1.0 / 3.0;

/// Origin and units of sets.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame {
    pub origin: Vec3,
    /// Exponent of the unit of lengths.
    pub unit_exponent: i32,
    /// Exponent of the unit of flux.
    pub phi_exponent: i32,
}

/// Sets in a frame. Their lengths and mean normals are in units of 2^-31 of the frame's unit and of 1, as the words of packed
/// nodes give them. No length is above 2^6 of the frame's units; of those with flux the brightest has 1/2 to 2 units of it,
/// and the least 2^-40.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Framed<const W: usize> {
    pub frame: Frame,
    pub sets: Lanes<W>,
}

/// `sets` in a frame of their own.
#[inline(always)]
pub(super) fn framed<const W: usize>(sets: &Lanes<W>) -> Framed<W> {
    let s = &sets.0;
    // The origin is the brightest set's centre: what cancels in the differences from it is less than what is far away could
    // bring.
    let mut brightest = 0.0;
    let mut origin = Vec3::new(0.0, 0.0, 0.0);
    each!(i, W, {
        let brighter = s[row::PHI][i] > brightest;
        brightest = if brighter { s[row::PHI][i] } else { brightest };
        origin.x = if brighter { s[row::C][i] } else { origin.x };
        origin.y = if brighter { s[row::C + 1][i] } else { origin.y };
        origin.z = if brighter { s[row::C + 2][i] } else { origin.z };
    });
    let mut reach = [[0.0; W]];
    each!(i, W, {
        let away = abs3(vector(s, row::C, i) - origin) + vector(s, row::H, i);
        let far = exact::max(exact::max(away.x, away.y), away.z);
        let wide = exact::max(s[row::ACROSS][i], s[row::ALONG][i]);
        // Numbers of a set without flux mean nothing.
        reach[0][i] = exact::masked(exact::mask_of(s[row::PHI][i] > 0.0), exact::max(far, wide));
    });
    maxima(&mut reach);
    let size = exponent(reach[0][0]);
    let size = if size > LEAST_SIZE_EXPONENT {
        size
    } else {
        LEAST_SIZE_EXPONENT
    };
    // One more, so that sums of a centre's offset and an extent stay below 2.
    let frame = Frame {
        origin,
        unit_exponent: size + 1,
        phi_exponent: exponent(brightest),
    };
    let to_words = pow2(31 - frame.unit_exponent);
    // In two steps: from 2^126 to 2^-100 is more than one power of two.
    let half = frame.phi_exponent / 2;
    let (first, second) = (pow2(-half), pow2(half - frame.phi_exponent));
    let mut rows = [[0.0; W]; SUMMARY_WORDS];
    each!(i, W, {
        let shines = exact::mask_of(s[row::PHI][i] > 0.0);
        let scaled = |x: f32| exact::masked(shines, x * to_words);
        let share = exact::masked(shines, (s[row::PHI][i] * first) * second);
        rows[row::PHI][i] = exact::max(share, exact::masked(shines, LEAST_SHARE));
        let offset = flush3(vector(s, row::C, i) - origin, LEAST_LENGTH);
        rows[row::C][i] = scaled(offset.x);
        rows[row::C + 1][i] = scaled(offset.y);
        rows[row::C + 2][i] = scaled(offset.z);
        rows[row::ACROSS][i] = scaled(s[row::ACROSS][i]);
        rows[row::ALONG][i] = scaled(s[row::ALONG][i]);
        rows[row::M][i] = exact::masked(shines, s[row::M][i] * PER_WORD_UNIT);
        rows[row::M + 1][i] = exact::masked(shines, s[row::M + 1][i] * PER_WORD_UNIT);
        rows[row::M + 2][i] = exact::masked(shines, s[row::M + 2][i] * PER_WORD_UNIT);
        rows[row::H][i] = scaled(s[row::H][i]);
        rows[row::H + 1][i] = scaled(s[row::H + 1][i]);
        rows[row::H + 2][i] = scaled(s[row::H + 2][i]);
    });
    Framed {
        frame,
        sets: Lanes(rows),
    }
}

/// 2^`exponent`, which is below 1, or [`LEAST_SQUARE`] where that is more.
#[inline(always)]
fn least(exponent: i32) -> f32 {
    exact::power(if exponent > LEAST_SQUARE_EXPONENT {
        exponent
    } else {
        LEAST_SQUARE_EXPONENT
    })
}

#[inline(always)]
fn vector<const W: usize>(rows: &[[f32; W]; SUMMARY_WORDS], first: usize, slot: usize) -> Vec3 {
    Vec3::new(rows[first][slot], rows[first + 1][slot], rows[first + 2][slot])
}

impl<const W: usize> Framed<W> {
    /// The moments of all sets together; those without flux are ignored.
    #[inline(always)]
    pub fn merged(&self) -> LightMoments {
        let s = &self.sets.0;
        let mut weighted = [[0.0; W]; 7];
        each!(i, W, {
            let f = s[row::PHI][i];
            weighted[6][i] = f;
            weighted[0][i] = s[row::C][i] * f;
            weighted[1][i] = s[row::C + 1][i] * f;
            weighted[2][i] = s[row::C + 2][i] * f;
            weighted[3][i] = s[row::M][i] * f;
            weighted[4][i] = s[row::M + 1][i] * f;
            weighted[5][i] = s[row::M + 2][i] * f;
        });
        sums(&mut weighted);
        let flux = weighted[6][0];
        let shines = flux > 0.0;
        let per_flux = exact::div(1.0, if shines { flux } else { 1.0 });
        let center = Vec3::new(weighted[0][0], weighted[1][0], weighted[2][0]) * per_flux;
        let normal = Vec3::new(weighted[3][0], weighted[4][0], weighted[5][0]) * per_flux * WORD_UNIT;
        let mean = flush3(normal, LEAST_SQUARE);
        let length_squared = dot(mean, mean);
        let directed = length_squared > LEAST_NORMAL;
        let per_length = exact::rsqrt(exact::max(length_squared, LEAST_NORMAL));
        let axis = mean * exact::masked(exact::mask_of(directed), per_length);

        let mut squares = [[0.0; W]; 2];
        let mut h = [[0.0; W]; 3];
        each!(i, W, {
            let f = s[row::PHI][i];
            let d = vector(s, row::C, i) - center;
            let m = vector(s, row::M, i);
            let (sa, sn) = (s[row::ACROSS][i], s[row::ALONG][i]);
            let (va, vn) = (sa * sa, sn * sn);
            let own = dot(m, m);
            let cosine = dot(m, axis);
            // The child's covariance is axially symmetric about its own normal; none has no axis to turn.
            let squared = cosine * cosine * exact::recip(exact::max(own, LEAST_OWN));
            let turn = exact::masked(exact::mask_of(own > LEAST_OWN), squared);
            let off = dot(d, axis);
            squares[0][i] = f * ((va + va + vn) + dot(d, d));
            squares[1][i] = f * ((va + (vn - va) * turn) + off * off);
            let reach = abs3(d) + vector(s, row::H, i);
            let some = exact::mask_of(f > 0.0);
            h[0][i] = exact::masked(some, reach.x);
            h[1][i] = exact::masked(some, reach.y);
            h[2][i] = exact::masked(some, reach.z);
        });
        sums(&mut squares);
        maxima(&mut h);
        // Lengths shorter than a coordinate count as zero: no sum of two such numbers is subnormal.
        let shortest = MIN_COORDINATE_EXPONENT - self.frame.unit_exponent;
        let (least_length, least_square) = (least(shortest), least(shortest + shortest));
        let total = exact::flush((squares[0][0] * per_flux) * SQUARE_UNIT, least_square);
        let along = exact::flush(
            exact::max((squares[1][0] * per_flux) * SQUARE_UNIT, 0.0),
            least_square,
        );
        let along = if directed {
            exact::min(along, total)
        } else {
            total * THIRD
        };
        let across = exact::flush((total - along) * 0.5, least_square);
        let h = Vec3::new(h[0][0], h[1][0], h[2][0]) * WORD_UNIT;
        let center = center * WORD_UNIT;
        let unit = pow2(self.frame.unit_exponent);
        // Sums stop at the greatest flux.
        let e = self.frame.phi_exponent;
        let phi = exact::min(flux, pow2(MAX_SUM_EXPONENT - e)) * pow2(e);
        let merged = LightMoments {
            phi,
            c: self.frame.origin + flush3(center, least_length) * unit,
            across: exact::sqrt(across) * unit,
            along: exact::sqrt(along) * unit,
            m: mean,
            h: flush3(h, least_length) * unit,
        };
        if shines { merged } else { LightMoments::EMPTY }
    }
}
